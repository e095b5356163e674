// SPDX-License-Identifier: MIT
// A frame of one of our engines, delivered as a subject delivers it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "fast/frame/patch_mesh.h"
#include "fast/frame/sink.h"
#include "fast/window/tessellator.h"
#include "verify/subject/adapter.h"

namespace limitcheck::verify {

/// Allocates the output of a frame and copies its vertices and where they lie.
///   corners   the scheme is Catmull-Clark's, whose faces may be larger than quads
template <class Real>
Output<Real> deliver_vertices(const lc_request& request, lc_tessellation& out,
                              const std::vector<fast::SurfaceVertex<Real>>& vertices,
                              const std::vector<fast::LatticePoint>& provenance, std::size_t triangles,
                              bool corners) {
  const auto output = allocate_output<Real>(request, out, static_cast<std::int64_t>(vertices.size()),
                                            static_cast<std::int64_t>(triangles), true, corners);
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const auto& [position, normal] = vertices[v];
    std::size_t i = 3 * v;
    for (const Real x : {position.x, position.y, position.z}) output.positions[i++] = x;
    i = 3 * v;
    for (const Real x : {normal.x, normal.y, normal.z}) output.normals[i++] = x;
    output.provenance[v] = {provenance[v].face, provenance[v].i, provenance[v].j, provenance[v].denominator};
    if (corners) output.corner[v] = provenance[v].corner;
  }
  return output;
}

/// Refuses, before anything is allocated, frames with more vertices than 32-bit indices name: a pair of 2 k^2
/// triangles has at least (k + 1)^2. Faces that become fans have fewer and are counted as if they did not.
inline void refuse_too_many_vertices(std::span<const std::int32_t> depth) {
  std::int64_t triangles = 0;
  for (const std::int32_t d : depth)
    if (d >= 0) triangles += std::int64_t{1} << std::min(2 * d, 40);
  if (triangles / 2 > std::int64_t{UINT32_MAX})
    throw SubjectError(LC_NOT_SUPPORTED, "more vertices at these depths than 32-bit indices can name");
}

/// Runs one frame of a Tessellator<Real> or StreamTessellator, as one indexed mesh or as strips and fans.
template <class Real, class Engine>
void deliver_frame(Engine& engine, std::span<const std::int32_t> depth, bool indexed,
                   const lc_request& request, lc_tessellation& out, bool corners = false) {
  refuse_too_many_vertices(depth);
  std::size_t at = 0;
  if (indexed) {
    fast::IndexedMesh<Real> mesh;
    engine.frame(depth, mesh);
    const auto output =
        deliver_vertices(request, out, mesh.vertices, mesh.provenance, mesh.triangles.size(), corners);
    for (const auto& t : mesh.triangles)
      for (const std::uint32_t v : t) output.triangles[at++] = v;
    std::copy(mesh.triangle_face.begin(), mesh.triangle_face.end(), output.triangle_face);
    return;
  }
  fast::DrawList<Real> list;
  const fast::FrameStats stats = engine.frame(depth, list);
  const auto output = deliver_vertices(request, out, list.vertices, list.provenance,
                                       static_cast<std::size_t>(stats.triangles), corners);
  for (const fast::Draw& draw : list.draws) {
    for (std::int32_t t = 0; t < draw.triangle_count(); ++t) {
      output.triangle_face[at / 3] = draw.face_of(t);
      for (const std::int32_t v : draw.triangle(t))
        output.triangles[at++] = static_cast<std::uint32_t>(draw.first + v);
    }
  }
}

/// A frame as patches, in memory that something may have been changed in.
template <class Real>
struct PatchView {
  std::span<const fast::PatchDraw> draws;
  std::span<const std::uint32_t> indices;
  std::span<const fast::SurfaceVertex<Real>> vertices;
  std::span<const fast::LatticePoint> provenance;

  static PatchView of(const fast::PatchMesh<Real>& mesh) {
    return {mesh.draws(), mesh.indices(), mesh.vertices(), mesh.provenance()};
  }
};

/// Delivers a frame of patches, whose indices are triangles. Vertices that no triangle has, such as those of
/// patches that are not shown, are left out.
template <class Real>
void deliver_patches(const PatchView<Real>& patches, const lc_request& request, lc_tessellation& out,
                     bool corners) {
  constexpr std::uint32_t kUnused = UINT32_MAX;
  std::vector<fast::SurfaceVertex<Real>> vertices;
  std::vector<fast::LatticePoint> provenance;
  std::vector<std::uint32_t> triangles, number;
  std::vector<std::int32_t> faces;
  for (const fast::PatchDraw& draw : patches.draws) {
    number.assign(static_cast<std::size_t>(draw.vertex_count), kUnused);
    for (std::uint32_t i = 0; i < draw.index_count; ++i) {
      const std::uint32_t v = patches.indices[draw.first_index + i];
      if (number[v] == kUnused) {
        const auto at = static_cast<std::size_t>(draw.base_vertex) + v;
        number[v] = static_cast<std::uint32_t>(vertices.size());
        vertices.push_back(patches.vertices[at]);
        provenance.push_back(patches.provenance[at]);
      }
      triangles.push_back(number[v]);
    }
    for (std::int32_t t = 0; t < draw.triangles; ++t)
      faces.push_back(t < draw.split ? draw.face : draw.face_after);
  }
  const auto output = deliver_vertices(request, out, vertices, provenance, faces.size(), corners);
  std::copy(triangles.begin(), triangles.end(), output.triangles);
  std::copy(faces.begin(), faces.end(), output.triangle_face);
}

}  // namespace limitcheck::verify
