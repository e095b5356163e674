// SPDX-License-Identifier: MIT
#include <fmt/core.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <numeric>

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

}  // namespace

std::vector<Result> check_watertight(const Evidence& e) {
  Result surface = e.result("watertight"), tees = e.result("t-vertices");
  surface.unit = tees.unit = "edges";
  surface.bound = tees.bound = 0;
  const Tessellation& t = e.tessellation;
  if (t.triangle_count() == 0) {
    surface.status = tees.status = Status::kNotRun;
    return {surface, tees};
  }

  // Merge, look, and let CGAL look.
  const MergedPoints merged =
      t.precision() == LC_FLOAT32 ? merge_identical(t.positions_f32()) : merge_identical(t.positions_f64());
  std::vector<std::array<std::int32_t, 3>> triangles(static_cast<std::size_t>(t.triangle_count()),
                                                     {-1, -1, -1});
  for (std::int64_t k = 0; k < t.triangle_count(); ++k)
    if (t.triangle_ok(k))
      for (int c = 0; c < 3; ++c) triangles[k][c] = merged.point_of[t.triangles()[k][c]];
  const auto points = static_cast<std::int64_t>(merged.vertex_of.size());
  SurfaceReport report;
  SurfaceJudgement judgement;
  tbb::parallel_invoke([&] { report = inspect_surface(points, triangles); },
                       [&] { judgement = judge_surface(points, triangles); });

  // Open edges: exactly the boundary that was asked for?
  const auto corner_at = [&](const OpenEdge& edge,
                             std::int32_t point) {  // the triangle's own vertex at this point
    for (const std::uint32_t v : t.triangles()[edge.triangle])
      if (merged.point_of[v] == point) return static_cast<std::int64_t>(v);
    return std::int64_t{-1};
  };
  const Boundary boundary = expected_boundary(e);
  std::vector<bool> met(boundary.steps.size(), false);
  std::vector<bool> named(static_cast<std::size_t>(e.lattice.size()), false);
  for (const Lattice::Id id : e.point)
    if (id != Lattice::kNone) named[id] = true;
  std::vector<OpenEdge> crack_edges;
  std::vector<bool> split;  // of each crack edge: another vertex lies inside it
  for (const OpenEdge& edge : report.open_edges) {
    const std::int64_t from_vertex = corner_at(edge, edge.from);
    const Lattice::Id from = e.point[from_vertex], to = e.point[corner_at(edge, edge.to)];
    const auto step = std::lower_bound(boundary.steps.begin(), boundary.steps.end(), std::pair(from, to));
    if (from != Lattice::kNone && step != boundary.steps.end() && *step == std::pair(from, to) &&
        !met[step - boundary.steps.begin()]) {
      met[step - boundary.steps.begin()] = true;
      continue;
    }
    if (crack_edges.empty()) {
      surface.witness = e.at_vertex(from_vertex);
      surface.witness->triangle = edge.triangle;
    }
    crack_edges.push_back(edge);
    split.push_back(false);
    if (from == Lattice::kNone || to == Lattice::kNone) continue;
    if (const Lattice::Id inside = point_inside(e, edge, from, to, named); inside != Lattice::kNone) {
      split.back() = true;
      if (!tees.witness) tees.witness = e.at_point(inside), tees.witness->triangle = edge.triangle;
    }
  }
  // ... and in space, exactly: what provenance does not tell.
  std::vector<double> places;
  for (std::int64_t v = 0; !crack_edges.empty() && v < t.vertex_count(); ++v)
    for (const double x : t.position(v)) places.push_back(x);
  for (const TVertex& tee : find_t_vertices(places, merged.vertex_of, crack_edges)) {
    split[tee.edge] = true;
    if (!tees.witness)
      tees.witness = e.at_vertex(merged.vertex_of[tee.point]),
      tees.witness->triangle = crack_edges[tee.edge].triangle;
  }
  const auto cracks = static_cast<std::int64_t>(crack_edges.size());
  const auto missed = static_cast<std::int64_t>(std::count(met.begin(), met.end(), false));
  if (missed > 0 && !surface.witness)
    surface.witness =
        e.at_point(boundary.steps[std::find(met.begin(), met.end(), false) - met.begin()].first);

  const auto triangle_witness = [&](const std::vector<std::int32_t>& list) {
    if (list.empty() || surface.witness) return;
    surface.witness = Witness{};
    surface.witness->triangle = list.front();
    if (t.triangle_ok(list.front())) {
      surface.witness = e.at_vertex(t.triangles()[list.front()][0]);
      surface.witness->triangle = list.front();
    }
  };
  triangle_witness(report.degenerate_witness);
  triangle_witness(report.duplicate_witness);
  for (const auto* list : {&report.crowded_witness, &report.clashing_witness})
    if (!list->empty()) triangle_witness({list->front().triangle});
  if (!report.bow_tie_witness.empty() && !surface.witness)
    surface.witness = e.at_vertex(merged.vertex_of[report.bow_tie_witness.front()]);

  surface.of = report.edges;
  surface.bad = cracks + missed + report.degenerate_triangles + report.duplicate_triangles +
                report.crowded_edges + report.clashing_edges + report.bow_tie_points;
  std::vector<std::string> parts;
  const auto part = [&](std::int64_t count, const char* what) {
    if (count > 0) parts.push_back(fmt::format("{} {}", count, what));
  };
  part(cracks, "open edges that are no boundary");
  part(missed, "boundary edges missing");
  part(report.degenerate_triangles, "degenerate triangles");
  part(report.duplicate_triangles, "duplicate triangles");
  part(report.crowded_edges, "edges of three or more triangles");
  part(report.clashing_edges, "edges of two triangles that run the same way");
  part(report.bow_tie_points, "points with more than one fan of triangles");
  if (surface.bad == 0 && boundary.loops >= 0 && report.open_loops != boundary.loops) {
    ++surface.bad;
    parts.push_back(fmt::format("{} boundary loops instead of {}", report.open_loops, boundary.loops));
  }
  for (const std::string& p : parts) surface.message += (surface.message.empty() ? "" : ", ") + p;
  if (surface.bad > 0) surface.status = Status::kFinding;

  // Two methods, one answer.
  const bool agree = report.manifold() == judgement.manifold() &&
                     (!report.manifold() || (report.open_edges.empty() == judgement.closed &&
                                             report.open_loops == judgement.boundary_cycles));
  if (!agree) {
    surface.status = Status::kError;
    surface.message = fmt::format(
        "our own count (manifold {}, {} open edges, {} loops) and CGAL's (manifold {}, closed {}, "
        "{} cycles) disagree; ours: {}",
        report.manifold(), report.open_edges.size(), report.open_loops, judgement.manifold(),
        judgement.closed, judgement.boundary_cycles, surface.message);
  }

  tees.of = static_cast<std::int64_t>(report.open_edges.size());
  tees.bad = std::count(split.begin(), split.end(), true);
  if (tees.bad > 0) {
    tees.status = Status::kFinding;
    tees.message = fmt::format("{} edges with another vertex inside", tees.bad);
  }
  return {surface, tees};
}

}  // namespace limitcheck::verify
