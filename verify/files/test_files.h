// SPDX-License-Identifier: MIT
// Tessellations as files would have them. For tests of this folder.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "data/splitmix64.h"
#include "reference/loop/refine.h"
#include "verify/files/audit_files.h"
#include "verify/files/checks/hausdorff.h"

namespace limitcheck::verify::test {

// The limit surface at a depth, in float as engines deliver it.
inline FileTessellation exact(const data::ControlMesh& mesh, int depth, bool limit = true) {
  const auto refined = reference::refine<double>(mesh, depth);
  const auto limits = refined.limits();
  FileTessellation t;
  t.name = "test.ply";
  const auto& points = limit ? limits.positions : refined.positions();
  for (std::size_t v = 0; v < points.size(); ++v) {
    const auto& p = points[v];
    const auto& n = limits.normals[v];
    t.positions.push_back({float(p.x), float(p.y), float(p.z)});
    t.normals.push_back({static_cast<std::int32_t>(v), {float(n.x), float(n.y), float(n.z)}});
  }
  t.triangles = refined.triangles();
  t.polygons = static_cast<std::int64_t>(t.triangles.size());
  t.polygon.resize(t.triangles.size());
  std::iota(t.polygon.begin(), t.polygon.end(), 0);
  t.used.assign(t.positions.size(), true);
  return t;
}

// As shuffled.ply would be: other numbers for the vertices, other order of the triangles, corners turned.
inline FileTessellation shuffled(const FileTessellation& from, std::uint64_t seed) {
  data::SplitMix64 random(seed);
  const auto permutation = [&](std::size_t n) {
    std::vector<std::int32_t> p(n);
    std::iota(p.begin(), p.end(), 0);
    for (std::size_t k = n; k > 1; --k) std::swap(p[k - 1], p[random.next() % k]);
    return p;
  };
  FileTessellation t = from;
  const auto to = permutation(t.positions.size());
  for (std::size_t v = 0; v < t.positions.size(); ++v) t.positions[to[v]] = from.positions[v];
  for (auto& n : t.normals) n.vertex = to[n.vertex];
  const auto order = permutation(t.triangles.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const auto& f = from.triangles[k];
    const auto turn = random.next() % 3;
    t.triangles[order[k]] = {to[f[turn]], to[f[(turn + 1) % 3]], to[f[(turn + 2) % 3]]};
  }
  return t;
}

inline void add_triangle(FileTessellation& t, const std::array<std::int32_t, 3>& corners) {
  t.triangles.push_back(corners);
  t.polygon.push_back(t.polygons++);
}

inline FilesAudit audit(const data::ControlMesh& mesh, FileTessellation t, const FilesOptions& options = {},
                        const std::vector<ProvenanceRow>& provenance = {}) {
  return audit_files("mesh", mesh, std::move(t), provenance, options,
                     [](const std::string&, std::size_t, std::size_t) {});
}

inline const Result& row(const FilesAudit& a, const std::string& check) {
  for (const Result& r : a.results)
    if (r.check == check) return r;
  throw std::out_of_range(check);
}

inline std::string findings(const FilesAudit& a) {
  std::string list;
  for (const Result& r : a.results)
    if (is_bad(r)) list += (list.empty() ? "" : " ") + r.check;
  return list;
}

// Faults of one place each.
inline void turn_a_normal(FileTessellation& t) {  // by 0.3 degrees
  auto& n = t.normals[321].direction;
  const Vector aside = cross(n, std::abs(n[0]) < .5 ? Vector{1, 0, 0} : Vector{0, 1, 0});
  n = n + (5e-3 / norm(aside)) * aside;
}
inline void turn_a_triangle(FileTessellation& t) {
  std::swap(t.triangles[99][0], t.triangles[99][1]);
}
inline void repeat_a_triangle(FileTessellation& t) {
  t.triangles.push_back(t.triangles[40]);
}
inline void leave_out_a_triangle(FileTessellation& t) {
  t.triangles.erase(t.triangles.begin() + 40);
}
// A corner of one triangle only, one ulp of float or of double beside.
template <class Real>
void crack(FileTessellation& t, std::size_t triangle, std::size_t corner) {
  std::int32_t& vertex = t.triangles[triangle][corner];
  t.positions.push_back(t.positions[vertex]);
  t.positions.back()[0] = std::nextafter(static_cast<Real>(t.positions.back()[0]), Real{9});
  t.used.push_back(true);
  vertex = static_cast<std::int32_t>(t.positions.size()) - 1;
}

// The brackets hold dense samples of both sides: of the triangles, and of the surface, which are given; and are not
// much too wide. The points of the evidence are placed.
inline void expect_brackets(const FileEvidence& e, const std::vector<Vector>& samples) {
  const Hausdorff h = hausdorff(e);
  const FileTessellation& t = e.tessellation;
  double there = 0, back = 0;
  for (const auto& c : t.triangles)
    for (int i = 0; i <= 6; ++i)
      for (int j = 0; i + j <= 6; ++j) {
        const Vector& o = t.positions[c[0]];
        const Vector p = o + (i / 6.) * (t.positions[c[1]] - o) + (j / 6.) * (t.positions[c[2]] - o);
        there = std::max(there, e.surface.closest(p).distance);
      }
  for (const Vector& s : samples) {
    double least = 1e300;
    for (const auto& c : t.triangles)
      least = std::min(
          least, closest_on_triangle(s, {t.positions[c[0]], t.positions[c[1]], t.positions[c[2]]}).distance);
    back = std::max(back, least);
  }
  EXPECT_LE(there, h.from_triangles.at_most) << e.control_name;
  EXPECT_LE(back, h.from_surface.at_most) << e.control_name;
  EXPECT_GE(h.from_triangles.at_least, .9 * there) << e.control_name;
  EXPECT_GE(h.from_surface.at_least, .9 * back) << e.control_name;
  EXPECT_LE(h.from_triangles.at_most, 6 * h.from_triangles.at_least) << e.control_name;
  EXPECT_EQ(h.loose, 0) << e.control_name;
}

}  // namespace limitcheck::verify::test
