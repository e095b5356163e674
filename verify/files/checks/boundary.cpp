// SPDX-License-Identifier: MIT
#include "verify/files/checks/boundary.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>

#include "data/cut_out.h"

namespace limitcheck::verify {
namespace {

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
  for (const std::int32_t p : {edge.from, edge.to}) {
    const FacePoint& at = e.place[p];
    std::vector<std::int32_t> faces{at.face};
    if (const int k = chart.corner_at(at.l); k >= 0)
      for (const std::int32_t f : domain.faces_at(domain.vertex(at.face, k))) faces.push_back(f);
    for (const std::int32_t face : faces) {
      FacePoint x, y;
      if (!domain.express(e.place[edge.from], face, x) || !domain.express(e.place[edge.to], face, y))
        continue;
      for (int k = 0; k < chart.corners(); ++k)
        if (chart.height(k, x.l) == 0 && chart.height(k, y.l) == 0 && is_rim(e, face, k)) return true;
    }
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

// Two boundary edges of the control mesh in one place.
bool has_seams(const data::ControlMesh& mesh, const std::vector<std::vector<std::int32_t>>& loops) {
  std::vector<std::pair<Vector, Vector>> edges;
  for (const auto& loop : loops)
    for (std::size_t k = 0; k < loop.size(); ++k)
      edges.push_back(
          std::minmax(Vector(mesh.positions[loop[k]]), Vector(mesh.positions[loop[(k + 1) % loop.size()]])));
  std::sort(edges.begin(), edges.end());
  return std::adjacent_find(edges.begin(), edges.end()) != edges.end();
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

}  // namespace

FileBoundary compare_boundary(const FileEvidence& e, const SurfaceReport& report) {
  FileBoundary boundary;
  const std::vector<OpenEdge>& open = report.open_edges;
  const auto loops = loops_of(Lattice(e.control, e.scheme(), 0));
  const FacesAround around(e.control.faces, e.control.positions.size());
  boundary.loops = static_cast<std::int64_t>(loops.size());
  boundary.seams = has_seams(e.control, loops);
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

}  // namespace limitcheck::verify
