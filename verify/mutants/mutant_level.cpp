// SPDX-License-Identifier: MIT
// The points of the model: by the rules that may be wrong, or those of `naive`.
#include <algorithm>
#include <cmath>
#include <utility>

#include "reference/catmull_clark/recursion.h"
#include "reference/loop/refine.h"
#include "verify/host/host.h"
#include "verify/mutants/mutant_rules.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {

MutantLevel::MutantLevel(const data::ControlMesh& control, data::Scheme scheme, const MutantRules& rules,
                         int depth)
    : depth_(depth), n_(std::int64_t{1} << depth) {
  std::size_t count = 0;
  for (std::size_t f = 0; f < control.faces.size(); ++f) {
    domains_.emplace_back(scheme, static_cast<int>(control.faces[f].size()));
    first_.push_back(count);
    count += static_cast<std::size_t>(domains_[f].point_count(n_));
  }
  limits_.resize(count);
  auto positions = reference::positions_of<double>(control);
  if (!control.sharpness.empty()) {
    Session session(*lc_subject_naive(), control, "", Session::Input::kValid, scheme);
    const Tessellation all = session.tessellate(depth);
    const auto point = [](const std::array<double, 3>& p) { return V{p[0], p[1], p[2]}; };
    for (std::int64_t v = 0; v < all.vertex_count(); ++v) {
      const Place p = all.place(v);
      limits_[number(static_cast<std::size_t>(p.face), point_of(p))] = {point(all.position(v)),
                                                                        point(all.normal(v))};
    }
  } else if (scheme == data::Scheme::kLoop) {
    follow(reference::RefinedMesh<double>(control), rules,
           [](const auto& mesh, std::size_t f, const FaceDomain::Point& p) {
             return mesh.vertex(f, static_cast<int>(p.i), static_cast<int>(p.j));
           });
  } else {
    follow(reference::catmull_clark::RefinedMesh<double>(control.faces, std::move(positions)), rules,
           [](const auto& mesh, std::size_t f, const FaceDomain::Point& p) {
             return mesh.vertex(f, static_cast<std::size_t>(p.part), static_cast<int>(p.i),
                                static_cast<int>(p.j));
           });
  }
}

// The mesh says who is next to whom, the rules where points go.
template <class Refined, class VertexAt>
void MutantLevel::follow(Refined mesh, const MutantRules& rules, VertexAt vertex_at) {
  points_ = mesh.positions();
  for (int step = 0; step < depth_; ++step) {
    std::vector<V> next = rules.refine(mesh.topology(), points_, step, depth_);
    const bool last = step + 1 == depth_;
    if (last && ((step > 0 && rules.is("one_step_missing")) || (depth_ % 2 == 1 && rules.is("odd_depths"))))
      std::copy(points_.begin(), points_.end(), next.begin());
    points_ = std::move(next);
    mesh.refine();
  }
  topology_.emplace(mesh.topology());
  std::vector<MutantRules::Limit> limits;
  for (std::size_t v = 0; v < points_.size(); ++v)
    limits.push_back(topology_->sector(static_cast<std::int32_t>(v)).faces.empty()
                         ? MutantRules::Limit{points_[v], {}}
                         : rules.limit(ring_of(v), depth_));
  if (rules.is("limits_smoothed")) {
    const std::vector<MutantRules::Limit> before = limits;
    for (const reference::Edge& e : topology_->edges())
      for (const auto& [to, from] : {std::pair(e.a, e.b), std::pair(e.b, e.a)})
        limits[to].position += (before[from].position - before[to].position) *
                               (1e-3 / static_cast<double>(topology_->ring(to).size()));
  }
  vertex_.resize(limits_.size());
  for (std::size_t f = 0; f < domains_.size(); ++f)
    domains_[f].for_each_point(n_, [&](const FaceDomain::Point& p) {
      const std::int32_t v = vertex_at(mesh, f, p);
      vertex_[number(f, p)] = v;
      limits_[number(f, p)] = limits[static_cast<std::size_t>(v)];
    });
}

MutantRing MutantLevel::ring_of(std::size_t v) const {
  const reference::Sector sector = topology_->sector(static_cast<std::int32_t>(v));
  MutantRing ring;
  ring.point = points_[v];
  ring.on_boundary = !sector.closed;
  for (const std::int32_t e : sector.neighbours) ring.edges.push_back(points_[e]);
  for (const std::int32_t f : sector.faces)
    if (topology_->faces()[f].size() == 4)
      ring.faces.push_back(
          points_[reference::catmull_clark::opposite(*topology_, f, static_cast<std::int32_t>(v))]);
  return ring;
}

MutantRing MutantLevel::ring(std::size_t face, const FaceDomain::Point& p, std::size_t first) const {
  MutantRing ring = ring_of(static_cast<std::size_t>(vertex_[number(face, p)]));
  if (ring.on_boundary) return ring;
  for (auto* list : {&ring.edges, &ring.faces})
    if (!list->empty())
      std::rotate(list->begin(), list->begin() + static_cast<std::ptrdiff_t>(first % list->size()),
                  list->end());
  return ring;
}

}  // namespace limitcheck::verify
