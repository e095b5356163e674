// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>
#include <limits>

#include "verify/files/checks/boundary.h"
#include "verify/files/checks/file_evidence.h"

namespace limitcheck::verify {
namespace {

// How far the points of the cracks are from the nearest
// other one, at most: what welding would have to bridge.
double widest(const FileEvidence& e, const std::vector<std::int32_t>& points) {
  std::vector<BoxTree::Box> boxes;
  for (const std::int32_t p : points) boxes.push_back(BoxTree::around({e.position(p)}));
  const BoxTree tree(boxes);
  double most = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    double least = std::numeric_limits<double>::infinity();
    tree.near(e.position(points[k]), [&](std::size_t other) {
      if (other != k) least = std::min(least, norm(e.position(points[k]) - e.position(points[other])));
      return least;
    });
    most = std::max(most, least);
  }
  return most;
}

}  // namespace

std::vector<Result> check_file_watertight(const FileEvidence& e) {
  Result r = e.result("file-watertight");
  r.unit = "elements";
  r.bound = 0;
  const auto& t = e.tessellation;
  if (t.triangles.empty()) {
    r.status = Status::kNotSupported;
    r.message = "the file has no faces";
    return {r};
  }
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<std::int64_t> number;
  std::int64_t degenerate = 0;
  for (std::size_t k = 0; k < t.triangles.size(); ++k) {
    const auto& v = t.triangles[k];
    const std::array<std::int32_t, 3> p{e.point_of(v[0]), e.point_of(v[1]), e.point_of(v[2])};
    // Strips of graphics hardware are joined by triangles without area: harmless.
    if (p[0] == p[1] || p[1] == p[2] || p[2] == p[0]) {
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
  if (!boundary.remark.empty()) r.message += (r.message.empty() ? "" : "; ") + boundary.remark;
  if (!cracks.empty()) {
    std::vector<std::int32_t> points;
    for (const auto& edge : cracks) points.insert(points.end(), {edge.from, edge.to});
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    const double width = widest(e, points) / e.surface.diagonal();
    if (width < 1e-3)
      r.message += fmt::format("; every point of the cracks has another within {:.2g} diagonals", width);
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
