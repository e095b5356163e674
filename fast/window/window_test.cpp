// SPDX-License-Identifier: MIT
// The sliding window of quads; that of triangles is compared with the reference by frames and in verify/proof.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "data/generators/polygon_meshes.h"
#include "data/generators/sharp_meshes.h"
#include "data/generators/surgery.h"
#include "data/numeral.h"
#include "data/splitmix64.h"
#include "data/test_support/known_answers.h"
#include "fast/rules/prepared_mesh.h"
#include "fast/test_support/shared_points.h"
#include "fast/test_support/test_meshes.h"
#include "fast/window/quad_rows.h"
#include "fast/window/quad_window.h"

namespace limitcheck::fast {
namespace {

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
    const PreparedQuads<double> prepared(quads, positions_of<double>(quads));
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
  const PreparedQuads<float> prepared(quads, positions_of<float>(quads));
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
    const PreparedQuads<float> prepared(quads, positions_of<float>(quads));
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

// Points of all sides of all quads, from windows and from strips along the sides. Cut vertices have names of their own.
void compare_sides(const data::ControlMesh& mesh, int depth, row_stream::SharedPoints& shared) {
  const QuadMesh quads(mesh);
  const QuadAdjacency& adjacency = quads.adjacency;
  const PreparedQuads<float> prepared(quads, positions_of<float>(quads));
  const int k = 1 << depth;
  QuadEdge<float> edge(depth, adjacency.max_valence());
  std::vector<SurfaceVertex<float>> along(k + 1);
  data::ControlMesh cut{quads.positions, {}};
  for (std::int32_t q = 0; q < adjacency.face_count(); ++q)
    cut.faces.push_back(
        {adjacency.corner(q, 0), adjacency.corner(q, 1), adjacency.corner(q, 2), adjacency.corner(q, 3)});
  std::vector<std::vector<SurfaceVertex<float>>> points;
  for (std::int32_t h = 0; h < 4 * adjacency.face_count(); ++h) {
    if (h % 4 == 0) points = points_of<float>(prepared, h / 4, depth);
    edge.evaluate(prepared, h, depth, along.data());
    // A dart's cut has the same ends on both sides: its normals are compared per quad only.
    const bool slit = adjacency.twin(h) < 0 && !quads.cut_twin.empty() && quads.cut_twin[h] >= 0;
    for (int t = 0; t <= k; ++t) {
      const int i[] = {t, k, k - t, 0}, j[] = {0, t, k, k - t};
      const SurfaceVertex<float>& v = points[j[h % 4]][i[h % 4]];
      ASSERT_EQ(std::memcmp(&v, &along[t], sizeof v), 0) << "half-edge " << h << " point " << t;
      if (!slit || t == 0 || t == k) shared.add(cut, h / 4, i[h % 4], j[h % 4], k, v, {});
    }
  }
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
      row_stream::SharedPoints shared;
      compare_sides(turned(shaken(meshes[m], .2, m), m), depth, shared);
      EXPECT_EQ(shared.different(), 0) << "of " << shared.compared();
      compared += shared.compared();
    }
  }
  EXPECT_GT(compared, 50000);
}

}  // namespace
}  // namespace limitcheck::fast
