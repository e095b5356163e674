// SPDX-License-Identifier: MIT
// A vertex and its neighbours: the paper's "vertex mask-like structure", subdivided in place, for the depth heuristics
// of either scheme. [mueller2000, 4.1; C21]
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "data/control_mesh.h"
#include "fast/mesh/adjacency.h"
#include "fast/mesh/vec3.h"
#include "fast/rules/prepared_quads.h"
#include "fast/rules/surface_vertex.h"
#include "fast/rules/vertex_limit.h"

namespace limitcheck::fast {

/// A vertex with its one-ring in counter-clockwise order, closed inside, open on the boundary.
///
/// One subdivision step maps the ring of a vertex to the ring of the same vertex one level deeper, so that it
/// can be repeated in place with two temporaries: [claim C29]
///
///      r2 ---- r1        inside               v'   = (1 - a) v + a / n sum r_i
///     /  \    /  \                            r_i' = (3 v + 3 r_i + r_{i-1} + r_{i+1}) / 8
///    /    \  /    \      boundary             v'   = 3/4 v + (r_0 + r_K) / 8
///   r3 --- v ---- r0                          r_0' = (v + r_0) / 2, r_K' likewise,
///    \    /  \    /                           the others as inside
///     \  /    \  /
///      r4 ---- r5
///
/// Memory is kept from vertex to vertex. All in double. [C10-C12, D1]
class Ring {
 public:
  /// Copies the neighbourhood of vertex v, starting from its canonical half-edge. A vertex without faces
  /// gives an empty ring.
  void gather(const data::ControlMesh& mesh, const Adjacency& adjacency, std::int32_t v,
              VertexKind kind = VertexKind::kPlain);
  /// The same from points given by the caller: n >= 3 for a closed ring, n >= 2 for an open one.
  void assign(const Point3& centre, std::vector<Point3> points, bool open);

  const Point3& centre() const { return centre_; }
  const std::vector<Point3>& points() const { return points_; }
  bool open() const { return open_; }
  /// Number of triangles (centre, r_i, r_{i+1}).
  int faces() const { return static_cast<int>(points_.size()) - (open_ && !points_.empty() ? 1 : 0); }

  void subdivide();

  /// Limit position and unit normal of the centre, from the tangents of vertex_limit.h by the rule of limit.h. On the
  /// boundary with six or more faces the surface has no tangent plane [claim D5], and this is the plane of the masks'
  /// eigenvector. [eq. 3; claims C14, D1, D12; erratum 1]
  ///   degenerate   whether the tangents vanish or are parallel
  ///   farthest     no point of the ring is farther from the centre, if that is known: it saves looking
  SurfaceVertex<double> limit_vertex(bool* degenerate = nullptr,
                                     double farthest = std::numeric_limits<double>::infinity()) const;

  /// Unit normal of triangle (centre, r_i, r_{i+1}); zero if it has no area.
  Point3 face_normal(int i) const;
  /// The smallest cosine between `normal` and the normals of the triangles with area; 1 if there is none.
  double cone_cosine(const Point3& normal) const;

 private:
  Point3 centre_;
  std::vector<Point3> points_;
  bool open_ = false;
  VertexKind kind_ = VertexKind::kPlain;
  RingWeightTable<double> weights_;
  mutable DartWeightTable<double> darts_;
};

/// As Ring, of Catmull-Clark's scheme. A vertex without faces is a ring without points.
class QuadRing {
 public:
  void gather(const QuadMesh& mesh, const SemiSharp& semi_sharp, std::int32_t v);

  const Point3& centre() const { return own_.star.centre; }
  int faces() const { return own_.star.faces; }

  /// Semi-sharp edges become less sharp. In a mesh that was cut by a step the first one does nothing: its
  /// star is that after the step already.
  void subdivide();

  /// Limit position and unit normal of the centre; `degenerate`: whether the tangents vanish or are parallel. [D12]
  SurfaceVertex<double> limit_vertex(bool* degenerate = nullptr, double farthest = 0);

  /// The smallest cosine between `normal` and the normals of the faces with area; 1 if there is none.
  double cone_cosine(const Point3& normal) const;

 private:
  std::span<const StarTags> tags_;
  int taken_ = 0;                    // steps that the mesh has taken before
  OwnQuadStar<double> own_, final_;  // final_: when nothing about it is semi-sharp any more
  StarWeightTable<double> weights_;
};

}  // namespace limitcheck::fast
