// SPDX-License-Identifier: MIT
// How deep each control face of Catmull-Clark's scheme is subdivided. [mueller2000, 4.1; C21]
#pragma once

#include <array>
#include <span>

#include "fast/plan/depth.h"
#include "fast/plan/faces.h"
#include "fast/rules/ring.h"

namespace limitcheck::fast {

/// Of Catmull-Clark's: a vertex of the mesh of quads is what vertices are numbered by.
struct QuadSurface {
  using VertexRing = QuadRing;

  const QuadFaces& faces;
  const SemiSharp& semi_sharp;
  const QuadAdjacency& adjacency = faces.mesh->adjacency;

  std::size_t face_count() const { return static_cast<std::size_t>(faces.size()); }
  std::span<const std::array<double, 3>> positions() const { return faces.mesh->positions; }
  template <class Visit>
  void for_each_corner(std::int32_t f, Visit&& visit) const {
    for (std::size_t c = faces.first[f]; c < faces.first[f + 1]; ++c)
      visit(faces.vertex(static_cast<std::int32_t>(c)));
  }
  void gather(QuadRing& ring, std::int32_t v) const { ring.gather(*faces.mesh, semi_sharp, v); }
};

/// Of Catmull-Clark's scheme. Keeps references to the faces and tags, which must outlive it.
class QuadDepthHeuristics : public BasicDepthHeuristics<QuadSurface> {
 public:
  QuadDepthHeuristics(const QuadFaces& faces, const SemiSharp& semi_sharp, int max_depth = 5)
      : BasicDepthHeuristics(QuadSurface{faces, semi_sharp}, max_depth) {}
  QuadDepthHeuristics(QuadFaces&&, const SemiSharp&, int = 5) = delete;
  QuadDepthHeuristics(const QuadFaces&, SemiSharp&&, int = 5) = delete;
};

extern template class BasicDepthHeuristics<QuadSurface>;

}  // namespace limitcheck::fast
