// SPDX-License-Identifier: MIT
// Names of points by where they lie, the same from every face that touches a point. For tests of this folder.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "data/bounding_box.h"
#include "data/generators/named_mesh.h"
#include "verify/evidence/vector.h"
#include "verify/host/host.h"
#include "verify/subject/face_domain.h"

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
using PointName = std::tuple<int, std::int64_t, std::int64_t, std::int64_t, std::int64_t>;

inline PointName place(const data::ControlMesh& mesh, const lc_provenance& p) {
  const auto& corners = triangles_of(mesh)[p.face];
  const auto at = FaceDomain::triangle().side_of(point_of(p), p.denominator);
  if (!at) return {2, p.face, p.i, p.j, p.denominator};
  const auto a = corners[at->side], b = corners[FaceDomain::triangle().next(at->side)];
  if (at->along == 0) return {0, a, 0, 0, 0};
  return a < b ? PointName{1, a, b, at->along, p.denominator}
               : PointName{1, b, a, p.denominator - at->along, p.denominator};
}

/// (l0, l1, l2) of `p` on `face`, which it may name or only touch.
inline std::optional<std::array<std::int64_t, 3>> on_face(const data::ControlMesh& mesh,
                                                          const lc_provenance& p, std::int32_t face) {
  const auto& from = triangles_of(mesh)[p.face];
  const auto& to = triangles_of(mesh)[face];
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
inline std::map<PointName, std::vector<std::int64_t>> places(const data::ControlMesh& mesh,
                                                             const Tessellation& t) {
  std::map<PointName, std::vector<std::int64_t>> result;
  for (std::int64_t v = 0; v < t.vertex_count(); ++v) {
    result[place(mesh, t.provenance()[v])].push_back(v);
  }
  return result;
}

inline double distance(const Vector& a, const Vector& b) {
  return norm(a - b);
}

/// Keeps the worst value seen in the test's record.
inline void record(const std::string& what, double worst) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", worst);
  testing::Test::RecordProperty(what, text);
}

}  // namespace limitcheck::verify::test
