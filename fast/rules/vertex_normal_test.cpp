// SPDX-License-Identifier: MIT
// Claim D12 has one rule: the sliding window, row streaming and the depth heuristics take the same normal
// where the tangents of a control vertex vanish, and find the same vertices where they do. The rings are
// turned and shifted, so that nothing cancels exactly.
#include "fast/rules/limit.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

#include "data/splitmix64.h"
#include "fast/rules/prepared_mesh.h"
#include "fast/rules/ring.h"
#include "fast/stream/gather/rings.h"
#include "fast/stream/host/number_stream.h"
#include "fast/test_support/test_meshes.h"

namespace limitcheck::fast::row_stream {
namespace {

using V = Vec3<double>;

V scattered(data::SplitMix64& random) {
  return {2 * random.unit() - 1, 2 * random.unit() - 1, 2 * random.unit() - 1};
}

/// A wheel of n points that wind round the hub, vertex n, as often as `turns` says, in the plane of a and b.
data::ControlMesh winding(int n, int turns, const V& hub, const V& a, const V& b) {
  data::ControlMesh mesh = wheel(n);
  for (int i = 0; i <= n; ++i) {
    const double t = 2 * std::numbers::pi * turns * i / n;
    const V p = i == n ? hub : hub + std::cos(t) * a + std::sin(t) * b;
    mesh.positions[i] = {p.x, p.y, p.z};
  }
  return mesh;
}

struct Normals {
  V window, stream;
  V heuristics;
  bool window_degenerate, stream_degenerate, heuristics_degenerate;
};

/// What the three have for a vertex.
Normals normals_of(const data::ControlMesh& mesh, std::int32_t v) {
  const Adjacency adjacency(mesh);
  Normals result;
  const PreparedMesh<double> window(adjacency, positions_of<double>(mesh));
  result.window = window.limit(v).normal;
  result.window_degenerate = window.zero_normals() > 0;
  const BasicLoopRings<ScalarNumber<double>> stream(mesh, adjacency);
  const double* n = stream.corner(v).head.data() + CornerBlock::kLimit + 3;
  result.stream = {n[0], n[1], n[2]};
  result.stream_degenerate = stream.degenerate_normals() > 0;
  Ring ring;
  ring.gather(mesh, adjacency, v);
  result.heuristics = ring.limit_normal(&result.heuristics_degenerate);
  return result;
}

double distance(const V& a, const V& b) {
  return std::sqrt(dot(a - b, a - b));
}

// Substitutes agree to the rounding of their sums, 1e-14 for rings that are not thin.
void expect_one_rule(const data::ControlMesh& mesh, std::int32_t v, bool degenerate, const std::string& what,
                     double tolerance = 1e-12) {
  const Normals n = normals_of(mesh, v);
  EXPECT_EQ(n.window_degenerate, degenerate) << what;
  EXPECT_EQ(n.stream_degenerate, degenerate) << what;
  EXPECT_EQ(n.heuristics_degenerate, degenerate) << what;
  EXPECT_LE(distance(n.window, n.stream), tolerance) << what;
  EXPECT_LE(distance(n.window, n.heuristics), tolerance) << what;
}

TEST(D12_OneRule, HoldsWhereTheFirstHarmonicVanishesButForRounding) {
  RecordProperty("claim", "D12");
  data::SplitMix64 random(12);
  for (int trial = 0; trial < 100; ++trial) {
    const int n = 8 + trial % 9;
    const V hub = scattered(random), a = scattered(random), b = scattered(random);
    const std::string what = "trial " + std::to_string(trial);
    expect_one_rule(winding(n, 2, hub, a, b), n, true, what);
    const V facets = cross(a, b);
    EXPECT_LE(
        distance(normals_of(winding(n, 2, hub, a, b), n).stream, 1 / std::sqrt(dot(facets, facets)) * facets),
        1e-12)
        << what;
    expect_one_rule(winding(n, 1, hub, a, b), n, false, what);
  }
}

// A ring of no first harmonic whose facets face down before a step and up after it: the rule looks at the
// steps first.
TEST(D12_OneRule, LooksAtTheFacetsAfterAStepBeforeThoseOfTheControlMesh) {
  RecordProperty("claim", "D12");
  const double x[] = {3.5, 1, -2.5, -2, .5, 1, .5, 1, .5, -2, -2.5, 1};
  const double y[] = {0, -.5, 1, 1.5, -1, -2.5, 0, 2.5, 1, -1.5, -1, .5};
  data::ControlMesh mesh = wheel(12);
  for (std::size_t i = 0; i < 12; ++i) mesh.positions[i] = {x[i], y[i], 0};
  mesh.positions[12] = {0, 0, 0};
  const Normals n = normals_of(mesh, 12);
  for (const V& normal : {n.window, n.stream, n.heuristics}) EXPECT_EQ(normal, (V{0, 0, 1}));
  expect_one_rule(mesh, 12, true, "control facets face down");
}

// Tangents of a sine of 1e-8 and of 1e-14, in any direction; the mesh small, large or far away.
TEST(D12_OneRule, HasOneToleranceAtEverySize) {
  RecordProperty("claim", "D12");
  data::SplitMix64 random(13);
  for (const double size : {1e-30, 1., 1e30})
    for (int trial = 0; trial < 20; ++trial) {
      const V hub = size * scattered(random), a = size * scattered(random);
      const V b = scattered(random), aside = (1 / std::sqrt(dot(b, b))) * cross(a, b);
      const std::string what = std::to_string(size) + " trial " + std::to_string(trial);
      expect_one_rule(winding(7, 1, V{}, a, 1e-8 * aside), 7, false, "sine of 1e-8, " + what, 1e-7);
      expect_one_rule(winding(7, 1, V{}, a, 1e-14 * aside), 7, true, "sine of 1e-14, " + what, 3);
      expect_one_rule(winding(8, 2, hub, a, aside), 8, true, "twice round, " + what, 1e-11);
    }
}

TEST(D12_OneRule, WritesNoNegativeZero) {
  RecordProperty("claim", "D12");
  for (const double down : {1., -1.}) {
    const data::ControlMesh once = winding(7, 1, V{}, {1, 0, 0}, {0, down, 0}),
                            twice = winding(8, 2, V{}, {1, 0, 0}, {0, down, 0});
    for (const auto& [mesh, v] : {std::pair{once, 7}, {twice, 8}}) {
      const Normals n = normals_of(mesh, v);
      for (const V& normal : {n.window, n.stream})
        for (const double c : {normal.x, normal.y, normal.z})
          EXPECT_NE(std::bit_cast<std::uint64_t>(c), std::bit_cast<std::uint64_t>(-0.)) << v << " " << down;
      const Adjacency adjacency(mesh);
      const LoopRings rings(mesh, adjacency);
      for (std::size_t k = 3; k < 6; ++k)
        EXPECT_NE(std::bit_cast<std::uint32_t>(rings.corner(v).head[CornerBlock::kLimit + k]),
                  std::bit_cast<std::uint32_t>(-0.f))
            << v << " " << down;
    }
  }
}

}  // namespace
}  // namespace limitcheck::fast::row_stream
