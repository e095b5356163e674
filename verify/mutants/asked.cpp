// SPDX-License-Identifier: MIT
#include "verify/mutants/faulty_subjects.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "data/bounding_box.h"

namespace limitcheck::verify {

void nowhere(const char* what) {
  throw SubjectError(LC_NOT_SUPPORTED, fmt::format("there is no {} to plant this fault in", what));
}

Delivered::Delivered(const Tessellation& good) : single(good.precision() == LC_FLOAT32) {
  provenance.assign(good.provenance().begin(), good.provenance().end());
  corner.assign(good.corners().begin(), good.corners().end());
  triangles.assign(good.triangles().begin(), good.triangles().end());
  triangle_face.assign(good.triangle_face().begin(), good.triangle_face().end());
  for (std::size_t c = 0; c < good.channel_count(); ++c)
    for (std::int64_t t = 0; t < good.triangle_count(); ++t)
      for (int k = 0; k < 3; ++k) {
        const int components = good.components(c);
        for (int i = 0; i < components; ++i) channel_values.push_back(good.channel_value(c, t, k, i));
        for (int i = 0; good.has_channel_derivatives() && i < 2 * components; ++i)
          channel_derivatives.push_back(good.channel_derivative(c, t, k, i % components, i / components));
      }
  for (std::int64_t v = 0; v < good.vertex_count(); ++v) {
    positions.push_back(good.position(v));
    if (good.has_normals()) normals.push_back(good.normal(v));
  }
}

std::uint32_t Delivered::add_vertex(const Delivered& from, std::size_t v) {
  positions.push_back(Vector(from.positions[v]));
  if (!from.normals.empty()) normals.push_back(Vector(from.normals[v]));
  provenance.push_back(lc_provenance(from.provenance[v]));
  if (!from.corner.empty()) corner.push_back(std::int32_t{from.corner[v]});
  return static_cast<std::uint32_t>(positions.size() - 1);
}

void Delivered::erase_triangle(std::size_t t) {
  triangles.erase(triangles.begin() + static_cast<std::ptrdiff_t>(t));
  triangle_face.erase(triangle_face.begin() + static_cast<std::ptrdiff_t>(t));
}

double Delivered::one_ulp_up(double x) const {
  if (!single) return std::nextafter(x, std::numeric_limits<double>::infinity());
  return static_cast<double>(std::nextafter(static_cast<float>(x), std::numeric_limits<float>::infinity()));
}

Asked::Asked(const data::ControlMesh& of, data::Scheme by, int deepest_face)
    : mesh(of),
      scheme(by),
      deepest(deepest_face),
      topology(of.positions.size(), of.faces),
      diagonal(data::box_diagonal(of)),
      infinite(of.positions.size()),
      semi_sharp(infinite.size()),
      held(infinite.size()),
      component(infinite.size()) {
  for (const auto& p : mesh.positions)
    for (const double x : p) largest = std::max(largest, std::abs(x));
  std::map<std::pair<std::int32_t, std::int32_t>, bool> boundary;
  for (const reference::Edge& e : topology.edges())
    if (e.on_boundary()) {
      boundary[std::minmax(e.a, e.b)] = true;
      ++infinite[e.a], ++infinite[e.b];
    }
  for (const data::SharpEdge& e : mesh.sharpness.edges)
    if (e.sharpness > 0 && !boundary.contains(std::minmax(e.a, e.b))) {
      std::vector<int>& count = e.sharpness >= data::kInfiniteSharpness ? infinite : semi_sharp;
      ++count[e.a], ++count[e.b];
    }
  for (const data::SharpVertex& v : mesh.sharpness.vertices) held[v.vertex] = v.sharpness;

  // The least number of a vertex that is joined to it, then numbered.
  std::vector<std::int32_t> root(infinite.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](std::int32_t v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (const reference::Edge& e : topology.edges()) root[find(e.a)] = find(e.b);
  std::map<std::int32_t, int> number;
  for (const std::int32_t v : mesh.faces.corners()) number.emplace(find(v), static_cast<int>(number.size()));
  for (const std::int32_t v : mesh.faces.corners()) component[v] = number.at(find(v));
}

int Asked::faces_of_side(std::int32_t v) const {
  if (!inside(v) || infinite[v] != 2) return 0;
  std::vector<int> at;
  const reference::Sector sector = topology.sector(v);
  for (std::size_t k = 0; k < sector.neighbours.size(); ++k)
    for (const data::SharpEdge& e : mesh.sharpness.edges)
      if (e.sharpness >= data::kInfiniteSharpness &&
          std::minmax(e.a, e.b) == std::minmax(v, sector.neighbours[k]))
        at.push_back(static_cast<int>(k));
  return at.size() == 2 ? at[1] - at[0] : 0;
}

std::int64_t Asked::characteristic() const {
  return static_cast<std::int64_t>(mesh.positions.size()) -
         static_cast<std::int64_t>(topology.edges().size()) + static_cast<std::int64_t>(mesh.faces.size());
}

bool Asked::has_polygons() const {
  std::size_t f = 0;
  while (f < mesh.faces.size() && !is_polygon(f)) ++f;
  return f < mesh.faces.size();
}

int Asked::most_faces() const {
  int most = 0;
  for (const std::int32_t v : mesh.faces.corners()) most = std::max(most, faces(v));
  return most;
}

std::int32_t Asked::beyond(std::size_t face, std::size_t side) const {
  const reference::Edge& e = topology.edges()[topology.edge(face, side)];
  return e.left_face == static_cast<std::int32_t>(face) ? e.right_face : e.left_face;
}

int Asked::depth_beyond(std::size_t face, std::size_t side) const {
  const std::int32_t other = beyond(face, side);
  return other < 0 ? -1 : depth[other];
}

std::optional<FaceDomain::SidePoint> Asked::side_of(const Place& at) const {
  return domain(face_of(at)).side_of(point_of(at), steps(at));
}

std::int32_t Asked::control_vertex(const Place& at) const {
  const auto corner = domain(face_of(at)).corner_at(point_of(at), steps(at));
  return corner ? mesh.faces[face_of(at)][static_cast<std::size_t>(*corner)] : -1;
}

}  // namespace limitcheck::verify
