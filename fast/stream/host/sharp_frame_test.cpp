// SPDX-License-Identifier: MIT
// Frames of Loop's scheme with edges that stay sharp, by both engines.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "data/error.h"
#include "data/generators/sharp_meshes.h"
#include "data/shapes.h"
#include "data/splitmix64.h"
#include "fast/mesh/cut_mesh.h"
#include "fast/stream/stream_tessellator.h"
#include "fast/test_support/exact_weld.h"
#include "fast/test_support/refined_limits.h"
#include "fast/test_support/test_meshes.h"
#include "fast/window/tessellator.h"

namespace limitcheck::fast {
namespace {

struct Shape {
  std::string name;
  data::ControlMesh mesh;
  bool cut = false;  // normals differ on both sides of an edge
};

// Points on a coarse grid, so that each is exact in every number type.
data::ControlMesh shaken(data::ControlMesh mesh, std::uint64_t seed) {
  data::SplitMix64 random(seed);
  for (auto& p : mesh.positions)
    for (double& x : p) x = std::round(64 * (x + .2 * (random.unit() - .5))) / 64;
  return mesh;
}

void sharpen(data::ControlMesh& mesh, std::int32_t a, std::int32_t b) {
  mesh.sharpness.edges.push_back({a, b, 10});
}

std::vector<Shape> shapes() {
  const auto rim = [](std::int32_t i) { return 2 + i; };  // of a double cone, whose apices are 0 and 1
  std::vector<Shape> out;
  for (const int n : {3, 4, 5, 6, 9}) out.push_back({"dart " + std::to_string(n), data::dart(n, true), true});
  for (int k = 2; k <= 5; ++k) out.push_back({"corner " + std::to_string(k), data::corner(k, true), true});
  for (int faces = 1; faces <= 5; ++faces) {
    Shape fan{"fan " + std::to_string(faces), data::fan(faces)};
    fan.mesh.sharpness.boundary = data::Boundary::kEdgeAndCorner;
    out.push_back(fan);
    fan.name += ", apex held";
    fan.mesh.sharpness.vertices.push_back({0, 10});
    out.push_back(fan);
  }
  for (const int n : {3, 6, 8}) {
    Shape spike{"spike " + std::to_string(n), data::wheel(n)};
    spike.mesh.sharpness.vertices.push_back({0, 10});
    out.push_back(spike);
  }
  // A face alone between cuts, and all faces alone.
  Shape island{"island", data::octahedron(), true};
  for (std::size_t k = 0; k < 3; ++k)
    sharpen(island.mesh, island.mesh.faces[0][k], island.mesh.faces[0][(k + 1) % 3]);
  out.push_back(island);
  Shape all{"all edges", data::octahedron(), true};
  for (std::size_t f = 0; f < all.mesh.faces.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k)
      if (all.mesh.faces[f][k] < all.mesh.faces[f][(k + 1) % 3])
        sharpen(all.mesh, all.mesh.faces[f][k], all.mesh.faces[f][(k + 1) % 3]);
  out.push_back(all);
  // The rim of a double cone and, of its 12 meridians, every twelfth, sixth, .. second: sectors of many
  // faces.
  for (const std::int32_t meridians : {0, 1, 2, 3, 4, 6}) {
    Shape cone{std::to_string(meridians) + " meridians", data::bipyramid(12), true};
    for (std::int32_t i = 0; i < 12; ++i) {
      sharpen(cone.mesh, rim(i), rim((i + 1) % 12));
      if (meridians > 0 && i % (12 / meridians) == 0)
        for (const std::int32_t apex : {0, 1}) sharpen(cone.mesh, apex, rim(i));
    }
    out.push_back(cone);
  }
  out.push_back({"an open crease", data::with_open_crease(data::icosahedron(), 3), true});
  for (std::size_t i = 0; i < out.size(); ++i) out[i].mesh = shaken(out[i].mesh, i);
  return out;
}

TessellatorOptions options(Repair repair) {
  TessellatorOptions o;
  o.cracks.repair = repair;
  o.provenance = true;
  return o;
}

int loops_of(const data::ControlMesh& mesh) {
  const Adjacency adjacency(mesh);
  for (std::int32_t v = 0; v < adjacency.vertex_count(); ++v)
    if (adjacency.on_boundary(v)) return 1;
  return 0;
}

constexpr int kDepth = 4;

template <class Real, class Engine>
void expect_the_surface(Engine&& engine, const Shape& shape, const RefinedLevels& limits, double bound,
                        int& judged, const std::string& what) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    const auto depth = random_depths(shape.mesh.faces.size(), 0, kDepth, seed);
    DrawList<Real> list;
    IndexedMesh<Real> mesh;
    engine.frame(depth, list);
    engine.frame(depth, mesh);
    for (const WeldReport& report :
         {weld(triangles_of(list), !shape.cut), weld(triangles_of(mesh), !shape.cut)}) {
      EXPECT_EQ(report.degenerate, 0) << what;
      EXPECT_EQ(report.repeated, 0) << what;
      EXPECT_EQ(report.boundary_loops, loops_of(shape.mesh)) << what << ", seed " << seed;
    }
    judged += expect_on_the_limit(limits, list, bound, what);
    judged += expect_on_the_limit(limits, mesh, bound, what);
  }
}

TEST(SharpFrame, HasNoCracksAndLiesWhereItsProvenanceSays) {
  int judged = 0;
  for (const Shape& shape : shapes()) {
    const RefinedLevels limits = RefinedLevels::loop(shape.mesh, kDepth);
    for (const Repair repair : {Repair::kFan, Repair::kStitch}) {
      expect_the_surface<double>(Tessellator<double>(shape.mesh, options(repair)), shape, limits, 1e-14,
                                 judged, shape.name + ", window");
      expect_the_surface<float>(Tessellator<float>(shape.mesh, options(repair)), shape, limits, 2e-6, judged,
                                shape.name + ", window in float");
      expect_the_surface<float>(row_stream::StreamTessellator(shape.mesh, options(repair)), shape, limits,
                                2e-6, judged, shape.name + ", stream");
    }
  }
  EXPECT_GT(judged, 100000);
}

// The check above can fail: the same mesh without its tags is elsewhere.
TEST(SharpFrame, WithoutTagsLiesElsewhere) {
  for (const Shape& shape : shapes()) {
    data::ControlMesh smooth = shape.mesh;
    smooth.sharpness = {};
    IndexedMesh<double> a, b;
    const std::vector<std::int32_t> depth(shape.mesh.faces.size(), 2);
    Tessellator<double>(shape.mesh, options(Repair::kFan)).frame(depth, a);
    Tessellator<double>(smooth, options(Repair::kFan)).frame(depth, b);
    double farthest = 0;
    for (const auto& p : a.vertices) {
      double nearest = 9;
      for (const auto& q : b.vertices) {
        const auto d = p.position - q.position;
        nearest = std::min(nearest, dot(d, d));
      }
      farthest = std::max(farthest, nearest);
    }
    EXPECT_GT(farthest, 1e-6) << shape.name;
  }
}

TEST(SharpFrame, FollowsPointsThatMove) {
  for (Shape& shape : shapes()) {
    Tessellator<double> engine(shape.mesh, options(Repair::kFan));
    const std::vector<std::int32_t> depth(shape.mesh.faces.size(), 2);
    for (auto& p : shape.mesh.positions) p[0] *= 2, p[2] += 1;
    engine.move_points(shape.mesh.positions);
    IndexedMesh<double> a, b;
    engine.frame(depth, a);
    Tessellator<double>(shape.mesh, options(Repair::kFan)).frame(depth, b);
    EXPECT_EQ(a.vertices, b.vertices) << shape.name;
  }
}

TEST(SharpFrame, DepthsFollowTheView) {
  Tessellator<float> engine(data::with_open_crease(data::icosahedron(), 3), options(Repair::kFan));
  DepthOptions strategy;
  Camera camera{.eye = {9, 2, 3}};
  IndexedMesh<float> out;
  const FrameStats stats = engine.frame(strategy, camera, out);
  EXPECT_GT(stats.culled, 0);
  EXPECT_GT(stats.triangles, 0);
}

TEST(SharpFrame, RefusesWhatItDoesNotDo) {
  data::ControlMesh semi = data::octahedron();
  semi.sharpness.edges.push_back({semi.faces[0][0], semi.faces[0][1], 2.5F});
  EXPECT_THROW(Tessellator<float>(semi, {}), data::ArgumentError);
  EXPECT_THROW(row_stream::StreamTessellator(semi, {}), data::ArgumentError);
}

}  // namespace
}  // namespace limitcheck::fast
