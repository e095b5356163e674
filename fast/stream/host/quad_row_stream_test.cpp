// SPDX-License-Identifier: MIT
#include "fast/stream/quad_row_stream.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <numeric>
#include <string>

#include "data/bounding_box.h"
#include "data/error.h"
#include "data/generators/bumpy_sphere.h"
#include "data/generators/polygon_meshes.h"
#include "data/generators/sharp_meshes.h"
#include "fast/stream/gather/quad_batch.h"
#include "fast/stream/kernel/kernel.h"
#include "fast/test_support/quad_meshes.h"
#include "fast/test_support/refined_quads.h"
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

struct Worst {
  double position = 0, normal = 0;  // in diagonals, and per coordinate of the unit vector
  std::string where = "nowhere";
};

Worst worst_against_refinement(const data::ControlMesh& mesh, int depth, const std::vector<Vertex>& got,
                               const std::set<int>& held = {}) {
  const RefinedQuads expected = RefinedQuads::of(mesh, depth, held);
  const double scale = data::box_diagonal(mesh);
  Worst worst;
  const auto raise = [&](double& most, double error, std::size_t f, int i, int j) {
    if (error <= most) return;
    most = error;  // NaN too
    worst.where = "face " + std::to_string(f) + " (" + std::to_string(i) + ", " + std::to_string(j) + ")";
  };
  const int n = side(depth);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const RefinedQuads::Limit e = expected.limit(f, i, j);
        const Vertex& v = got[(f * n + j) * n + i];
        for (int c = 0; c < 3; ++c) {
          raise(worst.position, std::abs(v.position[c] - static_cast<double>(e.position[c])) / scale, f, i,
                j);
          raise(worst.normal, std::abs(v.normal[c] - static_cast<double>(e.normal[c])), f, i, j);
        }
      }
    }
  }
  return worst;
}

void expect_the_limit_surface(const std::vector<NamedMesh>& meshes) {
  Worst all;
  for (const auto& [name, mesh] : meshes) {
    const data::ControlMesh single = shaken(mesh, 0, 0);
    for (int depth = 0; depth <= (mesh.faces.size() > 60 ? 4 : 5); ++depth) {
      const Worst worst =
          worst_against_refinement(single, depth, evaluate(single, depth, quad_kernels().front()));
      EXPECT_LE(worst.position, 1.2e-7) << name << " depth " << depth << " " << worst.where;
      const double bound = 2.4e-7 * (1 << depth) * data::box_diagonal(mesh) / least_height(mesh);
      EXPECT_LE(worst.normal, bound) << name << " depth " << depth << " " << worst.where;
      all.position = std::max(all.position, worst.position);
      all.normal = std::max(all.normal, worst.normal);
    }
  }
  ::testing::Test::RecordProperty("worst_position", std::to_string(all.position * 1e9) + "e-9");
  ::testing::Test::RecordProperty("worst_normal", std::to_string(all.normal * 1e9) + "e-9");
}

TEST(QuadStream, GivesTheLimitSurfaceOfClosedMeshes) {
  expect_the_limit_surface(closed_meshes());
}

TEST(QuadStream, GivesTheLimitSurfaceWithItsBoundaryCurve) {
  expect_the_limit_surface(open_meshes());
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

/// The first bits seen for each point on a side or corner, and how often others came.
class SharedQuadPoints {
 public:
  void add(const data::ControlMesh& mesh, std::size_t face, int i, int j, int size, const Vertex& v,
           const std::vector<std::int32_t>& known) {
    const auto q = mesh.faces[face];
    const auto name = [&](int corner) { return known.empty() ? q[corner % 4] : known[q[corner % 4]]; };
    const int along[4] = {i, j, size - i, size - j};
    const bool on[4] = {j == 0, i == size, j == size, i == 0};
    for (int k = 0; k < 4; ++k) {
      if (!on[k]) continue;
      std::int32_t a = name(k), b = name(k + 1), at = along[k];
      if (at == 0) b = a;
      if (at == size) a = b, at = 0;
      if (a > b) std::swap(a, b), at = size - at;
      if (a == b) at = 0;
      std::array<std::uint32_t, 6> bits;
      std::memcpy(bits.data(), &v, sizeof bits);
      const auto [seen, fresh] = first_.try_emplace({a, b, at}, bits);
      if (fresh) continue;
      ++compared_;
      if (seen->second != bits) ++different_;
    }
  }
  std::int64_t compared() const { return compared_; }
  std::int64_t different() const { return different_; }

 private:
  std::map<std::array<std::int32_t, 3>, std::array<std::uint32_t, 6>> first_;
  std::int64_t compared_ = 0, different_ = 0;
};

// Claim D14, on every variant the machine has: the same point has the same bits from every quad and from the
// side alone, however the mesh is written down; and from every variant.
void expect_equal_bits(const std::vector<NamedMesh>& meshes, int most) {
  std::int64_t compared = 0;
  for (const auto& [name, mesh] : meshes) {
    const data::ControlMesh single = shaken(mesh, 0, 0);
    for (int depth = 0; depth <= (mesh.faces.size() > 60 ? most - 2 : most); ++depth) {
      SharedQuadPoints shared;
      const int n = side(depth);
      for (std::uint64_t seed = 0; seed < 3; ++seed) {
        std::vector<std::int32_t> number, known(mesh.positions.size());
        const data::ControlMesh other = renumbered_quads(single, seed, number);
        for (std::size_t v = 0; v < known.size(); ++v) known[number[v]] = static_cast<std::int32_t>(v);
        for (const QuadKernel& kernel : quad_kernels()) {
          if (!kernel.fused && depth > 3) continue;
          const auto points = evaluate(other, depth, kernel);
          for (std::size_t f = 0; f < other.faces.size(); ++f) {
            for (int k = 0; k < n; ++k) {
              for (const auto& [i, j] : {std::pair{k, 0}, {k, n - 1}, {0, k}, {n - 1, k}})
                shared.add(other, f, i, j, n - 1, points[(f * n + j) * n + i], known);
            }
          }
          const QuadMesh quads(other);
          const QuadRowStream stream(quads, kernel);
          std::vector<std::int32_t> half_edges(4 * other.faces.size());
          std::iota(half_edges.begin(), half_edges.end(), 0);
          std::vector<Vertex> out(half_edges.size() * n);
          Workspace workspace;
          stream.edges(half_edges, depth, workspace, out.data());
          for (std::size_t h = 0; h < half_edges.size(); ++h) {
            for (int t = 0; t < n; ++t) {
              const int i[4] = {t, n - 1, n - 1 - t, 0}, j[4] = {0, t, n - 1, n - 1 - t};
              shared.add(other, h / 4, i[h % 4], j[h % 4], n - 1, out[h * n + t], known);
            }
          }
        }
      }
      EXPECT_EQ(shared.different(), 0) << name << " depth " << depth << " of " << shared.compared();
      compared += shared.compared();
    }
  }
  ::testing::Test::RecordProperty("compared", std::to_string(compared));
}

TEST(QuadStreamBits, AreEqualFromEveryQuadOfAClosedMesh) {
  expect_equal_bits(closed_meshes(), 6);
}

TEST(QuadStreamBits, AreEqualFromEveryQuadOfAMeshWithBoundary) {
  expect_equal_bits(open_meshes(), 6);
}

// What is sharp, and faces of other than four corners, against the sliding window in double.
TEST(QuadStream, GivesTheSurfaceOfTheWindowWhereEdgesAreSharp) {
  std::vector<NamedMesh> meshes{{"creased cube", data::creased_cube(10)},
                                {"crease ring", data::crease_ring(10)},
                                {"prism", data::polygon_prism(5)},
                                {"mixed pawn", data::mixed_pawn(5)}};
  for (const int n : {3, 4, 5, 7}) meshes.push_back({"dart " + std::to_string(n), data::dart(n, false)});
  for (const int k : {2, 3, 4, 5}) meshes.push_back({"corner " + std::to_string(k), data::corner(k, false)});
  auto spike = data::quad_cube();
  spike.sharpness.vertices.push_back({0, 10});
  meshes.push_back({"spike", spike});
  auto edge_and_corner = shaken(quad_sheet(2, 2), .1, 9);
  edge_and_corner.sharpness.boundary = data::Boundary::kEdgeAndCorner;
  meshes.push_back({"edge and corner", edge_and_corner});
  for (const auto& [name, mesh] : meshes) {
    data::ControlMesh single = mesh;
    for (auto& p : single.positions)
      for (double& x : p) x = static_cast<float>(x);
    const QuadMesh quads(single);
    std::vector<Vec3<double>> positions;
    for (const auto& p : quads.positions) positions.push_back({p[0], p[1], p[2]});
    const PreparedQuads<double> prepared(quads, positions);
    const QuadRowStream stream(quads);
    std::vector<std::int32_t> faces(static_cast<std::size_t>(quads.adjacency.face_count()));
    std::iota(faces.begin(), faces.end(), 0);
    for (int depth = 0; depth <= 6; ++depth) {
      const int n = side(depth);
      std::vector<Vertex> got(faces.size() * n * n);
      Workspace workspace;
      stream.whole(faces, depth, workspace, got.data());
      QuadWindow<double> window(depth, quads.adjacency.max_valence());
      double position = 0, normal = 0;
      for (const std::int32_t f : faces) {
        window.run(prepared, f, depth, [&](int row, const SurfaceVertex<double>* strip) {
          for (int q = 0; q < 2 * n; ++q) {
            const int j = n - 1 - row - q % 2;
            const Vertex& v = got[(f * n + j) * n + q / 2];
            const std::array p{strip[q].position.x, strip[q].position.y, strip[q].position.z};
            const std::array w{strip[q].normal.x, strip[q].normal.y, strip[q].normal.z};
            for (int c = 0; c < 3; ++c) {
              position = std::max(position, std::abs(v.position[c] - p[c]));
              normal = std::max(normal, std::abs(v.normal[c] - w[c]));
            }
          }
        });
      }
      EXPECT_LE(position / data::box_diagonal(single), 1.2e-7) << name << " depth " << depth;
      EXPECT_LE(normal, 1e-5 * (1 << depth)) << name << " depth " << depth;
    }
  }
}

// The two sides of a cut have a point each, in one place.
TEST(QuadStreamBits, PositionsAreEqualOnBothSidesOfACut) {
  std::int64_t compared = 0;
  for (const auto& mesh :
       {data::creased_cube(10), data::crease_ring(10), data::dart(5, false), data::dart(3, false)}) {
    const QuadMesh quads(mesh);
    const QuadRowStream stream(quads);
    for (int depth = 0; depth <= 6; ++depth) {
      const std::size_t n = side(depth);
      std::vector<Vertex> here(n), there(n);
      Workspace workspace;
      for (std::size_t i = 0; i < quads.cut_twin.size(); ++i) {
        const auto h = static_cast<std::int32_t>(i);
        if (quads.cut_twin[h] < 0) continue;
        stream.edges({&h, 1}, depth, workspace, here.data());
        stream.edges({&quads.cut_twin[h], 1}, depth, workspace, there.data());
        for (std::size_t k = 0; k < n; ++k, ++compared)
          EXPECT_EQ(std::memcmp(&here[k].position, &there[n - 1 - k].position, sizeof here[k].position), 0);
      }
    }
  }
  EXPECT_GT(compared, 1000);
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

// The order of the faces and what else is evaluated with them make no difference.
TEST(QuadStreamBits, DoNotDependOnTheBatch) {
  const data::ControlMesh mesh = shaken(data::pawn(5), .01, 8);
  const QuadMesh quads(mesh);
  const QuadRowStream stream(quads);
  const auto expected = evaluate(mesh, 5, quad_kernels().front());
  const std::size_t n = side(5);
  Workspace workspace;
  std::vector<Vertex> one(n * n), all(mesh.faces.size() * n * n);
  const auto order = stream.sorted(all_of(mesh));
  stream.streamed(order, 5, workspace, all.data());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const Vertex* want = expected.data() + static_cast<std::size_t>(order[k]) * n * n;
    EXPECT_EQ(std::memcmp(all.data() + k * n * n, want, n * n * sizeof(Vertex)), 0) << order[k];
    stream.whole({&order[k], 1}, 5, workspace, one.data());
    EXPECT_EQ(std::memcmp(one.data(), want, n * n * sizeof(Vertex)), 0) << order[k];
  }
}

}  // namespace
}  // namespace limitcheck::fast::row_stream
