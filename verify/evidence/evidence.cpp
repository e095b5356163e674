// SPDX-License-Identifier: MIT
#include "verify/evidence/evidence.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

#include "verify/row/bounds.h"

namespace limitcheck::verify {

Result Evidence::result(std::string check) const {
  Result r;
  r.subject = subject;
  r.mesh = mesh_name;
  r.check = std::move(check);
  r.depth = lattice.depth();
  r.in_float = capabilities.precision == LC_FLOAT32;
  r.scheme = lattice.scheme();
  r.weights = reference.weights();
  r.status = Status::kHeld;
  return r;
}

Witness Evidence::at_vertex(std::int64_t vertex) const {
  Witness w = at(tessellation.place(vertex));
  w.vertex = vertex;
  return w;
}

Witness Evidence::at_use(const Use& use) const {
  if (use.side == Lattice::kNone || reference.sides().none()) return at_vertex(use.vertex);
  Witness w = at(reference.sides().place(use.side));
  w.vertex = use.vertex;
  return w;
}

double Evidence::normal_bound_at(Sides::Id side) const {
  return std::max(
      normal_bound(capabilities.precision, reference.steps()),
      conditioned_normal_bound(capabilities.precision, magnitude, reference.normal_condition(side)));
}

Witness Evidence::at_point(Lattice::Id id) const {
  return at(lattice.place(id));
}

Witness Evidence::at(const Place& p) const {
  Witness w;
  w.face = p.face;
  if (p.face >= 0 && p.face < lattice.face_count() && lattice.domain(p.face).parts() > 1) w.corner = p.corner;
  w.l1 = fraction(p.i, p.denominator);
  w.l2 = fraction(p.j, p.denominator);
  return w;
}

bool Evidence::place(std::int64_t triangle, std::array<Lattice::Coordinates, 3>& corners) const {
  if (!tessellation.triangle_ok(triangle)) return false;
  const std::int32_t face = tessellation.triangle_face()[triangle];
  const auto& vertices = tessellation.triangles()[triangle];
  for (int k = 0; k < 3; ++k) {
    const Lattice::Id id = point[vertices[k]];
    if (id == Lattice::kNone) return false;
    const auto coordinates = lattice.in_face(id, face);
    if (!coordinates) return false;
    corners[k] = *coordinates;
  }
  lattice.domain(face).share_part(corners, lattice.scale());
  return true;
}

std::vector<std::int32_t> deepest_near(const Evidence& e) {
  std::vector<std::int32_t> depth(e.face_depth.begin(), e.face_depth.end());
  for (const Lattice::Edge& edge : e.lattice.edges()) {
    if (edge.on_boundary()) continue;
    for (int s = 0; s < 2; ++s)
      if (std::int32_t& its = depth[edge.face[s]]; its >= 0)
        its = std::max(its, e.face_depth[edge.face[1 - s]]);
  }
  return depth;
}

bool is_finite(const Tessellation& t, std::int64_t v) {
  return is_finite(t.position(v)) && (!t.has_normals() || is_finite(t.normal(v)));
}

std::int64_t not_finite(const Tessellation& t) {
  std::int64_t count = 0;
  for (std::int64_t v = 0; v < t.vertex_count(); ++v) count += !is_finite(t, v);
  return count;
}

std::vector<Lattice::Id> locate(const Tessellation& tessellation, const Lattice& lattice) {
  std::vector<Lattice::Id> ids(tessellation.vertex_count());
  tbb::parallel_for(std::size_t{0}, ids.size(), [&](std::size_t v) {
    ids[v] = lattice.id(tessellation.place(static_cast<std::int64_t>(v)));
  });
  return ids;
}

std::vector<Use> find_uses(const Tessellation& t, const std::vector<Lattice::Id>& point,
                           const Lattice& lattice, const Sides& sides) {
  std::vector<Use> uses;
  uses.reserve(point.size());
  if (!sides.none()) {
    for (std::int64_t k = 0; k < t.triangle_count(); ++k) {
      if (!t.triangle_ok(k)) continue;
      const std::int32_t face = t.triangle_face()[k];
      for (const std::int64_t v : t.triangles()[k])
        if (point[v] != Lattice::kNone && lattice.in_face(point[v], face))
          uses.push_back({v, sides.of(point[v], face)});
    }
    const auto order = [](const Use& use) { return std::pair(use.vertex, use.side); };
    std::sort(uses.begin(), uses.end(), [&](const Use& a, const Use& b) { return order(a) < order(b); });
    const auto same = [&](const Use& a, const Use& b) { return order(a) == order(b); };
    uses.erase(std::unique(uses.begin(), uses.end(), same), uses.end());
  }
  std::vector<bool> used(point.size(), false);
  for (const Use& use : uses) used[use.vertex] = true;
  for (std::size_t v = 0; v < point.size(); ++v)
    if (!used[v]) {
      const auto k = static_cast<std::int64_t>(v);
      uses.push_back({k, point[v] == Lattice::kNone ? Lattice::kNone : sides.of(point[v], t.place(k).face)});
    }
  if (!sides.none())
    std::stable_sort(uses.begin(), uses.end(),
                     [](const Use& a, const Use& b) { return a.vertex < b.vertex; });
  return uses;
}

}  // namespace limitcheck::verify
