// SPDX-License-Identifier: MIT
#include "fast/stream/row_stream.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>
#include <string>
#include <utility>

#include "data/bounding_box.h"
#include "data/error.h"
#include "data/generators/bumpy_sphere.h"
#include "data/generators/polygon_meshes.h"
#include "fast/stream/gather/batch.h"
#include "fast/stream/kernel/kernel.h"
#include "fast/test_support/quad_meshes.h"
#include "fast/test_support/refined_limits.h"
#include "fast/test_support/shared_points.h"
#include "fast/window/quad_window.h"

namespace limitcheck::fast::row_stream {
namespace {

std::vector<std::int32_t> all_of(const data::ControlMesh& mesh) {
  std::vector<std::int32_t> faces(mesh.faces.size());
  std::iota(faces.begin(), faces.end(), 0);
  return faces;
}

std::vector<Vertex> evaluate(const data::ControlMesh& mesh, int depth, const QuadKernel& kernel) {
  const QuadMesh quads(mesh);
  const QuadRowStream stream(quads, kernel);
  Workspace workspace;
  std::vector<Vertex> out(mesh.faces.size() * static_cast<std::size_t>(side(depth) * side(depth)));
  stream.whole(all_of(mesh), depth, workspace, out.data());
  return out;
}

/// The least height of the triangles that two sides of a quad span.
double least_height(const data::ControlMesh& mesh) {
  double least = data::box_diagonal(mesh);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto corner = [&](std::size_t k) {
      const auto& p = mesh.positions[mesh.faces[f][k % 4]];
      return Point{p[0], p[1], p[2]};
    };
    for (std::size_t k = 0; k < 4; ++k) {
      const Point a = corner(k + 1) - corner(k), b = corner(k + 3) - corner(k);
      const long double area = norm(cross_product(a, b));
      least = std::min(least, static_cast<double>(area / std::max(norm(a), norm(b))));
    }
  }
  return least;
}

TEST(QuadStream, GivesTheLimitSurfaceWithItsBoundaryCurve) {
  const auto worst_of = [](const data::ControlMesh& mesh, int depth) {
    const auto got = evaluate(mesh, depth, quad_kernels().front());
    const RefinedLevels expected(mesh, data::Scheme::kCatmullClark, depth);
    const int n = side(depth);
    Worst worst;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
      for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
          const LatticePoint at{static_cast<std::int32_t>(f), static_cast<std::uint32_t>(i),
                                static_cast<std::uint32_t>(j), 1U << depth};
          worst.see(got[(f * n + j) * n + i], expected.limit(at), data::box_diagonal(mesh), f, i, j);
        }
    return worst;
  };
  for (const auto& meshes : {closed_meshes(), open_meshes()})
    expect_all_limits(meshes, 4, worst_of, least_height);
}

// A mesh of 4002 quads, none regular, whose edges are a hundredth of its size. Without origins of their own,
// 99.9 % of the normals at depths 4 and 5 would be within 5.7e-5 and 7.9e-5 rad.
TEST(QuadStreamOrigins, KeepNormalsToAHundredThousandthAtDepthsFourAndFive) {
  const QuadMesh quads(data::bumpy_sphere(1334, 1));
  const QuadRowStream stream(quads, quad_kernels().front());
  const BasicQuadRings<double> rings(quads);
  std::vector<std::int32_t> faces;
  for (std::int32_t f = 0; f < quads.adjacency.face_count(); f += 8) faces.push_back(f);
  for (const int depth : {4, 5}) {
    const auto n = static_cast<std::size_t>(side(depth));
    std::vector<Vertex> got(faces.size() * n * n);
    Workspace workspace;
    stream.whole(faces, depth, workspace, got.data());
    std::vector<double> input(quad_input_size(depth)), work(quad_work_size(depth)), want(6 * n * n), errors;
    double* lane = want.data();
    const QuadTarget<double> target{&lane, static_cast<std::ptrdiff_t>(6 * n), nullptr, nullptr};
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const auto batch = gather_quads<double>(rings, {&faces[f], 1}, depth, 1, input.data());
      generic::QuadStream<ScalarNumber<double>>(batch, rings.placement(), work.data(), {target}).run();
      for (std::size_t v = 0; v < n * n; ++v) {
        double square = 0;
        for (std::size_t c = 0; c < 3; ++c) {
          const double d = got[f * n * n + v].normal[c] - want[6 * v + 3 + c];
          square += d * d;
        }
        errors.push_back(std::sqrt(square));
      }
    }
    std::sort(errors.begin(), errors.end());
    const auto at = [&](double share) {
      return errors[static_cast<std::size_t>(share * static_cast<double>(errors.size() - 1))];
    };
    EXPECT_LE(at(.999), 1e-5) << "depth " << depth;
    EXPECT_LE(at(.5), 1e-6) << "depth " << depth;
    for (const double share : {.5, .999, 1.})
      RecordProperty("depth_" + std::to_string(depth) + "_" + std::to_string(share),
                     std::to_string(at(share) * 1e9) + "e-9");
  }
}

void add_quads_and_sides(const data::ControlMesh& mesh, int depth, const QuadKernel& kernel,
                         const std::vector<std::int32_t>& known, SharedPoints& shared) {
  const int n = side(depth);
  const auto points = evaluate(mesh, depth, kernel);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (int k = 0; k < n; ++k)
      for (const auto& [i, j] : {std::pair{k, 0}, {k, n - 1}, {0, k}, {n - 1, k}})
        shared.add(mesh, f, i, j, n - 1, points[(f * n + j) * n + i], known);
  const QuadMesh quads(mesh);
  const QuadRowStream stream(quads, kernel);
  std::vector<std::int32_t> half_edges(4 * mesh.faces.size());
  std::iota(half_edges.begin(), half_edges.end(), 0);
  std::vector<Vertex> out(half_edges.size() * n);
  Workspace workspace;
  stream.edges(half_edges, depth, workspace, out.data());
  for (std::size_t h = 0; h < half_edges.size(); ++h) {
    for (int t = 0; t < n; ++t) {
      const int i[4] = {t, n - 1, n - 1 - t, 0}, j[4] = {0, t, n - 1, n - 1 - t};
      shared.add(mesh, h / 4, i[h % 4], j[h % 4], n - 1, out[h * n + t], known);
    }
  }
}

// Claim D14, on every variant the machine has: the same point has the same bits from every quad and from the side alone,
// however the mesh is written down, and from every variant.
TEST(QuadStreamBits, AreEqualFromEveryQuad) {
  std::vector<NamedMesh> meshes = closed_meshes();
  for (NamedMesh& open : open_meshes()) meshes.push_back(std::move(open));
  std::int64_t compared = 0;
  for (const auto& [name, mesh] : meshes) {
    for (int depth = 0; depth <= (mesh.faces.size() > 60 ? 4 : 6); ++depth) {
      SharedPoints shared;
      for (std::uint64_t seed = 0; seed < 3; ++seed) {
        std::vector<std::int32_t> number, known(mesh.positions.size());
        const data::ControlMesh other = renumbered(shaken(mesh, 0, 0), seed, number);
        for (std::size_t v = 0; v < known.size(); ++v) known[number[v]] = static_cast<std::int32_t>(v);
        for (const QuadKernel& kernel : quad_kernels())
          if (kernel.fused || depth <= 3) add_quads_and_sides(other, depth, kernel, known, shared);
      }
      EXPECT_EQ(shared.different(), 0) << name << " depth " << depth << " of " << shared.compared();
      compared += shared.compared();
    }
  }
  RecordProperty("compared", std::to_string(compared));
}

TEST(QuadStreamTargets, EachRunsTheCodeItNames) {
  const QuadMesh quads(data::quad_torus(4, 4));
  const QuadRings rings(quads);
  const std::int32_t face = 0;
  for (const QuadKernel& kernel : quad_kernels()) {
    AlignedFloats input, work, row;
    input.grow(kernel.lanes * quad_input_size(1)), work.grow(kernel.lanes * quad_work_size(1)), row.grow(64);
    std::array<float*, kMaxLanes> lane;
    lane.fill(row.data());
    const QuadTarget<float> target{lane.data(), 0, nullptr, nullptr};
    const auto run = [&](QuadKernel::Run* code, const QuadBatch<float>& batch) {
      return code(batch, rings.placement(), work.data(), target);
    };
    const auto whole = gather_quads<float>(rings, {&face, 1}, 1, kernel.lanes, input.data());
    EXPECT_STREQ(run(kernel.quads, whole), kernel.name);
    const auto side = gather_sides<float>(rings, {&face, 1}, 1, kernel.lanes, input.data());
    EXPECT_STREQ(run(kernel.sides, side), kernel.name);
    const auto patch = gather_patches<float>(rings, {&face, 1}, 1, kernel.lanes, input.data());
    EXPECT_STREQ(run(kernel.patches, patch), kernel.name);
  }
}

// Sides between regular vertices and regular quads: a depth has the points of the depths below it, bit by
// bit.
TEST(QuadStreamBits, AreEqualAtAllDepthsWhereTheSurfaceIsAPolynomial) {
  const data::ControlMesh mesh = shaken(data::quad_torus(6, 5), .1, 7);
  const auto deep = evaluate(mesh, 8, quad_kernels().front());
  for (int depth = 0; depth < 8; ++depth) {
    const auto points = evaluate(mesh, depth, quad_kernels().front());
    const std::size_t n = side(depth), all = side(8), step = std::size_t{1} << (8 - depth);
    std::int64_t different = 0;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t i = 0; i < n; ++i)
          different += std::memcmp(&points[(f * n + j) * n + i], &deep[(f * all + j * step) * all + i * step],
                                   sizeof(Vertex)) != 0;
      }
    }
    EXPECT_EQ(different, 0) << depth;
  }
}

void expect_no_difference_by_batch(const data::ControlMesh& mesh, int depth) {
  const QuadMesh quads(mesh);
  const QuadRowStream stream(quads);
  const auto expected = evaluate(mesh, depth, quad_kernels().front());
  const std::size_t n = side(depth);
  Workspace workspace;
  std::vector<Vertex> one(n * n), all(mesh.faces.size() * n * n);
  const auto order = stream.sorted(all_of(mesh));
  stream.streamed(order, depth, workspace, all.data());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const Vertex* want = expected.data() + static_cast<std::size_t>(order[k]) * n * n;
    EXPECT_EQ(std::memcmp(all.data() + k * n * n, want, n * n * sizeof(Vertex)), 0) << order[k];
    stream.whole({&order[k], 1}, depth, workspace, one.data());
    EXPECT_EQ(std::memcmp(one.data(), want, n * n * sizeof(Vertex)), 0) << order[k];
  }
}
// The order of the faces and what else is evaluated with them make no difference: also where some quads of a batch have
// origins of their own.
TEST(QuadStreamBits, DoNotDependOnTheBatch) {
  expect_no_difference_by_batch(shaken(data::pawn(5), .01, 8), 5);
  const data::ControlMesh mesh = pinched(shaken(quad_sheet(6, 7), .1, 4));
  const QuadRings rings{QuadMesh(mesh)};
  for (const int depth : {1, 2, 3}) {
    expect_no_difference_by_batch(mesh, depth);
    std::int32_t local = 0;
    for (const std::int32_t f : all_of(mesh)) local += depth >= rings.local().first<4>(f) ? 1 : 0;
    EXPECT_TRUE(local > 0 && local < 42) << local << " of 42 at depth " << depth;
  }
}

}  // namespace
}  // namespace limitcheck::fast::row_stream
