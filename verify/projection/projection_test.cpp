// SPDX-License-Identifier: MIT
// The closest point against points whose foot is known, and against brute force.
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <limits>

#include "data/generators/named_mesh.h"
#include "data/splitmix64.h"
#include "reference/loop/refine.h"
#include "verify/projection/closest_point.h"

namespace limitcheck::verify {
namespace {

std::vector<std::string> meshes() {
  std::vector<std::string> names = data::stock_shapes();
  names.insert(names.end(), {"bumpy:200", "wheel:50", "wheel:3", "fan:1", "fan:9"});
  return names;
}

// Inside faces, next to their edges, on edges, and on corners.
FacePoint random_point(data::SplitMix64& random, std::size_t faces) {
  FacePoint p{static_cast<std::int32_t>(random.next() % faces), {}};
  double a = random.unit(), b = random.unit();
  if (a + b > 1) a = 1 - a, b = 1 - b;
  p.l = {1 - a - b, a, b};
  const auto k = random.next() % 3;
  switch (random.next() % 6) {
    case 0:
      p.l[k] = 0;
      break;
    case 1:
      p.l[k] *= 1e-9;
      break;
    case 2:
      p.l = {0, 0, 0}, p.l[k] = 1;
      break;
    case 3:
      p.l = {1e-6, 1e-6, 1e-6}, p.l[k] = 1;
      break;
    default:
      break;
  }
  p.l = clamped(p.l);
  return p;
}

// 1e-15 everywhere but next to the corner of a boundary
// face without neighbours, where d1 and d2 become parallel.
TEST(Projection, APointOfTheSurfaceIsItsOwnFoot) {
  double worst = 0;
  for (const std::string& name : meshes()) {
    const data::ControlMesh mesh = data::named_mesh(name);
    const ClosestPoint closest(mesh, 1 << 14);
    data::SplitMix64 random(1);
    for (int n = 0; n < 300; ++n) {
      const FacePoint at = random_point(random, mesh.faces.size());
      const Foot truth = closest.at(at, {});
      const Foot foot = closest.closest(truth.position);
      if (name != "fan:1") worst = std::max(worst, foot.distance / closest.diagonal());
      EXPECT_LE(foot.distance, (name == "fan:1" ? 1e-11 : 1e-15) * closest.diagonal())
          << name << " face " << at.face << " (" << at.l[1] << ", " << at.l[2] << ") became " << foot.at.face
          << " (" << foot.at.l[1] << ", " << foot.at.l[2] << ")";
    }
  }
  RecordProperty("worst_distance_in_diagonals", std::to_string(worst * 1e16) + "e-16");
}

// On an embedded surface the parameter is unique: that of the point it was made from.
TEST(Projection, TheParameterOfAPointOfTheSurfaceIsRecovered) {
  double worst = 0;
  for (const std::string name : {"bumpy:200", "icosahedron", "wheel:7"}) {
    const data::ControlMesh mesh = data::named_mesh(name);
    const ClosestPoint closest(mesh, 1 << 14);
    data::SplitMix64 random(2);
    for (int n = 0; n < 500; ++n) {
      FacePoint at = random_point(random, mesh.faces.size());
      for (double& l : at.l) l = (l + .01) / 1.03;  // away from edges, where the face would be ambiguous
      const Foot foot = closest.closest(closest.at(at, {}).position);
      ASSERT_EQ(foot.at.face, at.face) << name;
      for (int k = 0; k < 3; ++k) worst = std::max(worst, std::abs(foot.at.l[k] - at.l[k]));
    }
  }
  RecordProperty("worst", std::to_string(worst * 1e12) + "e-12");
  EXPECT_LE(worst, 1e-12);
}

// The largest |normal curvature|, by the fundamental forms (do Carmo, 3.3); infinite where the evaluator has
// no second derivatives.
double largest_curvature(const ClosestPoint& closest, const FacePoint& at) {
  const auto s = closest.surface().evaluate(at, reference::Order::kSecond);
  if (!s.second_exist || s.at_corner) return std::numeric_limits<double>::infinity();
  const double E = dot(s.d1, s.d1), F = dot(s.d1, s.d2), G = dot(s.d2, s.d2);
  const double e = dot(s.d11, s.normal), f = dot(s.d12, s.normal), g = dot(s.d22, s.normal);
  const double gauss = (e * g - f * f) / (E * G - F * F);
  const double mean = (e * G - 2 * f * F + g * E) / (2 * (E * G - F * F));
  return std::abs(mean) + std::sqrt(std::max(mean * mean - gauss, 0.0));
}

// Offset by less than half of the radii of curvature, and by less than half of the distance to any other part
// of the surface (a thousandth of the size, on these). Next to interior vertices of valence 3 and from 7 on
// the curvature has no bound, at those of valence 4 and 5 it has.
TEST(Projection, ThePointItWasOffsetFromIsTheFoot) {
  double worst = 0;
  int looked = 0;
  for (const std::string name : {"bumpy:200", "icosahedron", "octahedron", "tetrahedron", "wheel:7"}) {
    const data::ControlMesh mesh = data::named_mesh(name);
    const ClosestPoint closest(mesh, 1 << 14);
    data::SplitMix64 random(3);
    for (int n = 0; n < 400; ++n) {
      const FacePoint at = random_point(random, mesh.faces.size());
      const Foot truth = closest.at(at, {});
      const double by = (n % 2 == 0 ? 1 : -1) * 1e-3 * closest.diagonal();
      const bool bounded = name == "icosahedron" || name == "octahedron";
      if (!bounded && largest_curvature(closest, at) * std::abs(by) > .5) continue;
      ++looked;
      const Foot foot = closest.closest(truth.position + by * truth.normal);
      worst = std::max(worst, norm(foot.position - truth.position) / closest.diagonal());
      EXPECT_LE(foot.distance, std::abs(by) * (1 + 1e-12)) << name;
      EXPECT_LE(norm(foot.position - truth.position), 1e-9 * closest.diagonal())
          << name << " face " << at.face << " (" << at.l[0] << ", " << at.l[1] << ", " << at.l[2]
          << ") became " << foot.at.face << " (" << foot.at.l[0] << ", " << foot.at.l[1] << ", "
          << foot.at.l[2] << ")";
      EXPECT_TRUE(foot.stationary) << name;
    }
  }
  EXPECT_GT(looked, 1200);
  RecordProperty("worst_in_diagonals", std::to_string(worst * 1e12) + "e-12");
}

// Random points near and far, against all limit points of a deep lattice.
TEST(Projection, NoSampleOfTheSurfaceIsNearerAndNoneIsBelowTheProvedBound) {
  int gaps = 0, all = 0;
  for (const std::string& name : meshes()) {
    const data::ControlMesh mesh = data::named_mesh(name);
    const ClosestPoint closest(mesh, 1 << 12);
    const auto samples = reference::refine<double>(mesh, closest.lattice().depth() + 1).limits().positions;
    data::SplitMix64 random(4);
    std::vector<Vector> points;
    for (int n = 0; n < 40; ++n) {
      const Vector origin = closest.at(random_point(random, mesh.faces.size()), {}).position;
      const double reach = closest.diagonal() * std::ldexp(1.0, -static_cast<int>(random.next() % 10));
      Vector p = origin;
      for (double& x : p) x += reach * (random.unit() - .5);
      points.push_back(p);
    }
    std::vector<double> brute(points.size());
    tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t k) {
      double least = std::numeric_limits<double>::infinity();
      for (const auto& s : samples) least = std::min(least, norm(points[k] - Vector{s.x, s.y, s.z}));
      brute[k] = least;
    });
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Foot foot = closest.closest(points[k]);
      EXPECT_LE(foot.distance, brute[k] + 1e-12 * closest.diagonal()) << name << " point " << k;
      EXPECT_GE(brute[k], foot.at_least) << name << " point " << k;
      EXPECT_LE(foot.at_least, foot.distance) << name;
      EXPECT_NEAR(foot.distance, norm(foot.position - points[k]), 1e-15 * closest.diagonal());
      gaps += foot.distance - foot.at_least > 2 * closest.lattice().largest_deviation();
      ++all;
    }
  }
  EXPECT_EQ(gaps, 0) << "of " << all;
}

}  // namespace
}  // namespace limitcheck::verify
