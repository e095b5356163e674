// SPDX-License-Identifier: MIT
#include "fast/rules/ring.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fast/rules/vertex_normal.h"

namespace limitcheck::fast {

namespace {

Point3 unit_or_zero(const Point3& a) {
  const double size = length(a);
  return size > 0 && std::isfinite(size) ? (1 / size) * a : Point3{};
}

}  // namespace

void Ring::gather(const data::ControlMesh& mesh, const Adjacency& adjacency, std::int32_t v,
                  VertexKind kind) {
  kind_ = kind;
  centre_ = to_point(mesh.positions[v]);
  points_.resize(static_cast<std::size_t>(adjacency.valence(v)));
  open_ = adjacency.on_boundary(v);
  Point3* next = points_.data();
  adjacency.for_each_neighbour(v, [&](std::int32_t w) { *next++ = to_point(mesh.positions[w]); });
  if (!points_.empty()) weights_.make(points_.size(), open_);
}

void Ring::assign(const Point3& centre, std::vector<Point3> points, bool open) {
  kind_ = VertexKind::kPlain;
  centre_ = centre;
  points_ = std::move(points);
  open_ = open;
  weights_.make(points_.size(), open_);
}

void Ring::subdivide() {
  if (!points_.empty()) subdivide_in_place<double>(centre_, points_, open_, kind_);
}

VertexLimit<double> Ring::limit() const {
  return limit_of_kind<double>(centre_, points_, open_, kind_, weights_.of(points_.size(), open_), darts_);
}

Point3 Ring::limit_position() const {
  return points_.empty() ? centre_ : limit().position;
}

Point3 Ring::limit_normal(bool* degenerate) const {
  return limit_vertex(degenerate).normal;
}

SurfaceVertex<double> Ring::limit_vertex(bool* degenerate, double farthest) const {
  bool without_tangents = true;
  SurfaceVertex<double> vertex{centre_, {0, 0, 1}};
  if (!points_.empty()) {
    const VertexLimit<double> at = limit();
    vertex = {at.position,
              vertex_normal<double>(at, centre_, points_, open_, without_tangents, farthest, kind_)};
  }
  if (degenerate != nullptr) *degenerate = without_tangents;
  return vertex;
}

Point3 Ring::face_normal(int i) const {
  const std::size_t a = static_cast<std::size_t>(i), b = a + 1 == points_.size() ? 0 : a + 1;
  return unit_or_zero(cross(points_[a] - centre_, points_[b] - centre_));
}

double Ring::cone_cosine(const Point3& normal) const {
  double smallest = 1;
  if (points_.empty()) return smallest;
  Point3 edge = points_.front() - centre_;
  for (std::size_t i = 1, last = open_ ? points_.size() - 1 : points_.size(); i <= last; ++i) {
    const Point3 next = points_[i == points_.size() ? 0 : i] - centre_,
                 face = unit_or_zero(cross(edge, next));
    if (face != Point3{}) smallest = std::min(smallest, dot(face, normal));
    edge = next;
  }
  return smallest;
}

}  // namespace limitcheck::fast
