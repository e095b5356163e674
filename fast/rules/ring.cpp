// SPDX-License-Identifier: MIT
#include "fast/rules/ring.h"

#include <algorithm>
#include <cmath>
#include <limits>
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
  points_.clear();
  open_ = adjacency.on_boundary(v);
  adjacency.for_each_neighbour(v, [&](std::int32_t w) { points_.push_back(to_point(mesh.positions[w])); });
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
  bool without_tangents = true;
  const Point3 normal = points_.empty()
                            ? Point3{0, 0, 1}
                            : vertex_normal<double>(limit(), centre_, points_, open_, without_tangents,
                                                    std::numeric_limits<double>::infinity(), kind_);
  if (degenerate != nullptr) *degenerate = without_tangents;
  return normal;
}

Point3 Ring::face_normal(int i) const {
  const std::size_t a = static_cast<std::size_t>(i), b = a + 1 == points_.size() ? 0 : a + 1;
  return unit_or_zero(cross(points_[a] - centre_, points_[b] - centre_));
}

double Ring::cone_cosine(const Point3& normal) const {
  double smallest = 1;
  for (int i = 0; i < faces(); ++i) {
    const Point3 face = face_normal(i);
    if (face != Point3{}) smallest = std::min(smallest, dot(face, normal));
  }
  return smallest;
}

}  // namespace limitcheck::fast
