// SPDX-License-Identifier: MIT
#include "fast/plan/faces.h"

#include <array>

namespace limitcheck::fast {

namespace {

std::uint32_t number(int i) {
  return static_cast<std::uint32_t>(i);
}

// Turned about the middle of a quad of k steps by so many quarters, counter-clockwise.
std::array<int, 2> turned(int quarters, std::array<int, 2> at, int k) {
  for (; quarters > 0; --quarters) at = {k - at[1], at[0]};
  return at;
}

}  // namespace

QuadFaces::QuadFaces(const data::Faces& faces, const QuadMesh& quads) : first{0}, mesh(&quads) {
  first.reserve(faces.size() + 1);
  face.reserve(faces.corners().size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    first.push_back(faces.first_corner(f) + faces[f].size());
    face.resize(first.back(), static_cast<std::int32_t>(f));
  }
}

std::int32_t QuadFaces::side_of(std::int32_t h) const {
  if (h < 0 || !cut()) return h;
  const std::int32_t c = h / 4;
  if (h % 4 == 0) return c;  // from its corner
  return c == first_side(face[c]) ? first_side(face[c] + 1) - 1 : c - 1;
}

LatticePoint QuadFaces::lattice(std::int32_t f, int depth, PartPoint p) const {
  if (!cut()) return {f, number(p.i), number(p.j), 1u << depth};
  const int m = part_size(depth), k = 2 * m;
  if (sides(f) != 4) return {f, number(p.i), number(p.j), number(m), p.part};
  const auto [i, j] = turned(p.part, {p.i, p.j}, k);
  return {f, number(i), number(j), number(k)};
}

LatticePoint QuadFaces::corner(std::int32_t f, int k) const {
  return sides(f) != 4 ? LatticePoint{f, 0, 0, 1, k} : on_side(f, k, 0, 1);
}

LatticePoint QuadFaces::on_side(std::int32_t f, int side, int t, int count) const {
  const int n = sides(f);
  if (n != 4) {
    const int half = count / 2;
    if (t == 0 || t == count) return corner(f, t == 0 ? side : (side + 1) % n);
    if (t <= half) return {f, number(t), 0, number(half), side};
    return {f, 0, number(count - t), number(half), (side + 1) % n};
  }
  const auto [i, j] = turned(side, {t, 0}, count);
  return {f, number(i), number(j), number(count)};
}

LatticePoint QuadFaces::centre(std::int32_t f) const {
  return sides(f) == 4 ? LatticePoint{f, 1, 1, 2} : LatticePoint{f, 1, 1, 1};
}

PartPoint QuadFaces::beside(std::int32_t f, int depth, int side, int t) const {
  const int k = 1 << depth;
  if (cut()) {
    if (t < k / 2) return {side, t + 1, 1};
    return {(side + 1) % sides(f), 1, k - 1 - t};
  }
  const auto [i, j] = turned(side, {t + 1, 1}, k);
  return {0, i, j};
}

}  // namespace limitcheck::fast
