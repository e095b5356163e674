// SPDX-License-Identifier: MIT
// Infinitely sharp edges of a mesh made boundaries: the surface is the same, exactly, in either scheme.
#pragma once

#include <cstdint>
#include <vector>

#include "fast/mesh/adjacency.h"
#include "fast/mesh/sharp_polygons.h"
#include "fast/mesh/vertex_kind.h"

namespace limitcheck::fast {

/// What became of a mesh.
struct SharpCut {
  std::vector<std::int32_t> twin;   // per half-edge: its twin before the cut, -1 elsewhere; or empty: no cut
  std::vector<std::int32_t> uncut;  // per vertex: the one that it is a copy of, or itself
  std::vector<VertexKind> kinds;    // per vertex
};

/// Cuts along all edges that are always sharp: each side has a copy of their points. A vertex that is always
/// sharp, or has three sharp edges and more, is held in each of its sectors; one with a single sharp edge is
/// a dart.
///   sharp   of the same faces, in the same order
template <int K>
SharpCut cut_sharp(BasicAdjacency<K>& adjacency, const SharpPolygons& sharp);

extern template SharpCut cut_sharp(BasicAdjacency<3>&, const SharpPolygons&);
extern template SharpCut cut_sharp(BasicAdjacency<4>&, const SharpPolygons&);

}  // namespace limitcheck::fast
