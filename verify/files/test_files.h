// SPDX-License-Identifier: MIT
// Tessellations as files would have them. For tests of this folder.
#pragma once

#include <array>
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "data/splitmix64.h"
#include "reference/loop/refine.h"
#include "verify/files/audit_files.h"

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

}  // namespace limitcheck::verify::test
