// SPDX-License-Identifier: MIT
#include "fast/rules/ring.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fast/rules/limit.h"

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

SurfaceVertex<double> Ring::limit_vertex(bool* degenerate, double farthest) const {
  bool without_tangents = true;
  SurfaceVertex<double> vertex{centre_, {0, 0, 1}};
  if (!points_.empty()) {
    const VertexLimit<double> at =
        limit_of_kind<double>(centre_, points_, open_, kind_, weights_.of(points_.size(), open_), darts_);
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

void QuadRing::gather(const QuadMesh& mesh, const SemiSharp& semi_sharp, std::int32_t v) {
  taken_ = mesh.steps;
  tags_ = semi_sharp.steps(v);
  const auto position = [&](std::int32_t w) { return to_point(mesh.positions[w]); };
  if (mesh.adjacency.outgoing(v) < 0) {
    own_.resize(0, false, VertexKind::kPlain);
    own_.star.centre = position(v);
    return;
  }
  own_.gather(mesh, v, position);
}

void QuadRing::subdivide() {
  if (faces() == 0) return;
  if (taken_ > 0) {
    --taken_;
    return;
  }
  own_.subdivide(tags_.empty() ? nullptr : tags_.data());
  if (!tags_.empty()) tags_ = tags_.subspan(1);
}

SurfaceVertex<double> QuadRing::limit_vertex(bool* degenerate, double /*farthest*/) {
  bool without_tangents = true;
  SurfaceVertex<double> vertex{centre(), {0, 0, 1}};
  if (faces() > 0) {
    final_.copy(own_);
    for (const StarTags& tags : tags_) final_.subdivide(&tags);
    const LimitFrame<double> at =
        star_limit(final_.star, weights_.of(final_.star.faces, final_.star.open, final_.star.kind));
    vertex = {at.position, star_normal(at, final_, without_tangents)};
  }
  if (degenerate != nullptr) *degenerate = without_tangents;
  return vertex;
}

double QuadRing::cone_cosine(const Point3& normal) const {
  double smallest = 1;
  for (int i = 0; i < faces(); ++i) {
    const Point3 face =
        cross(own_.star.face(i) - own_.star.centre, own_.star.edge(i + 1) - own_.star.edge(i));
    const double size = length(face);
    if (size > 0 && std::isfinite(size)) smallest = std::min(smallest, dot(face, normal) / size);
  }
  return smallest;
}

}  // namespace limitcheck::fast
