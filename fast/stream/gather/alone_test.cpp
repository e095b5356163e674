// SPDX-License-Identifier: MIT
// Row streaming of triangles next to a cut, and of quads next to something semi-sharp or sharp.
#include "fast/stream/gather/alone.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <numeric>
#include <string>
#include <tuple>
#include <vector>

#include "data/bounding_box.h"
#include "data/generators/polygon_meshes.h"
#include "data/generators/sharp_meshes.h"
#include "data/generators/surgery.h"
#include "data/shapes.h"
#include "fast/plan/pairing.h"
#include "fast/stream/row_stream.h"
#include "fast/test_support/quad_meshes.h"

namespace limitcheck::fast::row_stream {
namespace {

// Triangles next to a cut.
struct Cut {
  using Mesh = TriangleMesh;
  using Stream = RowStream;
  using View = RowView;
  using Items = std::vector<Grid>;  // all faces, in pairs
  static constexpr int kSides = 3;
  static constexpr std::int64_t kCompared = 500'000;
  static constexpr double kFromC = 0;  // how far rows from C may be off, in diagonals

  static std::vector<NamedMesh> meshes() {
    std::vector<NamedMesh> meshes{{"dart", data::dart(5, true)},
                                  {"corner", data::corner(3, true)},
                                  {"an open crease", data::with_open_crease(data::torus(12, 8), 5)},
                                  {"two edges", data::octahedron()}};
    auto& faces = meshes[3].mesh.faces;  // of one face, which is next to itself
    for (std::size_t k = 0; k < 2; ++k)
      meshes[3].mesh.sharpness.edges.push_back({faces[0][k], faces[0][k + 1], 10});
    for (std::uint64_t seed = 1; seed <= 4; ++seed)
      meshes.push_back(
          {"random " + std::to_string(seed), data::with_random_creases(data::torus(9, 7), seed)});
    return meshes;
  }

  explicit Cut(const data::ControlMesh& control) : mesh(control), before(control) {}
  const Adjacency& adjacency() const { return mesh.adjacency(); }
  // The other side of a cut, or -1.
  std::int32_t across(std::int32_t h) const { return mesh.is_cut(h) ? before.twin(h) : -1; }
  Items items() const {
    return pair_faces(adjacency(),
                      std::vector<std::int32_t>(static_cast<std::size_t>(adjacency().face_count())))
        .grids;
  }
  GridEdges edges(const Grid& grid) const { return {adjacency(), grid, Order::kFromA}; }
  static auto kernels() { return row_stream::kernels(); }
  static bool shown(const Grid& grid, std::size_t i, std::size_t j) { return !grid.singleton() || i <= j; }

  TriangleMesh mesh;
  Adjacency before;
};

// Quads next to something semi-sharp.
struct SemiSharpAndCut {
  using Mesh = QuadMesh;
  using Stream = QuadRowStream;
  using View = RowView;
  using Items = std::vector<std::int32_t>;
  static constexpr int kSides = 4;
  static constexpr std::int64_t kCompared = 1'000'000;
  static constexpr double kFromC = 1e-7;

  static std::vector<NamedMesh> meshes() {
    std::vector<NamedMesh> meshes{{"creased cube 2", data::creased_cube(2)},
                                  {"crease ring 2.5", data::crease_ring(2, 5)},
                                  {"one edge", data::quad_torus(6, 5)},
                                  {"one vertex", shaken(data::pawn(5), .01, 4)}};
    meshes[2].mesh.sharpness.edges.push_back({meshes[2].mesh.faces[7][0], meshes[2].mesh.faces[7][1], 1.5F});
    meshes[3].mesh.sharpness.vertices.push_back({meshes[3].mesh.faces[3][0], 2.25F});
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
      data::ControlMesh mesh = data::with_random_sharpness(data::mixed_mesh(seed), seed);
      if (seed % 2 == 0) mesh.sharpness.creasing = data::Creasing::kChaikin;
      meshes.push_back({"mixed " + std::to_string(seed), mesh});
    }
    return meshes;
  }

  explicit SemiSharpAndCut(const data::ControlMesh& control) : mesh(control) {}
  const QuadAdjacency& adjacency() const { return mesh.adjacency; }
  std::int32_t across(std::int32_t h) const { return mesh.cut_twin.empty() ? -1 : mesh.cut_twin[h]; }
  Items items() const {
    Items faces(static_cast<std::size_t>(mesh.adjacency.face_count()));
    std::iota(faces.begin(), faces.end(), 0);
    return faces;
  }
  static GridEdges edges(std::int32_t quad) { return {quad, Order::kFromA}; }
  static auto kernels() { return quad_kernels(); }
  static bool shown(std::int32_t, std::size_t, std::size_t) { return true; }

  QuadMesh mesh;
};

template <class Scheme>
std::vector<Vertex> whole(const typename Scheme::Stream& stream, const Scheme& scheme, int depth) {
  const auto items = scheme.items();
  std::vector<Vertex> out(items.size() * static_cast<std::size_t>(side(depth) * side(depth)));
  Workspace workspace;
  stream.whole(items, depth, workspace, out.data());
  return out;
}

template <class Scheme>
struct Alone : ::testing::Test {};
using Schemes = ::testing::Types<Cut, SemiSharpAndCut>;
TYPED_TEST_SUITE(Alone, Schemes);

// Every point of an edge or a corner from all who have it: grids, edges in either direction, every variant;
// and positions from both sides of a cut.
TYPED_TEST(Alone, SharesItsBorderPointsWithTheOthersBitByBit) {
  std::int64_t compared = 0, across = 0;
  for (const NamedMesh& named : TypeParam::meshes()) {
    const TypeParam scheme(shaken(named.mesh, 0, 0));
    const auto& adjacency = scheme.adjacency();
    const auto items = scheme.items();
    for (int depth = 0; depth <= 5; ++depth) {
      const int n = side(depth);
      SCOPED_TRACE(named.name + " depth " + std::to_string(depth));
      std::map<std::tuple<std::int32_t, int>, std::array<std::uint32_t, 6>> known;
      std::map<std::tuple<std::int32_t, int>, std::array<std::uint32_t, 3>> places;
      const auto see = [&](std::int32_t h, int t, const Vertex& v) {
        const auto name_of = [&](std::int32_t other) {
          return std::tuple(std::max(h, other), h >= other ? t : n - 1 - t);
        };
        const bool end = t == 0 || t == n - 1;
        const auto name = end ? std::tuple(-1 - (t == 0 ? adjacency.origin(h) : adjacency.target(h)), 0)
                              : name_of(adjacency.twin(h));
        std::array<std::uint32_t, 6> bits;
        std::memcpy(bits.data(), &v, sizeof bits);
        const auto [seen, fresh] = known.try_emplace(name, bits);
        compared += fresh ? 0 : 1;
        ASSERT_EQ(seen->second, bits) << "half-edge " << h << " point " << t;
        if (scheme.across(h) < 0) return;
        const std::array place{bits[0], bits[1], bits[2]};
        const auto [there, first] = places.try_emplace(name_of(scheme.across(h)), place);
        across += first ? 0 : 1;
        ASSERT_EQ(there->second, place) << "cut " << h << " point " << t;
      };
      for (const auto& kernel : TypeParam::kernels()) {
        if (!kernel.fused && depth > 3) continue;
        const typename TypeParam::Stream stream(scheme.mesh, kernel);
        const auto points = whole(stream, scheme, depth);
        for (std::size_t g = 0; g < items.size(); ++g) {
          const GridEdges along = scheme.edges(items[g]);
          for (int t = 0; t < n; ++t) {
            const int i[] = {t, n - 1, n - 1 - t, 0, t}, j[] = {0, t, n - 1, n - 1 - t, t};
            for (std::size_t k = 0; k < along.of.size(); ++k)
              if (along.of[k] >= 0)
                see(along.of[k], t, points[(g * n + static_cast<std::size_t>(j[k])) * n + i[k]]);
          }
        }
        std::vector<std::int32_t> half_edges(
            static_cast<std::size_t>(TypeParam::kSides * adjacency.face_count()));
        std::iota(half_edges.begin(), half_edges.end(), 0);
        std::vector<Vertex> out(half_edges.size() * static_cast<std::size_t>(n));
        Workspace workspace;
        stream.edges(half_edges, depth, workspace, out.data());
        for (const std::int32_t h : half_edges)
          for (int t = 0; t < n; ++t) see(h, t, out[static_cast<std::size_t>(h * n + t)]);
      }
    }
  }
  EXPECT_GT(compared, TypeParam::kCompared);
  EXPECT_GT(across, 10'000);
  ::testing::Test::RecordProperty("compared", std::to_string(compared));
}

// Row by row, whichever corner they are counted from, and past the caches.
TYPED_TEST(Alone, IsTheSameInEveryForm) {
  for (const NamedMesh& named : TypeParam::meshes()) {
    SCOPED_TRACE(named.name);
    const data::ControlMesh mesh = shaken(named.mesh, 0, 0);
    const TypeParam scheme(mesh);
    const typename TypeParam::Stream stream(scheme.mesh);
    const auto items = scheme.items();
    const int depth = 4;
    const std::size_t n = side(depth);
    const auto expected = whole(stream, scheme, depth);
    std::vector<Vertex> streamed(expected.size());
    Workspace workspace;
    stream.streamed(items, depth, workspace, streamed.data());
    for (const Order order : {Order::kFromA, Order::kFromC}) {
      std::vector<Vertex> rows(expected.size());
      struct Context {
        Vertex* out;
        std::size_t n;
        std::int64_t rows;
      } context{rows.data(), n, 0};
      stream.rows(
          items, depth, workspace,
          [](void* opaque, const typename TypeParam::View& view) {
            auto& to = *static_cast<Context*>(opaque);
            for (std::size_t lane = 0; lane < view.size(); ++lane, ++to.rows)
              std::copy_n(view.vertices(lane), to.n, to.out + (view.number(lane) * to.n + view.j) * to.n);
          },
          &context, order);
      EXPECT_EQ(context.rows, static_cast<std::int64_t>(items.size() * n));
      double worst = 0;
      for (std::size_t g = 0; g < items.size(); ++g) {
        for (std::size_t k = 0; k < n * n; ++k) {
          if (!TypeParam::shown(items[g], k % n, k / n)) continue;
          const Vertex &want = expected[g * n * n + k],
                       &got = rows[g * n * n + (order == Order::kFromA ? k : n * n - 1 - k)];
          const bool same = std::memcmp(&want, &got, sizeof want) == 0;
          ASSERT_TRUE(same || (order == Order::kFromC && TypeParam::kFromC > 0)) << g;
          for (int c = 0; c < 3; ++c)
            worst = std::max<double>(worst, std::abs(want.position[c] - got.position[c]));
          ASSERT_EQ(std::memcmp(&want, &streamed[g * n * n + k], sizeof want), 0) << g;
        }
      }
      EXPECT_LE(worst, TypeParam::kFromC * data::box_diagonal(mesh));
    }
  }
}

// Against the sliding window in double: positions everywhere; normals where judged(quad, i, j) says so.
template <class Judged>
void expect_the_window(const NamedMesh& named, int deepest, double normal_bound, double growth,
                       Judged&& judged) {
  const data::ControlMesh mesh = shaken(named.mesh, 0, 0);
  const SemiSharpAndCut scheme(mesh);
  std::vector<Vec3<double>> positions;
  for (const auto& p : scheme.mesh.positions) positions.push_back(to_point(p));
  const PreparedQuads<double> prepared(scheme.mesh, positions);
  const QuadRowStream stream(scheme.mesh);
  for (int depth = 0; depth <= deepest; ++depth, normal_bound *= growth) {
    const int n = side(depth);
    const auto got = whole(stream, scheme, depth);
    QuadWindow<double> window(depth, scheme.mesh.adjacency.max_valence());
    double position = 0, normal = 0;
    for (const std::int32_t f : scheme.items()) {
      window.run(prepared, f, depth, [&](int row, const SurfaceVertex<double>* strip) {
        for (int q = 0; q < 2 * n; ++q) {
          const int j = n - 1 - row - q % 2;
          const Vertex& v = got[(f * n + j) * n + q / 2];
          for (int c = 0; c < 3; ++c) {
            ASSERT_TRUE(std::isfinite(v.position[c]) && std::isfinite(v.normal[c])) << named.name;
            position = std::max(position, std::abs(v.position[c] - strip[q].position[c]));
            if (judged(stream.rings().kind(f), q / 2 % (n - 1), j % (n - 1)))
              normal = std::max(normal, std::abs(v.normal[c] - strip[q].normal[c]));
          }
        }
      });
    }
    EXPECT_LE(position / data::box_diagonal(mesh), 1.2e-7) << named.name << " depth " << depth;
    EXPECT_LE(normal, normal_bound) << named.name << " depth " << depth;
  }
}

TEST(SemiSharpQuads, AreThoseOfTheWindowInDouble) {
  for (const NamedMesh& named : SemiSharpAndCut::meshes()) {
    std::int64_t alone = 0;
    expect_the_window(named, 5, 1e-7, 1, [&](QuadClass kind, int i, int j) {
      alone += kind == QuadClass::kSemiSharp ? 1 : 0;
      return kind == QuadClass::kSemiSharp && i != 0 && j != 0;
    });
    EXPECT_GT(alone, 0) << named.name;
  }
}

// What is sharp, and faces of other than four corners.
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
  for (const NamedMesh& named : meshes) expect_the_window(named, 6, 1e-5, 2, [](auto...) { return true; });
}

}  // namespace
}  // namespace limitcheck::fast::row_stream
