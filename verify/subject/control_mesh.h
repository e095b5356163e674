// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

#include "data/control_mesh.h"
#include "verify/subject/subject.h"

namespace limitcheck::verify {

/// The mesh that the host handed over, for subjects of our own.
inline data::ControlMesh control_mesh(const lc_mesh& mesh) {
  data::ControlMesh result;
  for (std::int64_t v = 0; v < mesh.vertex_count; ++v) {
    const double* p = mesh.positions + 3 * v;
    result.positions.push_back({p[0], p[1], p[2]});
  }
  const std::int32_t* corner = mesh.corners;
  for (std::int64_t f = 0; f < mesh.face_count; ++f) {
    const auto size = static_cast<std::size_t>(mesh.face_sizes[f]);
    result.faces.push_back(std::span(corner, size));
    corner += size;
  }
  for (std::int64_t k = 0; k < mesh.sharp_edge_count; ++k)
    result.sharpness.edges.push_back(
        {mesh.sharp_edges[k].a, mesh.sharp_edges[k].b, mesh.sharp_edges[k].sharpness});
  for (std::int64_t k = 0; k < mesh.sharp_vertex_count; ++k)
    result.sharpness.vertices.push_back({mesh.sharp_vertices[k].vertex, mesh.sharp_vertices[k].sharpness});
  if (mesh.creasing == LC_CREASING_CHAIKIN) result.sharpness.creasing = data::Creasing::kChaikin;
  if (mesh.corners_held != 0) result.sharpness.boundary = data::Boundary::kEdgeAndCorner;
  if (mesh.smooth_triangles != 0) result.sharpness.triangles = data::TriangleRule::kSmooth;
  for (const lc_channel& c : std::span(mesh.channels, static_cast<std::size_t>(mesh.channel_count)))
    result.channels.push_back(
        {result.channels.empty() ? "uv" : "channel" + std::to_string(result.channels.size()),
         c.components,
         {c.values, c.values + c.components * c.value_count},
         {c.corners, c.corners + mesh.corner_count},
         static_cast<data::ChannelRule>(c.rule)});
  return result;
}

}  // namespace limitcheck::verify
