// SPDX-License-Identifier: MIT
// The ring of a vertex of a mesh of quads in double, for the depth heuristics. [mueller2000, 4.1; C21]
#pragma once

#include <cstdint>
#include <span>

#include "fast/mesh/point3.h"
#include "fast/rules/prepared_quads.h"

namespace limitcheck::fast {

/// As Ring, of Catmull-Clark's scheme. A vertex without faces is a ring without points.
class QuadRing {
 public:
  void gather(const QuadMesh& mesh, const SemiSharp& semi_sharp, std::int32_t v);

  const Point3& centre() const { return own_.star.centre; }
  int faces() const { return own_.star.faces; }

  /// Semi-sharp edges become less sharp. In a mesh that was cut by a step the first one does nothing: its
  /// star is that after the step already.
  void subdivide();

  Point3 limit_position();
  /// Unit limit normal of the centre; `degenerate`: whether the tangents vanish or are parallel. [D12]
  Point3 limit_normal(bool* degenerate = nullptr);

  /// Both.
  SurfaceVertex<double> limit_vertex(bool* degenerate = nullptr, double farthest = 0);

  /// The smallest cosine between `normal` and the normals of the faces with area; 1 if there is none.
  double cone_cosine(const Point3& normal) const;

 private:
  /// The star when nothing about it is semi-sharp any more.
  void gather_final();
  LimitFrame<double> limit();

  std::span<const StarTags> tags_;
  int taken_ = 0;  // steps that the mesh has taken before
  OwnQuadStar<double> own_, final_;
  StarWeightTable<double> weights_;
};

}  // namespace limitcheck::fast
