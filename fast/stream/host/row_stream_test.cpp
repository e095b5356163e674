// SPDX-License-Identifier: MIT
#include "fast/stream/row_stream.h"
#include "data/bounding_box.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>

#include "data/splitmix64.h"
#include "fast/frame/patch.h"
#include "fast/stream/host/number_stream.h"
#include "fast/test_support/refined_limits.h"
#include "fast/test_support/shared_points.h"
#include "fast/test_support/test_meshes.h"

namespace limitcheck::fast::row_stream {
namespace {

std::vector<NamedMesh> closed_meshes() {
  return {{"tetrahedron", tetrahedron()},
          {"octahedron", octahedron()},
          {"bipyramid 3", bipyramid(3)},
          {"bipyramid 7", bipyramid(7)},
          {"bipyramid 200", bipyramid(200)},
          {"torus", grid_torus(4, 5)},
          {"shaken tetrahedron", shaken(tetrahedron(), .3, 1)},
          {"shaken bipyramid 5", shaken(bipyramid(5), .3, 2)},
          {"shaken torus", shaken(grid_torus(5, 4), .3, 3)}};
}

std::vector<NamedMesh> open_meshes() {
  return {{"triangle", single_triangle()},          {"wheel 3", wheel(3, .5)},
          {"wheel 9", shaken(wheel(9, .5), .1, 4)}, {"sheet", grid_sheet(2, 3)},
          {"fan 2", shaken(fan(2), .1, 5)},         {"fan 3", shaken(fan(3), .1, 6)},
          {"fan 4", shaken(fan(4), .1, 7)},         {"fan 5", shaken(fan(5), .1, 8)}};
}

double shortest_edge(const data::ControlMesh& mesh) {
  double shortest = data::box_diagonal(mesh);
  for (const auto& t : triangles_of(mesh)) {
    for (int k = 0; k < 3; ++k) {
      const auto &a = mesh.positions[t[k]], &b = mesh.positions[t[(k + 1) % 3]];
      shortest = std::min(shortest, std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
    }
  }
  return shortest;
}

Worst worst_against_refinement(const data::ControlMesh& mesh, int depth, const Kernel& kernel) {
  const Adjacency adjacency(mesh);
  const auto grids = pair_faces(adjacency, std::vector<std::int32_t>(mesh.faces.size(), depth)).grids;
  const RowStream stream(mesh, adjacency, kernel);
  const int size = 1 << depth;
  Workspace workspace;
  std::vector<Vertex> out(grids.size() * static_cast<std::size_t>(side(depth) * side(depth)));
  stream.whole(grids, depth, workspace, out.data());

  const RefinedLevels expected = RefinedLevels::loop(mesh, depth);
  const double scale = data::box_diagonal(mesh);
  Worst worst;
  for (std::size_t p = 0; p < grids.size(); ++p) {
    for (int j = 0; j <= size; ++j) {
      for (int i = 0; i <= size; ++i) {
        const LatticePoint at = face_point(grids[p], size, i, j, j >= i);
        if (at.face < 0) continue;
        worst.see(out[(p * side(depth) + j) * side(depth) + i], expected.limit(at), scale, p, i, j);
      }
    }
  }
  return worst;
}

void expect_the_limit_surface(const std::vector<NamedMesh>& meshes) {
  expect_all_limits(
      meshes, 5,
      [](const auto& mesh, int depth) { return worst_against_refinement(mesh, depth, kernels().front()); },
      shortest_edge);
}

TEST(RowStream, GivesTheLimitSurfaceOfClosedMeshes) {
  expect_the_limit_surface(closed_meshes());
}

TEST(RowStream, GivesTheLimitSurfaceWithItsBoundaryCurve) {
  expect_the_limit_surface(open_meshes());
}

void expect_equal_bits(const std::vector<NamedMesh>& meshes) {
  expect_all_bits(
      meshes, 5, 5, 4, kernels(), renumbered,
      [](const auto& mesh, int depth, const Kernel& kernel, const auto& known, SharedPoints& shared) {
        add_shared_points(mesh, depth, kernel, known, shared);
        add_edges(mesh, depth, kernel, known, shared);
      });
}

TEST(RowStreamBits, AreEqualFromEveryFaceOfAClosedMesh) {
  expect_equal_bits(closed_meshes());
}

TEST(RowStreamBits, AreEqualFromEveryFaceOfAMeshWithBoundary) {
  expect_equal_bits(open_meshes());
}

TEST(RowStreamTargets, EachRunsTheCodeItNames) {
  const auto mesh = tetrahedron();
  for (const Kernel& kernel : kernels()) {
    AlignedFloats input, work, row;
    input.grow(kernel.lanes * input_size(1)), work.grow(kernel.lanes * work_size(1)),
        row.grow(kernel.lanes * 64);
    EXPECT_STREQ(
        kernel.run(input.data(), 1, {{{0, 0, 0}, 1}}, work.data(), {row.data(), 32, 0, nullptr, nullptr}),
        kernel.name);
  }
}

// Vectors have code of their own for depths 1 to 4, in which strips and corners stay in registers; the plain kernel has
// one code for all depths.
TEST(RowStreamTargets, GiveTheBitsOfThePlainKernelWithOriginsOfTheirOwn) {
  data::SplitMix64 random(3);
  KernelPlacement<float> placement{{{.1f, -.2f, .3f}, 1.5f}};
  placement.local_from = 1;
  for (const Kernel& kernel : kernels()) {
    for (int depth = 1; depth <= 5; ++depth) {
      const int lanes = kernel.lanes, count = input_size(depth), numbers = 6 * side(depth) * side(depth);
      AlignedFloats input, one, work, got, want;
      input.grow(lanes * count), one.grow(count), work.grow(lanes * work_size(depth));
      got.grow(lanes * numbers), want.grow(lanes * numbers);
      for (int k = 0; k < lanes * count; ++k) input.data()[k] = static_cast<float>(random.unit() - .5);
      for (int lane = 0; lane < lanes; ++lane) {
        for (int k = 0; k < count; ++k) one.data()[k] = input.data()[k * lanes + lane];
        kernels().back().run(one.data(), depth, placement, work.data(),
                             {want.data() + lane * numbers, 0, 6 * side(depth), nullptr, nullptr});
      }
      kernel.run(input.data(), depth, placement, work.data(),
                 {got.data(), numbers, 6 * side(depth), nullptr, nullptr});
      EXPECT_EQ(std::memcmp(got.data(), want.data(), 4 * want.size()), 0)
          << kernel.name << " depth " << depth;
    }
  }
}

TEST(LocalOrigins, BeginTheSoonerTheLowerATriangleIs) {
  const auto from = [](double height, double size = 1) {
    data::ControlMesh mesh{.positions = {{0, 0, 0}, {size, 0, 0}, {size / 2, size * height, 0}}};
    mesh.faces.push_back({0, 1, 2});
    return place<float>(mesh).placement.local_from;
  };
  EXPECT_EQ(from(.5), 4);
  EXPECT_EQ(from(1. / 127), 4);
  EXPECT_EQ(from(1. / 129), 3);
  EXPECT_EQ(from(1. / 129, 1e-30), 3);
  EXPECT_EQ(from(1. / 257), 2);
  EXPECT_EQ(from(1. / 513), 1);
  EXPECT_EQ(from(0), 4) << "flat: it has no normal to lose";
}

/// A sheet of 92 x 91 vertices, of size 1, with a column of needles: 1e-4 wide.
data::ControlMesh sheet_with_needles() {
  data::ControlMesh mesh = grid_sheet(90, 91);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    auto& p = mesh.positions[v];
    if (v % 92 == 45) p[0] = 44 + 90e-4;
    for (double& x : p) x = static_cast<float>(x / 90);
  }
  return mesh;
}

// Depth 4 has local origins in every mesh: the lesser depths do at most twice as badly. From an origin common
// to the mesh they are 3, 16 and 30 times as far off.
TEST(RowStreamManyVertices, KeepTheNormalsOfNeedlesAtEveryDepth) {
  const data::ControlMesh mesh = sheet_with_needles();
  const Adjacency adjacency(mesh);
  const RowStream stream(mesh, adjacency, kernels().front());
  const DoubleStream exact(mesh, adjacency);
  Workspace workspace;
  double allowed = 1e-3;
  for (const int depth : {4, 3, 2, 1}) {
    auto grids = pair_faces(adjacency, std::vector<std::int32_t>(mesh.faces.size(), depth)).grids;
    grids.resize(1000);  // ten rows of the sheet
    const auto count = grids.size() * static_cast<std::size_t>(side(depth) * side(depth));
    std::vector<Vertex> got(count);
    std::vector<double> want(6 * count);
    stream.whole(grids, depth, workspace, got.data());
    exact.whole(grids, depth, want.data());
    double worst = 0;
    for (std::size_t v = 0; v < count; ++v)
      for (std::size_t c = 0; c < 3; ++c)
        worst = std::max(worst, std::abs(static_cast<double>(got[v].normal[c]) - want[6 * v + 3 + c]));
    EXPECT_LE(worst, allowed) << depth;
    if (depth == 4) allowed = 2 * worst;
    RecordProperty("depth_" + std::to_string(depth), std::to_string(worst));
  }
}

TEST(RowStreamManyVertices, ShareTheBitsOfTheirEdges) {
  const data::ControlMesh mesh = sheet_with_needles();
  for (const int depth : {1, 2, 3}) {
    SharedPoints shared;
    add_shared_points(mesh, depth, kernels().front(), {}, shared);
    add_edges(mesh, depth, kernels().back(), {}, shared);
    EXPECT_GT(shared.compared(), 0);
    EXPECT_EQ(shared.different(), 0) << depth;
  }
}

}  // namespace
}  // namespace limitcheck::fast::row_stream
