// SPDX-License-Identifier: MIT
// Faults that show on some control meshes only: tables too short, assumptions about the shape.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "verify/mutants/planted_faults.h"
#include "verify/subject/face_domain.h"

namespace limitcheck::verify {
namespace {

// The component of each control vertex, numbered in the order of the faces.
std::vector<std::int32_t> components(const data::ControlMesh& mesh) {
  std::vector<std::int32_t> root(mesh.positions.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](std::int32_t v) {
    while (root[v] != v) v = root[v];
    return static_cast<std::size_t>(v);
  };
  for (const auto& t : triangles_of(mesh))
    for (std::size_t k = 1; k < 3; ++k) root[find(t[k])] = static_cast<std::int32_t>(find(t[0]));
  std::map<std::size_t, std::int32_t> number;
  for (const auto& t : triangles_of(mesh))
    number.emplace(find(t[0]), static_cast<std::int32_t>(number.size()));
  std::vector<std::int32_t> component(root.size(), -1);
  for (std::size_t v = 0; v < root.size(); ++v)
    if (const auto at = number.find(find(static_cast<std::int32_t>(v))); at != number.end())
      component[v] = at->second;
  return component;
}

std::int32_t component_of(const data::ControlMesh& mesh, const std::vector<std::int32_t>& component,
                          const lc_provenance& place) {
  return component[triangles_of(mesh)[place.face][0]];
}

// Edges in the order in which the faces name them; points inside those beyond the first `room` lie half way
// between its ends.
template <class Real>
void forget_edges(const data::ControlMesh& mesh, std::size_t room, Copy<Real>& out) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> edges;
  for (const auto& t : triangles_of(mesh))
    for (std::size_t k = 0; k < 3; ++k) edges.emplace(std::minmax(t[k], t[(k + 1) % 3]), edges.size());
  for (std::size_t v = 0; v < out.positions.size(); ++v) {
    const lc_provenance& p = out.provenance[v];
    if (control_vertex(mesh, p) >= 0) continue;
    const auto& t = triangles_of(mesh)[p.face];
    const auto place = FaceDomain::triangle().side_of(point_of(p), p.denominator);
    if (!place) continue;
    const std::int32_t a = t[place->side], b = t[FaceDomain::triangle().next(place->side)];
    if (edges.at(std::minmax(a, b)) < room) continue;
    for (std::size_t c = 0; c < 3; ++c)
      out.positions[v][c] = static_cast<Real>((mesh.positions[a][c] + mesh.positions[b][c]) / 2);
  }
}

}  // namespace

template <class Real>
std::vector<PlantedFault<Real>> mesh_faults() {
  using Mesh = const data::ControlMesh&;
  using Out = Copy<Real>&;
  static constexpr Real kNan = std::numeric_limits<Real>::quiet_NaN();
  return {
      {{"edges_of_genus_0",
        "a table of 3 V - 6 edges, as a closed mesh of genus 0 has: others are not smoothed"},
       [](Mesh mesh, Out out) { forget_edges(mesh, 3 * mesh.positions.size() - 6, out); }},
      {{"edges_of_genus_1", "a table of 3 V edges, as a closed mesh of genus 1 has: others are not smoothed"},
       [](Mesh mesh, Out out) { forget_edges(mesh, 3 * mesh.positions.size(), out); }},
      {{"second_component", "faces that are not reached from the first one keep their normals unturned"},
       [](Mesh mesh, Out out) {
         const auto component = components(mesh);
         for (std::size_t v = 0; v < out.normals.size(); ++v)
           if (component_of(mesh, component, out.provenance[v]) > 0)
             for (Real& x : out.normals[v]) x = -x;
       }},
      {{"third_component", "from the third component on, points are 1e-5 too far from the origin"},
       [](Mesh mesh, Out out) {
         const auto component = components(mesh);
         for (std::size_t v = 0; v < out.positions.size(); ++v)
           if (component_of(mesh, component, out.provenance[v]) > 1)
             for (Real& x : out.positions[v]) x *= Real(1.00001);
       }},
      {{"welded_components", "control vertices at one place, of whatever component, get one limit point"},
       [](Mesh mesh, Out out) {
         const auto component = components(mesh);
         std::map<std::array<double, 3>, std::pair<std::int32_t, std::size_t>> known;
         for (std::size_t v = 0; v < out.positions.size(); ++v) {
           const std::int32_t at = control_vertex(mesh, out.provenance[v]);
           if (at < 0) continue;
           const auto k = static_cast<std::size_t>(at);
           const auto [first, is_new] = known.try_emplace(mesh.positions[k], component[k], v);
           if (!is_new && first->second.first != component[k])
             out.positions[v] = std::array(out.positions[first->second.second]);
         }
       }},
      {{"flat_box", "brought to the unit cube axis by axis and back: 0 / 0 where the box is flat"},
       [](Mesh mesh, Out out) {
         for (std::size_t c = 0; c < 3; ++c) {
           const auto less = [&](const auto& a, const auto& b) { return a[c] < b[c]; };
           const auto [low, high] = std::minmax_element(mesh.positions.begin(), mesh.positions.end(), less);
           if ((*low)[c] == (*high)[c])
             for (auto& p : out.positions) p[c] = kNan;
         }
       }},
      {{"edge_without_length", "divides by the lengths of edges: 0 / 0 at both ends"},
       [](Mesh mesh, Out out) {
         std::vector<bool> spoilt(mesh.positions.size(), false);
         for (const auto& t : triangles_of(mesh))
           for (std::size_t k = 0; k < 3; ++k) {
             const auto a = static_cast<std::size_t>(t[k]), b = static_cast<std::size_t>(t[(k + 1) % 3]);
             if (mesh.positions[a] == mesh.positions[b]) spoilt[a] = spoilt[b] = true;
           }
         for (std::size_t v = 0; v < out.positions.size(); ++v)
           if (const auto at = control_vertex(mesh, out.provenance[v]); at >= 0 && spoilt[at])
             out.positions[v].fill(kNan);
       }},
      {{"indices_of_16_bits", "control points are fetched by the lower 16 bits of their number"},
       [](Mesh, Out) {},
       [](data::ControlMesh& mesh) {
         for (std::size_t v = 0x10000; v < mesh.positions.size(); ++v)
           mesh.positions[v] = mesh.positions[v & 0xFFFF];
       }},
  };
}

template std::vector<PlantedFault<float>> mesh_faults();
template std::vector<PlantedFault<double>> mesh_faults();

}  // namespace limitcheck::verify
