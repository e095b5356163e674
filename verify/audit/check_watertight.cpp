// SPDX-License-Identifier: MIT
#include <fmt/core.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <numeric>
#include <optional>

#include "verify/audit/checks.h"
#include "verify/watertight/watertight.h"

namespace limitcheck::verify {
namespace {

using OpenEdge = SurfaceReport::Edge;

// The steps along the boundary of what was asked for: (point, next point) on control edges with one visible
// face, in the direction in which that face runs along them.
struct Boundary {
  std::vector<std::pair<Lattice::Id, Lattice::Id>> steps;  // sorted
  std::int64_t loops = 0;
};

Boundary expected_boundary(const Evidence& e) {
  Boundary b;
  std::vector<OpenEdge> sides;  // the same at control level, to count loops
  const Lattice& lattice = e.lattice;
  for (const Lattice::Edge& edge : lattice.edges()) {
    int visible = 0, side = 0;
    for (int s = 0; s < 2; ++s)
      if (edge.face[s] >= 0 && e.face_depth[edge.face[s]] >= 0) ++visible, side = s;
    if (visible != 1) continue;
    const std::int32_t face = edge.face[side];
    const int k = edge.corner[side], depth = e.face_depth[face];
    const std::uint32_t n = std::uint32_t{1} << depth;
    const auto at = [&](std::uint32_t along) {  // steps from corner k to corner k + 1
      lc_provenance p{face, 0, 0, n};
      if (k == 0) p.i = along;
      if (k == 1) p.i = n - along, p.j = along;
      if (k == 2) p.j = n - along;
      return lattice.id(p);
    };
    for (std::uint32_t along = 0; along < n; ++along) b.steps.emplace_back(at(along), at(along + 1));
    const auto& corner = e.mesh.triangles[face];
    sides.push_back({corner[k], corner[(k + 1) % 3], face});
  }
  std::sort(b.steps.begin(), b.steps.end());

  // Loops. A vertex between two culled faces may lie on several: then they branch, and their number is not
  // asked for.
  std::vector<std::int32_t> leaving(e.mesh.positions.size(), -1);
  for (std::size_t s = 0; s < sides.size(); ++s) {
    if (leaving[sides[s].from] >= 0) b.loops = -1;
    leaving[sides[s].from] = static_cast<std::int32_t>(s);
  }
  std::vector<bool> walked(sides.size(), false);
  for (std::size_t s = 0; b.loops >= 0 && s < sides.size(); ++s) {
    if (walked[s]) continue;
    ++b.loops;
    for (auto at = static_cast<std::int32_t>(s); at >= 0 && !walked[at]; at = leaving[sides[at].to])
      walked[at] = true;
  }
  return b;
}

// A lattice point strictly inside the open edge that some vertex names, or kNone. The ends of an edge need a
// common face to be compared in.
Lattice::Id point_inside(const Evidence& e, const OpenEdge& edge, Lattice::Id from, Lattice::Id to,
                         const std::vector<bool>& named) {
  const std::int32_t face = e.tessellation.triangle_face()[edge.triangle];
  const auto p = e.lattice.in_face(from, face), q = e.lattice.in_face(to, face);
  if (!p || !q) return Lattice::kNone;
  const std::int64_t di = q->i - p->i, dj = q->j - p->j, pieces = std::gcd(di, dj);
  for (std::int64_t k = 1; k < pieces; ++k) {
    const std::int64_t i = p->i + di / pieces * k, j = p->j + dj / pieces * k;
    const Lattice::Id id = e.lattice.id({face, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j),
                                         static_cast<std::uint32_t>(e.lattice.scale())});
    if (id != Lattice::kNone && named[id]) return id;
  }
  return Lattice::kNone;
}

// What the merged surface looks like, to us and to CGAL.
struct Looked {
  MergedPoints merged;
  SurfaceReport report;
  SurfaceJudgement judgement;
};

Looked look(const Tessellation& t) {
  Looked l;
  l.merged =
      t.precision() == LC_FLOAT32 ? merge_identical(t.positions_f32()) : merge_identical(t.positions_f64());
  std::vector<std::array<std::int32_t, 3>> triangles(static_cast<std::size_t>(t.triangle_count()),
                                                     {-1, -1, -1});
  for (std::int64_t k = 0; k < t.triangle_count(); ++k)
    if (t.triangle_ok(k))
      for (int c = 0; c < 3; ++c) triangles[k][c] = l.merged.point_of[t.triangles()[k][c]];
  const auto points = static_cast<std::int64_t>(l.merged.vertex_of.size());
  tbb::parallel_invoke([&] { l.report = inspect_surface(points, triangles); },
                       [&] { l.judgement = judge_surface(points, triangles); });
  return l;
}

// The open edges that are no boundary, and the boundary that is not there.
struct Cracks {
  std::vector<OpenEdge> edges;
  std::int64_t missed = 0;         // steps of the boundary
  std::optional<Witness> witness;  // of the first crack or, if there is none, of the first step missed
  std::int64_t split = 0;          // edges with another vertex inside
  std::optional<Witness> split_witness;
};

Cracks find_cracks(const Evidence& e, const Looked& looked, const Boundary& boundary) {
  const Tessellation& t = e.tessellation;
  const auto vertex_at = [&](const OpenEdge& edge,
                             std::int32_t point) {  // the triangle's own vertex at this point
    for (const std::uint32_t v : t.triangles()[edge.triangle])
      if (looked.merged.point_of[v] == point) return static_cast<std::int64_t>(v);
    return std::int64_t{-1};
  };
  const auto with_triangle = [](Witness w, std::int64_t triangle) {
    w.triangle = triangle;
    return w;
  };
  std::vector<bool> named(static_cast<std::size_t>(e.lattice.size()), false);
  for (const Lattice::Id id : e.point)
    if (id != Lattice::kNone) named[id] = true;

  // By provenance: an open edge is a step of the boundary, once, or a crack, perhaps with a lattice point
  // inside.
  Cracks c;
  std::vector<bool> met(boundary.steps.size(), false);
  std::vector<bool> split;  // of each crack
  bool placed = true;       // every crack has its place on the lattice
  for (const OpenEdge& edge : looked.report.open_edges) {
    const std::int64_t vertex = vertex_at(edge, edge.from);
    const Lattice::Id from = e.point[vertex], to = e.point[vertex_at(edge, edge.to)];
    const auto step = std::lower_bound(boundary.steps.begin(), boundary.steps.end(), std::pair(from, to));
    if (step != boundary.steps.end() && *step == std::pair(from, to) && !met[step - boundary.steps.begin()]) {
      met[step - boundary.steps.begin()] = true;
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

  // In space, exactly, where provenance does not tell.
  if (!placed) {
    std::vector<double> places;
    for (std::int64_t v = 0; v < t.vertex_count(); ++v)
      for (const double x : t.position(v)) places.push_back(x);
    for (const TVertex& tee : find_t_vertices(places, looked.merged.vertex_of, c.edges)) {
      split[tee.edge] = true;
      if (!c.split_witness)
        c.split_witness =
            with_triangle(e.at_vertex(looked.merged.vertex_of[tee.point]), c.edges[tee.edge].triangle);
    }
  }
  c.split = std::count(split.begin(), split.end(), true);
  c.missed = std::count(met.begin(), met.end(), false);
  if (c.missed > 0 && !c.witness)
    c.witness = e.at_point(boundary.steps[std::find(met.begin(), met.end(), false) - met.begin()].first);
  return c;
}

// Somewhere the surface is not manifold.
std::optional<Witness> not_manifold(const Evidence& e, const Looked& looked) {
  const SurfaceReport& r = looked.report;
  std::int32_t triangle = -1;
  if (!r.degenerate_witness.empty()) {
    triangle = r.degenerate_witness.front();
  } else if (!r.duplicate_witness.empty()) {
    triangle = r.duplicate_witness.front();
  } else if (!r.crowded_witness.empty()) {
    triangle = r.crowded_witness.front().triangle;
  } else if (!r.clashing_witness.empty()) {
    triangle = r.clashing_witness.front().triangle;
  }
  if (triangle >= 0) {
    Witness w;
    if (e.tessellation.triangle_ok(triangle)) w = e.at_vertex(e.tessellation.triangles()[triangle][0]);
    w.triangle = triangle;
    return w;
  }
  if (!r.bow_tie_witness.empty()) return e.at_vertex(looked.merged.vertex_of[r.bow_tie_witness.front()]);
  return std::nullopt;
}

void tell(const SurfaceReport& report, const Cracks& cracks, const Boundary& boundary, Result& r) {
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
  if (r.bad == 0 && boundary.loops >= 0 && report.open_loops != boundary.loops) {
    r.bad = 1;
    r.message = fmt::format("{} boundary loops instead of {}", report.open_loops, boundary.loops);
  }
  if (r.bad > 0) r.status = Status::kFinding;
}

}  // namespace

std::vector<Result> check_watertight(const Evidence& e) {
  Result surface = e.result("watertight"), tees = e.result("t-vertices");
  surface.unit = tees.unit = "edges";
  surface.bound = tees.bound = 0;
  if (e.tessellation.triangle_count() == 0) {
    surface.status = tees.status = Status::kNotRun;
    return {surface, tees};
  }
  const Looked looked = look(e.tessellation);
  const SurfaceReport& ours = looked.report;
  const SurfaceJudgement& cgal = looked.judgement;
  const Boundary boundary = expected_boundary(e);
  const Cracks cracks = find_cracks(e, looked, boundary);
  surface.of = ours.edges;
  surface.witness = cracks.witness ? cracks.witness : not_manifold(e, looked);
  tell(ours, cracks, boundary, surface);

  // Two methods, one answer.
  const bool agree = ours.manifold() == cgal.manifold() &&
                     (!ours.manifold() ||
                      (ours.open_edges.empty() == cgal.closed && ours.open_loops == cgal.boundary_cycles));
  if (!agree) {
    surface.status = Status::kError;
    surface.message = fmt::format(
        "our own count (manifold {}, {} open edges, {} loops) and CGAL's (manifold {}, closed {}, {} cycles) "
        "disagree; "
        "ours: {}",
        ours.manifold(), ours.open_edges.size(), ours.open_loops, cgal.manifold(), cgal.closed,
        cgal.boundary_cycles, surface.message);
  }

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
