// SPDX-License-Identifier: MIT
// Section 4.1: what the heuristics do, as corrected and as printed.                       [C22, C26-C30, C82]
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include "fast/rules/ring.h"
#include "verify/claims/test_support/figures.h"
#include "verify/claims/test_support/scene.h"

namespace limitcheck::verify {
namespace {

using fast::Camera;
using fast::DepthOptions;
using fast::Facing;
using fast::Strategy;

double cosine(double degrees) {
  return std::cos(degrees * std::numbers::pi / 180);
}

/// N . N^(l) of each corner of each face and level 0 ..
/// levels, the face's own sub-triangle only: [3 f + k][l].
std::vector<std::vector<double>> corner_cosines(const Scene& scene, int levels) {
  std::vector<std::vector<double>> result(3 * scene.mesh.faces.size());
  fast::Ring ring;
  for (std::int32_t v = 0; v < scene.adjacency.vertex_count(); ++v) {
    ring.gather(scene.mesh, scene.adjacency, v);
    const fast::Point3 normal = ring.limit_vertex().normal;
    for (int l = 0; l <= levels; ++l) {
      if (l > 0) ring.subdivide();
      std::int32_t h =
          scene.adjacency.outgoing(v);  // triangle i of the ring lies in the face of the i-th half-edge
      for (int i = 0; i < ring.faces(); ++i, h = scene.adjacency.rotate(h)) {
        result[h].push_back(dot(ring.face_normal(i), normal));
      }
    }
  }
  return result;
}

TEST(Sec41_Depth, TakesSevenValuesOfWhichTheDeepestIs1024Triangles) {
  const Scene scene(800);
  std::set<std::int32_t> met;
  DepthOptions options{.strategy = Strategy::kProjectSphere, .target_pixels = 10};
  for (const double distance : {2., 4., 8., 16., 32., 64., 128.}) {
    Camera camera{.eye = {0, 0, distance}};
    for (const std::int32_t d : scene.heuristics.depths(options, camera)) met.insert(d);
  }
  EXPECT_EQ(met, (std::set<std::int32_t>{-1, 0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(std::pow(4, *met.rbegin()), 1024);
}

// "The minimal l with N . N^(l) < cos alpha": read literally,
// a corner is outside the cone at first or never again.
TEST(Sec41_ConeFormula, WithThePrintedInequalityHoldsAtDepthZeroOrNeverAndWithTheReversedOneAtSomeDepth) {
  constexpr int kLevels = 10;
  for (const int faces : {200, 800, 4000}) {
    const Scene scene(faces);
    const auto cosines = corner_cosines(scene, kLevels);
    for (const double alpha : {15., 30.}) {
      const double limit = cosine(alpha);
      int literal_at_zero = 0, literal_later = 0, literal_never = 0, corrected = 0;
      for (int f = 0; f < faces; ++f) {
        int literal = -1, reversed = -1;
        for (int l = kLevels; l >= 0; --l) {
          const double a = cosines[3 * f][l], b = cosines[3 * f + 1][l], c = cosines[3 * f + 2][l];
          if (a < limit && b < limit && c < limit) literal = l;
          if (a >= limit && b >= limit && c >= limit) reversed = l;
        }
        ++(literal == 0 ? literal_at_zero : literal > 0 ? literal_later : literal_never);
        corrected += reversed >= 0;
      }
      const std::string key = fmt::format("_{}_faces_{}_degrees", faces, alpha);
      record("{:.1f}", 100. * literal_at_zero / faces, "literal_at_zero_percent{}", key);
      record("{}", literal_later, "literal_later_faces{}", key);
      record("{}", faces - corrected, "reversed_never_faces{}", key);
      EXPECT_GE(corrected, .99 * faces) << "inside its cones at some depth, but for a few extreme spikes";
      EXPECT_GT(literal_never, 0) << "by no depth";
      EXPECT_LE(literal_later, faces / 50) << "a corner inside by chance at depth 0, then all three outside";
    }
  }
}

// By face, with depths up to the paper's 5, and up to 10, where hardly any face is cut off.
TEST(Sec41_ConeRules, OfTheFormulaAndOfTheProcedureDiffer) {
  for (const int faces : {200, 800, 4000}) {
    const Scene scene(faces, 1, fast::kDeepest);
    const auto cosines = corner_cosines(scene, fast::kDeepest);
    const double limit = cosine(15);
    for (const int deepest : {5, fast::kDeepest}) {
      double formula_sum = 0, procedure_sum = 0;
      for (std::int32_t f = 0; f < faces; ++f) {
        int formula = 0, procedure = 0;
        while (formula < deepest && std::min({cosines[3 * f][formula], cosines[3 * f + 1][formula],
                                              cosines[3 * f + 2][formula]}) < limit) {
          ++formula;
        }
        for (int k = 0; k < 3; ++k) {
          procedure = std::max(procedure, scene.heuristics.cone_depth(scene.adjacency.corner(f, k), limit));
        }
        procedure = std::min(procedure, deepest);
        EXPECT_GE(procedure + 1, formula) << "the procedure is the conservative one, but for C30";
        formula_sum += formula;
        procedure_sum += procedure;
      }
      const std::string key = fmt::format("{}_up_to_{}", faces, deepest);
      record("{:.2f}", formula_sum / faces, "mean_depth_formula_{}", key);
      record("{:.2f}", procedure_sum / faces, "mean_depth_procedure_{}", key);
      EXPECT_GT(procedure_sum, formula_sum + .2 * faces) << key;
    }
  }
}

// "The prescribed deviation can be varied according to the classification of a vertex": of the faces whose vertices all
// are of one class, and of no others, the depth follows that class's angle.
TEST(Sec41_ConeAngle, MayDifferByTheClassOfTheVertex) {
  const Scene scene(800);
  const auto depths = [&](double front, double silhouette) {
    DepthOptions options{.strategy = Strategy::kCurvature};
    options.angle_front = front, options.angle_silhouette = silhouette;
    return scene.heuristics.depths(options, {});
  };
  const auto fine = depths(15, 15), coarse_front = depths(60, 15), coarse_silhouette = depths(15, 60);
  const auto all_coarse = depths(60, 60);
  int by_front = 0, by_silhouette = 0, by_both = 0;
  for (std::size_t f = 0; f < fine.size(); ++f) {
    EXPECT_LE(coarse_front[f], fine[f]);
    EXPECT_LE(coarse_silhouette[f], fine[f]);
    // A face is as deep as the deepest of its corners: those of the class that is left fine decide.
    EXPECT_EQ(fine[f], std::max(coarse_front[f], coarse_silhouette[f]));
    by_front += coarse_front[f] < fine[f];
    by_silhouette += coarse_silhouette[f] < fine[f];
    by_both += all_coarse[f] < std::min(coarse_front[f], coarse_silhouette[f]);
  }
  record("{}", by_front, "faces_of_800_less_deep_by_the_angle_of_front_vertices");
  record("{}", by_silhouette, "faces_of_800_less_deep_by_the_angle_of_silhouette_vertices");
  EXPECT_GT(by_front, 0);
  EXPECT_GT(by_silhouette, 0);
  EXPECT_GT(by_both, 0) << "faces with vertices of both classes follow both angles";
}

// The procedure and the formula meet where they must: the vertex value is the smallest over its triangles.
TEST(Sec41_ConeRules, TheProcedureTakesTheWorstOfAllIncidentSubTriangles) {
  const Scene scene(200);
  const auto cosines = corner_cosines(scene, 5);
  for (std::int32_t v = 0; v < scene.adjacency.vertex_count(); ++v) {
    for (int l = 0; l <= 5; ++l) {
      double worst = 1;
      for (std::int32_t h = 0; h < 600; ++h) {
        if (scene.adjacency.origin(h) == v) worst = std::min(worst, cosines[h][l]);
      }
      ASSERT_EQ(scene.heuristics.cone_cosine(v, l), worst) << "vertex " << v << " level " << l;
    }
  }
}

TEST(Sec41_Cone, OnceEnteredItIsHardlyEverLeft) {
  constexpr int kLevels = 6;
  for (const int faces : {200, 800, 4000}) {
    const Scene scene(faces, 1, kLevels);
    const auto cosines = corner_cosines(scene, kLevels);
    for (const double alpha : {15., 30.}) {
      const double limit = cosine(alpha);
      const auto is_left_again = [&](const auto& cosine_of_level) {
        bool entered = false, left = false;
        for (int l = 0; l <= kLevels; ++l) {
          const bool inside = cosine_of_level(l) >= limit;
          left = left || (entered && !inside);
          entered = entered || inside;
        }
        return left;
      };
      int left_by_face = 0, left_by_vertex = 0;
      for (int f = 0; f < faces; ++f)
        left_by_face += is_left_again([&](int l) {
          return std::min({cosines[3 * f][l], cosines[3 * f + 1][l], cosines[3 * f + 2][l]});
        });
      for (std::int32_t v = 0; v < scene.adjacency.vertex_count(); ++v)
        left_by_vertex += is_left_again([&](int l) { return scene.heuristics.cone_cosine(v, l); });
      const std::string key = fmt::format("_{}_faces_{}_degrees", faces, alpha);
      record("{}", left_by_face, "left_again_faces{}", key);
      record("{}", left_by_vertex, "left_again_vertices{}", key);
      EXPECT_LE(left_by_face, std::max(1, faces / 100)) << key;
      EXPECT_LE(left_by_vertex, std::max(1, faces / 400)) << key;
    }
  }
}

// T2 of the register: combined is nowhere below either, stays culled, and costs more per visible face.
TEST(Sec41_Combined, AsTheMaximumIsNeverBelowEitherAndKeepsCulledFacesCulled) {
  double previous_sphere = 1e300, previous_combined = 0;
  for (const int faces : {200, 800, 4000}) {
    const Scene scene(faces);
    DepthOptions options;
    options.angle_front = options.angle_silhouette = 60;
    std::vector<std::int32_t> depth[3];
    double triangles[3] = {0, 0, 0};
    std::int64_t visible = 0;
    for (const auto& [i, strategy] :
         {std::pair{0, Strategy::kProjectSphere}, std::pair{1, Strategy::kCurvature},
          std::pair{2, Strategy::kCombined}}) {
      options.strategy = strategy;
      depth[i] = scene.heuristics.depths(options, {});
      for (const std::int32_t d : depth[i]) triangles[i] += d < 0 ? 0 : std::pow(4., d);
    }
    const auto facing = scene.heuristics.facing(Camera{});
    std::set<Facing> classes(facing.begin(), facing.end());
    EXPECT_EQ(classes.size(), 3u) << "front, silhouette and back all occur";
    for (int f = 0; f < faces; ++f) {
      ASSERT_EQ(depth[2][f], std::max(depth[0][f], depth[1][f]));
      ASSERT_EQ(depth[2][f] == fast::kCulled, facing[f] == Facing::kBack);
      visible += depth[2][f] >= 0;
    }
    const double sphere = triangles[0] / static_cast<double>(visible),
                 combined = triangles[2] / static_cast<double>(visible);
    record("{:.1f}", sphere, "triangles_per_visible_face_project_sphere_{}", faces);
    record("{:.1f}", combined, "triangles_per_visible_face_combined_{}", faces);
    EXPECT_LT(sphere, previous_sphere);
    EXPECT_GT(combined, previous_combined);
    previous_sphere = sphere;
    previous_combined = combined;
  }
}

}  // namespace
}  // namespace limitcheck::verify
