// SPDX-License-Identifier: MIT
#include "data/generators/bumpy_sphere.h"

#include <CGAL/Delaunay_triangulation_on_sphere_2.h>
#include <CGAL/Delaunay_triangulation_on_sphere_traits_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

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

// The triangles of the hull of some points, each by number(point) of its corners. A triangulation of the sphere by the
// directions is their hull and is found ten times as fast as that of any points; it leaves out points that lie too near
// each other.
template <class Number>
std::vector<Triangle> faces_of_hull(const std::vector<Point>& points, Number&& number) {
  using Traits = CGAL::Delaunay_triangulation_on_sphere_traits_2<Kernel>;
  using Vertex =
      CGAL::Triangulation_vertex_base_with_info_2<std::int32_t, Traits,
                                                  CGAL::Triangulation_on_sphere_vertex_base_2<Traits>>;
  using Face = CGAL::Triangulation_on_sphere_face_base_2<Traits>;
  CGAL::Delaunay_triangulation_on_sphere_2<Traits, CGAL::Triangulation_data_structure_2<Vertex, Face>> sphere(
      Traits(CGAL::ORIGIN, 1));
  sphere.insert(points.begin(), points.end());
  std::vector<Triangle> triangles;
  triangles.reserve(2 * points.size());
  if (sphere.number_of_vertices() == points.size() && sphere.number_of_ghost_faces() == 0 &&
      sphere.number_of_solid_faces() == 2 * points.size() - 4) {
    for (auto v = sphere.vertices_begin(); v != sphere.vertices_end(); ++v) v->info() = number(v->point());
    for (auto f = sphere.solid_faces_begin(); f != sphere.solid_faces_end(); ++f)
      triangles.push_back({f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info()});
    return triangles;
  }
  std::vector<Point> vertices;
  std::vector<std::array<std::size_t, 3>> faces;
  CGAL::convex_hull_3(points.begin(), points.end(), vertices, faces);
  for (const auto& [a, b, c] : faces)
    triangles.push_back({number(vertices[a]), number(vertices[b]), number(vertices[c])});
  return triangles;
}

// Each begins with its smallest corner; sorted. CGAL's points are recognised by their coordinates, which it copies.
std::vector<Triangle> hull(const std::vector<std::array<double, 3>>& directions) {
  std::vector<Point> points;
  points.reserve(directions.size());
  for (const auto& d : directions) points.emplace_back(d[0], d[1], d[2]);
  std::vector<std::pair<std::array<double, 3>, std::int32_t>> by_place;
  by_place.reserve(directions.size());
  for (const auto& d : directions) by_place.emplace_back(d, static_cast<std::int32_t>(by_place.size()));
  std::sort(by_place.begin(), by_place.end());
  std::vector<Triangle> triangles = faces_of_hull(points, [&](const Point& p) {
    return std::lower_bound(by_place.begin(), by_place.end(), std::pair(std::array{p.x(), p.y(), p.z()}, -1))
        ->second;
  });
  for (Triangle& t : triangles) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

}  // namespace

ControlMesh bumpy_sphere(int faces, std::uint64_t seed, double rmin, double rmax) {
  require(faces >= 4 && faces % 2 == 0 && faces <= 20'000'000,
          "a bumpy sphere has an even number of faces from 4 to 20 million, not " + std::to_string(faces));
  require(rmin > 0 && rmin <= rmax && std::isfinite(rmax), "the radii need 0 < rmin <= rmax");

  const int vertices = faces / 2 + 2;
  SplitMix64 random(seed);
  ControlMesh mesh;
  mesh.positions.reserve(vertices);
  for (int i = 0; i < vertices; ++i) mesh.positions.push_back(random_direction(random));
  mesh.faces = Faces(hull(mesh.positions));
  // With very few points the hull may miss the origin or a direction may occur twice; neither is a sphere.
  require(mesh.faces.size() == static_cast<std::size_t>(faces),
          "these directions have no triangulation with F = 2V - 4; try another seed");
  for (auto& position : mesh.positions) {
    const double radius = rmin + (rmax - rmin) * random.unit();
    for (double& coordinate : position) coordinate *= radius;
  }
  return mesh;
}

}  // namespace limitcheck::data
