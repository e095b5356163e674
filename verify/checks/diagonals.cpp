// SPDX-License-Identifier: MIT
#include "verify/checks/diagonals.h"

#include <map>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

namespace limitcheck::verify {
namespace {

// A side of a triangle, in the direction in which the triangle runs along it.
struct Side {
  std::int32_t face, from, to;  // points
  friend auto operator<=>(const Side&, const Side&) = default;
};

// Whether side k of a triangle joins two corners of its face that are not next to each other.
bool is_diagonal(const Evidence& e, std::int64_t triangle, std::size_t k) {
  const std::int32_t face = e.tessellation.triangle_face()[triangle];
  const auto& vertices = e.tessellation.triangles()[triangle];
  const Lattice::Id p = e.point[vertices[k]], q = e.point[vertices[(k + 1) % 3]];
  if (p == Lattice::kNone || q == Lattice::kNone || !e.lattice.is_vertex(p) || !e.lattice.is_vertex(q))
    return false;
  const auto a = e.lattice.corner_of(face, p), b = e.lattice.corner_of(face, q);
  const FaceDomain domain = e.lattice.domain(face);
  return a && b && *a != *b && domain.next(*a) != *b && domain.previous(*a) != *b;
}

}  // namespace

OriginOfTriangles tell_diagonals_apart(const Evidence& e, std::vector<std::array<std::int32_t, 3>> triangles,
                                       std::int64_t points) {
  OriginOfTriangles out{std::move(triangles), {}, points};
  out.origin.resize(out.triangles.size());
  std::iota(out.origin.begin(), out.origin.end(), 0);
  if (e.mesh.faces.are_triangles()) return out;

  std::map<Side, std::int32_t> triangle_of;  // of each diagonal, in each direction
  std::set<Side> twice;
  for (std::int32_t t = 0; t < std::ssize(out.triangles); ++t)
    for (std::size_t k = 0; k < 3 && e.tessellation.triangle_ok(t); ++k) {
      if (!is_diagonal(e, t, k)) continue;
      const Side side{e.tessellation.triangle_face()[t], out.triangles[t][k], out.triangles[t][(k + 1) % 3]};
      if (side.from >= 0 && side.to >= 0 && !triangle_of.try_emplace(side, t).second) twice.insert(side);
    }
  if (triangle_of.empty()) return out;
  std::map<std::pair<std::int32_t, std::int32_t>, int> uses;  // of the pairs of points that diagonals join
  for (const auto& [side, t] : triangle_of) uses.try_emplace(std::minmax(side.from, side.to), 0);
  for (const auto& t : out.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      if (const auto pair = uses.find(std::minmax(t[k], t[(k + 1) % 3])); pair != uses.end()) ++pair->second;

  // Cuts the triangle along this side from the side's middle to the corner opposite.
  const auto cut = [&](const Side& side, std::int32_t middle) {
    const std::int32_t t = triangle_of.at(side), other = static_cast<std::int32_t>(out.triangles.size());
    auto& first = out.triangles[t];
    std::size_t k = 0;
    while (first[k] != side.from || first[(k + 1) % 3] != side.to) ++k;
    const std::int32_t opposite = first[(k + 2) % 3];
    first[(k + 1) % 3] = middle;
    out.triangles.push_back({middle, side.to, opposite});
    out.origin.push_back(out.origin[t]);
    if (const auto next = triangle_of.find({side.face, side.to, opposite}); next != triangle_of.end())
      next->second = other;
  };
  const auto sides = triangle_of;
  for (const auto& [side, t] : sides) {
    const Side back{side.face, side.to, side.from};
    if (side.from > side.to || uses.at(std::minmax(side.from, side.to)) <= 2 || !sides.contains(back) ||
        twice.contains(side) || twice.contains(back))
      continue;
    const auto middle = static_cast<std::int32_t>(out.points++);
    cut(side, middle);
    cut(back, middle);
  }
  return out;
}

}  // namespace limitcheck::verify
