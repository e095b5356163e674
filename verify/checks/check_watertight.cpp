// SPDX-License-Identifier: MIT
#include <fmt/core.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "data/summary.h"
#include "verify/checks/checks.h"
#include "verify/checks/welded_surface.h"
#include "verify/watertight/watertight.h"

namespace limitcheck::verify {
namespace {

using OpenEdge = SurfaceReport::Edge;

// The points that vertices name, and those of them that touch each face, where points may be anywhere.
struct NamedPoints {
  explicit NamedPoints(const Evidence& e) : is_named(e.lattice.size(), false), of_face(e.mesh.faces.size()) {
    for (const Lattice::Id id : e.point)
      if (id != Lattice::kNone) is_named[id] = true;
    if (e.capabilities.points_anywhere == 0) return;
    for (std::size_t v = 0; v < e.point.size(); ++v) {
      const Lattice::Id id = e.point[v];
      if (id == Lattice::kNone) continue;
      if (e.lattice.is_shared(id) && !e.lattice.is_vertex(id)) {
        for (const std::int32_t face : e.lattice.edges()[e.lattice.edge_of(id)].face)
          if (face >= 0) of_face[face].push_back(id);
      } else if (!e.lattice.is_shared(id)) {
        of_face[e.tessellation.place(static_cast<std::int64_t>(v)).face].push_back(id);
      }
    }
  }
  std::vector<bool> is_named;
  std::vector<std::vector<Lattice::Id>> of_face;
};

// A point strictly inside the open edge that some vertex names, or kNone. The ends of an edge need a common face to be
// compared in.
Lattice::Id point_inside(const Evidence& e, const OpenEdge& edge, Lattice::Id from, Lattice::Id to,
                         const NamedPoints& named) {
  const std::int32_t face = e.tessellation.triangle_face()[edge.triangle];
  const auto p = e.lattice.in_face(from, face), q = e.lattice.in_face(to, face);
  if (!p || !q) return Lattice::kNone;
  Lattice::Id inside = Lattice::kNone;
  const FaceDomain domain = e.lattice.domain(face);
  if (e.capabilities.points_anywhere == 0) {
    domain.for_each_step(*p, *q, e.lattice.scale(), [&](const auto&, const auto& end) {
      const Lattice::Id id = e.lattice.id(face, end, e.lattice.scale());
      if (inside == Lattice::kNone && id != to && id != Lattice::kNone && named.is_named[id]) inside = id;
    });
    return inside;
  }
  const auto is_between = [&](Lattice::Id id) {
    bool between = false;
    const Lattice::Coordinates at = *e.lattice.in_face(id, face);
    domain.for_each_straight(*p, *q, e.lattice.scale(), [&](const auto& a, const auto& b) {
      const auto m = domain.in_part(at, a.part, e.lattice.scale());
      if (!m || a.part != b.part || domain.area({a, *m, b}, e.lattice.scale()) != 0) return;
      const auto within = [](std::int64_t x, std::int64_t y, std::int64_t z) {
        return std::min(x, z) <= y && y <= std::max(x, z);
      };
      between = between || (within(a.i, m->i, b.i) && within(a.j, m->j, b.j));
    });
    return between;
  };
  for (const Lattice::Id id : named.of_face[face])
    if (id != from && id != to && is_between(id)) return id;
  return Lattice::kNone;
}

// What our own count and CGAL find on the welded surface.
struct Looked {
  Welded welded;
  std::vector<std::int32_t> vertex_of;  // one vertex of each point, as welded, and ...
  std::vector<std::int32_t>
      whole_of;  // ... the welded point it is: itself unless it stands for a further fan
  SurfaceReport report;
  SurfaceJudgement judgement;
};

Looked look(const Evidence& e, const Outline& outline) {
  const Tessellation& t = e.tessellation;
  Looked l;
  l.welded = weld(e);
  l.vertex_of = l.welded.vertex_of;
  l.whole_of.resize(l.vertex_of.size());
  std::iota(l.whole_of.begin(), l.whole_of.end(), 0);

  // At a corner that is a control vertex, the fan of the triangle's face there; 0 at all others.
  const auto fan_at = [&](std::int64_t triangle, std::uint32_t vertex) {
    const Lattice::Id id = e.point[vertex];
    const std::int32_t face = t.triangle_face()[triangle];
    if (id == Lattice::kNone || !e.lattice.is_vertex(id) || face < 0 || face >= e.lattice.face_count())
      return 0;
    const auto k = e.lattice.corner_of(face, id);
    return k ? outline.fan(face, *k) : 0;
  };
  std::map<std::pair<std::int32_t, int>, std::int32_t> further;  // welded point, fan -> point of its own
  std::vector<std::array<std::int32_t, 3>> triangles(t.triangle_count(), {-1, -1, -1});
  for (std::int64_t k = 0; k < t.triangle_count(); ++k) {
    if (!t.triangle_ok(k)) continue;
    for (int c = 0; c < 3; ++c) {
      const std::uint32_t vertex = t.triangles()[k][c];
      std::int32_t& point = triangles[k][c];
      point = l.welded.point_of[vertex];
      const int fan = point < 0 ? 0 : fan_at(k, vertex);
      if (fan == 0) continue;
      const auto [it, is_new] =
          further.try_emplace({point, fan}, static_cast<std::int32_t>(l.vertex_of.size()));
      if (is_new) {
        l.vertex_of.push_back(static_cast<std::int32_t>(vertex));
        l.whole_of.push_back(point);
      }
      point = it->second;
    }
  }
  const OriginOfTriangles surface =
      tell_diagonals_apart(e, std::move(triangles), static_cast<std::int64_t>(l.vertex_of.size()));
  tbb::parallel_invoke([&] { l.report = inspect_surface(surface.points, surface.triangles); },
                       [&] { l.judgement = judge_surface(surface.points, surface.triangles); });
  // From here on the triangles are those of the tessellation. (An open edge is no diagonal that was told
  // apart.)
  for (auto* edges : {&l.report.open_edges, &l.report.crowded_witness, &l.report.clashing_witness})
    for (OpenEdge& edge : *edges) edge.triangle = surface.origin[edge.triangle];
  for (auto* list : {&l.report.degenerate_witness, &l.report.duplicate_witness})
    for (std::int32_t& triangle : *list) triangle = surface.origin[triangle];
  return l;
}

// The open edges that are no boundary, and the steps of the boundary that are missing.
struct Cracks {
  std::vector<OpenEdge> edges;
  std::int64_t missed = 0;         // steps of the boundary
  std::optional<Witness> witness;  // of the first crack or, if there is none, of the first step missed
  std::int64_t split = 0;          // edges with another vertex inside
  std::optional<Witness> split_witness;
};

Cracks find_cracks(const Evidence& e, const Looked& looked, const Outline& outline) {
  const Tessellation& t = e.tessellation;
  const auto vertex_at = [&](const OpenEdge& edge,
                             std::int32_t point) {  // the triangle's own vertex at this point
    for (const std::uint32_t v : t.triangles()[edge.triangle])
      if (looked.welded.point_of[v] == looked.whole_of[point]) return static_cast<std::int64_t>(v);
    return std::int64_t{-1};
  };
  const auto with_triangle = [](Witness w, std::int64_t triangle) {
    w.triangle = triangle;
    return w;
  };
  const NamedPoints named(e);

  // By provenance: an open edge is a step of the boundary,
  // once, or a crack, perhaps with a lattice point inside.
  Cracks c;
  const auto& steps = outline.steps();
  const auto step_of = [&](const OpenEdge& edge) {
    const std::pair at(e.point[vertex_at(edge, edge.from)], e.point[vertex_at(edge, edge.to)]);
    const auto step = std::lower_bound(steps.begin(), steps.end(), at, [](const auto& s, const auto& ends) {
      return std::pair(s.from, s.to) < ends;
    });
    return step != steps.end() && std::pair(step->from, step->to) == at ? step - steps.begin() : -1;
  };
  // Of the depths that a side may have, it has the one of which most steps were found.
  std::vector<std::vector<double>> share(outline.sides().size());
  for (std::size_t s = 0; s < share.size(); ++s)
    share[s].resize(static_cast<std::size_t>(outline.sides()[s].most - outline.sides()[s].least) + 1);
  for (const OpenEdge& edge : looked.report.open_edges)
    if (const auto s = step_of(edge); s >= 0)
      share[steps[s].side][steps[s].depth - outline.sides()[steps[s].side].least] +=
          std::ldexp(1, -steps[s].depth);
  const auto shown = [&](const Outline::Step& step) {
    const auto& its = share[step.side];
    return std::max_element(its.begin(), its.end()) - its.begin() ==
           step.depth - outline.sides()[step.side].least;
  };
  std::vector<bool> met(steps.size(), false);
  std::vector<bool> split;  // of each crack
  bool placed = true;       // every crack has its place on the lattice
  for (const OpenEdge& edge : looked.report.open_edges) {
    const std::int64_t vertex = vertex_at(edge, edge.from);
    const Lattice::Id from = e.point[vertex], to = e.point[vertex_at(edge, edge.to)];
    if (const auto step = step_of(edge); step >= 0 && shown(steps[step]) && !met[step]) {
      met[step] = true;
      continue;
    }
    if (!c.witness) c.witness = with_triangle(e.at_vertex(vertex), edge.triangle);
    c.edges.push_back(edge);
    split.push_back(false);
    placed = placed && from != Lattice::kNone && to != Lattice::kNone;
    if (from == Lattice::kNone || to == Lattice::kNone) continue;
    const Lattice::Id inside = point_inside(e, edge, from, to, named);
    if (inside == Lattice::kNone) continue;
    split.back() = true;
    if (!c.split_witness) c.split_witness = with_triangle(e.at_point(inside), edge.triangle);
  }

  // Where provenance cannot tell: in space, by exact arithmetic.
  if (!placed) {
    std::vector<double> places;
    for (std::int64_t v = 0; v < t.vertex_count(); ++v)
      for (const double x : t.position(v)) places.push_back(x);
    for (const TVertex& tee : find_t_vertices(places, looked.vertex_of, c.edges)) {
      split[tee.edge] = true;
      if (!c.split_witness)
        c.split_witness = with_triangle(e.at_vertex(looked.vertex_of[tee.point]), c.edges[tee.edge].triangle);
    }
  }
  c.split = std::count(split.begin(), split.end(), true);
  for (std::size_t s = 0; s < steps.size(); ++s) {
    if (met[s] || !shown(steps[s])) continue;
    if (c.missed++ == 0 && !c.witness) c.witness = e.at_point(steps[s].from);
  }
  return c;
}

// Somewhere the surface is not manifold.
std::optional<Witness> not_manifold(const Evidence& e, const Looked& looked) {
  const SurfaceReport& r = looked.report;
  std::vector<std::int32_t> triangles = r.degenerate_witness;
  triangles.insert(triangles.end(), r.duplicate_witness.begin(), r.duplicate_witness.end());
  for (const auto* edges : {&r.crowded_witness, &r.clashing_witness})
    for (const OpenEdge& edge : *edges) triangles.push_back(edge.triangle);
  if (!triangles.empty()) {
    const std::int32_t triangle = triangles.front();
    Witness w;
    if (e.tessellation.triangle_ok(triangle)) w = e.at_vertex(e.tessellation.triangles()[triangle][0]);
    w.triangle = triangle;
    return w;
  }
  if (!r.bow_tie_witness.empty() && r.bow_tie_witness.front() < std::ssize(looked.vertex_of))
    return e.at_vertex(looked.vertex_of[r.bow_tie_witness.front()]);
  return std::nullopt;
}

void tell(const SurfaceReport& report, const Cracks& cracks, const Outline& outline, Result& r) {
  const auto part = [&](std::int64_t count, const char* what) {
    if (count == 0) return;
    r.bad += count;
    r.message += fmt::format("{}{} {}", r.message.empty() ? "" : ", ", count, what);
  };
  part(static_cast<std::int64_t>(cracks.edges.size()), "open edges that are no boundary");
  part(cracks.missed, "boundary edges missing");
  part(report.degenerate_triangles, "degenerate triangles");
  part(report.duplicate_triangles, "duplicate triangles");
  part(report.crowded_edges, "edges of three or more triangles");
  part(report.clashing_edges, "edges of two triangles that run the same way");
  part(report.bow_tie_points, "points with more than one fan of triangles");
  if (r.bad == 0 && report.open_loops != outline.loops()) {
    r.bad = 1;
    r.message = fmt::format("{} boundary loops instead of {}", report.open_loops, outline.loops());
  }
  if (r.bad > 0) r.status = Status::kFinding;
}

}  // namespace

std::vector<Result> check_watertight(const Evidence& e) {
  Result surface = e.result("watertight", "elements", 0);  // points, edges and triangles
  Result tees = e.result("t-vertices", "edges", 0);
  if (e.tessellation.triangle_count() == 0) {
    surface.status = tees.status = Status::kNotRun;
    return {surface, tees};
  }
  const Outline outline(e);
  const Looked looked = look(e, outline);
  const SurfaceReport& ours = looked.report;
  const SurfaceJudgement& cgal = looked.judgement;
  const Cracks cracks = find_cracks(e, looked, outline);
  surface.of = ours.elements() + cracks.missed;
  surface.witness = cracks.witness ? cracks.witness : not_manifold(e, looked);
  tell(ours, cracks, outline, surface);

  // The two methods must agree.
  const bool agree = ours.manifold() == cgal.manifold() &&
                     (!ours.manifold() ||
                      (ours.open_edges.empty() == cgal.closed && ours.open_loops == cgal.boundary_cycles));
  if (!agree) {
    surface.status = Status::kError;
    surface.message = fmt::format(
        "our own count (manifold {}, {} open edges, {} loops) and CGAL's (manifold {}, closed {}, {} cycles) "
        "disagree; ours: {}",
        ours.manifold(), ours.open_edges.size(), ours.open_loops, cgal.manifold(), cgal.closed,
        cgal.boundary_cycles, surface.message);
  }

  const auto mention = [&](std::int64_t count, const char* what) {
    if (count > 0) say(surface, fmt::format("the control mesh has {} {}", count, what));
  };
  const data::MeshSummary control = data::summarise(e.mesh);
  mention(control.coincident_boundary_edges, "coincident boundary edges");
  mention(control.zero_area_faces, "faces without area");
  surface.not_finite = not_finite(e.tessellation);
  if (surface.not_finite > 0)
    say(surface, fmt::format("{} vertices that are not finite go with the others of their lattice points",
                             surface.not_finite));

  tees.of = static_cast<std::int64_t>(ours.open_edges.size());
  tees.bad = cracks.split;
  tees.witness = cracks.split_witness;
  if (tees.bad > 0) {
    tees.status = Status::kFinding;
    tees.message = fmt::format("{} edges with another vertex inside", tees.bad);
  }
  return {surface, tees};
}

}  // namespace limitcheck::verify
