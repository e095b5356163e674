// SPDX-License-Identifier: MIT
// What holds for every mesh that `repair` is given, for the test with random meshes and for the fuzzer.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "verify/repair/repair.h"

namespace limitcheck::verify {

using Place = std::array<double, 3>;

/// The largest sharpness at each edge and vertex (twice the same place), by the places of its ends.
inline std::map<std::pair<Place, Place>, double> sharpness_by_place(const data::io::PolygonSoup& soup) {
  std::map<std::pair<Place, Place>, double> all;
  const auto vertices = static_cast<std::int64_t>(soup.positions.size());
  for (const auto& t : soup.sharp) {
    if (t.a < 0 || t.a >= vertices || t.b < -1 || t.b >= vertices || t.a == t.b || !(t.sharpness >= 0))
      continue;
    const Place a = soup.positions[t.a], b = soup.positions[t.b < 0 ? t.a : t.b];
    double& most = all.emplace(std::minmax(a, b), t.sharpness).first->second;
    most = std::max(most, t.sharpness);
  }
  return all;
}

/// The first property that a repair breaks, in words; empty if it breaks none.
inline std::string broken_property(const data::io::PolygonSoup& soup, const RepairOptions& options) {
  const Repaired once = repair(soup, options);
  if (once.soup.polygon_end.empty()) return "";
  const auto faults = data::io::examine(once.soup, {}).faults;
  if (!faults.empty()) return "a fault is left: " + faults.front().message;

  const std::set<Place> before(soup.positions.begin(), soup.positions.end());
  for (const Place& p : once.soup.positions)
    if (!before.contains(p)) return "a vertex moved";

  const Repaired twice = repair(once.soup, options);
  if (!twice.changes.empty()) return "a second run changes something: " + twice.changes.front();
  const auto same_tag = [](const auto& a, const auto& b) {
    return a.a == b.a && a.b == b.b && a.sharpness == b.sharpness;
  };
  if (twice.soup.positions != once.soup.positions || twice.soup.corners != once.soup.corners ||
      twice.soup.polygon_end != once.soup.polygon_end ||
      !std::equal(once.soup.sharp.begin(), once.soup.sharp.end(), twice.soup.sharp.begin(),
                  twice.soup.sharp.end(), same_tag))
    return "a second run changes the mesh in silence";

  // Where no two vertices lie at one place, an edge that is left is as sharp as it was.
  if (before.size() != soup.positions.size() || options.weld_distance > 0) return "";
  const auto sharp_after = sharpness_by_place(once.soup);
  std::set<std::pair<Place, Place>> left;
  std::size_t begin = 0;
  for (const std::size_t end : once.soup.polygon_end) {
    for (std::size_t k = begin; k < end; ++k) {
      const Place a = once.soup.positions[once.soup.corners[k]];
      const Place b = once.soup.positions[once.soup.corners[k + 1 < end ? k + 1 : begin]];
      left.insert(std::minmax(a, b));
      left.insert({a, a});
    }
    begin = end;
  }
  for (const auto& [place, sharpness] : sharpness_by_place(soup)) {
    if (!left.contains(place)) continue;
    const auto after = sharp_after.find(place);
    if (after == sharp_after.end() || after->second != sharpness) return "a sharpness is lost";
  }
  return "";
}

}  // namespace limitcheck::verify
