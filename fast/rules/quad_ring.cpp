// SPDX-License-Identifier: MIT
#include "fast/rules/quad_ring.h"

#include <algorithm>
#include <cmath>

namespace limitcheck::fast {

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

void QuadRing::gather_final() {
  final_.resize(own_.star.faces, own_.star.open, own_.star.kind);
  final_.star.centre = own_.star.centre;
  std::copy(own_.star.ring, own_.star.ring + own_.star.size(), final_.star.ring);
  for (const StarTags& tags : tags_) final_.subdivide(&tags);
}

LimitFrame<double> QuadRing::limit() {
  gather_final();
  return star_limit(final_.star, weights_.of(final_.star.faces, final_.star.open, final_.star.kind));
}

Point3 QuadRing::limit_position() {
  return faces() == 0 ? centre() : limit().position;
}

Point3 QuadRing::limit_normal(bool* degenerate) {
  return limit_vertex(degenerate).normal;
}

SurfaceVertex<double> QuadRing::limit_vertex(bool* degenerate, double /*farthest*/) {
  bool without_tangents = true;
  SurfaceVertex<double> vertex{centre(), {0, 0, 1}};
  if (faces() > 0) {
    const LimitFrame<double> at = limit();
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
