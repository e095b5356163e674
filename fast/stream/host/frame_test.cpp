// SPDX-License-Identifier: MIT
// Frames of both schemes by both engines: without cracks, every point where its provenance says, whatever is sharp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "data/error.h"
#include "data/generators/polygon_meshes.h"
#include "data/generators/sharp_meshes.h"
#include "data/generators/surgery.h"
#include "data/shapes.h"
#include "data/splitmix64.h"
#include "fast/stream/stream_tessellator.h"
#include "fast/test_support/exact_weld.h"
#include "fast/test_support/refined_limits.h"
#include "fast/test_support/test_meshes.h"
#include "fast/window/tessellator.h"

namespace limitcheck::fast {
namespace {

constexpr auto kLoop = data::Scheme::kLoop, kQuads = data::Scheme::kCatmullClark;

struct Shape {
  std::string name;
  data::ControlMesh mesh;
  bool cut = false;      // normals differ on both sides of an edge
  bool outlined = true;  // whether it is closed, or has one boundary
};

std::vector<Shape> smooth_triangles() {
  return {{"tetrahedron", tetrahedron()},
          {"octahedron", octahedron()},
          {"shaken tetrahedron", shaken(tetrahedron(), .15, 1)},
          {"shaken bipyramid 3", shaken(bipyramid(3), .15, 2)},
          {"shaken bipyramid 9", shaken(bipyramid(9), .15, 3)},
          {"torus", grid_torus(3, 5)},
          {"shaken torus", shaken(grid_torus(4, 4), .15, 4)},
          {"sheet", grid_sheet(2, 3)},
          {"shaken sheet", shaken(grid_sheet(3, 3), .15, 5)},
          {"wheel 3", shaken(wheel(3), .15, 6)},
          {"wheel 8", shaken(wheel(8), .15, 7)},
          {"fan 2", shaken(fan(2), .15, 8)},
          {"fan 5", shaken(fan(5), .15, 9)},
          {"single triangle", shaken(single_triangle(), .15, 10)}};
}

void sharpen(data::ControlMesh& mesh, std::int32_t a, std::int32_t b) {
  mesh.sharpness.edges.push_back({a, b, 10});
}

std::vector<Shape> sharp_triangles() {
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
  // Points on a coarse grid, so that each is exact in every number type.
  for (std::size_t i = 0; i < out.size(); ++i) {
    data::SplitMix64 random(i);
    for (auto& p : out[i].mesh.positions)
      for (double& x : p) x = std::round(64 * (x + .2 * (random.unit() - .5))) / 64;
  }
  return out;
}

std::vector<Shape> polygons() {
  std::vector<Shape> out{{"cube", data::quad_cube()},
                         {"torus", data::quad_torus(3, 5)},
                         {"wheel 3", data::quad_wheel(3, 1)},
                         {"wheel 9", data::quad_wheel(9, 2)},
                         {"fan 1", data::quad_fan(1, 3)},
                         {"fan 5", data::quad_fan(5, 4)},
                         {"prism", data::polygon_prism(5)},
                         {"mixed pawn", data::mixed_pawn(5)},
                         {"pawn", data::pawn(5)},
                         {"semi-sharp cube", data::creased_cube(2)},
                         {"semi-sharp ring", data::crease_ring(1, 5)},
                         {"sharp cube", data::creased_cube(10), true},
                         {"dart", data::dart(5, false), true},
                         {"corner", data::corner(3, false), true},
                         {"crease ring", data::crease_ring(10), true}};
  for (std::size_t i = 0; i < out.size(); ++i) out[i].mesh = shaken(out[i].mesh, .1, i);
  for (std::uint64_t seed = 1; seed < 5; ++seed) {
    const data::RandomMeshOptions size{.faces = 30};
    const auto mesh = data::with_random_sharpness(data::mixed_mesh(seed, size), seed);
    out.push_back({"mixed " + std::to_string(seed), mesh, true, false});
  }
  return out;
}

TessellatorOptions options_of(data::Scheme scheme, Repair repair) {
  TessellatorOptions options{.provenance = true, .scheme = scheme};
  options.cracks.repair = repair;
  return options;
}

int loops_of(const RefinedMesh& mesh) {
  const auto edges = mesh.faces_of_edges();
  return std::any_of(edges.begin(), edges.end(), [](const auto& e) { return e.second.size() == 1; }) ? 1 : 0;
}

constexpr int kDepth = 4;

/// A shape with its limits, and how far points may be from them.
struct Expected {
  const Shape& shape;
  int loops;
  RefinedLevels limits;
  std::optional<double> normals;  // bound in double, of smooth shapes
  int judged = 0;
};

template <class Real>
struct PatchPoints {
  std::span<const SurfaceVertex<Real>> vertices;
  std::span<const LatticePoint> provenance;
};

template <class Real, class Tessellator>
void expect_the_surface(Tessellator&& engine, Expected& expected, double bound, const std::string& what) {
  const Shape& shape = expected.shape;
  const auto normals = std::is_same_v<Real, double> ? expected.normals : std::nullopt;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(what + ", seed " + std::to_string(seed));
    const bool culled = seed % 4 == 3;
    const int least = culled ? -1 : seed % 4 == 2 ? 2 : 0;  // depths from 2 on: faces are stitched
    const auto depth = random_depths(shape.mesh.faces.size(), least, kDepth, seed);
    DrawList<Real> list;
    IndexedMesh<Real> mesh;
    const FrameStats a = engine.frame(depth, list), b = engine.frame(depth, mesh);
    EXPECT_EQ(a.triangles, b.triangles);
    EXPECT_EQ(a.vertices, static_cast<std::int64_t>(list.vertices.size()));
    for (const WeldReport& report :
         {weld(triangles_of(list), !shape.cut), weld(triangles_of(mesh), !shape.cut)}) {
      EXPECT_EQ(report.triangles, a.triangles);
      if (!shape.outlined) continue;
      EXPECT_EQ(report.degenerate, 0);
      EXPECT_EQ(report.repeated, 0);
      if (culled) continue;
      EXPECT_EQ(report.boundary_loops, expected.loops);
      EXPECT_EQ(report.open == 0, expected.loops == 0);
    }
    std::set<std::uint32_t> used;
    for (const auto& t : mesh.triangles) used.insert(t.begin(), t.end());
    EXPECT_EQ(used.size(), mesh.vertices.size()) << "every vertex is written and used";
    if (shape.outlined && !shape.cut && !culled) {
      EXPECT_EQ(weld(triangles_of(mesh), true).points, static_cast<std::int64_t>(used.size())) << "once";
    }
    EXPECT_TRUE(std::none_of(mesh.provenance.begin(), mesh.provenance.end(),
                             [](const LatticePoint& p) { return p.face < 0; }));
    if (seed >= 4) continue;
    expected.judged += expect_on_the_limit(expected.limits, list, bound, what, normals);
    expected.judged += expect_on_the_limit(expected.limits, mesh, bound, what, normals);
    PatchMesh<Real> patches;
    engine.frame(depth, patches);
    const PatchPoints<Real> points{patches.vertices(), patches.provenance()};
    expected.judged += expect_on_the_limit(expected.limits, points, bound, what, normals);
  }
}

int expect_all_engines(const std::vector<Shape>& shapes, data::Scheme scheme, double bound,
                       std::optional<double> normals = {}) {
  int judged = 0;
  for (const Shape& shape : shapes) {
    Expected expected{shape, loops_of(RefinedMesh::of(shape.mesh, scheme)),
                      RefinedLevels(shape.mesh, scheme, kDepth), normals};
    for (const Repair repair : {Repair::kFan, Repair::kStitch}) {
      const auto options = options_of(scheme, repair);
      expect_the_surface<double>(Tessellator<double>(shape.mesh, options), expected, bound,
                                 shape.name + ", window");
      expect_the_surface<float>(Tessellator<float>(shape.mesh, options), expected, 2e-6,
                                shape.name + ", window in float");
      expect_the_surface<float>(row_stream::StreamTessellator(shape.mesh, options), expected, 2e-6,
                                shape.name + ", stream");
    }
    judged += expected.judged;
  }
  return judged;
}

TEST(Frame, OfSmoothTrianglesHasNoCracksAndLiesWhereItsProvenanceSays) {
  EXPECT_GT(expect_all_engines(smooth_triangles(), kLoop, 1e-14, 1e-12), 100000);
}
TEST(Frame, OfSharpTrianglesHasNoCracksAndLiesWhereItsProvenanceSays) {
  EXPECT_GT(expect_all_engines(sharp_triangles(), kLoop, 1e-14), 100000);
}
TEST(Frame, OfPolygonsHasNoCracksAndLiesWhereItsProvenanceSays) {
  RecordProperty("claim", "C21");
  EXPECT_GT(expect_all_engines(polygons(), kQuads, 1e-13), 60000);
}

// The checks above can fail: without repair the same depths leave cracks.
TEST(Frame, HasCracksIfNobodyRepairsThem) {
  Tessellator<float> tessellator(data::quad_cube(), options_of(kQuads, Repair::kNone));
  DrawList<float> list;
  tessellator.frame(std::vector<std::int32_t>{1, 2, 3, 1, 2, 3}, list);
  EXPECT_GT(weld(triangles_of(list), true).open, 0);
}

TEST(SharpFrame, DepthsFollowTheView) {
  Tessellator<float> engine(data::with_open_crease(data::icosahedron(), 3));
  IndexedMesh<float> out;
  const FrameStats stats = engine.frame(DepthOptions{}, Camera{.eye = {9, 2, 3}}, out);
  EXPECT_GT(stats.culled, 0);
  EXPECT_GT(stats.triangles, 0);
}

TEST(SharpFrame, RefusesWhatItDoesNotDo) {
  data::ControlMesh semi = data::octahedron();
  semi.sharpness.edges.push_back({semi.faces[0][0], semi.faces[0][1], 2.5F});
  EXPECT_THROW(Tessellator<float>(semi, {}), data::ArgumentError);
  EXPECT_THROW(row_stream::StreamTessellator(semi, {}), data::ArgumentError);
}

template <class Engine>
struct Engines : ::testing::Test {};
using Both = ::testing::Types<Tessellator<float>, row_stream::StreamTessellator>;
TYPED_TEST_SUITE(Engines, Both);

// A mesh times 2^k, k even far out: the same surface times 2^k, the same normals, to the last bit.
TYPED_TEST(Engines, ScaleByPowersOfTwoExactly) {
  const auto mesh = shaken(bipyramid(7), .2, 9);
  const std::vector<std::int32_t> depth(mesh.faces.size(), 4);
  DrawList<float> expected, out;
  TypeParam(mesh).frame(depth, expected);
  for (const int exponent : {-60, -20, 20, 60}) {
    auto scaled = mesh;
    for (auto& p : scaled.positions)
      for (double& x : p) x = std::ldexp(x, exponent);
    TypeParam(scaled).frame(depth, out);
    for (std::size_t v = 0; v < out.vertices.size(); ++v) {
      const auto &a = out.vertices[v], &b = expected.vertices[v];
      for (int c = 0; c < 3; ++c) ASSERT_EQ(a.position[c], std::ldexp(b.position[c], exponent));
      ASSERT_EQ(a.normal, b.normal);
    }
  }
}

TYPED_TEST(Engines, DeliverTheSameToASinkAsInMemory) {
  for (const Repair repair : {Repair::kFan, Repair::kStitch}) {
    TypeParam triangles(grid_torus(32, 40), options_of(kLoop, repair));
    expect_a_sink_gets_the_whole_list(triangles);
    TypeParam quads(data::quad_torus(50, 50), options_of(kQuads, repair));
    expect_a_sink_gets_the_whole_list(quads);
  }
  TypeParam polygons(data::mixed_pawn(40), options_of(kQuads, Repair::kStitch));
  expect_a_sink_gets_the_whole_list(polygons, 6);
}

TYPED_TEST(Engines, RefuseWhatTheyCannotDo) {
  EXPECT_THROW(TypeParam{data::ControlMesh{}}, data::ArgumentError);
  auto mesh = octahedron();
  TypeParam engine(mesh);
  DrawList<float> out;
  const auto frame = [&](std::size_t faces, std::int32_t depth) {
    return engine.frame(std::vector<std::int32_t>(faces, depth), out);
  };
  EXPECT_THROW(frame(7, 1), data::ArgumentError);
  EXPECT_THROW(frame(8, 11), data::ArgumentError);
  EXPECT_THROW(frame(8, -2), data::ArgumentError);
  EXPECT_EQ(frame(8, -1).culled, 8);
  EXPECT_TRUE(out.vertices.empty() && out.draws.empty());
  mesh.positions[0][0] = std::nan("");
  EXPECT_THROW(TypeParam{mesh}, data::ArgumentError);
}

}  // namespace
}  // namespace limitcheck::fast
