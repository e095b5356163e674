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
          {"shaken torus", shaken(grid_torus(5, 4), .3, 3)},
          {"flipped torus", flipped(shaken(grid_torus(9, 7), .1, 9))},
          {"pinched torus", pinched(flipped(shaken(grid_torus(9, 7), .1, 9)))}};
}

std::vector<NamedMesh> open_meshes() {
  return {{"triangle", single_triangle()},
          {"wheel 3", wheel(3, .5)},
          {"wheel 9", shaken(wheel(9, .5), .1, 4)},
          {"sheet", grid_sheet(2, 3)},
          {"fan 2", shaken(fan(2), .1, 5)},
          {"fan 3", shaken(fan(3), .1, 6)},
          {"fan 4", shaken(fan(4), .1, 7)},
          {"fan 5", shaken(fan(5), .1, 8)},
          {"pinched sheet", pinched(shaken(grid_sheet(6, 7), .1, 9))}};
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

// What else is evaluated with them makes no difference, nor from which corner they are seen: also where some grids of a
// batch have origins of their own.
TEST(RowStreamBits, DoNotDependOnTheBatch) {
  for (const data::ControlMesh& mesh : {closed_meshes().back().mesh, open_meshes().back().mesh}) {
    const Adjacency adjacency(mesh);
    const RowStream stream(mesh, adjacency);
    Workspace workspace;
    for (int depth = 0; depth <= 4; ++depth) {
      const auto grids = pair_faces(adjacency, std::vector<std::int32_t>(mesh.faces.size(), depth)).grids;
      const auto n = static_cast<std::size_t>(side(depth) * side(depth));
      std::vector<Vertex> all(grids.size() * n), from_c(all.size()), one(n);
      std::vector<Vertex*> places;
      for (std::size_t g = 0; g < grids.size(); ++g) places.push_back(from_c.data() + g * n);
      stream.whole(grids, depth, workspace, all.data());
      stream.put(grids, depth, workspace, places.data(), Order::kFromC, Stores::kOrdinary);
      std::size_t local = 0;
      for (std::size_t g = 0; g < grids.size(); ++g) {
        local += depth >= stream.local_from(grids[g]) ? 1 : 0;
        stream.whole(std::span(grids).subspan(g, 1), depth, workspace, one.data());
        // A face alone shows what lies above its diagonal.
        for (std::size_t k = 0; k < n; ++k) {
          const auto s = static_cast<std::size_t>(side(depth));
          if (grids[g].singleton() && k / s < k % s) continue;
          ASSERT_EQ(std::memcmp(&one[k], &all[g * n + k], sizeof(Vertex)), 0) << depth << " grid " << g;
          ASSERT_EQ(std::memcmp(&from_c[g * n + n - 1 - k], &all[g * n + k], sizeof(Vertex)), 0)
              << depth << " grid " << g << " from C";
        }
      }
      EXPECT_TRUE(depth != 2 || (local > 0 && local < grids.size())) << local << " of " << grids.size();
    }
  }
}

TEST(RowStreamBits, AreEqualAtAllDepthsWhereTheSurfaceIsAPolynomial) {
  const data::ControlMesh mesh = shaken(grid_torus(5, 6), .2, 9);
  const Adjacency adjacency(mesh);
  Workspace workspace;
  const auto grid_at = [&](const RowStream& stream, std::size_t g, int depth) {
    const auto grids = pair_faces(adjacency, std::vector<std::int32_t>(mesh.faces.size(), depth)).grids;
    EXPECT_EQ(regular_edges(stream.rings(), grids[g], depth), kAllEdges);
    std::vector<Vertex> out(static_cast<std::size_t>(side(depth) * side(depth)));
    stream.whole(std::span(grids).subspan(g, 1), depth, workspace, out.data());
    return out;
  };
  for (const Kernel& kernel : {kernels().front(), kernels().back()}) {
    const RowStream stream(mesh, adjacency, kernel);
    const int finest = kernel.fused ? kMaxDepth : 6;
    for (const std::size_t g : {0U, 7U}) {
      const auto fine = grid_at(stream, g, finest);
      for (int depth = kLocalFrom; depth < finest; ++depth) {
        const auto coarse = grid_at(stream, g, depth);
        const std::size_t n = static_cast<std::size_t>(side(depth)),
                          step = std::size_t{1} << (finest - depth);
        for (std::size_t k = 0; k < n * n; ++k)
          ASSERT_EQ(std::memcmp(&coarse[k],
                                &fine[k / n * step * static_cast<std::size_t>(side(finest)) + k % n * step],
                                sizeof(Vertex)),
                    0)
              << kernel.name << " depth " << depth << " point " << k;
      }
    }
  }
}

TEST(RowStreamTargets, EachRunsTheCodeItNames) {
  const auto mesh = tetrahedron();
  for (const Kernel& kernel : kernels()) {
    AlignedFloats input, work, row;
    input.grow(kernel.lanes * input_size(1)), work.grow(kernel.lanes * work_size(1)),
        row.grow(kernel.lanes * 64);
    EXPECT_STREQ(kernel.run(input.data(), 1, {}, work.data(), {row.data(), 32, 0, nullptr, nullptr}),
                 kernel.name);
  }
}

// Vectors have code of their own for depths 1 to 4, in which strips and corners stay in registers; the plain kernel has
// one code for all depths.
TEST(RowStreamTargets, GiveTheBitsOfThePlainKernelWithOriginsOfTheirOwn) {
  data::SplitMix64 random(3);
  BatchPlacement<float> placement{{{.1f, -.2f, .3f}, 1.5f}, true};
  for (const Kernel& kernel : kernels()) {
    for (int depth = 1; depth <= 5; ++depth) {
      placement.some_regular = depth < kLocalFrom ? 0 : static_cast<unsigned>(random.next() % 32);
      placement.all_regular = placement.some_regular & static_cast<unsigned>(random.next());
      const int lanes = kernel.lanes, count = input_size(depth), numbers = 6 * side(depth) * side(depth);
      AlignedFloats input, one, work, got, want;
      input.grow(lanes * count), one.grow(count), work.grow(lanes * work_size(depth));
      got.grow(lanes * numbers), want.grow(lanes * numbers);
      for (int k = 0; k < lanes * count; ++k)
        input.data()[k] = k < lanes * parts_offset(depth) ? static_cast<float>(random.unit() - .5)
                                                          : static_cast<float>(random.next() % 2);
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
    const auto placed = place<float>(mesh);
    return placed.faces_local_from.empty() ? placed.local_from : placed.faces_local_from[0];
  };
  EXPECT_EQ(from(.5), 4);
  EXPECT_EQ(from(1. / 127), 4);
  EXPECT_EQ(from(1. / 129), 3);
  EXPECT_EQ(from(1. / 129, 1e-30), 3);
  EXPECT_EQ(from(1. / 257), 2);
  EXPECT_EQ(from(1. / 513), 1);
  EXPECT_EQ(from(0), 4) << "flat: it has no normal to lose";
}

/// A sloping sheet of 92 x 91 vertices, of size 1, with a column of needles: 1e-4 wide.
data::ControlMesh sheet_with_needles() {
  data::ControlMesh mesh = grid_sheet(90, 91);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    auto& p = mesh.positions[v];
    if (v % 92 == 45) p = mesh.positions[v - 1], p[0] += 90e-4;
  }
  for (auto& p : mesh.positions) {
    p[2] += p[0] / 2;
    for (double& x : p) x = static_cast<float>(x / 90);
  }
  return mesh;
}

// Depth 4 has origins of their own in every mesh: at lesser depths grids of needles do at most twice as badly. Their
// insides from an origin common to the mesh are 7 times as far off as at depth 4. Other grids lose what such an origin costs: 2^depth
// roundings for each of their heights, 128 at most, in the size of the mesh.
TEST(RowStreamManyVertices, KeepTheNormalsOfNeedlesAtEveryDepth) {
  const data::ControlMesh mesh = sheet_with_needles();
  const Adjacency adjacency(mesh);
  const RowStream stream(mesh, adjacency, kernels().front());
  const DoubleStream exact(mesh, adjacency);
  Workspace workspace;
  double allowed = 1e-3;
  for (const int depth : {4, 3, 2, 1}) {
    auto grids =
        stream.sorted(pair_faces(adjacency, std::vector<std::int32_t>(mesh.faces.size(), depth)).grids);
    grids.resize(1000);  // needles, what is beside them, and others
    const auto points = static_cast<std::size_t>(side(depth) * side(depth));
    std::vector<Vertex> got(points * grids.size());
    std::vector<double> want(6 * got.size());
    stream.whole(grids, depth, workspace, got.data());
    exact.whole(grids, depth, want.data());
    double worst[2] = {};
    std::size_t needles = 0;
    for (std::size_t v = 0; v < got.size(); ++v) {
      const Grid& grid = grids[v / points];
      const LocalOrigins& local = stream.rings().local();
      const bool needle = local.of_face<3>(grid.face0) < kLocalFrom ||
                          (!grid.singleton() && local.of_face<3>(grid.face1) < kLocalFrom);
      needles += needle ? 1 : 0;
      for (std::size_t c = 0; c < 3; ++c)
        worst[needle] =
            std::max(worst[needle], std::abs(static_cast<double>(got[v].normal[c]) - want[6 * v + 3 + c]));
    }
    EXPECT_GT(needles, 0U);
    EXPECT_LE(worst[1], allowed) << depth;
    EXPECT_LE(worst[0], std::ldexp(128, depth - 24)) << depth;
    if (depth == 4) allowed = 2 * worst[1];
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
