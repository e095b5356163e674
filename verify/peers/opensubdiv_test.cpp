// SPDX-License-Identifier: MIT
// The reference's refinement against OpenSubdiv's, both schemes, with sharp edges and vertices and without; and where
// OpenSubdiv is known to differ.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <type_traits>
#include <utility>
#include <vector>

#include "data/generators/named_mesh.h"
#include "data/generators/polygon_meshes.h"
#include "data/generators/random_mesh.h"
#include "data/generators/sharp_meshes.h"
#include "data/generators/surgery.h"
#include "data/io/read.h"
#include "data/io/write.h"
#include "data/shapes.h"
#include "data/splitmix64.h"
#include "verify/peers/test_opensubdiv.h"
#include "verify/peers/test_sharp_shapes.h"

namespace limitcheck::verify {
namespace {

using namespace test;
namespace Far = OpenSubdiv::Far;

// The largest differences between both.
struct Differences {
  double refined = 0, limit = 0;  // over the largest coordinate
  double normal = 0;              // degrees
  double other_rule = 0;          // the same where the mask across a boundary is that of another rule
  std::int64_t limits = 0, normals = 0;

  void add(const Differences& d) {
    refined = std::max(refined, d.refined), limit = std::max(limit, d.limit),
    normal = std::max(normal, d.normal), other_rule = std::max(other_rule, d.other_rule);
    limits += d.limits, normals += d.normals;
  }
};

// The points of so many steps. With limits, those of the last as well, where OpenSubdiv's masks are those of
// the surface: not at darts; and normals not on edges that stay sharp, where it has one of several, nor where
// the mask across a boundary is that of another rule, nor where there is none.
template <class Refined>
Differences differences(const data::ControlMesh& mesh, int depth, bool with_limits) {
  const FarMesh<Refined> far(mesh, depth, with_limits);
  const double largest = largest_of(mesh);
  Differences worst;
  worst.refined = far.worst / largest;
  if (!with_limits) return worst;

  const auto limits = far.ours.limits();
  for (std::size_t v = 0; v < far.limits.size(); ++v) {
    using Rule = OpenSubdiv::Sdc::Crease;
    if (far.rule[v] == Rule::RULE_DART) continue;
    worst.limit = std::max(worst.limit, magnitude(limits.positions[v] - far.limits[v]) / largest);
    ++worst.limits;
    const auto sector = far.ours.topology().sector(static_cast<std::int32_t>(v));
    const std::size_t right = sector.closed                      ? 0
                              : far.rule[v] == Rule::RULE_CORNER ? 1
                              : std::is_same_v<Refined, Quads>   ? 2
                                                                 : 3;
    const bool one_side = sector.closed ? far.rule[v] == Rule::RULE_SMOOTH : sector.faces.size() <= right;
    if (limits.kinds[v] != reference::NormalKind::kRegular) continue;
    const double turned = degrees(limits.normals[v], far.normals[v]);
    if (!sector.closed && !one_side) worst.other_rule = std::max(worst.other_rule, turned);
    if (!one_side) continue;
    worst.normal = std::max(worst.normal, turned);
    ++worst.normals;
  }
  return worst;
}
template <class Refined>
double worst_difference(const data::ControlMesh& mesh, int depth) {
  return differences<Refined>(mesh, depth, false).refined;
}

// 4 units of the last place; a normal has lost three bits with each of three steps and more on a steep mesh.
void expect_a_few_ulp(const Differences& d) {
  std::printf("units of the last place: refined %.2f, %lld limits %.2f; %lld normals %.1e degrees\n",
              d.refined * 0x1p52, static_cast<long long>(d.limits), d.limit * 0x1p52,
              static_cast<long long>(d.normals), d.normal);
  EXPECT_LE(d.refined, 4 * 0x1p-52);
  EXPECT_LE(d.limit, 4 * 0x1p-52);
  EXPECT_LE(d.normal, 1e-9);
  EXPECT_GT(d.normals, 1000);
}

TEST(SmoothMeshes_OpenSubdiv, IsTheReferenceOnQuadsAndPolygons) {
  std::vector<data::ControlMesh> meshes{data::quad_cube(), data::quad_torus(6, 5),
                                        data::dual(data::named_mesh("bumpy:4000"))};
  for (const int n : {3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 50}) meshes.push_back(data::quad_wheel(n, 7));
  for (int k = 1; k <= 6; ++k) meshes.push_back(data::quad_fan(k, 11));
  for (int n = 3; n <= 8; ++n) meshes.push_back(data::polygon_prism(n));
  Differences worst;
  for (const auto& mesh : meshes)
    for (int depth = 1; depth <= 3; ++depth) worst.add(differences<Quads>(mesh, depth, true));
  expect_a_few_ulp(worst);
  EXPECT_GT(worst.other_rule, 0.5);
}

TEST(SharpEdges_OpenSubdiv, IsTheReferenceOnCubesWithAnyOfTheirEdgesSharp) {
  Differences worst;
  for (unsigned subset = 0; subset < 4096; ++subset)
    for (const bool semi_sharp : {false, true})
      worst.add(differences<Quads>(test::cube_with(subset, semi_sharp), 3, true));
  expect_a_few_ulp(worst);
}

TEST(SharpEdges_OpenSubdiv, IsTheReferenceOnEveryShapeOfPolygons) {
  Differences worst;
  for (const auto& [name, mesh] : test::sharp_polygons()) {
    const Differences d = differences<Quads>(mesh, 3, true);
    EXPECT_LE(std::max(d.refined, d.limit), 4 * 0x1p-52) << name;
    worst.add(d);
  }
  expect_a_few_ulp(worst);
}

TEST(SharpEdges_OpenSubdiv, IsTheReferenceOnEveryShapeOfTriangles) {
  Differences worst, smooth;
  for (auto& [name, mesh] : test::sharp_triangles()) {
    const Differences d = differences<Triangles>(mesh, 3, true);
    EXPECT_LE(std::max(d.refined, d.limit), 4 * 0x1p-52) << name;
    worst.add(d);
    mesh.sharpness.triangles = data::TriangleRule::kSmooth;
    smooth.add(differences<Quads>(mesh, 3, true));
  }
  expect_a_few_ulp(worst);
  expect_a_few_ulp(smooth);
}

// The points of so many steps of meshes with random tags. By Chaikin's creasing these are below 1: above, OpenSubdiv's
// weights of edges are wrong (see below).
double worst_of_random_meshes(data::Creasing creasing, int depth) {
  const auto tagged = [&](const data::ControlMesh& mesh, std::uint64_t seed) {
    data::ControlMesh result = data::with_random_sharpness(mesh, seed);
    result.sharpness.creasing = creasing;
    for (auto& e : result.sharpness.edges)
      if (creasing == data::Creasing::kChaikin && e.sharpness < 10) e.sharpness /= 4;
    return result;
  };
  double worst = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    data::ControlMesh mesh = tagged(data::mixed_mesh(seed, {.faces = 60}), seed);
    worst = std::max(worst, worst_difference<Quads>(mesh, depth));
    mesh.sharpness.triangles = data::TriangleRule::kSmooth;
    worst = std::max(worst, worst_difference<Quads>(mesh, 2));
    mesh = tagged(data::random_mesh(seed, {.faces = 60}), seed);
    worst = std::max(worst, worst_difference<Triangles>(mesh, depth));
  }
  return worst;
}

// Sharpnesses are multiples of 1/16, which OpenSubdiv's floats hold at every level.
TEST(SharpEdges_OpenSubdiv, HaveTheSameRefinedPointsWithUniformCreasing) {
  double worst = worst_of_random_meshes(data::Creasing::kUniform, 5);
  for (const auto& mesh : {data::creased_cube(2), data::creased_cube(10), data::dart(5, false),
                           data::corner(3, false), data::crease_ring(4)})
    worst = std::max(worst, worst_difference<Quads>(mesh, 5));
  std::printf("units of the last place: %.2f\n", worst * 0x1p52);
  EXPECT_LE(worst, 8 * 0x1p-52);
}

// Chaikin's means are rounded to float there; 1e-7 of the weights.
TEST(SharpEdges_OpenSubdiv, HaveTheSameRefinedPointsWithChaikinsUpToItsFloats) {
  const double worst = worst_of_random_meshes(data::Creasing::kChaikin, 4);
  std::printf("largest difference: %.1e\n", worst);
  EXPECT_LE(worst, 1e-6);
}

// An edge of a sharpness above 1 with a child edge of sharpness 0: OpenSubdiv weighs the midpoint with the
// sharpness, 1.225 here, and the smooth point with what is missing to 1, -0.225. The rule is the midpoint.
TEST(SharpEdges_OpenSubdiv, WeighAnEdgeWithMoreThanOneByChaikinsRule) {
  data::ControlMesh mesh = data::quad_wheel(4, 301);
  const auto spoke = [&](std::size_t f) {
    const auto face = mesh.faces[f];
    const auto at = static_cast<std::size_t>(std::find(face.begin(), face.end(), 0) - face.begin());
    return face[(at + 1) % 4];
  };
  std::vector<std::size_t> faces;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    if (std::find(mesh.faces[f].begin(), mesh.faces[f].end(), 0) != mesh.faces[f].end()) faces.push_back(f);
  ASSERT_EQ(faces.size(), 4U);
  mesh.sharpness.edges = {{0, spoke(faces[0]), 2.7F}, {0, spoke(faces[2]), 0.8F}};
  mesh.sharpness.creasing = data::Creasing::kChaikin;
  EXPECT_LE(worst_difference<Quads>(mesh, 1), 1e-7);
  EXPECT_GT(worst_difference<Quads>(mesh, 2), 1e-4);
  mesh.sharpness.creasing = data::Creasing::kUniform;
  EXPECT_LE(worst_difference<Quads>(mesh, 4), 1e-7);
}

// What a file hides with `interpolateboundary 0` is what OpenSubdiv hides with VTX_BOUNDARY_NONE, and the
// points are those of the boundary rule that it is read with.
TEST(SharpPeers, FacesBesideABoundaryThatIsNotInterpolatedAreThoseThatOpenSubdivHides) {
  data::SplitMix64 random(5);
  std::int64_t hidden = 0, shown = 0;
  for (const bool quads : {false, true})
    for (int seed = 1; seed <= 20; ++seed) {
      data::ControlMesh mesh = quads ? data::mixed_mesh(static_cast<std::uint64_t>(seed), {60, 12})
                                     : data::random_mesh(static_cast<std::uint64_t>(seed), {60, 12});
      mesh.sharpness = {};
      // Half of the boundary edges are sharp for good, or nearly.
      std::map<std::pair<std::int32_t, std::int32_t>, int> faces;
      for (std::size_t f = 0; f < mesh.faces.size(); ++f)
        for (std::size_t k = 0, n = mesh.faces[f].size(); k < n; ++k)
          ++faces[std::minmax(mesh.faces[f][k], mesh.faces[f][(k + 1) % n])];
      for (const auto& [edge, count] : faces)
        if (count == 1 && random.next() % 8 > 1)
          mesh.sharpness.edges.push_back({edge.first, edge.second, random.next() % 8 == 0 ? 9.5F : 10.F});
      const data::ControlMesh read = data::read_mesh(
          data::mesh_content(mesh, data::FileFormat::kObj) + "t interpolateboundary 1/0/0 0\n",
          data::FileFormat::kObj, "mesh.obj");

      using Rules = OpenSubdiv::Sdc::Options;
      const auto type = quads ? OpenSubdiv::Sdc::SCHEME_CATMARK : OpenSubdiv::Sdc::SCHEME_LOOP;
      const auto none = refined_by_opensubdiv(mesh, type, Rules::VTX_BOUNDARY_NONE, 1, false),
                 edge = refined_by_opensubdiv(mesh, type, Rules::VTX_BOUNDARY_EDGE_ONLY, 1, false);
      std::vector<std::int32_t> holes;
      const Far::TopologyLevel& control = none.refiner->GetLevel(0);
      for (int f = 0; f < control.GetNumFaces(); ++f)
        if (control.IsFaceHole(f)) holes.push_back(f);
      EXPECT_EQ(read.holes, holes) << quads << " " << seed;
      hidden += static_cast<std::int64_t>(holes.size());
      shown += static_cast<std::int64_t>(mesh.faces.size() - holes.size());
      EXPECT_EQ(none.points, edge.points);
    }
  EXPECT_GT(hidden, 100);
  EXPECT_GT(shown, 100);
}

}  // namespace
}  // namespace limitcheck::verify
