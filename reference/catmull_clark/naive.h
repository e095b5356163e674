// SPDX-License-Identifier: MIT
// The recursive subdivider of section 4 with Catmull-Clark's rules: every quad by itself, four sub-quads down
// to the depth, limit point and normal at the leaves. Most points are computed several times; that is its
// point. Near semi-sharp tags a quad is refined together with its neighbours, until they are gone. [C18, C21]
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "data/faces.h"
#include "reference/mesh/sharp_tags.h"
#include "reference/number/vec3.h"
#include "reference/point/surface_point.h"

namespace limitcheck::reference::catmull_clark {

template <class N>
struct QuadMesh;

/// A corner of a leaf: lattice point (i, j) of the quad.
template <class N>
struct LeafCorner {
  Vec3<N> position, normal;
  NormalKind normal_kind;
  std::int32_t i, j;
};

/// Counter-clockwise like its control face.
template <class N>
using LeafQuad = std::array<LeafCorner<N>, 4>;

/// Built for double, Decimal50, Decimal100.
template <class N>
class NaiveSubdivider {
 public:
  /// Throws data::ArgumentError if the mesh is not manifold (Topology) or the tags do not fit (Sharpness).
  NaiveSubdivider(data::Faces faces, std::vector<Vec3<N>> positions, const SharpTags& tags = {});

  std::size_t face_count() const;

  /// Subdivides a quad (corner 0), or the sub-quad at a corner of another face, and hands its leaves to
  /// `emit`, depth first. A quad has 4^depth of them, 2^depth + 1 lattice points a side; a sub-quad is itself
  /// the result of a step and is subdivided once less. Any number of threads may do so at once.
  ///   throws   data::ArgumentError: no such face or corner, depth < 0 or > 30, a face that is no quad at
  ///            depth 0
  void tessellate(std::size_t face, std::size_t corner, int depth,
                  const std::function<void(const LeafQuad<N>&)>& emit) const;

 private:
  std::shared_ptr<const QuadMesh<N>> mesh_;
};

}  // namespace limitcheck::reference::catmull_clark
