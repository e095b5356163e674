// SPDX-License-Identifier: MIT
// The meshes of the model from level to level, and the limits of the vertices of the deepest.
#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "reference/catmull_clark/refine.h"
#include "reference/loop/refine.h"
#include "reference/mesh/cut_mesh.h"
#include "verify/mutants/mutant_rules.h"

namespace limitcheck::verify {
namespace {

using reference::Edge, reference::Rational, reference::Sector, reference::Sharpness, reference::Topology;
using reference::VertexRule, reference::VertexRules, reference::VertexState;
using V = MutantRules::V;
using TaggedMesh = reference::TaggedMesh<double>;

// The sharpness of a mesh in a step with one rule changed.
class MutantTags {
 public:
  MutantTags(const TaggedMesh& mesh, const MutantRules& rules)
      : topology_(mesh.topology), right_(mesh.sharpness), rules_(rules) {}

  // What reference::sharpen asks for.
  bool is_smooth(std::int32_t e) const { return right_.is_smooth(e); }
  bool is_smooth_around(const Topology& topology, std::int32_t v) const {
    return right_.is_smooth_around(topology, v);
  }
  Rational edge_share(const Topology& topology, std::int32_t e) const {
    const Rational& s = right_.edge(e);
    const Edge& ends = topology.edges()[e];
    if (rules_.is("below_1_is_smooth") && s < 1) return 0;
    if (rules_.is("chaikin_without_clamp") && s > 1 && !Sharpness::is_infinite(s) &&
        (right_.half_after_step(topology, e, ends.a) == 0 ||
         right_.half_after_step(topology, e, ends.b) == 0))
      return s;
    return right_.edge_share(topology, e);
  }
  VertexRules rules(const Topology& topology, std::int32_t v) const {
    VertexRules result = right_.rules(topology, v);
    const Sector sector = topology.sector(v);
    const auto is_blended = [&] {
      return result.parent.rule >= VertexRule::kCrease && result.parent.rule != result.child.rule;
    };
    if (rules_.is("no_blend") && is_blended()) result.parent_share = 0;
    if (rules_.is("blend_reversed") && is_blended()) result.parent_share = 1 - result.parent_share;
    if (rules_.is("blend_by_the_sharpest") && is_blended()) result.parent_share = sharpest_that_ends(v);
    for (VertexRules::One* one : {&result.parent, &result.child}) {
      const bool held = right_.vertex(v) > 0;
      if ((rules_.is("dart_as_corner") && one->rule == VertexRule::kDart) ||
          (rules_.is("crease_as_corner") && one->rule == VertexRule::kCrease && sector.closed))
        one->rule = VertexRule::kCorner;
      if (rules_.is("three_edges_are_a_crease") && one->rule == VertexRule::kCorner && !held)
        one->rule = VertexRule::kCrease;
      if (rules_.is("boundary_not_counted") && !sector.closed && !held)
        *one = {VertexRule::kCrease, {sector.neighbours.front(), sector.neighbours.back()}};
    }
    return result;
  }

  //   control   the mesh is the control mesh
  Sharpness refined(const Topology& finer, bool control) const {
    constexpr const char* kOfHalves[] = {"falls_by_2",
                                         "tags_for_one_step",
                                         "tags_of_the_lower_end",
                                         "chaikin_ends_exchanged",
                                         "chaikin_takes_infinite",
                                         "chaikin_takes_half",
                                         "chaikin_by_maximum",
                                         "chaikin_by_sum"};
    if (std::none_of(std::begin(kOfHalves), std::end(kOfHalves), [&](auto name) { return rules_.is(name); }))
      return right_.refined(topology_, finer);
    reference::SharpTags tags;
    tags.creasing = right_.creasing();
    const auto exact = [](const Rational& s) { return reference::Parameter::parse(s.str()); };
    const auto vertices = static_cast<std::int32_t>(topology_.vertex_count());
    for (std::int32_t v = 0; v < vertices; ++v)
      if (const Rational left = fallen(Sharpness::one_less(right_.vertex(v))); left > 0)
        tags.vertices.push_back({v, exact(left)});
    for (std::int32_t e = 0; e < std::ssize(topology_.edges()); ++e) {
      const Edge& edge = topology_.edges()[e];
      for (const std::int32_t end : {edge.a, edge.b}) {
        if (is_smooth(e) || (control && rules_.is("tags_for_one_step")) ||
            (control && rules_.is("tags_of_the_lower_end") && end == std::max(edge.a, edge.b)))
          continue;
        if (const Rational left = fallen(half(e, end)); left > 0)
          tags.edges.push_back({end, vertices + e, exact(left)});
      }
    }
    return Sharpness(finer, tags);
  }

  // Whether the rule of a vertex is for ever the one that it has.
  bool is_settled(std::int32_t v) const {
    const auto is_open = [&](const Rational& s) {
      return Sharpness::is_semi_sharp(s) && (s > 1 || !rules_.is("last_sharp_step_missing"));
    };
    const auto edges = topology_.sector(v).edges;
    return !is_open(right_.vertex(v)) &&
           std::none_of(edges.begin(), edges.end(), [&](std::int32_t e) { return is_open(right_.edge(e)); });
  }

 private:
  Rational sharpest_that_ends(std::int32_t v) const {
    Rational most = 0;
    if (Sharpness::one_less(right_.vertex(v)) == 0) most = right_.vertex(v);
    for (const std::int32_t e : topology_.sector(v).edges)
      if (right_.half_after_step(topology_, e, v) == 0) most = std::max(most, right_.edge(e));
    return std::min(most, Rational(1));
  }
  Rational fallen(const Rational& s) const { return rules_.is("falls_by_2") ? Sharpness::one_less(s) : s; }
  // Of the half of a sharp edge at its end v, after a step.
  Rational half(std::int32_t e, std::int32_t v) const {
    const Rational& s = right_.edge(e);
    const Edge& edge = topology_.edges()[e];
    if (rules_.is("chaikin_ends_exchanged"))
      return right_.half_after_step(topology_, e, edge.a == v ? edge.b : edge.a);
    Rational sum = 0, most = 0;
    int others = 0;
    for (const std::int32_t other : topology_.sector(v).edges) {
      const Rational t = topology_.edges()[other].on_boundary() ? Rational(10) : right_.edge(other);
      if (other == e || t == 0 || (Sharpness::is_infinite(t) && !rules_.is("chaikin_takes_infinite")))
        continue;
      sum += t, most = std::max(most, t), ++others;
    }
    if (others == 0 || !Sharpness::is_semi_sharp(s) || right_.creasing() != data::Creasing::kChaikin)
      return Sharpness::one_less(s);
    const Rational share = rules_.is("chaikin_takes_half") ? Rational(1, 2) : Rational(3, 4);
    const Rational mean = rules_.is("chaikin_by_maximum") ? most
                          : rules_.is("chaikin_by_sum")   ? sum
                                                          : Rational(sum / others);
    return std::max(Rational(0), Rational(share * s + (1 - share) * mean - 1));
  }

  const Topology& topology_;
  const Sharpness& right_;
  const MutantRules& rules_;
};

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

std::size_t corner_at(const Topology& topology, std::int32_t face, std::int32_t v) {
  const auto corners = topology.faces()[face];
  return static_cast<std::size_t>(std::find(corners.begin(), corners.end(), v) - corners.begin());
}

MutantRing ring_of(const Topology& topology, const std::vector<V>& points, std::int32_t v) {
  const Sector sector = topology.sector(v);
  MutantRing ring;
  ring.point = points[v];
  ring.on_boundary = !sector.closed;
  for (const std::int32_t e : sector.neighbours) ring.edges.push_back(points[e]);
  for (const std::int32_t f : sector.faces)
    if (topology.faces()[f].size() == 4)
      ring.faces.push_back(points[reference::catmull_clark::opposite(topology, f, v)]);
  return ring;
}

// The stretch of so many faces from face `first` on, as a sector of its own.
MutantRing part(const MutantRing& all, std::size_t first, std::size_t faces, VertexState state) {
  MutantRing result;
  result.point = all.point;
  result.on_boundary = true;
  result.state = state;
  for (std::size_t i = 0; i <= faces; ++i) result.edges.push_back(all.edges[(first + i) % all.edges.size()]);
  for (std::size_t i = 0; i < faces && !all.faces.empty(); ++i)
    result.faces.push_back(all.faces[(first + i) % all.faces.size()]);
  return result;
}

// From one level to the next: the mesh with its tags, and its vertices' limits.
class Steps {
 public:
  Steps(const MutantRules& rules, const data::ControlMesh& control, int depth)
      : rules_(rules), depth_(depth), has_tags_(!control.sharpness.empty()) {}

  // Face f of four children has those from 4 f on, a face of n corners in quads one for each corner, all faces in order.
  TaggedMesh refined(const TaggedMesh& mesh, int step) const {
    const MutantTags tags(mesh, rules_);
    std::vector<V> points = rules_.refine(mesh.topology, mesh.positions, step, depth_);
    if (has_tags_) reference::sharpen(mesh.topology, tags, mesh.positions, points);
    const bool quads = points.size() > mesh.positions.size() + mesh.topology.edges().size();
    Topology finer(points.size(), quads ? reference::catmull_clark::refined_faces(mesh.topology)
                                        : refined_triangles(mesh.topology));
    Sharpness its = has_tags_ ? tags.refined(finer, step == 0) : Sharpness(finer, {});
    return {std::move(finer), std::move(points), std::move(its)};
  }

  // The position, and the normals in the faces around, in the order of the sector.
  std::pair<V, std::vector<V>> limit_of(const TaggedMesh& mesh, std::int32_t v) const {
    const Sector sector = mesh.topology.sector(v);
    const std::size_t count = sector.faces.size();
    if (!has_tags_ || mesh.sharpness.is_smooth_around(mesh.topology, v)) {
      const auto [position, normal] = rules_.limit(ring_of(mesh.topology, mesh.positions, v), depth_);
      return {position, std::vector<V>(count, normal)};
    }
    if (MutantTags(mesh, rules_).is_settled(v)) return lasting_limit(mesh, v);
    // The vertex alone, with the faces around, through the steps in which it has tags left: none that falls is above
    // 10. It stays the corner of its faces that it is.
    std::vector<std::int32_t> faces(sector.faces.begin(), sector.faces.end());
    std::vector<std::size_t> corner;
    for (const std::int32_t f : faces) corner.push_back(corner_at(mesh.topology, f, v));
    TaggedMesh near = mesh.around(faces);
    const auto here = [&] { return near.topology.faces()[0][corner[0]]; };
    for (int step = depth_; step < depth_ + 16 && !MutantTags(near, rules_).is_settled(here()); ++step) {
      for (std::size_t k = 0; k < count; ++k) faces[k] = static_cast<std::int32_t>(4 * k + corner[k]);
      near = refined(near, step).around(faces);
    }
    const auto [position, normals] = lasting_limit(near, here());
    std::vector<V> in_order;
    for (std::size_t k = 0; k < count; ++k)
      in_order.push_back(normals[static_cast<std::size_t>(near.topology.ring_index(k, corner[k]))]);
    return {position, in_order};
  }

 private:
  // Of a vertex whose rule stays: of each side of the edges that stay sharp.
  std::pair<V, std::vector<V>> lasting_limit(const TaggedMesh& mesh, std::int32_t v) const {
    const Sector sector = mesh.topology.sector(v);
    const std::size_t count = sector.faces.size();
    MutantRing ring = ring_of(mesh.topology, mesh.positions, v);
    std::vector<std::size_t> sharp;  // which neighbours lie across edges that stay sharp
    for (std::size_t i = 0; i < sector.edges.size(); ++i)
      if (mesh.topology.edges()[sector.edges[i]].on_boundary() ||
          Sharpness::is_infinite(mesh.sharpness.edge(sector.edges[i])))
        sharp.push_back(i);
    const bool held = Sharpness::is_infinite(mesh.sharpness.vertex(v)) || sharp.size() > 2;
    const bool dart = !held && sharp.size() == 1;
    ring.state = held ? VertexState::kHeld : VertexState::kOrdinary;

    std::optional<V> position;
    std::vector<V> normals;
    const auto add = [&](const MutantRing& side, std::size_t faces) {
      const auto limit = rules_.limit(side, depth_);
      if (!position) position = limit.position;
      normals.insert(normals.end(), faces, limit.normal);
      // A crease is (2/3, 1/6, 1/6) in either scheme, a corner stays.
      if (held && rules_.is("corner_limit_moved"))
        position = reference::boundary_limit(side.point, side.edges.front(), side.edges.back());
    };
    if (sharp.empty()) {
      add(ring, count);
    } else {
      const std::size_t sides = sector.closed ? sharp.size() : sharp.size() - 1;
      for (std::size_t k = 0; k < sides; ++k) {
        const std::size_t next = k + 1 < sharp.size() ? sharp[k + 1] : sharp[0] + count;
        add(part(ring, sharp[k], next - sharp[k], dart ? VertexState::kDart : ring.state), next - sharp[k]);
      }
      std::rotate(normals.rbegin(), normals.rbegin() + static_cast<std::ptrdiff_t>(sharp[0]), normals.rend());
    }
    const auto smooth = dart ? rules_.limit(ring, depth_) : MutantRules::Limit{};
    if (dart && rules_.is("dart_limit_smooth")) position = smooth.position;
    if (dart && rules_.is("dart_normal_smooth")) normals.assign(count, smooth.normal);
    if (rules_.is("normal_of_the_other_side"))
      std::rotate(normals.begin(), normals.begin() + static_cast<std::ptrdiff_t>(count / 2), normals.end());
    if (rules_.is("one_normal_for_all_sides")) normals.assign(count, V(normals[0]));
    if (rules_.is("mean_of_all_sides")) {
      const V sum = std::accumulate(normals.begin(), normals.end(), V{});
      normals.assign(count, dot(sum, sum) > 0 ? reference::unit(sum) : V{0, 0, 1});
    }
    return {*position, normals};
  }

  const MutantRules& rules_;
  int depth_;
  bool has_tags_;
};

}  // namespace

MutantLevel::MutantLevel(const data::ControlMesh& control, data::Scheme scheme, const MutantRules& rules,
                         int depth)
    : control_(control.faces),
      scheme_(scheme),
      depth_(depth),
      topology_(control.positions.size(), control.faces) {
  const Steps steps(rules, control, depth);
  Sharpness sharpness(topology_, control.sharpness);
  TaggedMesh mesh{std::move(topology_), reference::positions_of<double>(control), std::move(sharpness)};
  for (int step = 0; step < depth; ++step) {
    TaggedMesh next = steps.refined(mesh, step);
    const bool last = step + 1 == depth;
    if (last && ((step > 0 && rules.is("one_step_missing")) || (depth % 2 == 1 && rules.is("odd_depths"))))
      std::copy(mesh.positions.begin(), mesh.positions.end(), next.positions.begin());
    mesh = std::move(next);
  }
  positions_ = mesh.positions;
  normals_.resize(mesh.topology.faces().corners().size());
  for (std::int32_t v = 0; v < std::ssize(positions_); ++v) {
    const Sector sector = mesh.topology.sector(v);
    if (sector.faces.empty()) continue;
    const auto [position, normals] = steps.limit_of(mesh, v);
    positions_[v] = position;
    for (std::size_t i = 0; i < normals.size(); ++i)
      normals_[mesh.topology.faces().first_corner(sector.faces[i]) +
               corner_at(mesh.topology, sector.faces[i], v)] = normals[i];
  }
  topology_ = std::move(mesh.topology);
  points_ = std::move(mesh.positions);
  if (rules.is("limits_smoothed")) {
    const std::vector<V> before = positions_;
    for (const Edge& e : topology_.edges())
      for (const auto& [to, from] : {std::pair(e.a, e.b), std::pair(e.b, e.a)})
        positions_[to] +=
            (before[from] - before[to]) * (1e-3 / static_cast<double>(topology_.ring(to).size()));
  }
}

std::size_t MutantLevel::corner(std::size_t control_face, FaceDomain::Point p) const {
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
  const std::int64_t k = triangles ? p.i + 2 * p.j : p.j > 0 ? 3 - p.i : p.i;
  return topology_.faces().first_corner(cell) + static_cast<std::size_t>(k);
}

MutantRing MutantLevel::ring(std::size_t corner, std::size_t first) const {
  MutantRing ring = ring_of(topology_, points_, vertex(corner));
  if (ring.on_boundary) return ring;
  for (auto* list : {&ring.edges, &ring.faces})
    if (!list->empty())
      std::rotate(list->begin(), list->begin() + static_cast<std::ptrdiff_t>(first % list->size()),
                  list->end());
  return ring;
}

}  // namespace limitcheck::verify
