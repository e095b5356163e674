// SPDX-License-Identifier: MIT
#include "verify/shader/half_edges.h"

#include <algorithm>
#include <bit>
#include <map>
#include <span>
#include <utility>

#include "data/sharpness.h"
#include "verify/subject/subject_error.h"

namespace limitcheck::verify {

HalfEdges::HalfEdges(const lc_mesh& mesh) {
  const std::int64_t vertices = mesh.vertex_count, corners = mesh.corner_count;
  if (vertices > (1 << 24) || corners > (1 << 26))
    throw SubjectError(LC_NOT_SUPPORTED, "more vertices or corners than a shader is given");
  std::vector<std::int32_t> twin(static_cast<std::size_t>(corners), -1), edge(twin), face(twin), first;
  std::vector<float> sharp(twin.size()), sharp_vertex(static_cast<std::size_t>(vertices));
  std::vector<std::int32_t> faces_at(sharp_vertex.size());

  // The half-edges between two vertices, by the lower one: two, or one at the boundary.
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> half_edge_of;
  std::int32_t edges = 0, h = 0;
  for (std::int64_t f = 0; f < mesh.face_count; ++f) {
    first.push_back(h);
    const std::int32_t begin = h, size = mesh.face_sizes[f];
    for (; h < begin + size; ++h) {
      const auto at = static_cast<std::size_t>(h);
      const std::int32_t a = mesh.corners[h], b = mesh.corners[begin + (h - begin + 1) % size];
      face[at] = static_cast<std::int32_t>(f);
      ++faces_at[static_cast<std::size_t>(a)];
      const auto [other, is_new] = half_edge_of.try_emplace(std::minmax(a, b), h);
      if (is_new) {
        edge[at] = edges++;
        continue;
      }
      const auto partner = static_cast<std::size_t>(other->second);
      twin[at] = other->second, twin[partner] = h, edge[at] = edge[partner];
    }
  }
  first.push_back(h);
  for (std::size_t k = 0; k < sharp.size(); ++k)
    if (twin[k] < 0) sharp[k] = data::kInfiniteSharpness;
  for (const lc_sharp_edge& e : std::span(mesh.sharp_edges, static_cast<std::size_t>(mesh.sharp_edge_count)))
    if (const auto found = half_edge_of.find(std::minmax(e.a, e.b)); found != half_edge_of.end())
      if (const std::int32_t other = twin[static_cast<std::size_t>(found->second)]; other >= 0)
        sharp[static_cast<std::size_t>(found->second)] = sharp[static_cast<std::size_t>(other)] = e.sharpness;
  if (mesh.corners_held != 0)
    for (std::size_t k = 0; k < twin.size(); ++k)
      if (const auto v = static_cast<std::size_t>(mesh.corners[k]); twin[k] < 0 && faces_at[v] == 1)
        sharp_vertex[v] = data::kInfiniteSharpness;
  for (const lc_sharp_vertex& v :
       std::span(mesh.sharp_vertices, static_cast<std::size_t>(mesh.sharp_vertex_count)))
    sharp_vertex[static_cast<std::size_t>(v.vertex)] =
        std::max(sharp_vertex[static_cast<std::size_t>(v.vertex)], v.sharpness);

  counts = {vertices, mesh.face_count, corners, edges};
  const auto put = [&](float x) { words.push_back(std::bit_cast<std::int32_t>(x)); };
  for (std::int64_t k = 0; k < 3 * vertices; ++k) put(static_cast<float>(mesh.positions[k]));
  words.insert(words.end(), mesh.corners, mesh.corners + corners);
  for (const auto* list : {&twin, &edge, &face}) words.insert(words.end(), list->begin(), list->end());
  for (const float s : sharp) put(s);
  words.insert(words.end(), first.begin(), first.end());
  for (const float s : sharp_vertex) put(s);
}

}  // namespace limitcheck::verify
