// SPDX-License-Identifier: MIT
// Points by where they lie, the same name from every face that touches them. For tests of this folder.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "data/bounding_box.h"
#include "data/generators/named_mesh.h"
#include "verify/subject/host.h"

namespace limitcheck::verify::test {

/// Every interior valence class, every boundary situation, faces whose corners are all irregular.
inline std::vector<std::pair<std::string, data::ControlMesh>> shapes() {
  std::vector<std::pair<std::string, data::ControlMesh>> result;
  for (const char* name : {"tetrahedron", "octahedron", "triangle", "strip:6", "wheel:3:1", "wheel:7:2",
                           "fan:5:1", "fan:8:2", "ragged-disc", "holes", "two-components", "bumpy:200"}) {
    result.emplace_back(name, data::named_mesh(name));
  }
  return result;
}

/// (kind, a, b, c, d): control vertex a; or on edge a < b, c / d from a; or in face a at (b, c) / d.
using Place = std::tuple<int, std::int64_t, std::int64_t, std::int64_t, std::int64_t>;

inline Place place(const data::ControlMesh& mesh, const lc_provenance& p) {
  const auto& corners = mesh.triangles[static_cast<std::size_t>(p.face)];
  const std::array<std::int64_t, 3> l{std::int64_t{p.denominator} - p.i - p.j, p.i, p.j};
  for (std::size_t k = 0; k < 3; ++k) {
    if (l[k] == p.denominator) return {0, corners[k], 0, 0, 0};
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const auto a = corners[k], b = corners[(k + 1) % 3];
    if (l[(k + 2) % 3] != 0) continue;
    return a < b ? Place{1, a, b, l[(k + 1) % 3], p.denominator} : Place{1, b, a, l[k], p.denominator};
  }
  return {2, p.face, p.i, p.j, p.denominator};
}

/// (l0, l1, l2) of `p` on `face`, which it may name or only touch.
inline std::optional<std::array<std::int64_t, 3>> on_face(const data::ControlMesh& mesh,
                                                          const lc_provenance& p, std::int32_t face) {
  const auto& from = mesh.triangles[static_cast<std::size_t>(p.face)];
  const auto& to = mesh.triangles[static_cast<std::size_t>(face)];
  const std::array<std::int64_t, 3> l{std::int64_t{p.denominator} - p.i - p.j, p.i, p.j};
  if (p.face == face) return l;
  std::array<std::int64_t, 3> result{0, 0, 0};
  for (std::size_t k = 0; k < 3; ++k) {
    if (l[k] == 0) continue;
    std::size_t c = 0;
    while (c < 3 && to[c] != from[k]) ++c;
    if (c == 3) return std::nullopt;
    result[c] = l[k];
  }
  return result;
}

/// Every place and the vertices that lie there.
inline std::map<Place, std::vector<std::int64_t>> places(const data::ControlMesh& mesh,
                                                         const Tessellation& t) {
  std::map<Place, std::vector<std::int64_t>> result;
  for (std::int64_t v = 0; v < t.vertex_count(); ++v) {
    result[place(mesh, t.provenance()[static_cast<std::size_t>(v)])].push_back(v);
  }
  return result;
}

inline double distance(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return std::sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
                   (a[2] - b[2]) * (a[2] - b[2]));
}

}  // namespace limitcheck::verify::test
