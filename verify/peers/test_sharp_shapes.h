// SPDX-License-Identifier: MIT
// Control meshes with every arrangement of sharp edges and vertices that there is a word for.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "data/generators/polygon_meshes.h"
#include "data/generators/sharp_meshes.h"
#include "data/shapes.h"
#include "data/splitmix64.h"
#include "reference/mesh/topology.h"

namespace limitcheck::verify::test {

using Named = std::pair<std::string, data::ControlMesh>;

inline constexpr float kInfinite = data::kInfiniteSharpness;

/// Sharpness whose means are floats: an integer and a multiple of 3/16, so that two, three or four of them
/// that vanish in the same step have one.
inline float some_sharpness(data::SplitMix64& random, int most) {
  if (random.next() % 3 == 0) return kInfinite;
  return static_cast<float>(random.next() % static_cast<std::uint64_t>(most)) +
         static_cast<float>(random.next() % 5 + 1) * 0.1875F;
}

/// The ends of each edge.
inline std::vector<std::pair<std::int32_t, std::int32_t>> edges_of(const data::ControlMesh& mesh) {
  std::vector<std::pair<std::int32_t, std::int32_t>> edges;
  const reference::Topology topology(mesh.positions.size(), mesh.faces);
  for (const reference::Edge& e : topology.edges()) edges.emplace_back(e.a, e.b);
  return edges;
}

/// The cube with a subset of its twelve edges sharp; each infinite, or of some sharpness below 3.
inline data::ControlMesh cube_with(unsigned subset, bool semi_sharp) {
  data::ControlMesh mesh = data::quad_cube();
  data::SplitMix64 random(subset);
  const auto edges = edges_of(mesh);
  for (std::size_t k = 0; k < edges.size(); ++k)
    if ((subset >> k & 1U) != 0)
      mesh.sharpness.edges.push_back(
          {edges[k].first, edges[k].second, semi_sharp ? some_sharpness(random, 3) : kInfinite});
  return mesh;
}

/// A sheet of nx x ny quads, bumpy.
inline data::ControlMesh quad_sheet(int nx, int ny) {
  data::ControlMesh mesh;
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i)
      mesh.positions.push_back(
          {static_cast<double>(i), static_cast<double>(j), (i * 7 + j * 5 + i * j * 3) % 11 / 8.0});
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const int a = j * (nx + 1) + i;
      mesh.faces.push_back({a, a + 1, a + nx + 2, a + nx + 1});
    }
  return mesh;
}

/// What lines of edges do in the middle of a sheet of 6 x 6 quads, each line of a sharpness of its own.
inline std::vector<Named> lines(float s, float t) {
  const auto line = [](data::ControlMesh& mesh, int i, int j, int di, int dj, int edges, float sharpness) {
    for (int k = 0; k < edges; ++k)
      mesh.sharpness.edges.push_back(
          {(j + k * dj) * 7 + i + k * di, (j + (k + 1) * dj) * 7 + i + (k + 1) * di, sharpness});
  };
  const auto with = [&](const std::string& name, auto&&... each) {
    data::ControlMesh mesh = quad_sheet(6, 6);
    (each(mesh), ...);
    return Named{name, mesh};
  };
  const auto across = [&](data::ControlMesh& m) { line(m, 0, 3, 1, 0, 6, s); };
  const auto up = [&](data::ControlMesh& m) { line(m, 3, 0, 0, 1, 6, t); };
  const auto to_the_middle = [&](data::ControlMesh& m) { line(m, 0, 3, 1, 0, 3, s); };
  const auto from_the_middle = [&](data::ControlMesh& m) { line(m, 3, 3, 1, 0, 3, t); };
  const auto up_from_the_middle = [&](data::ControlMesh& m) { line(m, 3, 3, 0, 1, 3, t); };
  const auto inside = [&](data::ControlMesh& m) { line(m, 1, 3, 1, 0, 4, s); };
  const auto edge = [&](data::ControlMesh& m) { line(m, 2, 3, 1, 0, 1, s); };
  const auto ring = [&](data::ControlMesh& m) {
    line(m, 2, 2, 1, 0, 2, s), line(m, 4, 2, 0, 1, 2, t), line(m, 4, 4, -1, 0, 2, s),
        line(m, 2, 4, 0, -1, 2, t);
  };
  return {with("from boundary to boundary", across),
          with("a crossing", across, up),
          with("into the middle", to_the_middle),
          with("sharpness that changes on the way", to_the_middle, from_the_middle),
          with("a turn", to_the_middle, up_from_the_middle),
          with("a T", across, up_from_the_middle),
          with("two ends inside", inside),
          with("one edge", edge),
          with("a ring with corners", ring),
          with("a ring and a crossing", ring, across, up)};
}

/// Meshes of triangles, or of quads and other polygons, with sharpness below 3.
inline std::vector<Named> sharp_shapes(bool triangles) {
  std::vector<Named> all;
  const auto add = [&](const std::string& name, data::ControlMesh mesh) {
    mesh.sharpness.boundary = data::Boundary::kEdge;
    all.emplace_back(name, mesh);
    mesh.sharpness.boundary = data::Boundary::kEdgeAndCorner;
    all.emplace_back(name + ", corners held", std::move(mesh));
  };
  const auto held = [&](const std::string& name, data::ControlMesh mesh, float s) {
    mesh.sharpness.vertices.push_back({0, s});
    add(name + ", " + std::to_string(s), std::move(mesh));
  };
  const auto creased = [&](const std::string& name, data::ControlMesh mesh, float s, const auto& is_sharp) {
    for (int k = 0; const auto& [a, b] : edges_of(mesh))
      if (is_sharp(k++, a, b)) mesh.sharpness.edges.push_back({a, b, s});
    add(name + ", " + std::to_string(s), std::move(mesh));
  };
  for (const int n : {3, 4, 5, 6, 7, 8, 12}) add("dart " + std::to_string(n), data::dart(n, triangles));
  for (int k = 2; k <= 6; ++k) add("corner of creases " + std::to_string(k), data::corner(k, triangles));
  for (const float s : {kInfinite, 0.375F, 1.0F, 2.8125F}) {
    for (int k = 1; k <= (triangles ? 8 : 6); ++k)  // sectors of a corner
      held("corner " + std::to_string(k), triangles ? data::fan(k) : data::quad_fan(k, 11), s);
    for (const int n : {3, 4, 5, 6, 8, 12})
      held("spike " + std::to_string(n), triangles ? data::wheel(n) : data::quad_wheel(n, 7), s);
    for (int edges = 1; triangles && edges <= 12; ++edges)
      creased("octahedron " + std::to_string(edges), data::octahedron(), s,
              [&](int k, int, int) { return k < edges; });
    if (!triangles)
      creased("rim of a prism", data::polygon_prism(5), s, [](int, int a, int b) { return a < 5 && b < 5; });
  }
  if (triangles) return all;
  for (const auto& [s, t] : {std::pair{kInfinite, kInfinite},
                             {kInfinite, 1.375F},
                             {0.5625F, 2.1875F},
                             {2.75F, kInfinite},
                             {0.75F, 0.75F},
                             {1, 1},
                             {2, 1},
                             {3, kInfinite}})
    for (const auto& [name, mesh] : lines(s, t))
      add(name + ", " + std::to_string(s) + " " + std::to_string(t), mesh);
  for (const std::uint64_t s : {1, 2, 3, 10}) add("ring " + std::to_string(s), data::crease_ring(s));
  return all;
}
inline std::vector<Named> sharp_polygons() {
  return sharp_shapes(false);
}
inline std::vector<Named> sharp_triangles() {
  return sharp_shapes(true);
}

}  // namespace limitcheck::verify::test
