// SPDX-License-Identifier: MIT
// CGAL's part. Surface_mesh and Polygon_mesh_processing are GPL-3: they stay in this file.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/manifoldness.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <unordered_map>

#include "verify/watertight/watertight.h"

namespace limitcheck::verify {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::int32_t>;
namespace pmp = CGAL::Polygon_mesh_processing;
using Triangles = std::span<const std::array<std::int32_t, 3>>;

// add_face() looks for its edges among all that end at a vertex: beyond so many it takes too long.
constexpr std::int64_t kManyAtAPoint = 1000;

Mesh::Vertex_index vertex(std::int32_t p) {
  return Mesh::Vertex_index(static_cast<Mesh::size_type>(p));
}

std::int64_t most_at_a_point(std::int64_t point_count, Triangles triangles) {
  std::vector<std::int64_t> count(static_cast<std::size_t>(point_count), 0);
  std::int64_t most = 0;
  for (const auto& triangle : triangles)
    for (const std::int32_t p : triangle)
      if (p >= 0) most = std::max(most, ++count[static_cast<std::size_t>(p)]);
  return most;
}

// The mesh from a table of its sides, in place of add_face(). Returns how many triangles it refuses: those of
// which a side is taken. Of two fans at a point it refuses none; each is linked in itself, and the point is
// found by non_manifold_vertices().
std::int64_t link_faces(Mesh& mesh, Triangles triangles) {
  const auto key = [](std::int32_t from, std::int32_t to) {
    return static_cast<std::uint64_t>(from) << 32U | static_cast<std::uint32_t>(to);
  };
  std::unordered_map<std::uint64_t, Mesh::Halfedge_index> sides;
  sides.reserve(6 * triangles.size());
  const auto is_taken = [&](std::int32_t from, std::int32_t to) {
    const auto found = sides.find(key(from, to));
    return found != sides.end() && !mesh.is_border(found->second);
  };
  const auto side = [&](std::int32_t from, std::int32_t to) {
    const auto [found, is_new] = sides.try_emplace(key(from, to));
    if (is_new) {
      const Mesh::Halfedge_index h = mesh.add_edge(vertex(from), vertex(to));
      found->second = h;
      sides.emplace(key(to, from), mesh.opposite(h));
      return h;
    }
    return found->second;
  };
  std::int64_t refused = 0;
  for (const auto& t : triangles) {
    if (is_degenerate(t) || is_taken(t[0], t[1]) || is_taken(t[1], t[2]) || is_taken(t[2], t[0])) {
      ++refused;
      continue;
    }
    const std::array<Mesh::Halfedge_index, 3> h{side(t[0], t[1]), side(t[1], t[2]), side(t[2], t[0])};
    const Mesh::Face_index face = mesh.add_face();
    mesh.set_halfedge(face, h[0]);
    for (std::size_t k = 0; k < 3; ++k) {
      mesh.set_face(h[k], face);
      mesh.set_next(h[k], h[(k + 1) % 3]);
      mesh.set_halfedge(mesh.target(h[k]), h[k]);
    }
  }
  for (const Mesh::Halfedge_index h : mesh.halfedges()) {
    if (!mesh.is_border(h)) continue;
    Mesh::Halfedge_index out = mesh.opposite(h);  // round the fan to its other end
    while (!mesh.is_border(out)) out = mesh.opposite(mesh.prev(out));
    mesh.set_next(h, out);
    mesh.set_halfedge(mesh.target(h), h);
  }
  return refused;
}

}  // namespace

SurfaceJudgement judge_surface(std::int64_t point_count, Triangles triangles) {
  // Only topology is judged, so every point may sit at the origin.
  Mesh mesh;
  mesh.reserve(static_cast<Mesh::size_type>(point_count),
               static_cast<Mesh::size_type>(triangles.size() * 3 / 2 + 3),
               static_cast<Mesh::size_type>(triangles.size()));
  for (std::int64_t p = 0; p < point_count; ++p) mesh.add_vertex(Point(0, 0, 0));

  SurfaceJudgement judgement;
  if (most_at_a_point(point_count, triangles) > kManyAtAPoint) {
    judgement.refused_triangles = link_faces(mesh, triangles);
  } else {
    for (const auto& t : triangles)
      if (is_degenerate(t) || mesh.add_face(vertex(t[0]), vertex(t[1]), vertex(t[2])) == Mesh::null_face())
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
