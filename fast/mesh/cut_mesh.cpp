// SPDX-License-Identifier: MIT
#include "fast/mesh/cut_mesh.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "data/error.h"

namespace limitcheck::fast {

namespace {

bool any_semi_sharp(const SharpPolygons& sharp) {
  return std::any_of(sharp.side.begin(), sharp.side.end(), is_semi_sharp) ||
         std::any_of(sharp.vertex.begin(), sharp.vertex.end(), is_semi_sharp);
}

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

TriangleMesh::TriangleMesh(const data::ControlMesh& mesh) : mesh_(&mesh), adjacency_(mesh) {
  if (mesh.sharpness.empty()) return;
  const SharpPolygons sharp = SharpPolygons::of(mesh, data::Scheme::kLoop);
  if (any_semi_sharp(sharp))
    throw data::ArgumentError("tessellator: no semi-sharp edges or vertices in Loop's scheme");
  SharpCut cut = cut_sharp(adjacency_, sharp);
  kinds_ = std::move(cut.kinds);
  cut_twin_ = std::move(cut.twin);
  if (cut_twin_.empty()) return;
  uncut_ = std::move(cut.uncut);
  with_copies_.emplace();
  with_copies_->faces = mesh.faces;
  points_moved();
}

void TriangleMesh::points_moved() {
  if (!with_copies_) return;
  with_copies_->positions.resize(uncut_.size());
  for (std::size_t v = 0; v < uncut_.size(); ++v) with_copies_->positions[v] = mesh_->positions[uncut_[v]];
}

QuadMesh::QuadMesh(const data::ControlMesh& mesh) : QuadMesh(mesh, sharp_quads(mesh)) {}

QuadMesh::QuadMesh(const data::ControlMesh& mesh, const std::optional<SharpPolygons>& sharp)
    : steps(all_quads(mesh.faces) ? 0 : 1),
      positions(sharp ? sharp->positions : mesh.positions),
      adjacency(plain(mesh, sharp)),
      creasing(mesh.sharpness.creasing) {
  if (!sharp) return;
  SharpCut cut = cut_sharp(adjacency, *sharp);
  for (std::size_t v = positions.size(); v < cut.uncut.size(); ++v)
    positions.push_back(std::array<double, 3>(positions[cut.uncut[v]]));

  if (any_semi_sharp(*sharp)) {
    side_sharpness.resize(sharp->side.size());
    for (const std::int32_t before : cut.uncut)
      vertex_sharpness.push_back(is_semi_sharp(sharp->vertex[before]) ? sharp->vertex[before] : 0);
  }
  for (std::size_t h = 0; h < side_sharpness.size(); ++h)
    if (is_semi_sharp(sharp->side[h])) side_sharpness[h] = sharp->side[h];
  cut_twin = std::move(cut.twin);
  if (!cut_twin.empty()) uncut = std::move(cut.uncut);
  kinds = std::move(cut.kinds);
}

}  // namespace limitcheck::fast
