// SPDX-License-Identifier: MIT
#include "verify/evidence/audit_case.h"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "data/cut_out.h"
#include "data/splitmix64.h"
#include "reference/mesh/support.h"
#include "verify/evidence/faces_around.h"

namespace limitcheck::verify {

using data::ControlMesh;

MeshSample::MeshSample(const ControlMesh& whole, std::size_t faces, std::uint64_t seed)
    : text_(fmt::format("{}:{}", faces, seed)),
      part_of_(whole.faces.size(), -1),
      in_patch_(whole.faces.size(), false) {
  const FacesAround around(whole.faces, whole.positions.size());
  data::SplitMix64 random(seed);
  faces = std::min(faces, whole.faces.size());
  for (std::size_t chosen = 0; chosen < faces;) {
    const auto v = static_cast<std::int32_t>(random.next() % whole.positions.size());
    for (const std::int32_t f : around.of(v)) {
      chosen += !in_patch_[f];
      in_patch_[f] = true;
    }
  }

  for (std::size_t f = 0; f < in_patch_.size(); ++f)
    if (in_patch_[f]) faces_.push_back(static_cast<std::int32_t>(f));
  faces_ = reference::support_of(
      std::move(faces_), whole.faces, [&](std::int32_t v) { return around.of(v); }, whole.sharpness.creasing);
  std::sort(faces_.begin(), faces_.end());
  for (std::size_t p = 0; p < faces_.size(); ++p) part_of_[faces_[p]] = static_cast<std::int32_t>(p);
  data::CutOut cut = data::cut_out(whole.faces, faces_);
  part_ = {cut.of(whole.positions), {}, cut.of(whole.sharpness)};
  part_.faces = std::move(cut.faces);
  vertices_ = std::move(cut.vertices);
}

std::vector<std::int32_t> MeshSample::cull(std::vector<std::int32_t> depth) const {
  for (std::size_t f = 0; f < depth.size(); ++f)
    if (!in_patch_[f]) depth[f] = -1;
  return depth;
}

std::vector<std::int32_t> MeshSample::depths_of_part(std::span<const std::int32_t> depth_of_whole) const {
  std::vector<std::int32_t> depth(faces_.size());
  for (std::size_t p = 0; p < faces_.size(); ++p) depth[p] = depth_of_whole[faces_[p]];
  return depth;
}

ControlMesh MeshSample::part_with(const ControlMesh& positions) const {
  ControlMesh mesh;
  mesh.faces = part_.faces;
  mesh.sharpness = part_.sharpness;
  mesh.positions.reserve(vertices_.size());
  for (const std::int32_t v : vertices_) mesh.positions.push_back(positions.positions[v]);
  return mesh;
}

}  // namespace limitcheck::verify
