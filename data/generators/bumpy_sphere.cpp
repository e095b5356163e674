// SPDX-License-Identifier: MIT
#include "data/generators/bumpy_sphere.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "data/building_blocks.h"
#include "data/splitmix64.h"

namespace limitcheck::data {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Triangle = std::array<std::int32_t, 3>;

std::array<double, 3> random_direction(SplitMix64& random) {
  for (;;) {
    const double x = 2 * random.unit() - 1, y = 2 * random.unit() - 1, z = 2 * random.unit() - 1;
    const double squared = x * x + y * y + z * z;
    if (squared > 1 || squared < 0x1p-20) continue;
    const double length = std::sqrt(squared);
    return {x / length, y / length, z / length};
  }
}

// The hull's triangles in terms of the given points. CGAL returns the hull's vertices in an order of its own;
// they are recognised by their coordinates, which it copies.
std::vector<Triangle> hull(const std::vector<std::array<double, 3>>& directions) {
  std::vector<Point> points;
  points.reserve(directions.size());
  for (const auto& d : directions) points.emplace_back(d[0], d[1], d[2]);
  std::vector<Point> vertices;
  std::vector<std::array<std::size_t, 3>> faces;
  CGAL::convex_hull_3(points.begin(), points.end(), vertices, faces);

  std::vector<std::int32_t> by_place(directions.size());
  for (std::size_t i = 0; i < by_place.size(); ++i) by_place[i] = static_cast<std::int32_t>(i);
  std::sort(by_place.begin(), by_place.end(), [&](auto a, auto b) { return directions[a] < directions[b]; });
  std::vector<std::int32_t> original(vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const std::array<double, 3> place = {vertices[i].x(), vertices[i].y(), vertices[i].z()};
    original[i] = *std::lower_bound(by_place.begin(), by_place.end(), place,
                                    [&](auto a, const auto& b) { return directions[a] < b; });
  }

  std::vector<Triangle> triangles;
  triangles.reserve(faces.size());
  for (const auto& face : faces) {
    Triangle t = {original[face[0]], original[face[1]], original[face[2]]};
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    triangles.push_back(t);
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

}  // namespace

ControlMesh bumpy_sphere_of_vertices(int vertices, std::uint64_t seed, double rmin, double rmax) {
  require(vertices >= 4 && vertices <= 10'000'002,
          "a bumpy sphere has 4 to 10000002 vertices, not " + std::to_string(vertices));
  require(rmin > 0 && rmin <= rmax && std::isfinite(rmax), "the radii need 0 < rmin <= rmax");

  SplitMix64 random(seed);
  ControlMesh mesh;
  mesh.positions.reserve(vertices);
  for (int i = 0; i < vertices; ++i) mesh.positions.push_back(random_direction(random));
  mesh.faces = Faces(hull(mesh.positions));
  // With very few points the hull may miss the origin or a direction may occur twice; neither is a sphere.
  require(mesh.faces.size() == 2 * static_cast<std::size_t>(vertices) - 4,
          "these directions have no triangulation with F = 2V - 4; try another seed");
  for (auto& position : mesh.positions) {
    const double radius = rmin + (rmax - rmin) * random.unit();
    for (double& coordinate : position) coordinate *= radius;
  }
  return mesh;
}

ControlMesh bumpy_sphere(int faces, std::uint64_t seed, double rmin, double rmax) {
  require(faces >= 4 && faces % 2 == 0 && faces <= 20'000'000,
          "a bumpy sphere has an even number of faces from 4 to 20 million, not " + std::to_string(faces));
  return bumpy_sphere_of_vertices(faces / 2 + 2, seed, rmin, rmax);
}

}  // namespace limitcheck::data
