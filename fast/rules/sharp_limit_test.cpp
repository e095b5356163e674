// SPDX-License-Identifier: MIT
#include "fast/rules/vertex_limit.h"

#include <gtest/gtest.h>

#include <vector>

#include "fast/rules/limit.h"

namespace limitcheck::fast {
namespace {

// The left null vectors of the step, in rational numbers: of the vertex, then e_0, e_1, ..
struct Known {
  int faces;
  double whole;
  std::vector<double> parts;
};

TEST(DartWeights, AreTheRationalOnes) {
  const std::vector<Known> all{
      {3, 37, {9, 6, 6}}, {4, 6385, {1085, 744, 868, 744}}, {6, 426, {42, 29, 35, 36, 35, 29}}};
  for (const Known& known : all) {
    const auto weights = dart_weights<double>(known.faces);
    for (std::size_t i = 0; i < known.parts.size(); ++i)
      EXPECT_NEAR(weights.position[i], known.parts[i] / known.whole, 1e-14) << known.faces << ": " << i;
  }
}

// A step leaves the limit where it is, and scales each tangent by its eigenvalue. The symmetric ones to the
// digits that are known.
TEST(DartLimit, SurvivesASubdivisionStep) {
  for (const auto& [faces, eigenvalue] : {std::pair{3, .39827}, {4, .45182}, {5, .48094}, {6, .5}}) {
    Vec3<double> v{.1, .2, -.3};
    std::vector<Vec3<double>> ring;
    for (int i = 0; i < faces; ++i) ring.push_back({std::cos(i), std::sin(2 * i), .25 * i});
    ring.push_back(ring.front());
    const auto weights = dart_weights<double>(faces);
    const auto before = dart_limit<double>(v, ring, weights);
    subdivide_in_place<double>(v, ring, true, VertexKind::kDart);
    EXPECT_EQ(ring.front(), ring.back());
    const auto after = dart_limit<double>(v, ring, weights);
    const auto size = [](const Vec3<double>& a) { return std::sqrt(dot(a, a)); };
    EXPECT_LE(size(after.position - before.position), 1e-14);
    EXPECT_NEAR(size(after.du) / size(before.du), eigenvalue, 6e-6) << faces;
    EXPECT_LE(size(cross(after.du, before.du)), 1e-13);
    const double antisymmetric = .375 + .25 * std::cos(2 * std::numbers::pi / faces);
    EXPECT_LE(size(after.dv - antisymmetric * before.dv), 1e-14);
  }
}

TEST(HeldLimit, IsTheVertexAndTheEndsOfItsRing) {
  const Vec3<double> v{1, 2, 3};
  const std::vector<Vec3<double>> ring{{2, 2, 3}, {2, 3, 4}, {1, 4, 3}};
  const auto limit = held_limit<double>(v, ring, true, RingWeights<double>::open(3));
  EXPECT_EQ(limit.position, v);
  EXPECT_EQ(limit.du, (Vec3<double>{1, 0, 0}));
  EXPECT_EQ(limit.dv, (Vec3<double>{0, 2, 0}));
}

}  // namespace
}  // namespace limitcheck::fast
