// SPDX-License-Identifier: MIT
// CGAL's part. Surface_mesh and Polygon_mesh_processing are GPL-3: they stay in this file.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/manifoldness.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <iterator>

#include "verify/watertight/watertight.h"

namespace limitcheck::verify {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::int32_t>;
namespace pmp = CGAL::Polygon_mesh_processing;

}  // namespace

SurfaceJudgement judge_surface(std::int64_t point_count,
                               std::span<const std::array<std::int32_t, 3>> triangles) {
  // Only topology is judged, so every point may sit at the origin.
  Mesh mesh;
  mesh.reserve(static_cast<Mesh::size_type>(point_count),
               static_cast<Mesh::size_type>(triangles.size() * 3 / 2 + 3),
               static_cast<Mesh::size_type>(triangles.size()));
  for (std::int64_t p = 0; p < point_count; ++p) mesh.add_vertex(Point(0, 0, 0));

  SurfaceJudgement judgement;
  for (const auto& [a, b, c] : triangles) {
    const auto vertex = [](std::int32_t p) { return Mesh::Vertex_index(static_cast<Mesh::size_type>(p)); };
    const bool degenerate = a < 0 || b < 0 || c < 0 || a == b || b == c || c == a;
    if (degenerate || mesh.add_face(vertex(a), vertex(b), vertex(c)) == Mesh::null_face())
      ++judgement.refused_triangles;
  }
  for (const auto v : mesh.vertices())
    if (mesh.is_isolated(v)) mesh.remove_vertex(v);
  if (mesh.has_garbage()) mesh.collect_garbage();

  judgement.valid = CGAL::is_valid_polygon_mesh(mesh);
  judgement.closed = CGAL::is_closed(mesh);
  std::vector<Mesh::Halfedge_index> found;
  pmp::non_manifold_vertices(mesh, std::back_inserter(found));
  judgement.bow_tie_points = static_cast<std::int64_t>(found.size());
  found.clear();
  pmp::extract_boundary_cycles(mesh, std::back_inserter(found));
  judgement.boundary_cycles = static_cast<std::int64_t>(found.size());
  return judgement;
}

std::vector<TVertex> find_t_vertices(std::span<const double> positions,
                                     std::span<const std::int32_t> vertex_of,
                                     std::span<const SurfaceReport::Edge> open_edges) {
  const auto place = [&](std::int32_t point) {
    const std::size_t v = 3 * static_cast<std::size_t>(vertex_of[point]);
    return Point(positions[v], positions[v + 1], positions[v + 2]);
  };
  std::vector<std::int32_t> points;
  for (const auto& e : open_edges) points.insert(points.end(), {e.from, e.to});
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());

  std::vector<Box> edge_boxes, point_boxes;
  edge_boxes.reserve(open_edges.size());
  for (std::size_t e = 0; e < open_edges.size(); ++e)
    edge_boxes.emplace_back(place(open_edges[e].from).bbox() + place(open_edges[e].to).bbox(),
                            static_cast<std::int32_t>(e));
  point_boxes.reserve(points.size());
  for (const std::int32_t p : points) point_boxes.emplace_back(place(p).bbox(), p);

  std::vector<TVertex> found;
  CGAL::box_intersection_d(
      edge_boxes.begin(), edge_boxes.end(), point_boxes.begin(), point_boxes.end(),
      [&](const Box& e, const Box& p) {
        const auto& edge = open_edges[e.info()];
        const std::int32_t point = p.info();
        if (point == edge.from || point == edge.to) return;
        const Point a = place(edge.from), b = place(edge.to), c = place(point);
        if (CGAL::collinear(a, c, b) && CGAL::collinear_are_strictly_ordered_along_line(a, c, b))
          found.push_back({point, e.info()});
      });
  std::sort(found.begin(), found.end(), [](const TVertex& a, const TVertex& b) {
    return a.edge != b.edge ? a.edge < b.edge : a.point < b.point;
  });
  return found;
}

}  // namespace limitcheck::verify
