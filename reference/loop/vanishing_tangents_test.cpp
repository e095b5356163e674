// SPDX-License-Identifier: MIT
// Where tangents vanish but for rounding no evaluator claims a normal; and what a normal's condition number
// promises holds. All rings and meshes here are turned and shifted so that nothing cancels exactly.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "data/splitmix64.h"
#include "data/test_meshes.h"
#include "reference/loop/recursion.h"
#include "reference/loop/refine.h"
#include "reference/loop/stam.h"
#include "reference/loop/vertex_limit.h"
#include "reference/number/number_exact.h"

namespace limitcheck::reference {
namespace {

using V = Vec3<double>;

V scattered(data::SplitMix64& random) {
  return {2 * random.unit() - 1, 2 * random.unit() - 1, 2 * random.unit() - 1};
}

/// n points about `centre` that wind round it twice: no first harmonic, but what rounding leaves of one.
std::vector<V> twice_round(int n, const V& centre, const V& a, const V& b) {
  std::vector<V> ring;
  for (int i = 0; i < n; ++i) {
    const double t = 4 * std::numbers::pi * i / n;
    ring.push_back(centre + a * std::cos(t) + b * std::sin(t));
  }
  return ring;
}

/// A wheel: the hub is vertex 0, face i is (0, i + 1, i + 2).
data::ControlMesh wheel_of(const V& hub, const std::vector<V>& ring) {
  data::ControlMesh mesh{{{hub.x, hub.y, hub.z}}, {}};
  const auto n = static_cast<std::int32_t>(ring.size());
  for (const V& r : ring) mesh.positions.push_back({r.x, r.y, r.z});
  for (std::int32_t i = 0; i < n; ++i) mesh.faces.push_back({0, i + 1, (i + 1) % n + 1});
  return mesh;
}

double angle(const V& a, const V& b) {
  const V c = cross(a, b);
  return std::atan2(std::sqrt(dot(c, c)), dot(a, b));
}

TEST(D12_VanishingTangents, OfARingWithoutFirstHarmonicAreNotRegularInAnyEvaluator) {
  data::SplitMix64 random(16);
  for (int trial = 0; trial < 100; ++trial) {
    const int n = 8 + trial % 9;
    const V hub = scattered(random), a = scattered(random), b = scattered(random);
    const auto ring = twice_round(n, hub, a, b);
    EXPECT_NE(vertex_limit<double>(hub, ring, false).normal.kind, NormalKind::kRegular) << trial;
    const data::ControlMesh mesh = wheel_of(hub, ring);
    EXPECT_NE(StamEvaluator<double>(mesh).evaluate(0, 0., 0.).normal_kind, NormalKind::kRegular) << trial;
    EXPECT_NE(SubdivisionEvaluator<double>(mesh).evaluate(0, 0., 0.).normal_kind, NormalKind::kRegular);
    for (const int depth : {0, 1, 5}) {
      EXPECT_NE(refine<double>(mesh, depth).limits().kinds[0], NormalKind::kRegular) << trial << " " << depth;
      NaiveSubdivider<double>(mesh).tessellate(0, depth, [&](const LeafTriangle<double>& leaf) {
        for (const auto& c : leaf) {
          if (c.i != 0 || c.j != 0) continue;
          EXPECT_NE(c.normal_kind, NormalKind::kRegular) << trial << " " << depth;
        }
      });
    }
  }
}

TEST(D12_VanishingTangents, OnABoundaryAreNotRegularEither) {
  // The two ends of the ring agree but for the last bit: along vanishes.
  data::SplitMix64 random(17);
  for (int trial = 0; trial < 100; ++trial) {
    const V hub = scattered(random);
    std::vector<V> ring;
    for (int i = 0; i < 2 + trial % 5; ++i) ring.push_back(scattered(random));
    ring.push_back({std::nextafter(ring[0].x, 2), std::nextafter(ring[0].y, -2), ring[0].z});
    EXPECT_NE(vertex_limit<double>(hub, ring, true).normal.kind, NormalKind::kRegular) << trial;
  }
}

TEST(D12_VanishingTangents, InsideAFaceWhosePointsAgreeButForTheLastBitAreNotRegular) {
  data::SplitMix64 random(18);
  std::vector<V> ring;
  const V hub{1. / 3, 2. / 3, -.7};
  for (int i = 0; i < 7; ++i)
    ring.push_back({std::nextafter(hub.x, random.unit() < .5 ? 1 : -1),
                    std::nextafter(hub.y, random.unit() < .5 ? 1 : -1), hub.z});
  const data::ControlMesh mesh = wheel_of(hub, ring);
  const StamEvaluator<double> stam(mesh);
  const SubdivisionEvaluator<double> subdivision(mesh);
  for (int f = 0; f < 7; ++f)
    for (const auto& [l1, l2] :
         {std::pair{.25, .25}, {.5, .25}, {.125, .625}, {1e-3, 2e-3}, {0., .5}, {.375, .5}}) {
      EXPECT_NE(stam.evaluate(f, l1, l2).normal_kind, NormalKind::kRegular) << f << " " << l1 << " " << l2;
      EXPECT_NE(subdivision.evaluate(f, l1, l2).normal_kind, NormalKind::kRegular) << f << " " << l1;
    }
}

// With 16 and 30 meridians, at depths 0 and 3. The bound is what an audit allows a subject in double.
TEST(D12_VanishingTangents, AtThePolesOfASphereBlameNobody) {
  for (const int around : {16, 30}) {
    const data::ControlMesh mesh = data::sphere_with_residue(around);
    const NaiveSubdivider<double> naive(mesh);
    const StamEvaluator<double> stam(mesh);
    std::size_t regular = 0, points = 0;
    for (const int depth : {0, 3})
      for (std::size_t f = 0; f < naive.face_count(); ++f)
        naive.tessellate(f, depth, [&](const LeafTriangle<double>& leaf) {
          for (const auto& c : leaf) {
            const auto s = stam.evaluate(static_cast<int>(f), std::ldexp(c.i, -depth),
                                         std::ldexp(c.j, -depth), Derivatives::kFirst);
            ++points;
            if (s.normal_kind != NormalKind::kRegular) continue;
            ++regular;
            EXPECT_LE(angle(c.normal, s.normal), 1e-9) << "face " << f << " at " << c.i << ", " << c.j;
          }
        });
    EXPECT_GT(static_cast<double>(regular), .99 * static_cast<double>(points)) << "few points have no normal";
  }
}

TEST(D12_VanishingTangents, AreADirectionToANumberOfMoreDigits) {
  // A first harmonic of 1e-30: lost in double, thirty digits above the rounding of fifty.
  const auto ring = [](auto one) {
    using N = decltype(one);
    std::vector<Vec3<N>> points;
    for (int i = 0; i < 8; ++i)
      points.push_back({NumberTraits<N>::cos_pi(i, 2), sin_pi<N>(i, 2), one / N(3)});
    const N tiny = NumberTraits<N>::from_double(1e-30);
    points[1].x += tiny;
    points[6].y += tiny;
    return points;
  };
  EXPECT_EQ((vertex_limit<double>({0, 0, 0}, ring(1.), false).normal.kind), NormalKind::kFallback);
  const auto limit = vertex_limit<Decimal50>({}, ring(Decimal50(1)), false);
  EXPECT_EQ(limit.normal.kind, NormalKind::kRegular);
  EXPECT_LT(abs(limit.normal.direction.z + 1), Decimal50("1e-15"));
}

/// How far the normal turns when each control coordinate is off by a relative error u, in units of u times
/// the condition number, at most over some points and changes.
double worst_turn(const data::ControlMesh& mesh, const std::vector<std::array<double, 3>>& places) {
  constexpr double u = 1e-11;
  const StamEvaluator<double> exact(mesh);
  data::SplitMix64 random(19);
  double worst = 0;
  for (int trial = 0; trial < 20; ++trial) {
    data::ControlMesh moved = mesh;
    for (auto& p : moved.positions) {
      const double size = magnitude(V{p[0], p[1], p[2]});
      for (double& x : p) x += u * size * (random.unit() < .5 ? -1 : 1);
    }
    const StamEvaluator<double> off(moved);
    for (const auto& [f, l1, l2] : places) {
      const auto s = exact.evaluate(static_cast<int>(f), l1, l2, Derivatives::kFirst);
      EXPECT_EQ(s.normal_kind, NormalKind::kRegular);
      const auto t = off.evaluate(static_cast<int>(f), l1, l2, Derivatives::kFirst);
      worst = std::max(worst, angle(s.normal, t.normal) / (u * s.normal_condition));
    }
  }
  return worst;
}

// Terms are measured by the largest coordinate: sqrt(3) for the length of a change; and a face far thinner
// than long is as ill-conditioned as the number says. That the number is not much too large is the other
// half: a random change of signs reaches a tenth of it.
TEST(NormalCondition, BoundsHowFarErrorsOfThePointsTurnTheNormal) {
  data::SplitMix64 random(20);
  for (const double thin : {1., 1e-3, 1e-6}) {
    std::vector<V> ring;
    for (int i = 0; i < 7; ++i) {
      const double t = 2 * std::numbers::pi * i / 7;
      ring.push_back({2 + std::cos(t) + .1 * random.unit(), thin * (std::sin(t) + .1 * random.unit()),
                      1 + .3 * random.unit()});
    }
    const data::ControlMesh mesh = wheel_of({2, 0, 1}, ring);
    std::vector<std::array<double, 3>> places;
    for (const double f : {0., 3.})
      for (const auto& [l1, l2] :
           {std::pair{0., 0.}, {.25, .25}, {.5, .25}, {.01, .02}, {0., .5}, {.375, .5}, {1e-4, .999}})
        places.push_back({f, l1, l2});
    const double worst = worst_turn(mesh, places);
    EXPECT_LE(worst, std::sqrt(3.)) << thin;
    EXPECT_GE(worst, .1) << thin;
    RecordProperty("thin " + std::to_string(thin), std::to_string(worst));
  }
}

TEST(TangentDirections, AtAnExtraordinaryCornerAreTheEdgesOfARegularRing) {
  for (const int n : {3, 4, 5, 7, 12}) {
    const V hub{.2, -.3, .7}, a{1, .5, 0}, b{-.25, 1, .5};
    std::vector<V> ring;
    for (int i = 0; i < n; ++i) {
      const double t = 2 * std::numbers::pi * i / n;
      ring.push_back(hub + a * std::cos(t) + b * std::sin(t));
    }
    const auto s = StamEvaluator<double>(wheel_of(hub, ring)).evaluate(0, 0., 0.);
    EXPECT_TRUE(s.at_corner);
    EXPECT_LE(magnitude(s.t1 - (ring[0] - hub)), 1e-15) << n;
    EXPECT_LE(magnitude(s.t2 - (ring[1] - hub)), 2e-15) << n;
  }
}

}  // namespace
}  // namespace limitcheck::reference
