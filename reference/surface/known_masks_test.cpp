// SPDX-License-Identifier: MIT
// The masks of both schemes against data/known_masks.json: limits and tangents computed outside this project.
// The masks of a dart, whatever its numbers: a step leaves the limit where it is and shrinks a tangent by its
// eigenvalue. And the numbers that are known.
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "data/numeral.h"
#include "data/splitmix64.h"
#include "reference/catmull_clark/vertex_limit.h"
#include "reference/loop/vertex_limit.h"
#include "reference/number/number_exact.h"
#include "reference/number/vec3.h"

namespace limitcheck::reference {
namespace {

using N = Decimal100;

struct KnownMask {
  enum class Kind { kSmooth, kBoundary, kDart } kind;
  int faces;
  std::vector<Decimal100> limit, first, second;  ///< of the centre, the ring from e_0 on, the far corners
};

std::vector<KnownMask> known_masks(const std::string& scheme) {
  std::ifstream stream(LIMITCHECK_SOURCE_DIR "/data/known_masks.json");
  std::vector<KnownMask> result;
  const nlohmann::json all = nlohmann::json::parse(stream);
  for (const auto& one : all.at("masks")) {
    if (one.at("scheme") != scheme) continue;
    const auto weights = [&](const char* key) {
      std::vector<Decimal100> list;
      for (const auto& w : one.at(key)) list.push_back(data::parse<Decimal100>(w.get<std::string>()));
      return list;
    };
    const char first = one.at("vertex").get<std::string>()[0];
    const bool boundary = first == 'c', dart = first == 'd';
    const auto& count = one.at(boundary ? "K" : "valence");
    result.push_back({dart       ? KnownMask::Kind::kDart
                      : boundary ? KnownMask::Kind::kBoundary
                                 : KnownMask::Kind::kSmooth,
                      count.is_string() ? std::stoi(count.get<std::string>()) : count.get<int>(),
                      weights("limit"),
                      weights(dart       ? "symmetric"
                              : boundary ? "along"
                                         : "t1"),
                      weights(dart       ? "antisymmetric"
                              : boundary ? "across"
                                         : "t2")});
  }
  return result;
}

/// Compares the masks of a vertex with known ones to 40 digits; tangents up to a factor, which is positive
/// but at darts.
///   evaluate   takes points (of the centre, the ring, the far corners) to limit, first and second tangent
template <class Evaluate>
void expect_masks(const KnownMask& known, Evaluate&& evaluate) {
  const std::string what = std::to_string(static_cast<int>(known.kind)) + ", " + std::to_string(known.faces);
  std::array<std::vector<N>, 3> ours;
  for (std::size_t i = 0; i < known.limit.size(); ++i) {
    std::vector<Vec3<N>> points(known.limit.size());
    points[i].x = N(1);
    const std::array<Vec3<N>, 3> values = evaluate(points);
    for (std::size_t m = 0; m < 3; ++m) ours[m].push_back(values[m].x);
  }
  const std::array<const std::vector<N>*, 3> theirs{&known.limit, &known.first, &known.second};
  for (std::size_t m = 0; m < 3; ++m) {
    std::size_t largest = 0;
    for (std::size_t i = 0; i < ours[m].size(); ++i)
      if (magnitude((*theirs[m])[i]) > magnitude((*theirs[m])[largest])) largest = i;
    const N factor = m == 0 ? N(1) : N(ours[m][largest] / (*theirs[m])[largest]);
    if (known.kind != KnownMask::Kind::kDart) {
      EXPECT_GT(factor, N(0)) << what;
    }
    for (std::size_t i = 0; i < ours[m].size(); ++i)
      EXPECT_LE(magnitude(ours[m][i] - (*theirs[m])[i] * factor), N("1e-40") * (N(1) + magnitude(factor)))
          << what << " mask " << m << " weight " << i;
  }
}

TEST(Loop_Masks, AreTheKnownOnes) {
  const auto all = known_masks("loop");
  EXPECT_EQ(all.size(), 20U);
  for (const KnownMask& known : all)
    expect_masks(known, [&](const std::vector<Vec3<N>>& points) -> std::array<Vec3<N>, 3> {
      std::vector<Vec3<N>> ring(points.begin() + 1, points.end());
      const bool dart = known.kind == KnownMask::Kind::kDart;
      if (dart) ring.push_back(points[1]);
      const auto limit = vertex_limit<N>(points[0], ring, known.kind != KnownMask::Kind::kSmooth,
                                         Weights::kLoop, dart ? VertexState::kDart : VertexState::kOrdinary);
      return {limit.position, limit.tangents.first, limit.tangents.second};
    });
}

TEST(CatmullClark_Masks, AreTheKnownOnes) {
  const auto all = known_masks("cc");
  EXPECT_EQ(all.size(), 26U);
  for (const KnownMask& known : all)
    expect_masks(known, [&](const std::vector<Vec3<N>>& points) -> std::array<Vec3<N>, 3> {
      catmull_clark::RingedCorner<Vec3<N>> c;
      c.on_boundary = known.kind != KnownMask::Kind::kSmooth;
      if (known.kind == KnownMask::Kind::kDart) c.state = VertexState::kDart;
      const auto faces = static_cast<std::size_t>(known.faces);
      const std::size_t edges = faces + (known.kind == KnownMask::Kind::kBoundary ? 1 : 0);
      c.point = points[0];
      c.edges.assign(points.begin() + 1, points.begin() + 1 + static_cast<std::ptrdiff_t>(edges));
      c.faces.assign(points.begin() + 1 + static_cast<std::ptrdiff_t>(edges), points.end());
      if (known.kind == KnownMask::Kind::kDart) c.edges.push_back(points[1]);
      const Tangents<N> t = catmull_clark::limit_tangents(c);
      return {catmull_clark::limit_position(c), t.first, t.second};
    });
}

Vec3<N> random_point(data::SplitMix64& random) {
  const auto number = [&] { return N(static_cast<int>(random.next() % 2001) - 1000) / N(64); };
  Vec3<N> p;
  p.x = number(), p.y = number(), p.z = number();
  return p;
}

// By how much a tangent is shorter.
double shrinks(const Vec3<N>& after, const Vec3<N>& before, const std::string& what) {
  EXPECT_LE(magnitude(cross(after, before)), N("1e-90")) << what;
  EXPECT_GT(dot(after, before), N(0)) << what;
  return N(dot(after, before) / dot(before, before)).convert_to<double>();
}

TEST(Loop_Darts, StayWhereTheyAreInAStepThatShrinksTheirTangents) {
  for (const Weights weights : {Weights::kLoop, Weights::kWarren})
    for (int n = 3; n <= 30; ++n) {
      data::SplitMix64 random(static_cast<std::uint64_t>(n));
      const Vec3<N> v = random_point(random);
      std::vector<Vec3<N>> ring;
      for (int i = 0; i < n; ++i) ring.push_back(random_point(random));
      ring.push_back(ring.front());
      Vec3<N> moved = v;
      std::vector<Vec3<N>> next = ring;
      subdivide_ring(moved, next, true, weights, VertexState::kDart);
      const auto before = vertex_limit<N>(v, ring, true, weights, VertexState::kDart),
                 after = vertex_limit<N>(moved, next, true, weights, VertexState::kDart);
      EXPECT_LE(magnitude(after.position - before.position), N("1e-95")) << n;
      const double along = shrinks(after.tangents.first, before.tangents.first, "along " + std::to_string(n));
      const double across =
          shrinks(after.tangents.second, before.tangents.second, "across " + std::to_string(n));
      EXPECT_NEAR(across, .375 + NumberTraits<double>::cos_pi(2, n) / 4, 1e-14) << n;
      if (weights != Weights::kLoop) continue;
      const double known = n == 4 ? .4518223336 : n == 6 ? .5 : n == 7 ? .514472829837 : along;
      EXPECT_NEAR(along, known, 1e-10) << n;
    }
}

}  // namespace
}  // namespace limitcheck::reference
