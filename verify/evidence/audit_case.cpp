// SPDX-License-Identifier: MIT
#include "verify/evidence/audit_case.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "data/cut_out.h"
#include "data/splitmix64.h"
#include "reference/mesh/support.h"
#include "verify/evidence/faces_around.h"

namespace limitcheck::verify {

using data::ControlMesh;

namespace {

// How many faces, edges of a sharpness that ends and of one that does not, the vertex's own, and whether its
// index has more than 15 and 16 bits.
using Kind = std::array<float, 5>;
using Kinds = std::map<Kind, std::vector<std::int32_t>>;

Kinds kinds_of_vertices(const ControlMesh& mesh, const FacesAround& around) {
  std::vector<Kind> kind(mesh.positions.size());
  for (const data::SharpEdge& e : mesh.sharpness.edges)
    for (const std::int32_t v : {e.a, e.b})
      if (e.sharpness > 0) ++kind[v][e.sharpness < data::kInfiniteSharpness ? 1 : 2];
  for (const data::SharpVertex& s : mesh.sharpness.vertices) kind[s.vertex][3] = s.sharpness;
  Kinds all;
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(kind.size()); ++v) {
    kind[v][0] = static_cast<float>(around.of(v).size());
    kind[v][4] = static_cast<float>(std::min(v >> 15, 2));
    all[kind[v]].push_back(v);
  }
  return all;
}

}  // namespace

MeshSample::MeshSample(const ControlMesh& whole, std::size_t faces, std::uint64_t seed)
    : text_(fmt::format("{}:{}", faces, seed)),
      part_of_(whole.faces.size(), -1),
      in_patch_(whole.faces.size(), false) {
  const FacesAround around(whole.faces, whole.positions.size());
  data::SplitMix64 random(seed);
  faces = std::min(faces, whole.faces.size());
  Kinds kinds = kinds_of_vertices(whole, around);
  for (std::size_t chosen = 0; chosen < faces;)
    for (auto& [kind, left] : kinds) {
      if (left.empty() || chosen >= faces) continue;
      std::swap(left[random.next() % left.size()], left.back());
      for (const std::int32_t f : around.of(left.back())) {
        chosen += !in_patch_[f];
        in_patch_[f] = true;
      }
      left.pop_back();
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
