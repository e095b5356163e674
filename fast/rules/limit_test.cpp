// SPDX-License-Identifier: MIT
// Claim D12 has one rule: the sliding window, row streaming and the depth heuristics take the same normal
// where the tangents of a control vertex vanish, and find the same vertices where they do. The rings are
// turned and shifted, so that nothing cancels exactly.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "data/splitmix64.h"
#include "fast/rules/limit.h"
#include "fast/rules/prepared_mesh.h"
#include "fast/rules/ring.h"
#include "fast/stream/gather/rings.h"
#include "fast/stream/host/number_stream.h"
#include "fast/test_support/test_meshes.h"
#include "fast/window/tessellator.h"

namespace limitcheck::fast {
namespace {

using row_stream::BasicLoopRings;
using row_stream::CornerBlock;
using row_stream::LoopRings;
using row_stream::ScalarNumber;
using V = Vec3<double>;

VertexLimit<double> limit_of(const V& v, const std::vector<V>& ring, bool open) {
  const auto n = static_cast<int>(ring.size());
  return vertex_limit<double>(v, ring, open,
                              open ? RingWeights<double>::open(n) : RingWeights<double>::closed(n));
}

double size(const V& v) {
  return std::sqrt(dot(v, v));
}

/// A ring of n points that is no symmetric figure.
std::vector<V> uneven_ring(int n) {
  std::vector<V> ring;
  for (int i = 0; i < n; ++i) {
    const double t = 2 * std::numbers::pi * i / n, r = 1 + .3 * std::sin(2.3 * i);
    ring.push_back({r * std::cos(t), r * std::sin(t), .4 * std::cos(1.7 * i)});
  }
  return ring;
}

TEST(Sec31_LimitMasks, AreLeftEigenvectorsOfTheSubdivisionStep) {
  RecordProperty("claim", "C14 C17");
  for (int n = 3; n <= 200; ++n) {
    const std::vector<V> ring = uneven_ring(n);
    const V centre{.1, -.2, .3};
    const auto before = limit_of(centre, ring, false);
    const auto weights = vertex_weights<double>(n);
    V sum{};
    for (const V& p : ring) sum = sum + p;
    const V refined = weights.centre * centre + weights.ring * sum;
    std::vector<V> finer;
    const auto size_n = static_cast<std::size_t>(n);
    for (std::size_t i = 0; i < size_n; ++i)
      finer.push_back(edge_point(centre, ring[i], ring[(i + size_n - 1) % size_n], ring[(i + 1) % size_n]));
    const auto after = limit_of(refined, finer, false);
    EXPECT_LE(size(after.position - before.position), 1e-14) << n;
    const double lambda = .375 + .25 * std::cos(2 * std::numbers::pi / n);
    EXPECT_LE(size(after.du - lambda * before.du), 1e-13 * n) << n;
    EXPECT_LE(size(after.dv - lambda * before.dv), 1e-13 * n) << n;
  }
}

TEST(Sec31_LimitMasks, OfTheRegularCasesAreTheGeneralOnes) {
  const std::vector<V> r = uneven_ring(6);
  const V centre{.1, -.2, .3};
  const auto general = limit_of(centre, r, false);
  const auto regular = regular_limit<double>(centre, {r[0], r[1], r[2], r[3], r[4], r[5]});
  EXPECT_LE(size(general.position - regular.position), 1e-15);
  EXPECT_LE(size(2. * general.du - regular.du), 1e-14);
  EXPECT_LE(size(2 / std::sqrt(3.) * general.dv - regular.dv), 1e-14);
  const std::vector<V> open(r.begin(), r.begin() + 4);
  const auto boundary = limit_of(centre, open, true);
  const auto three = regular_boundary_limit<double>(centre, r[0], r[1], r[2], r[3]);
  EXPECT_LE(size(boundary.position - three.position), 1e-15);
  EXPECT_LE(size(boundary.du - three.du), 1e-15);
  EXPECT_LE(size(4 / std::sqrt(3.) * boundary.dv - three.dv), 1e-14);
}

TEST(Sec31_LimitMasks, KeepTheirBitsUnderAHalfTurn) {
  RecordProperty("claim", "D14");
  for (int seed = 0; seed < 200; ++seed) {
    Vec3<float> p[7];
    for (int i = 0; i < 7; ++i) {
      const auto x = [&](int k) { return std::round(8 * std::sin(seed * 1.3f + 3.7f * i + 2.1f * k)) / 8; };
      p[i] = {static_cast<float>(x(0)), static_cast<float>(x(1)),
              seed % 2 == 0 ? 0.0f : static_cast<float>(x(2))};
    }
    std::int64_t zero = 0;
    const auto at = [&](int turn) {
      const auto r = [&](int i) -> const Vec3<float>& { return p[(i + turn) % 6]; };
      const AxisRing<float> ring{r(0), r(1), r(2), r(3), r(4), r(5)};
      return LimitSurface<float>::vertex(
          regular_limit(p[6], ring),
          [&] {
            V all[] = {widen<float>(r(0)), widen<float>(r(1)), widen<float>(r(2)),
                       widen<float>(r(3)), widen<float>(r(4)), widen<float>(r(5))};
            return substitute_normal<double>(widen<float>(p[6]), all, false, kParallel<float>);
          },
          zero);
    };
    const auto a = at(0), b = at(3);
    const auto same = [](float x, float y) {
      return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y);
    };
    for (const auto& [x, y] : {std::pair{a.position, b.position}, {a.normal, b.normal}})
      EXPECT_TRUE(same(x.x, y.x) && same(x.y, y.y) && same(x.z, y.z)) << seed;
  }
}

/// A bipyramid over eight points without first harmonic: A cos 2t + B sin 2t + C cos 3t + D sin 3t. The
/// tangents at its apexes 8 and 9 vanish.
data::ControlMesh without_first_harmonic(const V& a, const V& b, const V& c, const V& d) {
  data::ControlMesh mesh = bipyramid(8);
  for (int i = 0; i < 8; ++i) {
    const double t = 2 * std::numbers::pi * i / 8;
    const V p = std::cos(2 * t) * a + std::sin(2 * t) * b + std::cos(3 * t) * c + std::sin(3 * t) * d;
    mesh.positions[i] = {p.x, p.y, p.z};
  }
  return mesh;
}

TEST(D12_VanishingNormals, AreThoseOfTheFacesWeightedByAreaAfterOneStep) {
  RecordProperty("claim", "D12");
  const V a{1, .2, .3}, b{-.1, .9, .4}, c{.3, -.8, .1}, d{.2, .5, 2};
  const data::ControlMesh mesh = without_first_harmonic(a, b, c, d);
  const Adjacency adjacency(mesh);
  const PreparedMesh<double> prepared(adjacency, positions_of<double>(mesh));
  EXPECT_EQ(prepared.zero_normals(), 2);
  // The areas of a ring add up to n / 2 sum over k of sin(2 pi k / n) A_k x B_k, and a step multiplies the
  // k-th harmonic by 3/8 + cos(2 pi k / n) / 4.
  const auto after = [&](int steps) {
    const double two = std::pow(.375, 2 * steps), three = std::pow(.375 - std::sqrt(.5) / 4, 2 * steps);
    const V sum = two * cross(a, b) + std::sqrt(.5) * three * cross(c, d);
    return 1 / size(sum) * sum;
  };
  ASSERT_GT(size(after(0) - after(1)), .1) << "of a ring that does not tell them apart";
  ASSERT_GT(size(after(2) - after(1)), .01);
  EXPECT_LE(size(prepared.limit(8).normal - after(1)), 1e-14);
  EXPECT_LE(size(prepared.limit(9).normal + after(1)), 1e-14);
}

TEST(D12_VanishingNormals, OfCollinearAndCoincidentRingsPointUpwards) {
  RecordProperty("claim", "D12");
  data::ControlMesh mesh = bipyramid(7);
  for (const bool collapsed : {false, true}) {
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      const double t = collapsed ? .7 : std::sin(1. + static_cast<double>(i));
      mesh.positions[i] = {.1 + .3 * t, .7 * t, .2 - .9 * t};  // not representable: collinear up to rounding
    }
    const Adjacency adjacency(mesh);
    const PreparedMesh<double> prepared(adjacency, positions_of<double>(mesh));
    EXPECT_EQ(prepared.zero_normals(), 9);
    for (int v = 0; v < 9; ++v) EXPECT_EQ(prepared.limit(v).normal, (V{0, 0, 1})) << v;
  }
}

TEST(D12_VanishingNormals, AreFiniteUnitAndCounted) {
  // coincident points, collinear points, a doubly wound ring without first harmonic
  for (const int kind : {0, 1, 2}) {
    data::ControlMesh mesh = bipyramid(8);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      auto& p = mesh.positions[i];
      if (kind == 0) p = {1, 1, 1};
      if (kind == 1) p = {static_cast<double>(i), 0, 0};
      const double t = 4 * std::numbers::pi * static_cast<double>(i) / 8;
      if (kind == 2) p = {i < 8 ? std::cos(t) : 0, i < 8 ? std::sin(t) : 0, i == 8 ? 1. : i == 9 ? -1. : 0};
    }
    Tessellator<float> tessellator(mesh);
    DrawList<float> list;
    const auto stats = tessellator.frame(std::vector<std::int32_t>(16, 3), list);
    EXPECT_GT(stats.zero_normals, 0) << kind;
    for (const auto& v : list.vertices) {
      ASSERT_TRUE(std::isfinite(v.position.x + v.position.y + v.position.z));
      ASSERT_NEAR(dot(v.normal, v.normal), 1, 1e-5) << kind;
    }
  }
}

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
  const double* n = stream.head(v) + CornerBlock::kLimit + 3;
  result.stream = {n[0], n[1], n[2]};
  result.stream_degenerate = stream.degenerate_normals() > 0;
  Ring ring;
  ring.gather(mesh, adjacency, v);
  result.heuristics = ring.limit_vertex(&result.heuristics_degenerate).normal;
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
        EXPECT_NE(std::bit_cast<std::uint32_t>(rings.head(v)[CornerBlock::kLimit + k]),
                  std::bit_cast<std::uint32_t>(-0.f))
            << v << " " << down;
    }
  }
}

}  // namespace
}  // namespace limitcheck::fast
