// SPDX-License-Identifier: MIT
#include "data/shapes.h"

#include <cmath>
#include <numbers>

#include "data/building_blocks.h"
#include "data/splitmix64.h"

namespace limitcheck::data {
namespace {

std::array<double, 2> on_circle(double turns) {
  const double angle = 2 * std::numbers::pi * turns;
  return {rounded(std::cos(angle)), rounded(std::sin(angle))};
}

// Fixed heights in [0, 1/4), one for each vertex of a flat shape.
void add_bumps(ControlMesh& mesh) {
  SplitMix64 random(0);
  for (auto& position : mesh.positions) position[2] = rounded(random.unit() / 4);
}

// Sectors of the regular triangular lattice round vertex 0, between the directions given. Ring r of an open
// fan has sectors * r + 1 vertices, of a closed one sectors * r.
ControlMesh sectors_of_lattice(const std::vector<std::array<double, 2>>& directions, bool closed, int rings) {
  const int sectors = static_cast<int>(directions.size()) - (closed ? 0 : 1);
  const auto first_of_ring = [&](int r) {
    return r == 0 ? 0 : 1 + sectors * r * (r - 1) / 2 + (closed ? 0 : r - 1);
  };
  const auto vertex = [&](int sector, int r, int step) {
    const int place = sector * r + step;
    return first_of_ring(r) + (closed && r > 0 ? place % (sectors * r) : place);
  };
  ControlMesh mesh;
  mesh.positions.resize(first_of_ring(rings + 1));
  for (int s = 0; s < sectors; ++s) {
    const auto from = directions[s];
    const auto to = directions[(s + 1) % directions.size()];
    for (int r = 1; r <= rings; ++r) {
      for (int i = 0; i <= r; ++i) {
        mesh.positions[vertex(s, r, i)] = {rounded((r - i) * from[0] + i * to[0]),
                                           rounded((r - i) * from[1] + i * to[1]), 0};
      }
    }
    for (int r = 0; r < rings; ++r) {
      for (int i = 0; i <= r; ++i) {
        mesh.faces.push_back({vertex(s, r, i), vertex(s, r + 1, i), vertex(s, r + 1, i + 1)});
        if (i < r) mesh.faces.push_back({vertex(s, r, i), vertex(s, r + 1, i + 1), vertex(s, r, i + 1)});
      }
    }
  }
  return mesh;
}

// A sheet without the squares for which `absent` holds; vertices that no face uses are dropped.
template <class Absent>
ControlMesh sheet_without(int nx, int ny, Absent absent) {
  ControlMesh mesh;
  std::vector<std::int32_t> index(static_cast<std::size_t>(nx + 1) * (ny + 1), -1);
  const auto vertex = [&](int i, int j) {
    std::int32_t& v = index[static_cast<std::size_t>(j) * (nx + 1) + i];
    if (v < 0) {
      v = static_cast<std::int32_t>(mesh.positions.size());
      mesh.positions.push_back({double(i), double(j), 0});
    }
    return v;
  };
  for (int j = 0; j < ny; ++j) {
    for (int i = 0; i < nx; ++i) {
      if (absent(i, j)) continue;
      const std::int32_t a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1),
                         d = vertex(i, j + 1);
      mesh.faces.push_back({a, b, c});
      mesh.faces.push_back({a, c, d});
    }
  }
  add_bumps(mesh);
  return mesh;
}

}  // namespace

ControlMesh tetrahedron() {
  return {{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}, {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}};
}

ControlMesh octahedron() {
  return {{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
          {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
}

ControlMesh icosahedron() {
  const double g = rounded((1 + std::sqrt(5.0)) / 2);
  ControlMesh mesh;
  for (std::size_t turn = 0; turn < 3; ++turn)
    for (const double y : {g, -g})
      for (const double x : {-1., 1.}) {
        auto& p = mesh.positions.emplace_back();
        p[turn] = x, p[(turn + 1) % 3] = y;
      }
  mesh.faces = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  return mesh;
}

ControlMesh torus(int around, int along) {
  require(around >= 3 && along >= 3, "a torus needs at least 3 steps each way");
  require(2 * std::int64_t{around} * along <= kMostFaces, "too many faces");
  ControlMesh mesh;
  for (int i = 0; i < around; ++i) {
    const auto large = on_circle(double(i) / around);
    for (int j = 0; j < along; ++j) {
      const auto small = on_circle(double(j) / along);
      const double radius = 1 + 0.4 * small[0];
      mesh.positions.push_back(
          {rounded(radius * large[0]), rounded(radius * large[1]), rounded(0.4 * small[1])});
      const std::int32_t next_i = (i + 1) % around, next_j = (j + 1) % along;
      const std::int32_t a = i * along + j, b = next_i * along + j, c = next_i * along + next_j,
                         d = i * along + next_j;
      mesh.faces.push_back({a, b, c});
      mesh.faces.push_back({a, c, d});
    }
  }
  return mesh;
}

ControlMesh bipyramid(int n) {
  require(n >= 3, "a bipyramid needs at least 3 sides");
  require(2 * std::int64_t{n} <= kMostFaces, "too many faces");
  ControlMesh mesh;
  mesh.positions = {{0, 0, 1}, {0, 0, -1}};
  for (int i = 0; i < n; ++i) {
    const auto p = on_circle(double(i) / n);
    mesh.positions.push_back({p[0], p[1], 0});
    mesh.faces.push_back({0, 2 + i, 2 + (i + 1) % n});
    mesh.faces.push_back({1, 2 + (i + 1) % n, 2 + i});
  }
  return mesh;
}

ControlMesh cube() {
  ControlMesh mesh;
  for (int v = 0; v < 8; ++v) {
    mesh.positions.push_back({v & 1 ? 1.0 : -1.0, v & 2 ? 1.0 : -1.0, v & 4 ? 1.0 : -1.0});
  }
  mesh.faces = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

ControlMesh wheel(int n, int rings) {
  require(n >= 3, "a wheel needs a valence of at least 3");
  require(rings >= 1 && rings <= 1000 && n * (std::int64_t{rings} * rings) <= kMostFaces,
          "a wheel needs at least 1 ring, and at most 10 million faces");
  std::vector<std::array<double, 2>> directions;
  for (int i = 0; i < n; ++i) directions.push_back(on_circle(double(i) / n));
  ControlMesh mesh = sectors_of_lattice(directions, true, rings);
  add_bumps(mesh);
  return mesh;
}

ControlMesh fan(int k, int rings) {
  require(k >= 1, "a fan needs at least 1 face");
  require(rings >= 1 && rings <= 1000 && k * (std::int64_t{rings} * rings) <= kMostFaces,
          "a fan needs at least 1 ring, and at most 10 million faces");
  // A sector of half a turn would be flat: fans of one or two faces open by sixths of a turn.
  const double opening = k < 3 ? k / 6.0 : 0.5;
  std::vector<std::array<double, 2>> directions;
  for (int i = 0; i <= k; ++i) directions.push_back(on_circle(opening * i / k));
  ControlMesh mesh = sectors_of_lattice(directions, false, rings);
  add_bumps(mesh);
  return mesh;
}

ControlMesh sheet(int nx, int ny) {
  require(nx >= 1 && ny >= 1, "a sheet needs at least 1 square each way");
  require(2 * std::int64_t{nx} * ny <= kMostFaces, "too many faces");
  return sheet_without(nx, ny, [](int, int) { return false; });
}

ControlMesh holes() {
  return sheet_without(8, 8, [](int i, int j) {
    return (i == 1 || i == 2) ? (j == 1 || j == 2) : (i == 5 || i == 6) && (j == 4 || j == 5);
  });
}

ControlMesh strip(int n) {
  require(n >= 1 && n <= kMostFaces, "a strip needs 1 to 10 million triangles");
  ControlMesh mesh;
  for (int i = 0; i < n + 2; ++i) mesh.positions.push_back({i / 2.0, i % 2 == 0 ? 0.0 : 1.0, 0});
  for (int i = 0; i < n; ++i) {
    const int odd = i % 2;
    mesh.faces.push_back({i, i + 2 - odd, i + 1 + odd});
  }
  add_bumps(mesh);
  return mesh;
}

ControlMesh ragged_disc() {
  ControlMesh mesh = wheel(7, 3);
  const int inner_count = 21;
  const std::int32_t inner = static_cast<std::int32_t>(mesh.positions.size()) - inner_count;
  const std::int32_t outer = inner + inner_count;
  // Outer vertex k is the apex over so many edges of the wheel's rim, and gets two faces more from its own
  // two edges.
  constexpr std::array<int, 9> apex_of = {0, 0, 6, 1, 5, 0, 2, 4, 3};
  const int outer_count = static_cast<int>(apex_of.size());
  int p = 0;
  for (int k = 0; k < outer_count; ++k) {
    const auto at = on_circle((p + apex_of[k] / 2.0 + k * inner_count / 9.0) / (2 * inner_count));
    mesh.positions.push_back({rounded(4.5 * at[0]), rounded(4.5 * at[1]), 0});
    for (int i = 0; i < apex_of[k]; ++i, ++p) {
      mesh.faces.push_back({outer + k, inner + (p + 1) % inner_count, inner + p % inner_count});
    }
    mesh.faces.push_back({inner + p % inner_count, outer + k, outer + (k + 1) % outer_count});
  }
  // The ear: a vertex with one face, on the edge of outer vertices 0 and 1.
  const auto ear = static_cast<std::int32_t>(mesh.positions.size());
  mesh.positions.push_back({6, 1, 0});
  mesh.faces.push_back({outer + 1, outer, ear});
  add_bumps(mesh);
  return mesh;
}

ControlMesh triangle() {
  return fan(1, 1);
}

ControlMesh triangle_pair() {
  return fan(2, 1);
}

ControlMesh two_components() {
  ControlMesh mesh = tetrahedron();
  append(mesh, wheel(5, 2), {8, 0, 0});
  return mesh;
}

}  // namespace limitcheck::data
