// SPDX-License-Identifier: MIT
// What all meshes by name are made of: coordinates that are exact in float, parts put together, and refusals.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "data/control_mesh.h"

namespace limitcheck::data {

/// The nearest float (ties to even). It also hides the last bits in which the sines of two C libraries may
/// differ. By integers, because g++ 12 at -O2 drops a conversion to float and back where it vectorises the
/// two.
inline double rounded(double x) {
  auto bits = std::bit_cast<std::uint64_t>(x);
  bits += 0x0fffffff + (bits >> 29 & 1);
  return std::bit_cast<double>(bits & ~std::uint64_t{0x1fffffff});
}

/// Meshes of more faces are refused.
inline constexpr std::int64_t kMostFaces = 10'000'000;

/// Throws InputError NAME_BAD_PARAMETER unless the condition holds.
inline void require(bool condition, const std::string& why) {
  if (!condition) throw InputError("NAME_BAD_PARAMETER", "", 0, why);
}

/// Adds a mesh beside the faces that are there, moved by `shift` and rounded to float.
inline void append(ControlMesh& mesh, const ControlMesh& other, const std::array<double, 3>& shift = {}) {
  const auto first = static_cast<std::int32_t>(mesh.positions.size());
  for (const auto& p : other.positions)
    mesh.positions.push_back({rounded(p[0] + shift[0]), rounded(p[1] + shift[1]), rounded(p[2] + shift[2])});
  std::vector<std::int32_t> face;
  for (std::size_t f = 0; f < other.faces.size(); ++f) {
    face.assign(other.faces[f].begin(), other.faces[f].end());
    for (std::int32_t& v : face) v += first;
    mesh.faces.push_back(face);
  }
}

/// For each position the first that lies exactly where it does (-0 is 0). Compared as bits, so that NaN has its place
/// in the order, too.
inline std::vector<std::int32_t> first_at_place(const std::vector<std::array<double, 3>>& positions) {
  using Key = std::array<std::uint64_t, 3>;
  std::vector<std::pair<Key, std::int32_t>> order;
  order.reserve(positions.size());
  for (const auto& [x, y, z] : positions)
    order.emplace_back(Key{std::bit_cast<std::uint64_t>(x + 0.0), std::bit_cast<std::uint64_t>(y + 0.0),
                           std::bit_cast<std::uint64_t>(z + 0.0)},
                       static_cast<std::int32_t>(order.size()));
  std::sort(order.begin(), order.end());
  std::vector<std::int32_t> first(positions.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const auto& [key, v] = order[k];
    first[v] = k > 0 && key == order[k - 1].first ? first[order[k - 1].second] : v;
  }
  return first;
}

/// An edge, the smaller vertex first.
using VertexPair = std::pair<std::int32_t, std::int32_t>;

/// Calls what(a, b) for every side of every face, from a to b.
template <class What>
void for_each_side(const Faces& faces, What&& what) {
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (std::size_t k = 0, n = faces[f].size(); k < n; ++k) what(faces[f][k], faces[f][(k + 1) % n]);
}

/// Each edge once for each face that has it, in order.
inline std::vector<VertexPair> sides_of(const Faces& faces) {
  std::vector<VertexPair> sides;
  sides.reserve(faces.corners().size());
  for_each_side(faces, [&](std::int32_t a, std::int32_t b) { sides.push_back(std::minmax(a, b)); });
  std::sort(sides.begin(), sides.end());
  return sides;
}

}  // namespace limitcheck::data
