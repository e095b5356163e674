// SPDX-License-Identifier: MIT
// Faults that need a rare neighbourhood: what a search over many meshes has to find.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <utility>

#include "verify/mutants/planted_faults.h"

namespace limitcheck::verify {
namespace {

std::map<std::pair<std::int32_t, std::int32_t>, std::array<std::int32_t, 2>> faces_of_edges(
    const data::ControlMesh& mesh) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::array<std::int32_t, 2>> edges;
  const auto triangles = triangles_of(mesh);
  for (std::size_t f = 0; f < triangles.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [edge, is_new] = edges.try_emplace(
          std::minmax(std::int32_t{triangles[f][k]}, std::int32_t{triangles[f][(k + 1) % 3]}),
          std::array<std::int32_t, 2>{static_cast<std::int32_t>(f), -1});
      if (!is_new) edge->second[1] = static_cast<std::int32_t>(f);
    }
  return edges;
}

// Faces around each vertex inside the mesh; 0 for those on the boundary.
std::vector<int> interior_valences(const data::ControlMesh& mesh) {
  std::vector<int> valence(mesh.positions.size(), 0);
  for (const auto& t : triangles_of(mesh))
    for (const std::int32_t v : t) ++valence[v];
  for (const auto& [ends, faces] : faces_of_edges(mesh))
    if (faces[1] < 0) valence[ends.first] = valence[ends.second] = 0;
  return valence;
}

// Along x by 1e-5 of the largest coordinate.
template <class Real>
void move(const data::ControlMesh& mesh, Copy<Real>& out, std::size_t v) {
  double largest = 0;
  for (const auto& p : mesh.positions)
    for (const double x : p) largest = std::max(largest, std::abs(x));
  out.positions[v][0] += static_cast<Real>(1e-5 * largest);
}

}  // namespace

template <class Real>
std::vector<PlantedFault<Real>> rare_faults() {
  using Mesh = const data::ControlMesh&;
  using Out = Copy<Real>&;
  return {
      {{"adjacent_extraordinary",
        "in faces with two extraordinary vertices side by side, points are 1e-5 of the mesh off along x"},
       [](Mesh mesh, Out out) {
         const std::vector<int> valence = interior_valences(mesh);
         for (std::size_t v = 0; v < out.positions.size(); ++v) {
           if (control_vertex(mesh, out.provenance[v]) >= 0) continue;
           const auto& t = triangles_of(mesh)[out.provenance[v].face];
           if (std::count_if(t.begin(), t.end(),
                             [&](std::int32_t c) { return valence[c] > 0 && valence[c] != 6; }) > 1)
             move(mesh, out, v);
         }
       }},
      {{"depth_difference_3",
        "in faces beside one whose depth differs by 3, points are 1e-5 of the mesh off along x"},
       [](Mesh mesh, Out out) {
         const auto& depth = out.face_depth;
         std::vector<bool> spoilt(mesh.faces.size(), false);
         for (const auto& [ends, f] : faces_of_edges(mesh))
           if (f[1] >= 0 && depth[f[0]] >= 0 && depth[f[1]] >= 0 && std::abs(depth[f[0]] - depth[f[1]]) == 3)
             spoilt[f[0]] = spoilt[f[1]] = true;
         for (std::size_t v = 0; v < out.positions.size(); ++v)
           if (spoilt[out.provenance[v].face] && control_vertex(mesh, out.provenance[v]) < 0)
             move(mesh, out, v);
       }},
      {{"valence_above_40",
        "limit points of vertices amid more than 40 faces are 1e-5 of the mesh off along x"},
       [](Mesh mesh, Out out) {
         const std::vector<int> valence = interior_valences(mesh);
         for (std::size_t v = 0; v < out.positions.size(); ++v)
           if (const auto at = control_vertex(mesh, out.provenance[v]); at >= 0 && valence[at] > 40)
             move(mesh, out, v);
       }},
  };
}

template std::vector<PlantedFault<float>> rare_faults();
template std::vector<PlantedFault<double>> rare_faults();

}  // namespace limitcheck::verify
