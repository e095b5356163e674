// SPDX-License-Identifier: MIT
#include "fast/window/tessellator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "data/splitmix64.h"
#include "fast/test_support/exact_weld.h"
#include "fast/test_support/global_refinement.h"
#include "fast/test_support/test_meshes.h"

namespace limitcheck::fast {
namespace {

struct Shape {
  const char* name;
  data::ControlMesh mesh;
  int boundary_loops;
};

std::vector<Shape> shapes() {
  return {{"tetrahedron", tetrahedron(), 0},
          {"octahedron", octahedron(), 0},
          {"shaken tetrahedron", shaken(tetrahedron(), .15, 1), 0},
          {"shaken bipyramid 3", shaken(bipyramid(3), .15, 2), 0},
          {"shaken bipyramid 9", shaken(bipyramid(9), .15, 3), 0},
          {"torus", grid_torus(3, 5), 0},
          {"shaken torus", shaken(grid_torus(4, 4), .15, 4), 0},
          {"sheet", grid_sheet(2, 3), 1},
          {"shaken sheet", shaken(grid_sheet(3, 3), .15, 5), 1},
          {"wheel 3", shaken(wheel(3), .15, 6), 1},
          {"wheel 8", shaken(wheel(8), .15, 7), 1},
          {"fan 2", shaken(fan(2), .15, 8), 1},
          {"fan 5", shaken(fan(5), .15, 9), 1},
          {"single triangle", shaken(single_triangle(), .15, 10), 1}};
}

/// Worst distances to the whole mesh refined, over all vertices with lattice provenance.
template <class Real, class Output>
void expect_on_the_limit(const data::ControlMesh& mesh, const Output& out, double position_bound,
                         double normal_bound, const std::string& what) {
  std::map<std::uint32_t, RefinedMesh> refined;
  long double position = 0, normal = 0;
  ASSERT_EQ(out.provenance.size(), out.vertices.size());
  for (std::size_t i = 0; i < out.vertices.size(); ++i) {
    const LatticePoint& at = out.provenance[i];
    const auto& v = out.vertices[i];
    const Point p{v.position.x, v.position.y, v.position.z}, n{v.normal.x, v.normal.y, v.normal.z};
    if (at.denominator == 3) continue;
    if (refined.count(at.denominator) == 0)
      refined[at.denominator] = RefinedMesh::of(mesh, static_cast<int>(std::bit_width(at.denominator)) - 1);
    const RefinedMesh& fine = refined[at.denominator];
    const auto expected = fine.limit(at);
    position = std::max(position, norm(p - expected.position));
    normal = std::max(normal, norm(n - expected.normal));
  }
  EXPECT_LE(position, position_bound) << what;
  EXPECT_LE(normal, normal_bound) << what;
}

TEST(Sec5_Frame, EveryPointLiesWhereItsProvenanceSays) {
  for (const auto& [name, mesh, loops] : shapes()) {
    data::SplitMix64 random(11);
    for (const Repair repair : {Repair::kFan, Repair::kStitch}) {
      TessellatorOptions options;
      options.provenance = true;
      options.cracks.repair = repair;
      Tessellator<double> tessellator(mesh, options);
      for (int round = 0; round < 6; ++round) {
        const auto depth = random_depths(mesh.faces.size(), round % 2 == 0 ? 0 : -1, 3, random);
        DrawList<double> list;
        const FrameStats stats = tessellator.frame(depth, list);
        expect_on_the_limit<double>(mesh, list, 1e-14, 1e-12, name);
        IndexedMesh<double> indexed;
        const FrameStats again = tessellator.frame(depth, indexed);
        expect_on_the_limit<double>(mesh, indexed, 1e-14, 1e-12, name);
        EXPECT_EQ(stats.triangles, again.triangles);
        EXPECT_EQ(static_cast<std::size_t>(stats.triangles), indexed.triangles.size());
        EXPECT_EQ(static_cast<std::size_t>(stats.triangles), triangles_of(list).size());
      }
    }
  }
}

template <class Real>
void expect_watertight(int rounds, int deepest) {
  for (const auto& [name, mesh, loops] : shapes()) {
    data::SplitMix64 random(12);
    for (const Repair repair : {Repair::kFan, Repair::kStitch}) {
      TessellatorOptions options;
      options.cracks.repair = repair;
      options.threads = 1;
      Tessellator<Real> tessellator(mesh, options);
      DrawList<Real> list;
      IndexedMesh<Real> indexed;
      for (int round = 0; round < rounds; ++round) {
        const auto depth = random_depths(mesh.faces.size(), 0, deepest, random);
        tessellator.frame(depth, list);
        tessellator.frame(depth, indexed);
        for (const auto& report : {weld(triangles_of(list), true), weld(triangles_of(indexed), true)}) {
          EXPECT_EQ(report.repeated, 0) << name;
          EXPECT_EQ(report.degenerate, 0) << name;
          EXPECT_EQ(report.boundary_loops, loops) << name;
          EXPECT_EQ(report.open == 0, loops == 0) << name;
        }
        if (::testing::Test::HasFailure()) return;
      }
    }
  }
}

TEST(Sec5_Frame, IsWatertightBitByBitWithNormalsInFloat) {
  expect_watertight<float>(40, 3);
}
TEST(Sec4_Frame, OpensOnlyWhereCulledFacesBegin) {
  data::ControlMesh mesh = shaken(grid_torus(12, 16), .15, 14);
  Camera camera;
  camera.eye = {1, 5, 3};
  for (const Strategy strategy : {Strategy::kUniform, Strategy::kRandom, Strategy::kProjectSphere,
                                  Strategy::kCurvature, Strategy::kCombined}) {
    for (const Repair repair : {Repair::kFan, Repair::kStitch}) {
      DepthOptions depth;
      depth.strategy = strategy;
      depth.cull = true;
      TessellatorOptions options;
      options.cracks.repair = repair;
      Tessellator<float> tessellator(mesh, options);
      DrawList<float> list;
      const FrameStats stats = tessellator.frame(depth, camera, list);
      EXPECT_GT(stats.culled, 0);
      EXPECT_EQ(2 * stats.pairs + stats.singletons + stats.culled, stats.faces);
      const Adjacency& adjacency = tessellator.adjacency();
      const auto& final_depth = tessellator.last_pairing().depth;
      std::int64_t expected = 0;
      for (std::int32_t h = 0; h < 3 * adjacency.face_count(); ++h)
        if (final_depth[h / 3] >= 0 && final_depth[adjacency.twin(h) / 3] < 0)
          expected += 1 << tessellator.last_plan().edge_depth[h];
      const WeldReport report = weld(triangles_of(list), true);
      EXPECT_EQ(report.open, expected) << name(strategy);
      EXPECT_EQ(report.repeated, 0);
      EXPECT_EQ(report.degenerate, 0);
    }
  }
}

TEST(Sec4_Frame, KeepsItsNormalsAtAnyScaleAndFarFromTheOrigin) {
  const data::ControlMesh mesh = shaken(grid_torus(4, 5), .15, 13);
  const std::vector<std::int32_t> depth(mesh.faces.size(), 3);
  DrawList<float> plain, other;
  Tessellator<float>(mesh).frame(depth, plain);
  for (const int exponent : {-60, -20, 20, 60}) {
    data::ControlMesh scaled = mesh;
    for (auto& p : scaled.positions)
      for (double& x : p) x = std::ldexp(x, exponent);
    Tessellator<float>(scaled).frame(depth, other);
    for (std::size_t i = 0; i < plain.vertices.size(); ++i) {
      ASSERT_EQ(plain.vertices[i].normal, other.vertices[i].normal) << exponent;
      ASSERT_EQ(std::ldexp(plain.vertices[i].position.x, exponent), other.vertices[i].position.x) << exponent;
    }
  }
  // moved by 1024, the control points lose digits when they are rounded; nothing more is lost afterwards
  data::ControlMesh moved = mesh, rounded = mesh;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      moved.positions[i][k] = static_cast<float>(mesh.positions[i][k] + 1024);
      rounded.positions[i][k] = moved.positions[i][k] - 1024;
    }
  }
  Tessellator<float>(moved).frame(depth, other);
  Tessellator<float>(rounded).frame(depth, plain);
  for (std::size_t i = 0; i < plain.vertices.size(); ++i) {
    const auto d = plain.vertices[i].normal - other.vertices[i].normal;
    ASSERT_LE(dot(d, d), 1e-9f);
    ASSERT_NEAR(plain.vertices[i].position.x + 1024, other.vertices[i].position.x, 1e-4);
  }
}

// Coordinates of few bits, so that the mesh can be moved without loss: however far, its normals keep their
// bits.
TEST(Sec4_Frame, KeepsTheBitsOfItsNormalsWhereverTheMeshLies) {
  data::ControlMesh mesh = shaken(grid_torus(4, 5), .15, 13);
  for (auto& p : mesh.positions)
    for (double& x : p) x = std::round(64 * x) / 64;
  const std::vector<std::int32_t> depth(mesh.faces.size(), 3);
  DrawList<float> plain, other;
  const std::array<double, 3> middle = [&] {  // of the box: then the centre of the plain mesh is 0
    std::array<double, 3> low = mesh.positions[0], high = low;
    for (const auto& p : mesh.positions)
      for (std::size_t i = 0; i < 3; ++i) low[i] = std::min(low[i], p[i]), high[i] = std::max(high[i], p[i]);
    return std::array{(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2};
  }();
  for (auto& p : mesh.positions)
    for (std::size_t i = 0; i < 3; ++i) p[i] -= middle[i];
  Tessellator<float>(mesh).frame(depth, plain);
  for (const double offset : {20., -20., 0x1p30, -0x1p40}) {
    data::ControlMesh moved = mesh;
    for (auto& p : moved.positions)
      for (double& x : p) x += offset;
    Tessellator<float>(moved).frame(depth, other);
    ASSERT_EQ(plain.vertices.size(), other.vertices.size());
    for (std::size_t i = 0; i < plain.vertices.size(); ++i)
      ASSERT_EQ(plain.vertices[i].normal, other.vertices[i].normal) << offset;
  }
}

// A sheet in the plane x = 2^25 + 3, which is no float and no centre: its points are the nearest float.
TEST(Sec4_Frame, RoundsACoordinateOnceThatIsNoFloat) {
  data::ControlMesh mesh = grid_sheet(3, 3);
  for (auto& p : mesh.positions) p = {0x1p25 + 3, p[1], p[0]};
  DrawList<float> list;
  Tessellator<float>(mesh).frame(std::vector<std::int32_t>(mesh.faces.size(), 2), list);
  for (const auto& v : list.vertices) EXPECT_EQ(v.position.x, 0x1p25f + 4);
}

TEST(Sec5_Frame, IsWatertightBitByBitWithNormalsInDouble) {
  expect_watertight<double>(10, 4);
}

}  // namespace
}  // namespace limitcheck::fast
