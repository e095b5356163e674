// SPDX-License-Identifier: MIT
// The sliding windows of both schemes.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "data/generators/polygon_meshes.h"
#include "data/generators/sharp_meshes.h"
#include "data/generators/surgery.h"
#include "data/numeral.h"
#include "data/splitmix64.h"
#include "data/test_support/known_answers.h"
#include "fast/test_support/refined_limits.h"
#include "fast/test_support/test_meshes.h"
#include "fast/window/quad_rows.h"
#include "fast/window/quad_window.h"
#include "fast/window/sliding_window.h"

namespace limitcheck::fast {
namespace {

/// (row, column) of the window as a point of the face left of half-edge h0 (upper left) or of its twin h1.
LatticePoint lattice_of(std::int32_t h0, std::int32_t h1, int k, int row, int column, bool upper) {
  std::uint32_t weight[3];
  const int edge = upper ? h0 % 3 : h1 % 3;
  if (upper) {  // h0 runs corner0 -> corner2, then corner3
    weight[edge] = row;
    weight[(edge + 1) % 3] = column;
    weight[(edge + 2) % 3] = k - row - column;
  } else {  // h1 runs corner2 -> corner0, then corner1
    weight[edge] = k - row;
    weight[(edge + 1) % 3] = k - column;
    weight[(edge + 2) % 3] = row + column - k;
  }
  return {(upper ? h0 : h1) / 3, weight[1], weight[2], static_cast<std::uint32_t>(k)};
}

struct Worst {
  long double position = 0, normal = 0;
};

template <class N>
Worst compare(const data::ControlMesh& mesh, int depth) {
  const Adjacency adjacency(mesh);
  const PreparedMesh<N> prepared(adjacency, positions_of<N>(mesh));
  SlidingWindow<N> window(depth, adjacency.max_valence());
  const RefinedLevels refined = RefinedLevels::loop(mesh, depth);
  const int k = 1 << depth;
  Worst worst;
  for (std::int32_t h = 0; h < 3 * adjacency.face_count(); ++h) {
    const std::int32_t twin = adjacency.twin(h);
    if (twin < 0) continue;
    int expected_row = 0;
    window.run(prepared, h, depth, [&](int row, const SurfaceVertex<N>* strip) {
      EXPECT_EQ(row, expected_row++);
      for (int i = 0; i <= k; ++i) {
        for (int below = 0; below < 2; ++below) {
          const int r = row + below;
          const bool upper = r + i <= k;
          const auto expected = refined.limit(lattice_of(h, twin, k, r, i, upper));
          const auto& got = strip[2 * i + below];
          const Point p{got.position.x, got.position.y, got.position.z};
          const Point n{got.normal.x, got.normal.y, got.normal.z};
          worst.position = std::max(worst.position, norm(p - expected.position));
          worst.normal = std::max(worst.normal, norm(n - expected.normal));
        }
      }
    });
    EXPECT_EQ(expected_row, k);
  }
  return worst;
}

struct Shape {
  const char* name;
  data::ControlMesh mesh;
};

std::vector<Shape> shapes() {
  return {{"tetrahedron", tetrahedron()},
          {"octahedron", octahedron()},
          {"bipyramid 3", bipyramid(3)},
          {"bipyramid 7", bipyramid(7)},
          {"torus", grid_torus(3, 4)},
          {"bipyramid 60", bipyramid(60)},
          {"sheet", grid_sheet(2, 3)},
          {"wheel 3", wheel(3, .5)},
          {"wheel 5", wheel(5, .3)},
          {"fan 2", fan(2)},
          {"fan 3", fan(3)},
          {"fan 5", fan(5)}};
}

TEST(Sec4_SlidingWindow, EqualsTheMeshRefinedAsAWhole) {
  for (const auto& [name, mesh] : shapes()) {
    for (int depth = 0; depth <= (mesh.faces.size() > 50 ? 2 : 4); ++depth) {
      const Worst worst = compare<double>(mesh, depth);
      EXPECT_LE(worst.position, 1e-14L) << name << " depth " << depth;
      EXPECT_LE(worst.normal, 1e-12L) << name << " depth " << depth;
    }
  }
}

template <class N>
std::vector<Vec3<N>> rounded(const QuadMesh& mesh) {
  std::vector<Vec3<N>> out;
  for (const auto& p : mesh.positions)
    out.push_back({static_cast<N>(p[0]), static_cast<N>(p[1]), static_cast<N>(p[2])});
  return out;
}

// All points of a quad: [j][i] at (u, v) = (i, j) / 2^depth.
template <class N, bool Carry = true, class Mesh>
std::vector<std::vector<SurfaceVertex<N>>> points_of(const Mesh& mesh, std::int32_t quad, int depth,
                                                     WindowCounts* counts = nullptr) {
  QuadWindow<N, LimitSurface<N>, Counting, Carry> window(depth, mesh.mesh().adjacency.max_valence());
  const int k = 1 << depth;
  std::vector<std::vector<SurfaceVertex<N>>> out(k + 1, std::vector<SurfaceVertex<N>>(k + 1));
  window.run(mesh, quad, depth, [&](int row, const SurfaceVertex<N>* strip) {
    for (int i = 0; i <= k; ++i) {
      out[k - row][i] = strip[2 * i];
      out[k - row - 1][i] = strip[2 * i + 1];
    }
  });
  if (counts != nullptr) *counts = window.probe().counts;
  return out;
}

double value(const data::Numeral& n) {
  return data::parse<double>(n);
}

data::ControlMesh mesh_of(const data::QuadAnswer& answer) {
  data::ControlMesh mesh;
  for (const auto& p : answer.vertices) mesh.positions.push_back({value(p[0]), value(p[1]), value(p[2])});
  mesh.faces = answer.faces;
  for (const auto& tag : answer.sharp_edges)
    mesh.sharpness.edges.push_back({tag.a, tag.b, static_cast<float>(value(tag.sharpness))});
  for (const auto& tag : answer.sharp_vertices)
    mesh.sharpness.vertices.push_back({tag.a, static_cast<float>(value(tag.sharpness))});
  mesh.sharpness.boundary =
      answer.boundary == "edge" ? data::Boundary::kEdge : data::Boundary::kEdgeAndCorner;
  mesh.sharpness.creasing =
      answer.creasing == "chaikin" ? data::Creasing::kChaikin : data::Creasing::kUniform;
  mesh.sharpness.triangles =
      answer.triangles == "smooth" ? data::TriangleRule::kSmooth : data::TriangleRule::kCatmark;
  return mesh;
}

TEST(QuadWindow, GivesTheKnownAnswers) {
  int points = 0, normals = 0;
  for (const auto& answer : data::load_quad_answers()) {
    if (answer.scheme != "catmull-clark") continue;
    const auto mesh = mesh_of(answer);
    const QuadMesh quads(mesh);
    const PreparedQuads<double> prepared(quads, rounded<double>(quads));
    double size = 0;
    for (const auto& p : mesh.positions)
      for (const double x : p) size = std::max(size, std::abs(x));
    // A sharpness such as 2.3 is no float: the surface is another one by as much as that moves it.
    double moved = 0;
    for (const auto* tags : {&answer.sharp_edges, &answer.sharp_vertices})
      for (const auto& tag : *tags)
        moved = std::max(moved, std::abs(static_cast<float>(value(tag.sharpness)) - value(tag.sharpness)));
    for (const auto& sample : answer.samples) {
      std::array<double, 2> uv{value(sample.uv[0]), value(sample.uv[1])};
      std::int32_t quad = sample.face;
      if (quads.steps == 1) {
        const auto first = static_cast<std::int32_t>(mesh.faces.first_corner(sample.face));
        if (mesh.faces[sample.face].size() == 4) {  // the quad is cut at its middle, and its parts are turned
          const int k = uv[0] <= .5 ? (uv[1] <= .5 ? 0 : 3) : uv[1] <= .5 ? 1 : 2;
          for (int turn = 0; turn < k; ++turn) uv = {uv[1], 1 - uv[0]};
          uv = {2 * uv[0], 2 * uv[1]};
          quad = first + k;
        } else {
          quad = first + sample.corner;
        }
      }
      for (int depth = 0; depth <= 6; ++depth) {
        const double k = std::ldexp(1, depth), i = uv[0] * k, j = uv[1] * k;
        if (i != std::floor(i) || j != std::floor(j)) continue;
        const auto at = points_of<double>(prepared, quad, depth)[static_cast<int>(j)][static_cast<int>(i)];
        const std::array ours{at.position.x, at.position.y, at.position.z};
        for (std::size_t c = 0; c < 3; ++c)
          ASSERT_NEAR(ours[c], value(sample.position[c]), (1e-14 + moved / 100) * size)
              << answer.id << " face " << sample.face << " (" << uv[0] << ", " << uv[1] << ") depth "
              << depth;
        ++points;
        if (!sample.normal || sample.no_tangent_plane) continue;
        const std::array normal{at.normal.x, at.normal.y, at.normal.z};
        for (std::size_t c = 0; c < 3; ++c)
          ASSERT_NEAR(normal[c], value((*sample.normal)[c]), 1e-11 + moved)
              << answer.id << " face " << sample.face << " (" << uv[0] << ", " << uv[1] << ") depth "
              << depth;
        ++normals;
      }
    }
  }
  EXPECT_GT(points, 400);
  EXPECT_GT(normals, 400);
}

TEST(QuadWindow, ComputesEveryPointOnce) {
  RecordProperty("claim", "C21");
  const auto mesh = data::quad_torus(5, 6);
  const QuadMesh quads(mesh);
  const PreparedQuads<float> prepared(quads, rounded<float>(quads));
  for (int depth = 0; depth <= 6; ++depth) {
    WindowCounts carried, printed;
    const auto a = points_of<float>(prepared, 7, depth, &carried);
    const auto b = points_of<float, false>(prepared, 7, depth, &printed);
    EXPECT_EQ(a, b);
    std::int64_t points = 0, as_printed = 0;
    for (int l = 1; l <= depth; ++l) {
      const std::int64_t side = (1 << l) + 3;
      points += side * side;
      as_printed += (std::int64_t{5} << (l - 1)) * side;
    }
    EXPECT_EQ(carried.rows, points);
    EXPECT_EQ(printed.rows, as_printed);
    const std::int64_t k = 1 << depth;
    EXPECT_EQ(carried.limit_points, (k + 1) * (k + 1));
    EXPECT_EQ(printed.limit_points, 2 * k * (k + 1));
    EXPECT_EQ(carried.strips, k);
    EXPECT_EQ(3 * points, std::max(std::int64_t{0}, (std::int64_t{4} << (2 * depth)) - 4 +
                                                        18 * ((std::int64_t{2} << depth) - 2) + 27 * depth))
        << "the closed form";
  }
}

// Sharpness that differs from part to part of a side is looked up by the row.
TEST(QuadWindow, CarriesRowsAtSemiSharpSides) {
  for (std::uint64_t seed = 1; seed < 6; ++seed) {
    data::ControlMesh mesh = data::with_random_sharpness(data::mixed_mesh(seed), seed);
    mesh.sharpness.creasing = data::Creasing::kChaikin;
    const QuadMesh quads(mesh);
    const PreparedQuads<float> prepared(quads, rounded<float>(quads));
    for (std::int32_t q = 0; q < std::min(80, quads.adjacency.face_count()); ++q)
      ASSERT_EQ((points_of<float>(prepared, q, 4)), (points_of<float, false>(prepared, q, 4)))
          << "quad " << q;
  }
}

// The same surface with corners of faces turned, so that each edge is seen as every side of either quad.
data::ControlMesh turned(const data::ControlMesh& mesh, std::uint64_t seed) {
  data::SplitMix64 random(seed);
  data::ControlMesh out = mesh;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto face = mesh.faces[f];
    const std::size_t turn = random.next() % face.size();
    for (std::size_t k = 0; k < face.size(); ++k) out.faces[f][k] = face[(k + turn) % face.size()];
  }
  return out;
}

struct Shared {
  std::map<std::array<std::int32_t, 3>, std::vector<std::uint64_t>> first;
  std::int64_t compared = 0, different = 0;

  // With normals only where the sides are not cut apart: cut vertices have names of their own.
  template <class N>
  void add(std::int32_t a, std::int32_t b, std::int32_t along, std::int32_t size, const SurfaceVertex<N>& v,
           bool with_normal) {
    if (along == 0) b = a;
    if (along == size) a = b, along = 0;
    if (a > b) std::swap(a, b), along = size - along;
    if (a == b) along = 0;
    std::vector<std::uint64_t> bits;
    for (const N x : {v.position.x, v.position.y, v.position.z, with_normal ? v.normal.x : N(0),
                      with_normal ? v.normal.y : N(0), with_normal ? v.normal.z : N(0)}) {
      std::uint64_t b64 = 0;
      std::memcpy(&b64, &x, sizeof x);
      bits.push_back(b64);
    }
    const auto [at, fresh] = first.try_emplace({a, b, along}, bits);
    if (fresh) return;
    ++compared;
    different += at->second != bits ? 1 : 0;
  }
};

// Points of all sides of all quads, from windows and from strips along the sides.
template <class N>
void compare_sides(const data::ControlMesh& mesh, int depth, std::int64_t& compared) {
  const QuadMesh quads(mesh);
  const PreparedQuads<N> prepared(quads, rounded<N>(quads));
  const int k = 1 << depth;
  QuadEdge<N> edge(depth, quads.adjacency.max_valence());
  std::vector<SurfaceVertex<N>> along(k + 1);
  Shared with_normals, positions;
  for (std::int32_t q = 0; q < quads.adjacency.face_count(); ++q) {
    const auto points = points_of<N>(prepared, q, depth);
    for (std::int32_t side = 0; side < 4; ++side) {
      const std::int32_t h = 4 * q + side, a = quads.adjacency.origin(h), b = quads.adjacency.target(h);
      edge.evaluate(prepared, h, depth, along.data());
      const auto uncut = [&](std::int32_t v) { return quads.uncut.empty() ? v : quads.uncut[v]; };
      for (int t = 0; t <= k; ++t) {
        const int i = side == 0 ? t : side == 1 ? k : side == 2 ? k - t : 0;
        const int j = side == 0 ? 0 : side == 1 ? t : side == 2 ? k : k - t;
        for (const auto& v : {points[j][i], along[t]}) {
          // A dart's cut has the same ends on both sides: its normals are compared per quad only.
          const bool slit = quads.adjacency.twin(h) < 0 && !quads.cut_twin.empty() && quads.cut_twin[h] >= 0;
          if (!slit || t == 0 || t == k) with_normals.add(a, b, t, k, v, true);
          positions.add(uncut(a), uncut(b), t, k, v, false);
        }
        ASSERT_EQ(std::memcmp(&points[j][i], &along[t], sizeof along[t]), 0)
            << "quad " << q << " side " << side << " point " << t;
      }
    }
  }
  EXPECT_EQ(with_normals.different, 0) << "of " << with_normals.compared;
  EXPECT_EQ(positions.different, 0) << "of " << positions.compared;
  compared += positions.compared;
}

TEST(QuadWindow, SharedPointsHaveTheSameBits) {
  RecordProperty("claim", "C21");
  std::int64_t compared = 0;
  std::vector<data::ControlMesh> meshes{
      data::quad_cube(),       data::quad_torus(4, 5),  data::quad_wheel(3, 1), data::quad_wheel(5, 2),
      data::quad_wheel(12, 3), data::quad_wheel(50, 4), data::quad_fan(1, 3),   data::quad_fan(2, 3),
      data::quad_fan(5, 4),    data::polygon_prism(5),  data::mixed_pawn(6),    data::creased_cube(2),
      data::creased_cube(10),  data::dart(5, false),    data::corner(2, false), data::corner(3, false),
      data::crease_ring(3),    data::crease_ring(10)};
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    data::ControlMesh mesh = data::with_random_sharpness(data::mixed_mesh(seed), seed);
    if (seed % 2 == 0) mesh.sharpness.creasing = data::Creasing::kChaikin;
    meshes.push_back(mesh);
  }
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    for (const int depth : {1, 2, 4}) {
      SCOPED_TRACE("mesh " + std::to_string(m) + " depth " + std::to_string(depth));
      if (depth == 4 && meshes[m].faces.size() > 60) continue;
      const data::ControlMesh mesh = turned(shaken(meshes[m], .2, m), m);
      compare_sides<float>(mesh, depth, compared);
      if (depth == 2) compare_sides<double>(mesh, depth, compared);
    }
  }
  EXPECT_GT(compared, 50000);
}

}  // namespace
}  // namespace limitcheck::fast
