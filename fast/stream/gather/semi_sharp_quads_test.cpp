// SPDX-License-Identifier: MIT
// Row streaming of quads next to something semi-sharp.
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
#include "data/generators/mixed_mesh.h"
#include "data/generators/polygon_meshes.h"
#include "data/generators/sharp_meshes.h"
#include "fast/stream/quad_row_stream.h"
#include "fast/test_support/quad_meshes.h"
#include "fast/window/quad_window.h"

namespace limitcheck::fast::row_stream {
namespace {

std::vector<NamedMesh> semi_sharp_meshes() {
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
  for (auto& [name, mesh] : meshes)
    for (auto& p : mesh.positions)
      for (double& x : p) x = static_cast<float>(x);
  return meshes;
}

std::vector<std::int32_t> all_quads(const QuadMesh& quads) {
  std::vector<std::int32_t> faces(static_cast<std::size_t>(quads.adjacency.face_count()));
  std::iota(faces.begin(), faces.end(), 0);
  return faces;
}

std::vector<Vertex> whole(const QuadRowStream& stream, const QuadMesh& quads, int depth) {
  const auto n = static_cast<std::size_t>(side(depth));
  std::vector<Vertex> out(all_quads(quads).size() * n * n);
  Workspace workspace;
  stream.whole(all_quads(quads), depth, workspace, out.data());
  return out;
}

TEST(SemiSharpQuads, AreThoseOfTheWindowInDouble) {
  for (const NamedMesh& named : semi_sharp_meshes()) {
    const std::string& name = named.name;  // clang 14 captures no structured bindings
    const data::ControlMesh& mesh = named.mesh;
    const QuadMesh quads(mesh);
    std::vector<Vec3<double>> positions;
    for (const auto& p : quads.positions) positions.push_back({p[0], p[1], p[2]});
    const PreparedQuads<double> prepared(quads, positions);
    const QuadRowStream stream(quads);
    std::int64_t alone = 0;
    for (const std::int32_t f : all_quads(quads))
      if (stream.rings().kind(f) == QuadClass::kSemiSharp) ++alone;
    EXPECT_GT(alone, 0) << name;
    for (int depth = 0; depth <= 5; ++depth) {
      const int n = side(depth);
      const auto got = whole(stream, quads, depth);
      QuadWindow<double> window(depth, quads.adjacency.max_valence());
      double position = 0, normal = 0;
      for (const std::int32_t f : all_quads(quads)) {
        window.run(prepared, f, depth, [&](int row, const SurfaceVertex<double>* strip) {
          for (int q = 0; q < 2 * n; ++q) {
            const int j = n - 1 - row - q % 2;
            const Vertex& v = got[(f * n + j) * n + q / 2];
            const std::array p{strip[q].position.x, strip[q].position.y, strip[q].position.z};
            const std::array w{strip[q].normal.x, strip[q].normal.y, strip[q].normal.z};
            const bool own =
                stream.rings().kind(f) == QuadClass::kSemiSharp && j % (n - 1) != 0 && q / 2 % (n - 1) != 0;
            for (int c = 0; c < 3; ++c) {
              ASSERT_TRUE(std::isfinite(v.position[c]) && std::isfinite(v.normal[c])) << name;
              position = std::max(position, std::abs(v.position[c] - p[c]));
              if (own) normal = std::max(normal, std::abs(v.normal[c] - w[c]));
            }
          }
        });
      }
      EXPECT_LE(position / data::box_diagonal(mesh), 1.2e-7) << name << " depth " << depth;
      EXPECT_LE(normal, 1e-7) << name << " depth " << depth;
    }
  }
}

// Every point of a side or a corner from all who have it: both quads, both half-edges, every variant; and
// positions from both sides of a cut.
TEST(SemiSharpQuads, ShareTheirBorderPointsWithTheOthersBitByBit) {
  std::int64_t compared = 0, across = 0;
  for (const NamedMesh& named : semi_sharp_meshes()) {
    const std::string& name = named.name;  // clang 14 captures no structured bindings
    const data::ControlMesh& mesh = named.mesh;
    const QuadMesh quads(mesh);
    for (int depth = 0; depth <= 5; ++depth) {
      const int n = side(depth);
      std::map<std::tuple<std::int32_t, int>, std::array<std::uint32_t, 6>> known;
      std::map<std::tuple<std::int32_t, int>, std::array<std::uint32_t, 3>> places;
      const auto see = [&](std::int32_t h, int t, const Vertex& v) {
        std::int32_t name_of = std::max(h, quads.adjacency.twin(h));
        int at = name_of == h ? t : n - 1 - t;
        if (t == 0 || t == n - 1) {
          name_of = -1 - (t == 0 ? quads.adjacency.origin(h) : quads.adjacency.target(h)), at = 0;
        }
        std::array<std::uint32_t, 6> bits;
        std::memcpy(bits.data(), &v, sizeof bits);
        const auto [seen, fresh] = known.try_emplace({name_of, at}, bits);
        if (!fresh) ++compared;
        ASSERT_EQ(seen->second, bits) << name << " depth " << depth << " half-edge " << h << " point " << t;
        const std::int32_t cut = quads.cut_twin.empty() ? -1 : quads.cut_twin[h];
        if (cut < 0) return;
        const std::int32_t side_of = std::max(h, cut);
        const auto [place, first] = places.try_emplace({side_of, side_of == h ? t : n - 1 - t},
                                                       std::array{bits[0], bits[1], bits[2]});
        if (!first) ++across;
        ASSERT_EQ(place->second, (std::array{bits[0], bits[1], bits[2]})) << name << " cut " << h;
      };
      for (const QuadKernel& kernel : quad_kernels()) {
        if (!kernel.fused && depth > 3) continue;
        const QuadRowStream stream(quads, kernel);
        const auto points = whole(stream, quads, depth);
        for (const std::int32_t f : all_quads(quads)) {
          for (int t = 0; t < n; ++t) {
            const int i[4] = {t, n - 1, n - 1 - t, 0}, j[4] = {0, t, n - 1, n - 1 - t};
            for (int k = 0; k < 4; ++k) see(4 * f + k, t, points[(f * n + j[k]) * n + i[k]]);
          }
        }
        std::vector<std::int32_t> half_edges(4 * all_quads(quads).size());
        std::iota(half_edges.begin(), half_edges.end(), 0);
        std::vector<Vertex> out(half_edges.size() * static_cast<std::size_t>(n));
        Workspace workspace;
        stream.edges(half_edges, depth, workspace, out.data());
        for (const std::int32_t h : half_edges)
          for (int t = 0; t < n; ++t) see(h, t, out[static_cast<std::size_t>(h * n + t)]);
      }
    }
  }
  EXPECT_GT(compared, 1'000'000);
  EXPECT_GT(across, 10'000);
  RecordProperty("compared", std::to_string(compared));
}

// Rows come one by one, whichever corner they are counted from.
TEST(SemiSharpQuads, HaveTheSameRowsFromEitherCorner) {
  for (const NamedMesh& named : semi_sharp_meshes()) {
    const std::string& name = named.name;  // clang 14 captures no structured bindings
    const data::ControlMesh& mesh = named.mesh;
    const QuadMesh quads(mesh);
    const QuadRowStream stream(quads);
    const int depth = 4, n = side(depth);
    struct Context {
      int n;
      Order order;
      const std::vector<Vertex>& expected;
      std::int64_t rows;
      double worst;
    };
    const auto expected = whole(stream, quads, depth);
    for (const Order order : {Order::kFromA, Order::kFromC}) {
      Context context{n, order, expected, 0, 0};
      Workspace workspace;
      stream.rows(
          all_quads(quads), depth, workspace,
          [](void* opaque, const QuadRowView& view) {
            Context& c = *static_cast<Context*>(opaque);
            for (std::size_t lane = 0; lane < view.index.size(); ++lane, ++c.rows) {
              const Vertex* face =
                  c.expected.data() + static_cast<std::ptrdiff_t>(view.index[lane]) * c.n * c.n;
              for (int i = 0; i < c.n; ++i) {
                const bool turned = c.order == Order::kFromC;
                const int row = turned ? c.n - 1 - view.j : view.j, column = turned ? c.n - 1 - i : i;
                const Vertex& want = face[row * c.n + column];
                for (int x = 0; x < 3; ++x)
                  c.worst = std::max<double>(c.worst,
                                             std::abs(view.vertices(lane)[i].position[x] - want.position[x]));
              }
            }
          },
          &context, order);
      EXPECT_EQ(context.rows, quads.adjacency.face_count() * n) << name;
      EXPECT_LE(context.worst, order == Order::kFromA ? 0 : 1e-7 * data::box_diagonal(mesh)) << name;
    }
  }
}

}  // namespace
}  // namespace limitcheck::fast::row_stream
