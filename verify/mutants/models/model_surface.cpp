// SPDX-License-Identifier: MIT
#include "verify/mutants/models/model_surface.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "verify/mutants/models/model_sharp.h"

namespace limitcheck::verify {
namespace {

using V = ModelRules::V;

// Edge points between visible and culled faces, as if the culled faces did not exist.
void cut_holes(const ModelMesh& from, const std::vector<V>& points, std::span<const std::int32_t> shown,
               std::vector<V>& next) {
  for (std::size_t f = 0; f < shown.size(); ++f)
    for (int k = 0; k < 3; ++k) {
      const std::int32_t edge = from.topology.edge(f, k);
      const auto& e = from.topology.edges()[edge];
      const std::int32_t g = from.neighbour(f, k);
      if (g >= 0 && (shown[f] < 0) != (shown[g] < 0))
        next[points.size() + static_cast<std::size_t>(edge)] = (points[e.a] + points[e.b]) * .5;
    }
}

data::ControlMesh without_tags(data::ControlMesh mesh) {
  mesh.sharpness = {};
  return mesh;
}

// One step of smoothing.
void smooth(const reference::Topology& topology, std::vector<V>& limits) {
  const std::vector<V> before = limits;
  for (const auto& e : topology.edges())
    for (const auto& [to, from] : {std::pair(e.a, e.b), std::pair(e.b, e.a)})
      limits[to] += (before[from] - before[to]) * (1e-3 / static_cast<double>(topology.ring(to).size()));
}

}  // namespace

ModelMesh::ModelMesh(const data::ControlMesh& given)
    : control(given), topology(given.positions.size(), given.faces) {
  if (control.faces.empty()) throw data::ArgumentError("the mesh has no faces");
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double low = control.positions[0][axis], high = low;
    for (const auto& p : control.positions) {
      low = std::min(low, p[axis]);
      high = std::max(high, p[axis]);
    }
    size = std::hypot(size, high - low);
    largest = std::max({largest, -low, high});
  }
}

std::int32_t ModelMesh::neighbour(std::size_t face, int k) const {
  const reference::Edge& edge = topology.edges()[topology.edge(face, k)];
  return edge.left_face == static_cast<std::int32_t>(face) ? edge.right_face : edge.left_face;
}

int ModelMesh::neighbour_depth(std::span<const std::int32_t> depth, std::size_t face, int k) const {
  const std::int32_t g = neighbour(face, k);
  return g < 0 || depth[g] < 0 ? depth[face] : depth[g];
}

ModelLevel::ModelLevel(const ModelMesh& from, const ModelRules& rules, int depth,
                       std::span<const std::int32_t> shown)
    : mesh(without_tags(from.control)) {
  ModelTags tags = from.control.sharpness.empty()
                       ? ModelTags()
                       : ModelTags(from.control.sharpness, mesh.topology(), rules.mutation());
  for (std::size_t v = 0; v < from.control.positions.size(); ++v) {
    const auto& p = from.control.positions[v];
    points.push_back({p[0], p[1], p[2]});
    if (rules.is("by_vertex_number") && v % 2 == 1) points.back().x += 1e-9 * from.size;
  }
  for (int step = 0; step < depth; ++step) {
    std::vector<V> next = sharp_refine(rules, mesh.topology(), points, tags, depth);
    const bool last = step + 1 == depth;
    if (last && ((step > 0 && rules.is("one_step_missing")) || (depth % 2 == 1 && rules.is("odd_depths"))))
      std::copy(points.begin(), points.end(), next.begin());
    if (step == 0 && rules.is("culled_are_holes")) cut_holes(from, points, shown, next);
    points = std::move(next);
    if (tags.none()) {
      mesh.refine();
      continue;
    }
    const reference::Topology before = mesh.topology();
    mesh.refine();
    tags = tags.refined(before, mesh.topology());
  }
  for (std::size_t v = 0; v < points.size(); ++v) {
    const auto k = static_cast<std::int32_t>(v);
    if (!tags.none() && !tags.plain(mesh.topology(), k)) {
      ModelLimit limit = sharp_limit(rules, mesh.topology(), points, tags, k, depth);
      limits.push_back(limit.position);
      normals.push_back(limit.normals[0]);
      if (limit.normals.size() > 1) sides.emplace(k, std::move(limit));
      continue;
    }
    limits.push_back(rules.limit(mesh.topology(), points, k, depth));
    normals.push_back(rules.normal(mesh.topology(), points, k));
  }
  if (rules.is("limits_smoothed")) smooth(mesh.topology(), limits);
}

const V& ModelLevel::normal(std::size_t face, int i, int j) const {
  const std::int32_t v = mesh.vertex(face, i, j);
  const auto found = sides.find(v);
  if (found == sides.end()) return normals[v];
  // A triangle of the face at the point: the one it begins, or the last before the side beyond it.
  const int n = 1 << mesh.depth();
  const int a = i + j < n ? i : i > 0 ? i - 1 : i, b = i + j < n || i > 0 ? j : j - 1;
  std::vector<std::int32_t> others;
  for (const auto& [x, y] : {std::pair(a, b), std::pair(a + 1, b), std::pair(a, b + 1)})
    if (x != i || y != j) others.push_back(mesh.vertex(face, x, y));
  return found->second.normal(mesh.topology(), v, others[0], others[1]);
}

}  // namespace limitcheck::verify
