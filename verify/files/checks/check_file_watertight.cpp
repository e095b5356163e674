// SPDX-License-Identifier: MIT
// The row file-watertight: which open edges of a tessellation are the boundary of its control mesh, and which are cracks.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "data/cut_out.h"
#include "data/summary.h"
#include "verify/files/checks/file_evidence.h"

namespace limitcheck::verify {
namespace {

// The open edges of a tessellation held against the boundary of its control mesh.
struct FileBoundary {
  std::vector<SurfaceReport::Edge> cracks;  // open edges that are no boundary, in the order of the report
  std::int64_t loops = 0;                   // closed walks along the boundary edges of the control mesh
  std::int64_t touching = 0;                // points in which faces touch between holes, in no edge
  bool seams = false;  // some of its boundary edges coincide, and so may the tessellation's
  std::string remark;  // a sentence, if the boundary is not that of the limit surface
};

using OpenEdge = SurfaceReport::Edge;

bool off_the_surface(const FileEvidence& e, std::int32_t point) {
  return e.foot[point].distance > e.tolerance * e.surface.diagonal();
}

// Whether the surface that is shown ends at a side of a face.
bool is_rim(const FileEvidence& e, std::int32_t face, int side) {
  const std::int32_t next = e.surface.domain().across(face, side);
  const LimitSurface& surface = e.surface.surface();
  return surface.is_hole(face) ? next >= 0 && !surface.is_hole(next) : next < 0 || surface.is_hole(next);
}

// Both ends lie on the limit of one boundary edge of the domain.
bool on_limit_boundary(const FileEvidence& e, const OpenEdge& edge) {
  const Domain& domain = e.surface.domain();
  const Chart chart = domain.chart();
  if (off_the_surface(e, edge.from) || off_the_surface(e, edge.to)) return false;
  for (const std::int32_t p : {edge.from, edge.to})
    for (const std::int32_t face : faces_with(domain, e.place[p])) {
      FacePoint x, y;
      if (!domain.express(e.place[edge.from], face, x) || !domain.express(e.place[edge.to], face, y))
        continue;
      for (int k = 0; k < chart.corners(); ++k)
        if (chart.height(k, x.l) == 0 && chart.height(k, y.l) == 0 && is_rim(e, face, k)) return true;
    }
  return false;
}

// The control vertices along each closed walk of boundary edges, those of holes included. Where two holes
// meet in a vertex one walk leads through it twice.
std::vector<std::vector<std::int32_t>> loops_of(const Lattice& control) {
  std::vector<bool> hole(control.face_count(), false);
  for (const std::int32_t f : control.mesh().holes) hole[f] = true;
  std::multimap<std::int32_t, std::int32_t> next;
  for (std::int32_t f = 0; f < control.face_count(); ++f)
    for (int k = 0; k < control.domain(f).corners(); ++k)
      if (!hole[f] && (control.across(f, k) < 0 || hole[control.across(f, k)]))
        next.emplace(control.vertex(f, k), control.vertex(f, control.domain(f).next(k)));
  std::vector<std::vector<std::int32_t>> loops;
  while (!next.empty()) {
    loops.emplace_back();
    for (auto at = next.begin(); at != next.end();) {
      loops.back().push_back(at->first);
      const std::int32_t to = at->second;
      next.erase(at);
      at = next.find(to);
    }
  }
  return loops;
}

// How many vertices the faces that are shown would need more, so that they touch in no vertex only.
std::int64_t touching(const data::ControlMesh& mesh) {
  if (mesh.holes.empty()) return 0;
  data::Faces shown;
  for (std::size_t f = 0, h = 0; f < mesh.faces.size(); ++f) {
    if (h < mesh.holes.size() && mesh.holes[h] == static_cast<std::int32_t>(f))
      ++h;
    else
      shown.push_back(mesh.faces[f]);
  }
  return static_cast<std::int64_t>(data::split_fans(shown, mesh.positions.size()).size());
}

// A closed polygon that subdivides to the boundary curve.
struct Polygon {
  std::vector<Vector> points;
  std::vector<bool> kept;  // these stay in place

  const Vector& at(std::size_t k) const { return points[k % points.size()]; }
  // `centre` of 8 or 6: the weight of the point itself beside its two neighbours'.
  Vector smoothed(std::size_t k, double centre) const {
    if (kept[k]) return points[k];
    return 1 / (centre + 2) * (at(k + points.size() - 1) + centre * points[k] + at(k + 1));
  }
  Polygon refined() const {
    Polygon fine;
    for (std::size_t k = 0; k < points.size(); ++k) {
      fine.points.push_back(smoothed(k, 6));
      fine.points.push_back(.5 * (at(k) + at(k + 1)));
      fine.kept.push_back(kept[k]);
      fine.kept.push_back(false);
    }
    return fine;
  }
  Polygon limit() const {
    Polygon points_of_limit = *this;
    for (std::size_t k = 0; k < points.size(); ++k) points_of_limit.points[k] = smoothed(k, 4);
    return points_of_limit;
  }
};

// For each open edge, whether both ends lie within the tolerance of the same side; after so many steps
// 2^steps segments of the polygons, one after the other, are one side.
std::vector<bool> on_polygons(const FileEvidence& e, const std::vector<OpenEdge>& open,
                              const std::vector<Polygon>& polygons, int steps) {
  std::vector<std::array<Vector, 3>> segments;  // as triangles without area
  std::vector<BoxTree::Box> boxes;
  for (const Polygon& polygon : polygons)
    for (std::size_t k = 0; k < polygon.points.size(); ++k) {
      segments.push_back({polygon.at(k), polygon.at(k + 1), polygon.at(k + 1)});
      boxes.push_back(BoxTree::around({polygon.at(k), polygon.at(k + 1)}));
    }
  const BoxTree tree(boxes);
  const double tolerance = e.tolerance * e.surface.diagonal();
  std::map<std::int32_t, std::vector<std::size_t>> sides;  // of each point
  for (const OpenEdge& edge : open)
    for (const std::int32_t point : {edge.from, edge.to}) {
      const auto [entry, is_new] = sides.try_emplace(point);
      if (!is_new) continue;
      const Vector& p = e.position(point);
      tree.near(p, [&, list = &entry->second](std::size_t k) {
        if (closest_on_triangle(p, segments[k]).distance <= tolerance) list->push_back(k >> steps);
        return tolerance;
      });
    }
  std::vector<bool> result;
  for (const OpenEdge& edge : open) {
    const auto &a = sides[edge.from], &b = sides[edge.to];
    result.push_back(std::find_first_of(a.begin(), a.end(), b.begin(), b.end()) != a.end());
  }
  return result;
}

// A tessellation that is wrong in position still has a boundary: refined control points, for one, do not lie
// on the limit's boundary curve. So its open edges are held against every curve that a subdivision program
// makes of the control mesh's boundary, and the curve that explains most of them is taken:
//   the limit's boundary, by the closest points of the surface, of points that lie on it
//   the boundary polygon after 0, 1, 2 ... steps of the cubic B-spline's rule
//   the same where the corners of faces without neighbours stay in place (OpenSubdiv's EDGE_AND_CORNER), and
//   its limit points
// An open edge is explained if both ends lie within the tolerance of what the curve makes of one boundary
// edge of the control mesh. Where no curve explains half of the open edges, most of whose ends are off the
// surface, only the number of loops is compared: if it is the control mesh's, there are no cracks.
//   report   of the triangles between merged points; O(n log n) in the number of its open edges
FileBoundary compare_boundary(const FileEvidence& e, const SurfaceReport& report) {
  FileBoundary boundary;
  const std::vector<OpenEdge>& open = report.open_edges;
  const auto loops = loops_of(Lattice(e.control, e.scheme(), 0));
  const FacesAround around(e.control.faces, e.control.positions.size());
  boundary.loops = static_cast<std::int64_t>(loops.size());
  boundary.seams = data::summarise(e.control).coincident_boundary_edges > 0;
  boundary.touching = touching(e.control);

  std::vector<bool> explained;
  for (const OpenEdge& edge : open) explained.push_back(on_limit_boundary(e, edge));
  const auto count = [](const std::vector<bool>& list) { return std::count(list.begin(), list.end(), true); };
  const auto all = static_cast<std::int64_t>(open.size());
  for (const bool corners_kept : {false, true}) {
    std::vector<Polygon> polygons;
    std::size_t sides = 0;
    for (const auto& loop : loops) {
      sides += loop.size();
      Polygon& polygon = polygons.emplace_back();
      for (const std::int32_t v : loop) {
        polygon.points.push_back(e.control.positions[v]);
        polygon.kept.push_back(corners_kept && around.of(v).size() == 1);
      }
    }
    // Much of the boundary may be missing, but not nearly all of it.
    for (int steps = 0; sides > 0 && sides << steps <= 16 * open.size(); ++steps) {
      for (const bool limit : {false, true}) {
        if (count(explained) == all) break;
        if (limit && !corners_kept) continue;  // by the places, at any parameters
        std::vector<Polygon> curve = polygons;
        if (limit)
          for (Polygon& p : curve) p = p.limit();
        std::vector<bool> by_this = on_polygons(e, open, curve, steps);
        if (count(by_this) <= count(explained)) continue;
        explained = std::move(by_this);
        boundary.remark =
            fmt::format("the boundary is that of the {} after {} step{}{}",
                        limit ? "limit points" : "control mesh refined", steps, steps == 1 ? "" : "s",
                        corners_kept ? ", with corners of single faces kept in place" : "");
      }
      for (Polygon& p : polygons) p = p.refined();
    }
  }

  std::int64_t off = 0;
  for (std::size_t k = 0; k < open.size(); ++k) {
    if (explained[k]) continue;
    boundary.cracks.push_back(open[k]);
    off += off_the_surface(e, open[k].from) + off_the_surface(e, open[k].to);
  }
  const auto cracks = static_cast<std::int64_t>(boundary.cracks.size());
  if (2 * cracks > all && off > cracks && report.open_loops == boundary.loops) {
    boundary.cracks.clear();
    boundary.remark =
        "the boundary lies elsewhere than the limit surface's or a refined control mesh's; it has as many "
        "loops as the control mesh's, and no more of it was compared";
  }
  return boundary;
}

}  // namespace

std::vector<Result> check_file_watertight(const FileEvidence& e) {
  Result r = e.result("file-watertight", "elements", 0);
  const auto& t = e.tessellation;
  if (lacks(t.triangles, "faces", r)) return {r};
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::int64_t> number;
  std::int64_t degenerate = 0;
  for (std::size_t k = 0; k < t.triangles.size(); ++k) {
    const auto p = e.points_of(t.triangles[k]);
    // Strips of graphics hardware are joined by triangles without area: harmless.
    if (is_collapsed(p)) {
      ++degenerate;
      continue;
    }
    triangles.push_back(p);
    number.push_back(static_cast<std::int64_t>(k));
  }
  const SurfaceReport report =
      inspect_surface(static_cast<std::int64_t>(e.merged.vertex_of.size()), triangles);

  const FileBoundary boundary = compare_boundary(e, report);
  const auto& cracks = boundary.cracks;
  r.of = report.elements() + t.left_out;
  const auto part = [&](std::int64_t count, const char* what, bool bad = true) {
    if (count == 0) return;
    if (bad) r.bad += count;
    r.message += fmt::format("{}{} {}", r.message.empty() ? "" : ", ", count, what);
  };
  part(static_cast<std::int64_t>(cracks.size()), "open edges that are no boundary");
  r.not_finite = report.degenerate_triangles;
  part(report.degenerate_triangles, "triangles with a corner that is not finite");
  part(report.duplicate_triangles, "duplicate triangles");
  part(report.crowded_edges, "edges of three or more triangles");
  part(report.clashing_edges, "edges of two triangles that run the same way");
  part(std::max<std::int64_t>(0, report.bow_tie_points - boundary.touching),
       "points with more than one fan of triangles");
  part(t.left_out, "faces of fewer than three corners, or of vertices that do not exist");
  // A hole of the control mesh that is filled. Seams may be closed by merging equal positions, or not.
  if (r.bad == 0 && !boundary.seams && boundary.touching == 0 && report.open_loops != boundary.loops) {
    r.bad = 1;
    r.message = fmt::format("{} boundary loops instead of {}", report.open_loops, boundary.loops);
  }
  if (r.bad > 0) r.status = Status::kFinding;
  part(degenerate, "triangles with two corners in one place left out", false);
  say(r, boundary.remark);
  if (!cracks.empty()) {
    r.witness = e.at_vertex(e.merged.vertex_of[cracks.front().from]);
    r.witness->triangle = number[cracks.front().triangle];
  } else if (r.bad > 0) {
    std::int32_t triangle = -1;
    for (const auto* list : {&report.degenerate_witness, &report.duplicate_witness})
      if (triangle < 0 && !list->empty()) triangle = list->front();
    for (const auto* list : {&report.crowded_witness, &report.clashing_witness})
      if (triangle < 0 && !list->empty()) triangle = list->front().triangle;
    if (triangle >= 0) {
      r.witness = e.at_vertex(t.triangles[number[triangle]][0]);
      r.witness->triangle = number[triangle];
    } else if (!report.bow_tie_witness.empty()) {
      r.witness = e.at_vertex(e.merged.vertex_of[report.bow_tie_witness.front()]);
    }
  }
  return {r};
}

}  // namespace limitcheck::verify
