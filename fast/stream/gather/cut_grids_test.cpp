// SPDX-License-Identifier: MIT
// Row streaming of triangles next to a cut.
#include "fast/stream/gather/cut_grids.h"

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
#include "data/generators/sharp_meshes.h"
#include "data/shapes.h"
#include "fast/plan/pairing.h"
#include "fast/stream/row_stream.h"

namespace limitcheck::fast::row_stream {
namespace {

struct NamedMesh {
  std::string name;
  data::ControlMesh mesh;
};

std::vector<NamedMesh> cut_meshes() {
  std::vector<NamedMesh> meshes{{"dart", data::dart(5, true)},
                                {"corner", data::corner(3, true)},
                                {"an open crease", data::with_open_crease(data::torus(12, 8), 5)},
                                {"two edges", data::octahedron()}};
  auto& faces = meshes[3].mesh.faces;  // of one face, which is next to itself
  for (std::size_t k = 0; k < 2; ++k)
    meshes[3].mesh.sharpness.edges.push_back({faces[0][k], faces[0][k + 1], 10});
  for (std::uint64_t seed = 1; seed <= 4; ++seed)
    meshes.push_back({"random " + std::to_string(seed), data::with_random_creases(data::torus(9, 7), seed)});
  for (auto& [name, mesh] : meshes)
    for (auto& p : mesh.positions)
      for (double& x : p) x = static_cast<float>(x);
  return meshes;
}

// All faces, in pairs.
std::vector<Grid> grids_of(const TriangleMesh& mesh) {
  const std::vector<std::int32_t> depth(static_cast<std::size_t>(mesh.adjacency().face_count()), 0);
  return pair_faces(mesh.adjacency(), depth).grids;
}

std::vector<Vertex> whole(const RowStream& stream, std::span<const Grid> grids, int depth) {
  std::vector<Vertex> out(grids.size() * static_cast<std::size_t>(side(depth) * side(depth)));
  Workspace workspace;
  stream.whole(grids, depth, workspace, out.data());
  return out;
}

// Every point of an edge or a corner from all who have it: grids, edges in either direction, every variant;
// and positions from both sides of a cut.
TEST(CutGrids, ShareTheirBorderPointsWithTheOthersBitByBit) {
  std::int64_t compared = 0, across = 0;
  for (const NamedMesh& named : cut_meshes()) {
    const std::string& name = named.name;  // clang 14 captures no structured bindings
    const data::ControlMesh& mesh = named.mesh;
    const TriangleMesh cut(mesh);
    const Adjacency& adjacency = cut.adjacency();
    const auto grids = grids_of(cut);
    for (int depth = 0; depth <= 5; ++depth) {
      const int n = side(depth);
      std::map<std::tuple<std::int32_t, std::int32_t, int>, std::array<std::uint32_t, 6>> known;
      std::map<std::tuple<std::int32_t, std::int32_t, int>, std::array<std::uint32_t, 3>> places;
      const auto see = [&](std::int32_t h, int t, const Vertex& v) {
        std::array<std::uint32_t, 6> bits;
        std::memcpy(bits.data(), &v, sizeof bits);
        const auto key = [&](std::int32_t a, std::int32_t b) {
          if (t == 0) return std::tuple(a, a, 0);
          if (t == n - 1) return std::tuple(b, b, 0);
          return a < b ? std::tuple(a, b, t) : std::tuple(b, a, n - 1 - t);
        };
        const std::int32_t a = adjacency.origin(h), b = adjacency.target(h);
        // A cut that ends in two darts has the same vertices on both sides.
        const auto name_of = cut.is_cut(h) && t > 0 && t < n - 1 ? std::tuple(-1 - h, 0, t) : key(a, b);
        const auto [seen, fresh] = known.try_emplace(name_of, bits);
        if (!fresh) ++compared;
        ASSERT_EQ(seen->second, bits) << name << " depth " << depth << " half-edge " << h << " point " << t;
        const std::array place{bits[0], bits[1], bits[2]};
        const auto [there, first] = places.try_emplace(key(cut.uncut(a), cut.uncut(b)), place);
        if (!first && cut.is_cut(h)) ++across;
        ASSERT_EQ(there->second, place) << name << " depth " << depth << " half-edge " << h << " point " << t;
      };
      for (const Kernel& kernel : kernels()) {
        if (!kernel.fused && depth > 3) continue;
        const RowStream stream(cut, kernel);
        const auto points = whole(stream, grids, depth);
        for (std::size_t g = 0; g < grids.size(); ++g) {
          const GridEdges along(adjacency, grids[g], Order::kFromA);
          for (int t = 0; t < n; ++t) {
            const int i[] = {t, n - 1, n - 1 - t, 0, t}, j[] = {0, t, n - 1, n - 1 - t, t};
            for (int k = 0; k < GridEdges::kCount; ++k)
              if (along.of[k] >= 0)
                see(along.of[k], t, points[(g * n + static_cast<std::size_t>(j[k])) * n + i[k]]);
          }
        }
        std::vector<std::int32_t> half_edges(3 * static_cast<std::size_t>(adjacency.face_count()));
        std::iota(half_edges.begin(), half_edges.end(), 0);
        std::vector<Vertex> out(half_edges.size() * static_cast<std::size_t>(n));
        Workspace workspace;
        stream.edges(half_edges, depth, workspace, out.data());
        for (const std::int32_t h : half_edges)
          for (int t = 0; t < n; ++t) see(h, t, out[static_cast<std::size_t>(h * n + t)]);
      }
    }
  }
  EXPECT_GT(compared, 500'000);
  EXPECT_GT(across, 10'000);
  RecordProperty("compared", std::to_string(compared));
}

// Whatever the order of rows, and past the caches.
TEST(CutGrids, AreTheSameInEveryForm) {
  for (const NamedMesh& named : cut_meshes()) {
    const std::string& name = named.name;  // clang 14 captures no structured bindings
    const data::ControlMesh& mesh = named.mesh;
    const TriangleMesh cut(mesh);
    const RowStream stream(cut);
    const auto grids = grids_of(cut);
    const int depth = 4;
    const std::size_t n = side(depth);
    const auto expected = whole(stream, grids, depth);
    std::vector<Vertex> turned(expected.size()), streamed(expected.size());
    struct Context {
      const Grid* first;
      Vertex* out;
    } context{grids.data(), turned.data()};
    Workspace workspace;
    stream.rows(
        grids, depth, workspace,
        [](void* opaque, const RowView& view) {
          const Context& to = *static_cast<const Context*>(opaque);
          const auto size = static_cast<std::size_t>(side(view.depth));
          for (std::size_t lane = 0; lane < view.grids.size(); ++lane) {
            Vertex* const grid =
                to.out + static_cast<std::size_t>(&view.grids[lane] - to.first) * size * size;
            const auto row = size - 1 - static_cast<std::size_t>(view.j);
            for (std::size_t i = 0; i < size; ++i) grid[row * size + size - 1 - i] = view.vertices(lane)[i];
          }
        },
        &context, Order::kFromC);
    stream.streamed(grids, depth, workspace, streamed.data());
    for (std::size_t g = 0; g < grids.size(); ++g) {
      for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t i = 0; i < n; ++i) {
          if (grids[g].singleton() && i > j) continue;  // never shown
          const std::size_t at = (g * n + j) * n + i;
          ASSERT_EQ(std::memcmp(&expected[at], &turned[at], sizeof(Vertex)), 0) << name << " " << g;
          ASSERT_EQ(std::memcmp(&expected[at], &streamed[at], sizeof(Vertex)), 0) << name << " " << g;
        }
      }
    }
  }
}

}  // namespace
}  // namespace limitcheck::fast::row_stream
