// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "data/error.h"
#include "data/generators/mixed_mesh.h"
#include "data/generators/polygon_meshes.h"
#include "data/generators/sharp_meshes.h"
#include "data/splitmix64.h"
#include "fast/test_support/exact_weld.h"
#include "fast/test_support/refined_limits.h"
#include "fast/test_support/test_meshes.h"
#include "fast/window/tessellator.h"

namespace limitcheck::fast {
namespace {

TessellatorOptions quads(Repair repair) {
  TessellatorOptions options{.scheme = data::Scheme::kCatmullClark};
  options.cracks.repair = repair;
  options.provenance = true;
  return options;
}

struct Shape {
  data::ControlMesh mesh;
  int boundary_loops;
  bool cut = false;  // normals differ on both sides of an edge
};

std::vector<Shape> shapes() {
  std::vector<Shape> out{{data::quad_cube(), 0},          {data::quad_torus(3, 5), 0},
                         {data::quad_wheel(3, 1), 1},     {data::quad_wheel(9, 2), 1},
                         {data::quad_fan(1, 3), 1},       {data::quad_fan(5, 4), 1},
                         {data::polygon_prism(5), 0},     {data::mixed_pawn(5), 0},
                         {data::creased_cube(2), 0},      {data::creased_cube(10), 0, true},
                         {data::dart(5, false), 1, true}, {data::corner(3, false), 1, true},
                         {data::crease_ring(10), 0, true}};
  for (std::size_t i = 0; i < out.size(); ++i) out[i].mesh = shaken(out[i].mesh, .1, i);
  return out;
}

template <class Output>
void expect_closed(const Shape& shape, const Output& out, const std::string& what) {
  const WeldReport report = weld(triangles_of(out), !shape.cut);
  EXPECT_EQ(report.degenerate, 0) << what;
  EXPECT_EQ(report.repeated, 0) << what;
  EXPECT_EQ(report.boundary_loops, shape.boundary_loops) << what;
}

TEST(QuadFrame, HasNoCracksAtAnyDepths) {
  RecordProperty("claim", "C21");
  int which = 0;
  for (const Shape& shape : shapes()) {
    for (const Repair repair : {Repair::kFan, Repair::kStitch}) {
      Tessellator<float> tessellator(shape.mesh, quads(repair));
      for (std::uint64_t seed = 0; seed < 6; ++seed) {
        const std::string what = "shape " + std::to_string(which) + " seed " + std::to_string(seed);
        const auto depth = random_depths(shape.mesh.faces.size(), seed < 3 ? 0 : 2, 4, seed);
        DrawList<float> list;
        IndexedMesh<float> mesh;
        const FrameStats a = tessellator.frame(depth, list), b = tessellator.frame(depth, mesh);
        expect_closed(shape, list, what);
        expect_closed(shape, mesh, what);
        EXPECT_EQ(a.triangles, static_cast<std::int64_t>(mesh.triangles.size())) << what;
        EXPECT_EQ(a.triangles, b.triangles);
        EXPECT_EQ(a.vertices, static_cast<std::int64_t>(list.vertices.size()));
        EXPECT_EQ(a.triangles, static_cast<std::int64_t>(triangles_of(list).size())) << what;
        const std::set<std::uint32_t> used = [&] {
          std::set<std::uint32_t> s;
          for (const auto& t : mesh.triangles) s.insert(t.begin(), t.end());
          return s;
        }();
        EXPECT_EQ(used.size(), mesh.vertices.size()) << what << ": every vertex is written and used";
        EXPECT_TRUE(std::none_of(mesh.provenance.begin(), mesh.provenance.end(), [](const LatticePoint& p) {
          return p.face < 0;
        })) << what;
      }
    }
    ++which;
  }
}

// Without repair the same depths do leave cracks: the check above can fail.
TEST(QuadFrame, HasCracksIfNobodyRepairsThem) {
  const auto mesh = data::quad_cube();
  Tessellator<float> tessellator(mesh, quads(Repair::kNone));
  DrawList<float> list;
  tessellator.frame(std::vector<std::int32_t>{1, 2, 3, 1, 2, 3}, list);
  EXPECT_GT(weld(triangles_of(list), true).open, 0);
}

TEST(QuadFrame, EveryPointLiesWhereItsProvenanceSays) {
  int judged = 0, which = 0;
  std::vector<Shape> all = shapes();
  for (std::uint64_t seed = 1; seed < 5; ++seed) {
    data::RandomMeshOptions size{.faces = 30};
    all.push_back({data::with_random_sharpness(data::mixed_mesh(seed, size), seed), 0, true});
  }
  for (const Shape& shape : all) {
    const std::string what = "shape " + std::to_string(which++);
    const RefinedLevels exact(shape.mesh, data::Scheme::kCatmullClark, 4);
    for (const Repair repair : {Repair::kFan, Repair::kStitch}) {
      Tessellator<double> tessellator(shape.mesh, quads(repair));
      const auto depth = random_depths(shape.mesh.faces.size(), 0, 3, 7);
      DrawList<double> list;
      IndexedMesh<double> mesh;
      tessellator.frame(depth, list);
      tessellator.frame(depth, mesh);
      judged += expect_on_the_limit(exact, list, 1e-13, what);
      judged += expect_on_the_limit(exact, mesh, 1e-13, what);
    }
  }
  EXPECT_GT(judged, 20000);
}

TEST(QuadFrame, CullsAndCountsFaces) {
  const auto mesh = data::quad_torus(6, 8);
  Tessellator<float> tessellator(mesh, quads(Repair::kFan));
  EXPECT_EQ(tessellator.face_count(), 48);
  std::vector<std::int32_t> depth(48, 2);
  depth[5] = -1;
  IndexedMesh<float> out;
  const FrameStats stats = tessellator.frame(depth, out);
  EXPECT_EQ(stats.culled, 1);
  EXPECT_EQ(stats.pairs, 47) << "a quad is a pair of itself";
  EXPECT_EQ(stats.singletons, 0);
  EXPECT_EQ(stats.strips, 47 * 4);
  EXPECT_EQ(stats.limit_points, 47 * 25);
  EXPECT_EQ(stats.triangles, 47 * 32);
  EXPECT_EQ(weld(triangles_of(out), true).boundary_loops, 1) << "a hole where the face was";
  EXPECT_THROW(tessellator.adjacency(), data::ArgumentError);
  EXPECT_THROW(tessellator.frame(std::vector<std::int32_t>(47, 1), out), data::ArgumentError);
}

TEST(QuadFrame, DepthsFollowTheView) {
  for (const auto& mesh : {data::pawn(12), data::mixed_pawn(12)}) {
    Tessellator<float> tessellator(mesh, quads(Repair::kFan));
    DepthOptions options;
    Camera camera{.eye = {9, 2, 3}};
    IndexedMesh<float> out;
    std::int64_t coarse = 0;
    for (const double angle : {60., 20., 5.}) {
      options.angle_front = options.angle_silhouette = options.angle_back = angle;
      const FrameStats stats = tessellator.frame(options, camera, out);
      EXPECT_GT(stats.culled, stats.faces / 4) << "about half look away";
      EXPECT_LT(stats.culled, 3 * stats.faces / 4);
      EXPECT_GT(stats.triangles, coarse) << "a smaller angle asks for more";
      coarse = stats.triangles;
    }
    options.strategy = Strategy::kProjectSphere;
    options.target_pixels = 20;
    const auto near = tessellator.frame(options, camera, out).triangles;
    camera.eye = {90, 20, 30};
    EXPECT_LT(tessellator.frame(options, camera, out).triangles, near) << "from afar";
  }
  // A flat sheet needs no depth, whatever its faces.
  auto flat = data::quad_wheel(5, 1);
  for (auto& p : flat.positions) p[2] = 0;
  Tessellator<float> tessellator(flat, quads(Repair::kFan));
  DepthOptions options{.strategy = Strategy::kCurvature, .cull = false};
  IndexedMesh<float> out;
  tessellator.frame(options, Camera{}, out);
  for (const std::int32_t d : tessellator.last_pairing().depth) EXPECT_EQ(d, 0);
}

TEST(QuadFrame, TheNumberOfThreadsChangesNothing) {
  const auto mesh = data::mixed_mesh(3);
  const auto depth = random_depths(mesh.faces.size(), -1, 4, 1);
  TessellatorOptions one = quads(Repair::kStitch), many = one;
  one.threads = 1;
  many.threads = 4;
  IndexedMesh<float> a, b;
  Tessellator<float>(mesh, one).frame(depth, a);
  Tessellator<float>(mesh, many).frame(depth, b);
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.triangles, b.triangles);
  EXPECT_EQ(a.provenance, b.provenance);
}

TEST(QuadFrame, ASinkGetsTheWholeList) {
  const auto mesh = data::mixed_pawn(40);
  Tessellator<float> tessellator(mesh, quads(Repair::kStitch));
  const auto depth = random_depths(mesh.faces.size(), -1, 6, 2);
  DrawList<float> list;
  CollectingSink sink;
  const FrameStats a = tessellator.frame(depth, list);
  const FrameStats b = tessellator.frame(depth, static_cast<DrawSink<float>&>(sink));
  EXPECT_GT(list.vertices.size(), std::size_t{1} << 18) << "more than one part, or nothing is tested";
  EXPECT_EQ(sink.list.vertices, list.vertices);
  EXPECT_EQ(sink.list.provenance, list.provenance);
  EXPECT_EQ(a.vertices, b.vertices);
}

// Collapsed meshes get finite unit normals, and are counted. [D12]
TEST(QuadFrame, DegenerateMeshesHaveUnitNormals) {
  for (const int flat : {0, 1, 2, 3}) {
    auto mesh = data::quad_wheel(5, 1);
    for (auto& p : mesh.positions)
      for (int axis = 0; axis < flat; ++axis) p[2 - axis] = 0;
    Tessellator<float> tessellator(mesh, quads(Repair::kFan));
    DrawList<float> out;
    const FrameStats stats = tessellator.frame(std::vector<std::int32_t>(mesh.faces.size(), 3), out);
    EXPECT_EQ(stats.zero_normals > 0, flat >= 2) << "of " << flat << " flat axes";
    for (const auto& v : out.vertices) ASSERT_NEAR(dot(v.normal, v.normal), 1, 1e-6);
  }
}

}  // namespace
}  // namespace limitcheck::fast
