// SPDX-License-Identifier: MIT
#include "verify/files/checks/file_evidence.h"

#include <fmt/core.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

#include "verify/host/matching.h"
#include "verify/interrupt/interrupt.h"

namespace limitcheck::verify {

Result FileEvidence::result(std::string check, std::string unit, std::optional<double> bound) const {
  return {.subject = tessellation.name,
          .mesh = control_name,
          .check = std::move(check),
          .scheme = scheme(),
          .status = Status::kHeld,
          .bound = bound,
          .unit = std::move(unit)};
}

Witness FileEvidence::at_vertex(std::int32_t vertex) const {
  Witness w;
  w.vertex = vertex;
  const std::int32_t point = point_of(vertex);
  const bool told = !claimed.empty() && claimed[vertex].face >= 0;
  if (!told && (point < 0 || place[point].face < 0)) return w;
  Witness there = at_point(told ? claimed[vertex] : foot[point].at);
  there.vertex = vertex;
  return there;
}

Witness FileEvidence::at_point(const LimitSurface::ControlPoint& named) const {
  Witness w;
  w.face = named.face;
  w.corner = named.corner;
  w.l1 = fmt::format("{}", named.first);
  w.l2 = fmt::format("{}", named.second);
  return w;
}

namespace {

// On a corner or an edge, if the surface there is no farther from the foot than `slack`.
FacePoint snapped(const FileEvidence& e, const Foot& foot, double slack) {
  const Chart chart = e.surface.domain().chart();
  FacePoint best = foot.at;
  const auto better = [&](const FacePoint& there) {
    if (norm(e.surface.at(there, foot.position).position - foot.position) > slack) return false;
    best = there;
    return true;
  };
  for (int k = 0; k < chart.corners(); ++k)
    if (chart.is_near(k, foot.at.l) && better({foot.at.face, chart.corner(k)})) return best;
  for (int k = 0; k < chart.corners(); ++k) {
    const double height = chart.height(k, foot.at.l);
    if (height == 0 || height > .05) continue;
    if (better({foot.at.face, chart.dropped(k, foot.at.l)})) return best;
  }
  return best;
}

void sort_once(std::vector<std::int32_t>& list) {
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

// How many they are, or 2 where the point is no corner.
std::size_t count_faces(const Domain& domain, const FacePoint& at) {
  const int k = domain.chart().corner_at(at.l);
  return k < 0 ? 2 : domain.faces_at(domain.vertex(at.face, k)).size();
}

void add_neighbours(const Domain& domain, std::vector<std::int32_t>& faces) {
  const std::size_t known = faces.size();
  for (std::size_t f = 0; f < known; ++f)
    for (int k = 0; k < domain.chart().corners(); ++k)
      if (const std::int32_t next = domain.across(faces[f], k); next >= 0) faces.push_back(next);
  sort_once(faces);
}

// The depth at which the refined control mesh has so many triangles, or -1.
int depth_of(const data::ControlMesh& control, data::Scheme scheme, std::size_t triangles) {
  double at_0 = 0, at_1 = 0;  // of faces that are no quads, two for each corner at depth 1
  for (std::size_t f = 0; f < control.faces.size(); ++f) {
    const auto corners = static_cast<double>(control.faces[f].size());
    at_0 += corners - 2;
    at_1 += scheme == data::Scheme::kLoop ? 4 : 2 * corners;
  }
  if (static_cast<double>(triangles) == at_0) return 0;
  for (int depth = 1; depth <= 12; ++depth)
    if (static_cast<double>(triangles) == std::ldexp(at_1, 2 * (depth - 1))) return depth;
  return -1;
}

}  // namespace

FacePoint domain_point(const FileEvidence& e, const ProvenanceRow& row) {
  return e.surface.surface().has_control_faces()
             ? row.at
             : e.surface.surface().at({row.at.face, row.corner, row.at.l[1], row.at.l[2]});
}

std::vector<ProvenanceRow> matched_provenance(const FileEvidence& e) {
  const FileTessellation& t = e.tessellation;
  const int depth = depth_of(e.control, e.scheme(), t.triangles.size());
  if (depth < 0) return {};
  std::vector<std::array<std::uint32_t, 3>> triangles;
  triangles.reserve(t.triangles.size());
  for (const auto& [a, b, c] : t.triangles)
    triangles.push_back(
        {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(c)});
  const Matching found = match(RefinedComplex(e.control, e.scheme(), depth),
                               {std::ssize(t.positions), triangles, [&](std::int64_t v) {
                                  return std::array{t.positions[v][0], t.positions[v][1], t.positions[v][2]};
                                }});
  std::vector<ProvenanceRow> rows;
  std::int64_t near = 0;
  for (std::int64_t v = 0; v < std::ssize(found.provenance); ++v) {
    if (!t.used[v]) continue;
    const lc_provenance& at = found.provenance[v];
    const double n = at.denominator, a = at.i / n, b = at.j / n;
    ProvenanceRow row{v, {at.face, Chart::at(a, b)}, -1};
    if (e.scheme() == data::Scheme::kLoop)
      row.at.l = {1 - a - b, a, b};
    else if (e.control.faces[at.face].size() != 4)
      row.corner = found.corner[v];
    const Vector& p = t.positions[v];
    near += norm(e.surface.at(domain_point(e, row), p).position - p) <= e.tolerance * e.surface.diagonal();
    rows.push_back(row);
  }
  // Of vertices that were moved along the surface, or are those of a refined mesh, most are elsewhere.
  if (2 * near < std::ssize(rows)) rows.clear();
  return rows;
}

void place_points(FileEvidence& e, const std::vector<ProvenanceRow>& provenance, bool told,
                  const std::function<void(std::size_t, std::size_t)>& on_step, bool quick) {
  const FileTessellation& t = e.tessellation;
  std::vector<double> flat;
  flat.reserve(3 * t.positions.size());
  for (const Vector& p : t.positions) flat.insert(flat.end(), p.begin(), p.end());
  e.merged = merge_identical(std::span<const double>(flat));

  const std::size_t points = e.merged.vertex_of.size();
  const bool again = !e.quick.empty();
  e.foot.resize(points);
  e.place.resize(points);
  e.quick.resize(points, 0);
  std::vector<FacePoint> claim(points);
  if (told) e.claimed.assign(t.positions.size(), {});
  for (const ProvenanceRow& row : provenance) {
    const FacePoint at = domain_point(e, row);
    if (told) e.claimed[row.vertex] = at;
    const std::int32_t point = e.point_of(static_cast<std::int32_t>(row.vertex));
    if (point >= 0 && claim[point].face < 0) claim[point] = at;
  }
  std::vector<char> used(points, 0);
  for (std::size_t v = 0; v < t.positions.size(); ++v)
    if (t.used[v] && e.merged.point_of[v] >= 0) used[e.merged.point_of[v]] = 1;

  const double slack = e.tolerance * e.surface.diagonal();
  std::size_t done = 0;
  std::mutex mutex;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points, 256), [&](const auto& range) {
    for (std::size_t k = range.begin(); k < range.end(); ++k) {
      if (used[k] == 0 || (again && e.quick[k] == 0)) continue;
      end_if_interrupted();
      const Vector& p = e.position(static_cast<std::int32_t>(k));
      std::optional<Foot> foot;
      if (claim[k].face >= 0) {
        foot = e.surface.at(claim[k], p);
      } else if (quick) {
        foot = e.surface.on_surface(p, slack / 4);
        e.quick[k] = foot ? 1 : 0;
      }
      e.foot[k] = foot ? *foot : e.surface.closest(p);
      e.place[k] = snapped(e, e.foot[k], slack);
    }
    const std::lock_guard lock(mutex);
    on_step(done += range.size(), points);
  });
}

std::vector<std::int32_t> faces_with(const Domain& domain, const FacePoint& at) {
  const Chart chart = domain.chart();
  std::vector<std::int32_t> faces{at.face};
  for (int k = 0; k < chart.corners(); ++k)
    if (chart.height(k, at.l) == 0 && domain.across(at.face, k) >= 0)
      faces.push_back(domain.across(at.face, k));
  if (const int k = chart.corner_at(at.l); k >= 0)
    for (const std::int32_t f : domain.faces_at(domain.vertex(at.face, k))) faces.push_back(f);
  sort_once(faces);
  return faces;
}

std::vector<Foot> in_all_faces(const FileEvidence& e, const FacePoint& at, const Vector& p) {
  const Domain& domain = e.surface.domain();
  std::vector<Foot> feet;
  for (const std::int32_t face : faces_with(domain, at))
    if (FacePoint there; domain.express(at, face, there)) feet.push_back(e.surface.at(there, p));
  return feet;
}

PlacedTriangle place_triangle(const FileEvidence& e, const std::array<std::int32_t, 3>& points) {
  PlacedTriangle placed;
  for (const std::int32_t p : points)
    if (p < 0 || e.place[p].face < 0) return placed;
  const Domain& domain = e.surface.domain();
  const Chart chart = domain.chart();

  // Candidates are the faces of the corner that lies in the fewest: a face that all three lie in is among them.
  // Beyond an edge, they are those and their neighbours, as far as one of the corners lies in them.
  const auto faces_of = [&](std::int32_t p) { return count_faces(domain, e.place[p]); };
  const std::int32_t with_fewest =
      *std::min_element(points.begin(), points.end(),
                        [&](std::int32_t p, std::int32_t q) { return faces_of(p) < faces_of(q); });
  std::vector<std::int32_t> candidates = faces_with(domain, e.place[with_fewest]);
  // Three points of one edge, or of its ends, lie in both of its faces, and in the wrong one have no area.
  for (const bool unfold : {false, true}) {
    if (unfold) add_neighbours(domain, candidates);
    for (const std::int32_t face : candidates) {
      FacePoint ignored;
      if (unfold && std::none_of(points.begin(), points.end(),
                                 [&](std::int32_t p) { return domain.express(e.place[p], face, ignored); }))
        continue;
      std::array<Chart::Affine, 3> l{};
      bool all = true;
      for (int c = 0; c < 3 && all; ++c) {
        const FacePoint& at = e.place[points[c]];
        FacePoint here;
        if (domain.express(at, face, here)) {
          l[c] = here.l;
          continue;
        }
        all = false;
        for (int k = 0; unfold && k < chart.corners() && !all; ++k) {
          const std::int32_t next = domain.across(face, k);
          FacePoint there;
          // Around the middle of a control face there are as many quads as it has corners: no plane has them.
          if (next < 0 || !e.surface.surface().on_control_edge(face, k)) continue;
          if (!domain.express(at, next, there)) continue;
          l[c] = domain.unfolded(next, domain.side_across(face, k), there.l);
          all = true;
        }
      }
      if (!all) continue;
      const double area = determinant(l[0], l[1], l[2]) / chart.area();
      if (placed.face >= 0 && std::abs(area) <= std::abs(placed.area)) continue;
      placed = {face, unfold, l, area};
    }
    if (placed.face >= 0) break;
  }
  return placed;
}

}  // namespace limitcheck::verify
