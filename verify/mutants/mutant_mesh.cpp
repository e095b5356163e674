// SPDX-License-Identifier: MIT
#include "verify/mutants/mutant_rules.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "data/cut_out.h"
#include "reference/catmull_clark/refine.h"
#include "reference/loop/refine.h"

namespace limitcheck::verify {
namespace {

using reference::Sector, reference::Topology;
using V = MutantRules::V;

// Four for each triangle: its directions stay those of the triangle in those at the corners.
data::Faces refined_triangles(const Topology& topology) {
  const auto edges = static_cast<std::int32_t>(topology.vertex_count());
  data::Faces refined;
  for (std::size_t f = 0; f < topology.faces().size(); ++f) {
    const auto c = topology.faces()[f];
    const auto edge = [&](std::size_t k) { return edges + topology.edge(f, k); };
    refined.push_back({c[0], edge(0), edge(2)});
    refined.push_back({edge(0), c[1], edge(1)});
    refined.push_back({edge(2), edge(1), c[2]});
    refined.push_back({edge(1), edge(2), edge(0)});
  }
  return refined;
}

// Of a vertex whose rule stays.
//   faces   around it, in the order of the normals asked for
MutantLimit lasting_limit(const MutantRules& rules, const MutantMesh& mesh, std::int32_t v, int depth,
                          std::span<const std::int32_t> faces) {
  const Sector sector = mesh.topology.sector(v);
  const std::size_t count = sector.faces.size();
  const MutantRing ring = MutantRing::of(mesh.topology, mesh.points, v);
  const bool held = mesh.tags.vertex(v) == MutantTags::kForEver;
  std::vector<std::size_t> sharp;  // which neighbours lie across edges that stay sharp
  for (std::size_t i = 0; i < sector.edges.size(); ++i)
    if (mesh.tags.lasts(mesh.topology, sector.edges[i])) sharp.push_back(i);
  if (!held && sharp.empty()) return {rules.limit(ring, depth), {rules.normal(ring)}};
  if (!held && sharp.size() == 1) {
    const MutantRing turned = ring.turned(sharp[0]);
    return {rules.is("dart_limit_smooth") ? rules.limit(ring, depth) : rules.dart_limit(turned),
            {rules.is("dart_normal_smooth") ? rules.normal(ring) : rules.dart_normal(turned)}};
  }

  // A crease is (2/3, 1/6, 1/6) in either scheme, a corner stays.
  const bool crease = !held && sharp.size() == 2;
  MutantLimit result{ring.c, {}};
  if (crease || rules.is("corner_limit_moved")) {
    const V ends = ring.e[sharp.empty() ? 0 : sharp.front()] + ring.e[sharp.empty() ? 1 : sharp.back()];
    result.position = ring.c * (2. / 3) + ends * (1. / 6);
  }
  if (sharp.empty()) {
    result.normals = {rules.corner_normal(ring)};
    return result;
  }
  std::vector<V> normals(count);
  const std::size_t stretches = sector.closed ? sharp.size() : sharp.size() - 1;
  for (std::size_t k = 0; k < stretches; ++k) {
    const std::size_t first = sharp[k], next = k + 1 < sharp.size() ? sharp[k + 1] : sharp[0] + count;
    const MutantRing side = ring.part(first, next - first);
    const V n = crease ? rules.normal(side) : rules.corner_normal(side);
    for (std::size_t i = first; i < next; ++i) normals[i % count] = n;
  }
  if (rules.is("normal_of_the_other_side"))
    std::rotate(normals.begin(), normals.begin() + static_cast<std::ptrdiff_t>(count / 2), normals.end());
  if (rules.is("one_normal_for_all_sides")) normals.assign(count, V(normals[0]));
  if (rules.is("mean_of_all_sides"))
    normals.assign(count, unit_or_up(std::accumulate(normals.begin(), normals.end(), V{})));
  if (stretches == 1) {
    result.normals = {normals[0]};
    return result;
  }
  for (const std::int32_t f : faces) {
    const auto at = std::find(sector.faces.begin(), sector.faces.end(), f) - sector.faces.begin();
    result.normals.push_back(normals[static_cast<std::size_t>(at)]);
  }
  return result;
}

MutantLimit limit_of(const MutantRules& rules, const MutantMesh& mesh, std::int32_t v, int depth) {
  const Sector sector = mesh.topology.sector(v);
  if (sector.faces.empty()) return {mesh.points[v], {{0, 0, 1}}};
  if (mesh.tags.none() || mesh.tags.plain(mesh.topology, v)) {
    const MutantRing ring = MutantRing::of(mesh.topology, mesh.points, v);
    return {rules.limit(ring, depth), {rules.normal(ring)}};
  }
  if (mesh.tags.settled(mesh.topology, v)) return lasting_limit(rules, mesh, v, depth, sector.faces);
  // The vertex alone, with the faces around, through the steps in which it has tags left: none that falls is
  // above 10.
  std::vector<std::int32_t> faces(sector.faces.begin(), sector.faces.end());
  MutantMesh near = mesh.around(faces, v);
  std::iota(faces.begin(), faces.end(), 0);
  for (int step = 0; step < 16 && !near.tags.settled(near.topology, v); ++step) {
    for (std::int32_t& f : faces) {
      const auto corners = near.topology.faces()[f];
      f = 4 * f + static_cast<std::int32_t>(std::find(corners.begin(), corners.end(), v) - corners.begin());
    }
    near = near.refined(rules, 1, depth).around(faces, v);
    std::iota(faces.begin(), faces.end(), 0);
  }
  return lasting_limit(rules, near, v, depth, faces);
}

}  // namespace

MutantRing MutantRing::of(const Topology& topology, const std::vector<V>& points, std::int32_t v) {
  const Sector sector = topology.sector(v);
  MutantRing ring{points[v], {}, {}, sector.closed};
  for (const std::int32_t e : sector.neighbours) ring.e.push_back(points[e]);
  for (const std::int32_t f : sector.faces) {
    const auto quad = topology.faces()[f];
    if (quad.size() != 4) continue;
    const auto at = std::find(quad.begin(), quad.end(), v) - quad.begin();
    ring.f.push_back(points[quad[static_cast<std::size_t>(at + 2) % 4]]);
  }
  return ring;
}

MutantRing MutantRing::part(std::size_t first, std::size_t faces) const {
  MutantRing result{c, {}, {}, false};
  for (std::size_t i = 0; i <= faces; ++i) result.e.push_back(e[(first + i) % e.size()]);
  for (std::size_t i = 0; i < faces && !f.empty(); ++i) result.f.push_back(f[(first + i) % f.size()]);
  return result;
}

MutantRing MutantRing::turned(std::size_t first) const {
  MutantRing result = *this;
  if (!closed) return result;
  for (auto* list : {&result.e, &result.f})
    if (!list->empty())
      std::rotate(list->begin(), list->begin() + static_cast<std::ptrdiff_t>(first % list->size()),
                  list->end());
  return result;
}

V MutantRing::facets() const {
  V sum{};
  for (std::size_t i = 0; i < faces(); ++i) sum += cross(e[i] - c, e[(i + 1) % e.size()] - c);
  return sum;
}

V unit_or_up(const V& n) {
  const double size = std::hypot(n.x, n.y, n.z);
  return size > 0 ? n * (1 / size) : V{0, 0, 1};
}

MutantMesh MutantMesh::refined(const MutantRules& rules, int step, int depth) const {
  MutantRules::Points next = rules.refine(topology, points, tags, step, depth);
  const bool quads = next.size() > points.size() + topology.edges().size();
  Topology finer(next.size(),
                 quads ? reference::catmull_clark::refined_faces(topology) : refined_triangles(topology));
  MutantTags its = tags.refined(topology, finer);
  return {std::move(finer), std::move(next), std::move(its)};
}

MutantMesh MutantMesh::around(std::vector<std::int32_t> faces, std::int32_t& v) const {
  faces = reference::support_of(std::move(faces), topology, data::Creasing::kUniform);
  const data::CutOut part = data::cut_out(topology.faces(), faces);
  Topology local(part.vertices.size(), part.faces);
  MutantTags its = tags.of_part(topology, local, part.vertices);
  v = static_cast<std::int32_t>(std::find(part.vertices.begin(), part.vertices.end(), v) -
                                part.vertices.begin());
  return {std::move(local), part.of(points), std::move(its)};
}

MutantLevel::MutantLevel(const data::ControlMesh& control, data::Scheme scheme, const MutantRules& rules,
                         int depth)
    : control_(control.faces),
      scheme_(scheme),
      depth_(depth),
      mesh_{Topology(control.positions.size(), control.faces), reference::positions_of<double>(control), {}} {
  if (!control.sharpness.empty())
    mesh_.tags = MutantTags(control.sharpness, mesh_.topology, rules.mutation());
  for (int step = 0; step < depth; ++step) {
    MutantMesh next = mesh_.refined(rules, step, depth);
    const bool last = step + 1 == depth;
    if (last && ((step > 0 && rules.is("one_step_missing")) || (depth % 2 == 1 && rules.is("odd_depths"))))
      std::copy(mesh_.points.begin(), mesh_.points.end(), next.points.begin());
    mesh_ = std::move(next);
  }
  for (std::size_t v = 0; v < mesh_.points.size(); ++v)
    limits_.push_back(limit_of(rules, mesh_, static_cast<std::int32_t>(v), depth));
  if (rules.is("limits_smoothed")) {
    const std::vector<MutantLimit> before = limits_;
    for (const auto& e : mesh_.topology.edges())
      for (const auto& [to, from] : {std::pair(e.a, e.b), std::pair(e.b, e.a)})
        limits_[to].position += (before[from].position - before[to].position) *
                                (1e-3 / static_cast<double>(mesh_.topology.ring(to).size()));
  }
}

MutantLevel::Corner MutantLevel::corner(std::size_t control_face, FaceDomain::Point p) const {
  const bool triangles = scheme_ == data::Scheme::kLoop;
  const auto corners = static_cast<int>(control_[control_face].size());
  std::int64_t n = FaceDomain(scheme_, corners).denominator(std::int64_t{1} << depth_);
  std::size_t cell = control_face, first = triangles ? 4 * cell : control_.first_corner(cell);
  if (!triangles && corners != 4) cell = first + static_cast<std::size_t>(p.part), first = 4 * cell;
  for (; n > 1; first = 4 * cell) {  // down to the child that has the point
    n /= 2;
    const bool right = p.i > n, up = p.j > n;
    if (!triangles) {
      cell = first + (up ? (right ? 2 : 3) : (right ? 1 : 0));
      p = {right ? p.i - n : p.i, up ? p.j - n : p.j};
    } else if (right || up) {
      cell = first + (right ? 1 : 2);
      p = {right ? p.i - n : p.i, up ? p.j - n : p.j};
    } else if (p.i + p.j > n) {
      cell = first + 3;
      p = {n - p.i, n - p.j};
    } else {
      cell = first;
    }
  }
  const auto vertices = mesh_.topology.faces()[cell];
  const std::size_t k =
      triangles ? static_cast<std::size_t>(p.i + 2 * p.j) : static_cast<std::size_t>(p.j > 0 ? 3 - p.i : p.i);
  return {static_cast<std::int32_t>(cell), vertices[k]};
}

const V& MutantLevel::normal(const Corner& at) const {
  const std::vector<V>& normals = limits_[at.vertex].normals;
  if (normals.size() == 1) return normals[0];
  const auto faces = mesh_.topology.sector(at.vertex).faces;
  return normals[static_cast<std::size_t>(std::find(faces.begin(), faces.end(), at.face) - faces.begin())];
}

}  // namespace limitcheck::verify
