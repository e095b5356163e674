// SPDX-License-Identifier: MIT
// Section 4.1 held against the limit surface itself: what the heuristics can and cannot promise.
// [C23-C25, C31-C34]
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include "data/generators/bumpy_sphere.h"
#include "data/shapes.h"
#include "reference/loop/stam.h"
#include "verify/claims/test_support/figures.h"
#include "verify/claims/test_support/scene.h"

namespace limitcheck::verify {
namespace {

using fast::Camera;
using fast::DepthOptions;
using fast::Facing;
using fast::Point3;
using fast::Strategy;
using reference::Order;
using Evaluator = reference::StamEvaluator<double>;

Point3 point(const reference::Vec3<double>& p) {
  return {p.x, p.y, p.z};
}

double angle(const Point3& a, const Point3& b) {
  return std::atan2(length(cross(a, b)), dot(a, b)) * 180 / std::numbers::pi;
}

struct TrueScene : Scene {
  using Scene::Scene;
  Evaluator truth{mesh};
};

/// Limit positions and normals of a face on the lattice of
/// a depth: row j from corner 0 to corner 2, i within it.
struct Lattice {
  int n;
  std::vector<Point3> position, normal;
  std::size_t at(int i, int j) const { return static_cast<std::size_t>(j * (n + 1) - j * (j - 1) / 2 + i); }
};

Lattice sample(const Evaluator& truth, int face, int depth) {
  Lattice lattice{1 << depth, {}, {}};
  for (int j = 0; j <= lattice.n; ++j) {
    for (int i = 0; i + j <= lattice.n; ++i) {
      const auto p = truth.evaluate(face, 1. * i / lattice.n, 1. * j / lattice.n, Order::kFirst);
      lattice.position.push_back(point(p.position));
      lattice.normal.push_back(point(p.normal));
    }
  }
  return lattice;
}

double quantile(std::vector<double> values, double q) {
  std::sort(values.begin(), values.end());
  return values[q * static_cast<double>(values.size() - 1)];
}

struct Sphere {
  Point3 centre;
  double radius = 0;
};
Sphere sphere_round_mean(const std::vector<Point3>& points) {
  Sphere sphere;
  for (const Point3& p : points) sphere.centre = sphere.centre + p;
  sphere.centre = (1. / static_cast<double>(points.size())) * sphere.centre;
  for (const Point3& p : points) sphere.radius = std::max(sphere.radius, length(p - sphere.centre));
  return sphere;
}

std::vector<Point3> corners(const Scene& scene, std::int32_t f) {
  std::vector<Point3> result;
  for (int k = 0; k < 3; ++k)
    result.push_back(fast::to_point(scene.mesh.positions[scene.adjacency.corner(f, k)]));
  return result;
}

std::vector<std::int32_t> half_edges_from(const fast::Adjacency& adjacency, std::int32_t vertex) {
  std::vector<std::int32_t> all;
  const std::int32_t first = adjacency.outgoing(vertex);
  for (std::int32_t h = first; h >= 0 && (all.empty() || h != first); h = adjacency.rotate(h))
    all.push_back(h);
  return all;
}

TEST(Sec41_ProjectSphere, MayMisjudgeTheLimitPatchAndIsNoBoundingVolume) {
  for (const int faces : {200, 800}) {
    const TrueScene scene(faces);
    std::vector<double> ratio;
    int leaving = 0;
    for (std::int32_t f = 0; f < faces; ++f) {
      const Sphere control = sphere_round_mean(corners(scene, f));
      const Lattice patch = sample(scene.truth, f, 3);
      ratio.push_back(sphere_round_mean(patch.position).radius / control.radius);
      leaving += std::any_of(patch.position.begin(), patch.position.end(), [&](const Point3& p) {
        return length(p - control.centre) > control.radius * (1 + 1e-12);
      });
    }
    const double least = quantile(ratio, 0), median = quantile(ratio, .5), most = quantile(ratio, 1);
    record("{}", fmt::format("{:.2f} {:.2f} {:.2f}", least, median, most),
           "patch_radius_over_triangle_radius_{}", faces);
    record("{:.1f}", 100. * leaving / faces, "percent_leaving_the_sphere_{}", faces);
    EXPECT_LT(least, .4);
    EXPECT_GT(most, 1.1);
    EXPECT_LT(median, .9);
    EXPECT_GT(leaving, faces / 50) << "the sphere round the triangle does not bound the patch";
  }
}

// The weight of control point i is the limit function of the values 1 at i and 0 elsewhere. All of them are
// non-negative and sum to 1, so every limit point is a convex combination; none reaches beyond the one-ring.
TEST(Sec41_ConvexHull, OfTheNeighbourhoodBoundsTheLimitPatchBecauseNoWeightIsNegative) {
  double least = 1, worst_sum = 0, beyond = 0;
  for (const auto& mesh : {data::bumpy_sphere(60, 1), data::tetrahedron(), data::wheel(12, 2),
                           data::wheel(3, 2), data::fan(3, 2), data::fan(7, 2), data::ragged_disc()}) {
    const fast::Adjacency adjacency(mesh);
    const auto vertices = static_cast<std::int32_t>(mesh.positions.size());
    const int faces = adjacency.face_count();
    std::vector<std::set<std::int32_t>> near(faces);
    for (std::int32_t f = 0; f < faces; ++f)
      for (int k = 0; k < 3; ++k)
        for (const std::int32_t h : half_edges_from(adjacency, adjacency.corner(f, k)))
          near[f].insert(
              {adjacency.origin(h), adjacency.target(h), adjacency.origin(fast::Adjacency::prev(h))});
    constexpr int kDepth = 2;
    const std::size_t points = (4 + 1) * (4 + 2) / 2;
    std::vector<double> sums(static_cast<std::size_t>(faces) * points, 0);
    for (std::int32_t v = 0; v < vertices; v += 3) {  // three control points at a time, one per coordinate
      std::vector<reference::Vec3<double>> values(mesh.positions.size());
      values[v].x = 1;
      if (v + 1 < vertices) values[v + 1].y = 1;
      if (v + 2 < vertices) values[v + 2].z = 1;
      const Evaluator weights(values, triangles_of(mesh).to_vector());
      for (std::int32_t f = 0; f < faces; ++f) {
        const Lattice lattice = sample(weights, f, kDepth);
        for (std::size_t p = 0; p < points; ++p) {
          const Point3 w = lattice.position[p];
          const std::array<double, 3> weight{w.x, w.y, w.z};
          for (std::int32_t k = 0; k < 3; ++k) {
            sums[static_cast<std::size_t>(f) * points + p] += weight[k];
            least = std::min(least, weight[k]);
            if (!near[f].contains(v + k)) beyond = std::max(beyond, std::abs(weight[k]));
          }
        }
      }
    }
    for (const double sum : sums) worst_sum = std::max(worst_sum, std::abs(sum - 1));
  }
  record("{:.3g}", least, "least_weight");
  // Weights are of order 1 and computed by about 30 operations: a few hundred units of 1.1e-16 at the most.
  EXPECT_GE(least, -1e-13);
  EXPECT_LE(worst_sum, 1e-13);
  EXPECT_LE(beyond, 1e-13) << "a control point beyond the one-ring has an influence";
}

TEST(Sec41_ConvexHull, IsNotTight) {
  const TrueScene scene(200);
  std::vector<double> ratio;
  for (std::int32_t f = 0; f < 200; ++f) {
    std::vector<Point3> neighbourhood = corners(scene, f);
    for (int k = 0; k < 3; ++k)
      for (const std::int32_t h : half_edges_from(scene.adjacency, scene.adjacency.corner(f, k)))
        neighbourhood.push_back(fast::to_point(scene.mesh.positions[scene.adjacency.target(h)]));
    ratio.push_back(sphere_round_mean(neighbourhood).radius /
                    sphere_round_mean(sample(scene.truth, f, 3).position).radius);
  }
  record("{:.2f}", quantile(ratio, .5), "median_radius_of_neighbourhood_over_patch");
  EXPECT_GT(quantile(ratio, 0), 1.2);
  EXPECT_GT(quantile(ratio, .5), 2);
}

// The cones that the paper describes and does not compute: an axis and the largest angle of all normals of the limit
// patch to it, and a sphere that its points lie in. Whoever they call front or back is that all over.
TEST(Sec41_NormalCones, OfTheLimitPatchTellFrontBackAndSilhouette) {
  for (const int faces : {200, 800}) {
    const TrueScene scene(faces);
    const Camera camera;
    int decided = 0, silhouettes = 0, truly = 0;
    for (std::int32_t f = 0; f < faces; ++f) {
      const Lattice patch = sample(scene.truth, f, 5), finer = sample(scene.truth, f, 6);
      const Sphere sphere = sphere_round_mean(patch.position);
      Point3 axis{};
      for (const Point3& n : patch.normal) axis = axis + n;
      double spread = 0;
      for (const Point3& n : patch.normal) spread = std::max(spread, angle(n, axis));
      const Point3 view = sphere.centre - camera.eye;
      spread += std::asin(sphere.radius / length(view)) * 180 / std::numbers::pi;
      const double between = angle(axis, view);
      std::size_t away = 0;
      for (std::size_t p = 0; p < finer.position.size(); ++p)
        away += dot(finer.normal[p], finer.position[p] - camera.eye) >= 0;
      const bool front = between - spread > 90, back = between + spread < 90;
      decided += front || back;
      silhouettes += !front && !back;
      truly += away > 0 && away < finer.position.size();
      EXPECT_TRUE(!front || away == 0) << faces << " faces, face " << f;
      EXPECT_TRUE(!back || away == finer.position.size()) << faces << " faces, face " << f;
    }
    record("{:.0f}", 100. * decided / faces, "percent_decided_by_cones_{}", faces);
    record("{:.0f}", 100. * silhouettes / faces, "percent_called_silhouette_{}", faces);
    record("{:.0f}", 100. * truly / faces, "percent_truly_on_the_silhouette_{}", faces);
    EXPECT_GE(silhouettes, truly) << "no silhouette is missed";
    EXPECT_GT(decided, faces / 10);
  }
}

TEST(Sec41_Culling, HidesSomeFrontFacingPointsAndCompletelyFrontFacingIsNoGuarantee) {
  for (const int faces : {200, 800}) {
    const TrueScene scene(faces);
    const Camera camera;
    const auto facing = scene.heuristics.facing(camera);
    int culled = 0, wrongly_culled = 0, front = 0, wrongly_front = 0;
    for (std::int32_t f = 0; f < faces; ++f) {
      if (facing[f] == Facing::kSilhouette) continue;
      const Lattice patch = sample(scene.truth, f, 4);
      int away = 0, total = static_cast<int>(patch.position.size());
      for (std::size_t p = 0; p < patch.position.size(); ++p) {
        away += dot(patch.normal[p], patch.position[p] - camera.eye) >= 0;
      }
      if (facing[f] == Facing::kBack) {
        ++culled;
        wrongly_culled += away < total;
      } else {
        ++front;
        wrongly_front += away > 0;
      }
      // The corners themselves are what the class is made of.
      for (const std::size_t corner : {patch.at(0, 0), patch.at(patch.n, 0), patch.at(0, patch.n)}) {
        ASSERT_EQ(dot(patch.normal[corner], patch.position[corner] - camera.eye) >= 0,
                  facing[f] == Facing::kBack);
      }
    }
    record("{:.1f}", 100. * wrongly_culled / culled, "percent_of_culled_with_front_points_{}", faces);
    record("{:.1f}", 100. * wrongly_front / front, "percent_of_front_with_back_points_{}", faces);
    EXPECT_GT(wrongly_culled, culled / 20);
    EXPECT_LT(wrongly_culled, culled / 2);
    EXPECT_GT(wrongly_front, front / 20);
    EXPECT_LT(wrongly_front, front / 2);
  }
}

// Limit position and normal of the heuristics against the exact evaluator, at every vertex.
TEST(Sec41_VertexNormals, OfTheHeuristicsAreThoseOfTheLimitSurface) {
  double worst_position = 0, worst_normal = 0;
  for (const auto& mesh :
       {data::bumpy_sphere(800, 1), data::tetrahedron(), data::wheel(50), data::fan(1, 2), data::fan(2, 2),
        data::fan(3, 2), data::fan(5, 2), data::sheet(4, 5), data::strip(5), data::bipyramid(200)}) {
    const TrueScene scene(mesh);
    for (std::int32_t f = 0; f < scene.adjacency.face_count(); ++f) {
      for (int k = 0; k < 3; ++k) {
        const auto p = scene.truth.evaluate(f, k == 1 ? 1. : 0., k == 2 ? 1. : 0., Order::kFirst);
        const std::int32_t v = scene.adjacency.corner(f, k);
        worst_position =
            std::max(worst_position, length(point(p.position) - scene.heuristics.limit_position(v)));
        worst_normal = std::max(worst_normal, angle(point(p.normal), scene.heuristics.limit_normal(v)));
      }
    }
  }
  record("{:.2g}", worst_position, "worst_position");
  record("{:.2g}", worst_normal, "worst_normal_degrees");
  EXPECT_LE(worst_position, 1e-14);  // sums of at most 200 numbers of order 1
  EXPECT_LE(worst_normal, 1e-10);
}

// Depth from the corners alone: somewhere inside, a sub-triangle may deviate from the limit normals at its
// own corners by more than the prescribed angle.
TEST(Sec41_Cone, AtTheCornersDoesNotBoundTheCurvatureInside) {
  for (const int faces : {200, 800}) {
    const TrueScene scene(faces);
    DepthOptions options;
    options.strategy = Strategy::kCurvature;
    options.cull = false;
    options.angle_front = options.angle_silhouette = options.angle_back = 15;
    const auto depth = scene.heuristics.depths(options, {});
    int looked_at = 0, beyond = 0;
    double worst = 0;
    for (std::int32_t f = 0; f < faces; ++f) {
      if (depth[f] < 2) continue;
      ++looked_at;
      const Lattice patch = sample(scene.truth, f, depth[f]);
      double here = 0;
      const auto look = [&](std::size_t a, std::size_t b, std::size_t c) {
        const Point3 n = cross(patch.position[b] - patch.position[a], patch.position[c] - patch.position[a]);
        for (const std::size_t corner : {a, b, c}) here = std::max(here, angle(n, patch.normal[corner]));
      };
      for (int j = 0; j < patch.n; ++j) {
        for (int i = 0; i + j < patch.n; ++i) {
          const bool at_corner = (i == 0 && j == 0) || i == patch.n - 1 || j == patch.n - 1;
          if (!at_corner) look(patch.at(i, j), patch.at(i + 1, j), patch.at(i, j + 1));
          if (i + j + 1 < patch.n) look(patch.at(i + 1, j), patch.at(i + 1, j + 1), patch.at(i, j + 1));
        }
      }
      beyond += here > 15;
      worst = std::max(worst, here);
    }
    record("{}", fmt::format("{} of {}, worst {:.1f} degrees", beyond, looked_at, worst),
           "faces_of_depth_2_to_5_beyond_15_degrees_inside_{}", faces);
    EXPECT_GT(beyond, looked_at / 100);
    EXPECT_LT(beyond, looked_at / 2);
    EXPECT_GT(worst, 20);
  }
}

/// Largest absolute k-th difference of a curve sampled at equal steps, over the coordinates.
double difference(std::vector<Point3> curve, int k) {
  for (; k > 0; --k) {
    for (std::size_t i = 0; i + 1 < curve.size(); ++i) curve[i] = curve[i + 1] - curve[i];
    curve.pop_back();
  }
  double largest = 0;
  for (const Point3& p : curve) largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return largest;
}

TEST(Sec41_LoopSurface, IsOfDegreeFourInsideAndCubicOnlyAlongTheBoundary) {
  const TrueScene closed(data::torus(7, 6));
  std::vector<Point3> inside;
  for (int i = 0; i <= 8; ++i)
    inside.push_back(point(closed.truth.evaluate(5, i / 16., i / 24., Order::kPosition).position));
  EXPECT_LE(difference(inside, 5), 1e-14);  // 2^5 times the rounding of one position
  EXPECT_GE(difference(inside, 4), 1e-7) << "not a cubic";

  const TrueScene open(data::sheet(6, 6));
  bool found = false;
  for (std::int32_t h = 0; h < 3 * open.adjacency.face_count() && !found; ++h) {
    if (open.adjacency.twin(h) >= 0 || open.adjacency.valence(open.adjacency.origin(h)) != 4 ||
        open.adjacency.valence(open.adjacency.target(h)) != 4) {
      continue;
    }
    found = true;
    std::vector<Point3> border;
    for (int i = 0; i <= 8; ++i) {
      std::array<double, 3> l{0, 0, 0};
      l[h % 3] = 1 - i / 8.;
      l[fast::Adjacency::next(h) % 3] = i / 8.;
      border.push_back(point(open.truth.evaluate(h / 3, l[1], l[2], Order::kPosition).position));
    }
    EXPECT_LE(difference(border, 4), 3e-14);
    EXPECT_GE(difference(border, 3), 1e-6);
  }
  EXPECT_TRUE(found);
}

}  // namespace
}  // namespace limitcheck::verify
