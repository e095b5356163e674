// SPDX-License-Identifier: MIT
#include "data/generators/awkward_meshes.h"

#include <array>
#include <cmath>
#include <functional>
#include <map>

#include "data/building_blocks.h"
#include "data/generators/polygon_meshes.h"
#include "data/shapes.h"
#include "data/splitmix64.h"

namespace limitcheck::data {
namespace {

using Point = std::array<double, 3>;

ControlMesh moved(ControlMesh mesh, const std::function<Point(const Point&)>& there) {
  for (Point& p : mesh.positions) p = there(p);
  return mesh;
}

ControlMesh scaled(ControlMesh mesh, int exponent) {
  return moved(std::move(mesh), [&](const Point& p) {
    return Point{std::ldexp(p[0], exponent), std::ldexp(p[1], exponent), std::ldexp(p[2], exponent)};
  });
}

}  // namespace

ControlMesh handles(int genus) {
  require(genus >= 1 && genus <= 1000, "handles: 1 to 1000");
  using Place = std::array<int, 3>;
  const auto solid = [&](const Place& p) {
    const bool inside = p[0] >= 0 && p[0] <= 2 * genus && p[1] >= 0 && p[1] < 3 && p[2] == 0;
    return inside && !(p[1] == 1 && p[0] % 2 == 1);
  };

  ControlMesh mesh;
  std::map<Place, std::int32_t> vertices;
  const auto vertex = [&](const Place& p) {
    const auto [at, fresh] = vertices.emplace(p, static_cast<std::int32_t>(mesh.positions.size()));
    if (fresh) mesh.positions.push_back({double(p[0]), double(p[1]), double(p[2])});
    return at->second;
  };
  // The side of the unit cube at `p` that faces +-axis. Diagonals alternate, which makes valences irregular.
  const auto add_side = [&](const Place& p, std::size_t axis, bool up) {
    std::array<std::int32_t, 4> c{};
    for (std::size_t k = 0; k < 4; ++k) {
      Place q = p;
      q[axis] += up ? 1 : 0;
      q[(axis + 1) % 3] += k == 1 || k == 2 ? 1 : 0;
      q[(axis + 2) % 3] += k >= 2 ? 1 : 0;
      c[up ? k : 3 - k] = vertex(q);
    }
    if ((p[0] + p[1] + p[2]) % 2 != 0) c = {c[1], c[2], c[3], c[0]};
    mesh.faces.push_back({c[0], c[1], c[2]});
    mesh.faces.push_back({c[0], c[2], c[3]});
  };
  for (int x = 0; x <= 2 * genus; ++x)
    for (int y = 0; y < 3; ++y) {
      const Place p{x, y, 0};
      if (!solid(p)) continue;
      for (std::size_t axis = 0; axis < 3; ++axis)
        for (const bool up : {false, true}) {
          Place beyond = p;
          beyond[axis] += up ? 1 : -1;
          if (!solid(beyond)) add_side(p, axis, up);
        }
    }

  SplitMix64 random(0);
  for (Point& p : mesh.positions)
    for (double& x : p) x += static_cast<double>(random.next() % 64) / 256;
  return mesh;
}

ControlMesh three_components() {
  ControlMesh mesh = two_components();
  append(mesh, octahedron(), {0, 16, 0});
  return mesh;
}

ControlMesh touching_components() {
  ControlMesh mesh = octahedron();
  append(mesh, octahedron(), {2, 0, 0});
  return mesh;
}

ControlMesh flat() {
  return moved(wheel(5, 2), [](const Point& p) { return Point{p[0], p[1], 0}; });
}

ControlMesh needles() {
  return moved(sheet(4, 4), [](const Point& p) {
    return Point{p[0], std::ldexp(p[1], -14), std::ldexp(p[2], -14)};
  });
}

ControlMesh far_box() {
  ControlMesh mesh;
  append(mesh, cube(), {64, -128, 192});
  return mesh;
}

ControlMesh zero_edge() {
  ControlMesh mesh = icosahedron();
  mesh.positions[1] = mesh.positions[0];
  return mesh;
}

ControlMesh stellated() {
  const ControlMesh inner = octahedron();
  ControlMesh mesh{inner.positions, {}};
  for (const auto& t : triangles_of(inner)) {
    const auto tip = static_cast<std::int32_t>(mesh.positions.size());
    Point p{};
    for (const std::int32_t v : t)
      for (std::size_t k = 0; k < 3; ++k) p[k] += inner.positions[v][k] / 2;
    mesh.positions.push_back(p);
    for (std::size_t k = 0; k < 3; ++k) mesh.faces.push_back({t[k], t[(k + 1) % 3], tip});
  }
  return mesh;
}

ControlMesh tiny_box() {
  return scaled(cube(), -83);
}

ControlMesh huge_box() {
  return scaled(cube(), 66);
}

ControlMesh crowd(int count, bool quads) {
  require(count >= 1 && count <= 1'500'000, "a crowd: 1 to 1 500 000 tetrahedra or cubes");
  int side = 1;
  while (side * side * side < count) ++side;
  const ControlMesh one = quads ? quad_cube() : tetrahedron();
  ControlMesh mesh;
  for (int k = 0; k < count; ++k)
    append(mesh, one, {3. * (k % side), 3. * (k / side % side), 3. * (k / side / side)});
  return mesh;
}

}  // namespace limitcheck::data
