// SPDX-License-Identifier: MIT
#include "verify/evidence/weld.h"

#include <algorithm>
#include <utility>

#include "verify/evidence/vector.h"
#include "verify/watertight/watertight.h"

namespace limitcheck::verify {

Welded weld(const Evidence& e) {
  const Tessellation& t = e.tessellation;
  const MergedPoints places =
      t.precision() == LC_FLOAT32 ? merge_identical(t.positions_f32()) : merge_identical(t.positions_f64());
  Welded welded;
  welded.point_of.assign(e.point.size(), -1);
  // The points at each lattice point and at each place, of which there is nearly always one.
  std::vector<std::int32_t> of_lattice_point(e.lattice.size(), -1), next, place;
  std::vector<std::int32_t> of_place(places.vertex_of.size(), -1);
  const auto add = [&](std::size_t v) {
    const auto point = static_cast<std::int32_t>(welded.vertex_of.size());
    welded.vertex_of.push_back(static_cast<std::int32_t>(v));
    place.push_back(places.point_of[v]);
    next.push_back(-1);
    if (place.back() >= 0 && of_place[place.back()] < 0) of_place[place.back()] = point;
    if (e.point[v] != Lattice::kNone) next.back() = std::exchange(of_lattice_point[e.point[v]], point);
    return point;
  };
  for (std::size_t v = 0; v < e.point.size(); ++v) {
    if (e.point[v] == Lattice::kNone || places.point_of[v] < 0) continue;
    std::int32_t point = of_lattice_point[e.point[v]];
    while (point >= 0 && place[point] != places.point_of[v]) point = next[point];
    welded.point_of[v] = point >= 0 ? point : add(v);
  }
  for (std::size_t v = 0; v < e.point.size(); ++v) {
    if (welded.point_of[v] >= 0) continue;
    const bool named = e.point[v] != Lattice::kNone;
    if (!named && places.point_of[v] < 0) continue;
    const std::int32_t point = named ? of_lattice_point[e.point[v]] : of_place[places.point_of[v]];
    welded.point_of[v] = point >= 0 ? point : add(v);
  }
  return welded;
}

std::int64_t coincident_boundary_edges(const Evidence& e) {
  std::vector<std::pair<Vector, Vector>> ends;
  for (const Lattice::Edge& edge : e.lattice.edges())
    if (edge.on_boundary()) ends.push_back(std::minmax({e.mesh.positions[edge.a], e.mesh.positions[edge.b]}));
  std::sort(ends.begin(), ends.end());
  std::int64_t count = 0;
  for (auto first = ends.begin(); first != ends.end();) {
    const auto last = std::find_if(first, ends.end(), [&](const auto& other) { return other != *first; });
    if (last - first > 1) count += last - first;
    first = last;
  }
  return count;
}

std::int64_t faces_without_area(const Evidence& e) {
  std::int64_t count = 0;
  for (std::size_t f = 0; f < e.mesh.faces.size(); ++f) {
    const auto corner = e.mesh.faces[f];
    const auto& a = e.mesh.positions;
    Vector area{};  // twice, of a fan from the first corner
    for (std::size_t k = 1; k + 1 < corner.size(); ++k)
      area = area + cross(a[corner[k]] - a[corner[0]], a[corner[k + 1]] - a[corner[0]]);
    count += largest(area) == 0;
  }
  return count;
}

}  // namespace limitcheck::verify
