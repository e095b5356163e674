// SPDX-License-Identifier: MIT
#include "data/triangulate.h"

#include <array>
#include <span>

namespace limitcheck::data {
namespace {

double squared_distance(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  return x * x + y * y + z * z;
}

// The corner from which the fan of a face starts.
std::size_t apex(const ControlMesh& mesh, std::span<const std::int32_t> face, Triangulation rule) {
  if (rule != Triangulation::kShortestDiagonal || face.size() != 4) return 0;
  const auto& p = mesh.positions;
  for (const std::int32_t v : face)
    if (v < 0 || static_cast<std::size_t>(v) >= p.size()) return 0;
  return squared_distance(p[face[1]], p[face[3]]) < squared_distance(p[face[0]], p[face[2]]) ? 1 : 0;
}

}  // namespace

Triangulated triangulate(const ControlMesh& mesh, Triangulation rule) {
  Triangulated result;
  result.faces.reserve(mesh.faces.size());
  result.face.reserve(mesh.faces.size());
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto face = mesh.faces[f];
    const std::size_t n = face.size();
    if (n <= 3 || rule == Triangulation::kKeep) {
      result.faces.push_back(face);
      result.face.push_back(static_cast<std::int64_t>(f));
      continue;
    }
    ++result.cut;
    const std::size_t first = apex(mesh, face, rule);
    for (std::size_t k = 1; k + 1 < n; ++k) {
      result.faces.push_back({face[first], face[(first + k) % n], face[(first + k + 1) % n]});
      result.face.push_back(static_cast<std::int64_t>(f));
    }
  }
  return result;
}

}  // namespace limitcheck::data
