// SPDX-License-Identifier: MIT
#include "verify/audit/lattice.h"

#include <fmt/core.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace limitcheck::verify {

Lattice::Lattice(const data::ControlMesh& mesh, int depth)
    : mesh_(mesh),
      depth_(depth),
      n_(std::int64_t{1} << depth),
      first_edge_(static_cast<Id>(mesh.positions.size())),
      face_points_((n_ - 1) * (n_ - 2) / 2 + 1) {
  if (depth < 0 || depth > 15) throw std::invalid_argument("Lattice: depth must be 0..15");

  // Edges: sort the sides of all faces by their vertices; the two sides of an edge come together.
  struct Side {
    std::int32_t a, b, face;
    std::int8_t corner;
  };
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  vertex_face_.assign(mesh.positions.size(), -1);
  vertex_corner_.assign(mesh.positions.size(), 0);
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
    for (std::int8_t k = 0; k < 3; ++k) {
      const std::int32_t from = mesh.triangles[f][k], to = mesh.triangles[f][(k + 1) % 3];
      sides.push_back({std::min(from, to), std::max(from, to), static_cast<std::int32_t>(f), k});
      if (vertex_face_[from] < 0) {
        vertex_face_[from] = static_cast<std::int32_t>(f);
        vertex_corner_[from] = k;
      }
    }
  std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
    return x.a != y.a ? x.a < y.a : x.b != y.b ? x.b < y.b : x.face < y.face;
  });
  face_edges_.resize(mesh.triangles.size());
  for (const Side& s : sides) {
    if (edges_.empty() || edges_.back().a != s.a || edges_.back().b != s.b)
      edges_.push_back({s.a, s.b, {-1, -1}, {0, 0}});
    Edge& edge = edges_.back();
    const int slot = edge.face[0] < 0 ? 0 : 1;
    edge.face[slot] = s.face;
    edge.corner[slot] = s.corner;
    face_edges_[s.face][s.corner] = static_cast<std::int32_t>(edges_.size() - 1);
  }
  first_interior_ = first_edge_ + (n_ - 1) * static_cast<Id>(edges_.size());

  row_start_.assign(static_cast<std::size_t>(n_) + 1, 0);
  for (std::int64_t j = 1; j + 1 < n_; ++j) row_start_[j + 1] = row_start_[j] + (n_ - 1 - j);
}

Lattice::Id Lattice::interior(std::int64_t i, std::int64_t j) const {
  return row_start_[j] + i - 1;
}

Lattice::Id Lattice::id(const lc_provenance& p) const {
  if (p.face < 0 || static_cast<std::size_t>(p.face) >= mesh_.triangles.size() || p.denominator == 0)
    return kNone;
  const std::int64_t denominator = p.denominator;
  if (std::int64_t{p.i} + p.j > denominator) return kNone;
  const Id first = first_interior_ + face_points_ * p.face;
  if ((p.i * n_) % denominator != 0 || (p.j * n_) % denominator != 0)
    return std::int64_t{3} * p.i == denominator && p.i == p.j ? first + face_points_ - 1 : kNone;
  const std::int64_t i = p.i * n_ / denominator, j = p.j * n_ / denominator, h = n_ - i - j;
  if (i > 0 && j > 0 && h > 0) return first + interior(i, j);

  // On the border of the face: a corner, or `along` steps from corner k to corner k+1.
  const auto& corner = mesh_.triangles[p.face];
  if (h == n_) return corner[0];
  if (i == n_) return corner[1];
  if (j == n_) return corner[2];
  const int k = j == 0 ? 0 : h == 0 ? 1 : 2;
  const std::int64_t along = k == 0 ? i : k == 1 ? j : h;
  const std::int64_t from_smaller = corner[k] < corner[(k + 1) % 3] ? along : n_ - along;
  return first_edge_ + (n_ - 1) * face_edges_[p.face][k] + from_smaller - 1;
}

std::optional<Lattice::Coordinates> Lattice::in_face(Id id, std::int32_t face) const {
  const auto& corner = mesh_.triangles[face];
  // Barycentric steps at corners k and k+1 to (l1, l2).
  const auto on_side = [&](int k, std::int64_t along) -> Coordinates {
    const std::int64_t at_next = 3 * along, at_k = 3 * (n_ - along);
    if (k == 0) return {at_next, 0};
    if (k == 1) return {at_k, at_next};
    return {0, at_k};
  };
  if (is_vertex(id)) {
    for (int k = 0; k < 3; ++k)
      if (corner[k] == id) return on_side(k, 0);
    return std::nullopt;
  }
  if (is_shared(id)) {
    const auto edge = static_cast<std::int32_t>((id - first_edge_) / (n_ - 1));
    const std::int64_t from_smaller = (id - first_edge_) % (n_ - 1) + 1;
    for (int k = 0; k < 3; ++k)
      if (face_edges_[face][k] == edge)
        return on_side(k, corner[k] == edges_[edge].a ? from_smaller : n_ - from_smaller);
    return std::nullopt;
  }
  if ((id - first_interior_) / face_points_ != face) return std::nullopt;
  const Id within = (id - first_interior_) % face_points_;
  if (within == face_points_ - 1) return Coordinates{n_, n_};  // (1/3, 1/3)
  const auto row = std::upper_bound(row_start_.begin() + 1, row_start_.begin() + n_ - 1, within) - 1;
  const std::int64_t j = row - row_start_.begin();
  return Coordinates{3 * (within - *row + 1), 3 * j};
}

lc_provenance Lattice::provenance(Id id) const {
  std::int32_t face = 0;
  if (is_vertex(id)) {
    face = vertex_face_[id];
  } else if (is_shared(id)) {
    face = edges_[(id - first_edge_) / (n_ - 1)].face[0];
  } else {
    face = static_cast<std::int32_t>((id - first_interior_) / face_points_);
  }
  const Coordinates c = *in_face(id, face);
  const std::int64_t divisor = std::gcd(std::gcd(c.i, c.j), scale());
  return {face, static_cast<std::uint32_t>(c.i / divisor), static_cast<std::uint32_t>(c.j / divisor),
          static_cast<std::uint32_t>(scale() / divisor)};
}

std::string fraction(std::uint64_t numerator, std::uint64_t denominator) {
  const std::uint64_t divisor = std::gcd(numerator, denominator);
  if (numerator == 0 || divisor == 0) return "0";
  if (numerator == denominator) return "1";
  return fmt::format("{}/{}", numerator / divisor, denominator / divisor);
}

}  // namespace limitcheck::verify
