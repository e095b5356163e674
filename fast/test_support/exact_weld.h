// SPDX-License-Identifier: MIT
// For tests: merges points that are the same to the last bit and looks at the edges that remain; and collects what a
// draw sink is given.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <span>
#include <unordered_map>
#include <vector>

#include "fast/frame/engine.h"

namespace limitcheck::fast {

struct WeldReport {
  std::int64_t points = 0, triangles = 0;
  std::int64_t degenerate = 0;      // triangles with two equal corners
  std::int64_t repeated = 0;        // directed edges met more than once: not manifold, or not orientable
  std::int64_t open = 0;            // directed edges without the opposite one
  std::int64_t boundary_loops = 0;  // -1: the open edges do not form simple loops
  std::int64_t euler = 0;           // V - E + F
  bool closed() const { return degenerate == 0 && repeated == 0 && open == 0; }
};

/// Corners of triangles, three after the other, each a position and (if `with_normals`) a normal.
template <class Real>
WeldReport weld(const std::vector<std::array<SurfaceVertex<Real>, 3>>& triangles, bool with_normals) {
  struct Hash {
    std::size_t operator()(const std::array<Real, 6>& key) const {
      std::uint64_t h = 1469598103934665603u;
      for (const Real x : key) {
        std::uint64_t bits = 0;
        std::memcpy(&bits, &x, sizeof(x));
        h = (h ^ bits) * 1099511628211u;
        h ^= h >> 29;
      }
      return h;
    }
  };
  struct Same {
    bool operator()(const std::array<Real, 6>& a, const std::array<Real, 6>& b) const {
      return std::memcmp(a.data(), b.data(), sizeof(a)) == 0;
    }
  };
  std::unordered_map<std::array<Real, 6>, std::uint32_t, Hash, Same> index;
  const auto point = [&](const SurfaceVertex<Real>& v) {
    std::array<Real, 6> key{v.position.x, v.position.y, v.position.z, 0, 0, 0};
    if (with_normals) key[3] = v.normal.x, key[4] = v.normal.y, key[5] = v.normal.z;
    return index.try_emplace(key, static_cast<std::uint32_t>(index.size())).first->second;
  };
  WeldReport report;
  std::unordered_map<std::uint64_t, int> edges;
  const auto key = [](std::uint64_t a, std::uint64_t b) { return a << 32 | b; };
  for (const auto& t : triangles) {
    const std::uint32_t v[3] = {point(t[0]), point(t[1]), point(t[2])};
    if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) {
      ++report.degenerate;
      continue;
    }
    for (int k = 0; k < 3; ++k) report.repeated += edges[key(v[k], v[(k + 1) % 3])]++ > 0 ? 1 : 0;
  }
  std::map<std::uint32_t, std::uint32_t> onward;
  bool simple = true;
  for (const auto& [edge, count] : edges) {
    const auto a = static_cast<std::uint32_t>(edge >> 32), b = static_cast<std::uint32_t>(edge);
    if (edges.count(key(b, a)) != 0) continue;
    ++report.open;
    simple = simple && onward.emplace(a, b).second;
  }
  report.points = static_cast<std::int64_t>(index.size());
  report.triangles = static_cast<std::int64_t>(triangles.size());
  report.euler =
      report.points - (static_cast<std::int64_t>(edges.size()) + report.open) / 2 + report.triangles;
  while (simple && !onward.empty()) {
    const std::uint32_t start = onward.begin()->first;
    std::uint32_t at = start;
    do {
      const auto next = onward.find(at);
      if (next == onward.end()) {
        simple = false;
        break;
      }
      at = next->second;
      onward.erase(next);
    } while (at != start);
    ++report.boundary_loops;
  }
  if (!simple) report.boundary_loops = -1;
  return report;
}

template <class Real>
std::vector<std::array<SurfaceVertex<Real>, 3>> triangles_of(const DrawList<Real>& list) {
  std::vector<std::array<SurfaceVertex<Real>, 3>> out;
  for (const Draw& draw : list.draws) {
    for (std::int32_t t = 0; t < draw.triangle_count(); ++t) {
      const auto v = draw.triangle(t);
      const auto at = [&](std::int32_t i) { return list.vertices[draw.first + i]; };
      out.push_back({at(v[0]), at(v[1]), at(v[2])});
    }
  }
  return out;
}

template <class Real>
std::vector<std::array<SurfaceVertex<Real>, 3>> triangles_of(const IndexedMesh<Real>& mesh) {
  std::vector<std::array<SurfaceVertex<Real>, 3>> out;
  for (const auto& t : mesh.triangles)
    out.push_back({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
  return out;
}

/// Collects what a draw sink is given.
struct CollectingSink : DrawSink<float> {
  DrawList<float> list;
  void draw(const Draw& draw, std::span<const SurfaceVertex<float>> vertices,
            std::span<const LatticePoint> provenance) override {
    EXPECT_EQ(draw.first, static_cast<std::int64_t>(list.vertices.size()));
    list.draws.push_back(draw);
    list.vertices.insert(list.vertices.end(), vertices.begin(), vertices.end());
    list.provenance.insert(list.provenance.end(), provenance.begin(), provenance.end());
  }
};

/// For an engine with provenance: a frame of more than one part delivers the same to a sink as in memory.
inline void expect_a_sink_gets_the_whole_list(Engine<float>& engine, int most = 4) {
  std::vector<std::int32_t> depth;
  for (std::int32_t f = 0; f < engine.face_count(); ++f) depth.push_back(most - f % 5);
  DrawList<float> list;
  CollectingSink sink;
  const FrameStats a = engine.frame(depth, list);
  const FrameStats b = engine.frame(depth, static_cast<DrawSink<float>&>(sink));
  EXPECT_GT(list.vertices.size(), std::size_t{1} << 18) << "more than one part, or nothing is tested";
  EXPECT_EQ(sink.list.vertices, list.vertices);
  EXPECT_EQ(sink.list.provenance, list.provenance);
  EXPECT_EQ(triangles_of(sink.list), triangles_of(list));
  EXPECT_EQ(a.vertices, b.vertices);
}

}  // namespace limitcheck::fast
