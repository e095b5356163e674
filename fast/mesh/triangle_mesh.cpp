// SPDX-License-Identifier: MIT
#include "fast/mesh/triangle_mesh.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "data/error.h"
#include "fast/mesh/sharp_cut.h"
#include "fast/mesh/sharp_polygons.h"

namespace limitcheck::fast {

TriangleMesh::TriangleMesh(const data::ControlMesh& mesh) : mesh_(&mesh), adjacency_(mesh) {
  if (mesh.sharpness.empty()) return;
  const SharpPolygons sharp = SharpPolygons::of(mesh, data::Scheme::kLoop);
  const auto is_semi_sharp = [](double s) { return s > 0 && s < kAlwaysSharp; };
  if (std::any_of(sharp.side.begin(), sharp.side.end(), is_semi_sharp) ||
      std::any_of(sharp.vertex.begin(), sharp.vertex.end(), is_semi_sharp))
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

}  // namespace limitcheck::fast
