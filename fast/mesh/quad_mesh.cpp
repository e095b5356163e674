// SPDX-License-Identifier: MIT
#include "fast/mesh/quad_mesh.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <optional>
#include <utility>

#include "fast/mesh/sharp_polygons.h"

namespace limitcheck::fast {

namespace {

bool all_quads(const data::Faces& faces) {
  for (std::size_t f = 0; f < faces.size(); ++f)
    if (faces[f].size() != 4) return false;
  return true;
}

// The mesh with its tags where they are used, of quads; nothing if it is one of quads without tags.
std::optional<SharpPolygons> sharp_quads(const data::ControlMesh& mesh) {
  const bool quads = all_quads(mesh.faces);
  if (quads && mesh.sharpness.empty()) return std::nullopt;
  SharpPolygons polygons = SharpPolygons::of(mesh);
  return quads ? std::move(polygons) : polygons.step();
}

data::ControlMesh plain(const data::ControlMesh& mesh, const std::optional<SharpPolygons>& sharp) {
  return sharp ? data::ControlMesh{sharp->positions, sharp->faces} : mesh;
}

}  // namespace

QuadMesh::QuadMesh(const data::ControlMesh& mesh) : QuadMesh(mesh, sharp_quads(mesh)) {}

QuadMesh::QuadMesh(const data::ControlMesh& mesh, const std::optional<SharpPolygons>& sharp)
    : steps(all_quads(mesh.faces) ? 0 : 1),
      positions(sharp ? sharp->positions : mesh.positions),
      adjacency(plain(mesh, sharp)),
      creasing(mesh.sharpness.creasing) {
  if (!sharp) return;
  const auto is_infinite = [](double s) { return s == kAlwaysSharp; };
  const auto is_semi_sharp = [](double s) { return s > 0 && s < kAlwaysSharp; };

  // How many infinitely sharp edges end at each vertex, and which of them have two faces.
  std::vector<std::int32_t> sharp_edges(positions.size());
  std::vector<std::uint8_t> cuts(sharp->side.size());
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    const auto h = static_cast<std::int32_t>(i);
    if (!is_infinite(sharp->side[i])) continue;
    ++sharp_edges[adjacency.origin(h)];
    if (adjacency.twin(h) < 0) ++sharp_edges[adjacency.target(h)];
    cuts[i] = adjacency.twin(h) >= 0 ? 1 : 0;
  }
  std::vector<std::int32_t> before(positions.size());
  std::iota(before.begin(), before.end(), 0);
  if (std::find(cuts.begin(), cuts.end(), 1) != cuts.end()) {
    cut_twin.assign(cuts.size(), -1);
    for (std::size_t h = 0; h < cuts.size(); ++h)
      if (cuts[h] != 0) cut_twin[h] = adjacency.twin(static_cast<std::int32_t>(h));
    uncut = before = adjacency.cut(cuts);
  }

  const bool semi = std::any_of(sharp->side.begin(), sharp->side.end(), is_semi_sharp) ||
                    std::any_of(sharp->vertex.begin(), sharp->vertex.end(), is_semi_sharp);
  kinds.resize(before.size());
  if (semi) {
    side_sharpness.resize(sharp->side.size());
    vertex_sharpness.resize(before.size());
  }
  for (std::size_t v = 0; v < before.size(); ++v) {
    const std::int32_t b = before[v];
    if (v >= positions.size()) positions.push_back(std::array<double, 3>(positions[b]));
    if (is_infinite(sharp->vertex[b]) || sharp_edges[b] > 2)
      kinds[v] = VertexKind::kHeld;
    else if (sharp_edges[b] == 1)
      kinds[v] = VertexKind::kDart;
    if (semi && is_semi_sharp(sharp->vertex[b])) vertex_sharpness[v] = sharp->vertex[b];
  }
  for (std::size_t h = 0; h < side_sharpness.size(); ++h)
    if (is_semi_sharp(sharp->side[h])) side_sharpness[h] = sharp->side[h];
}

}  // namespace limitcheck::fast
