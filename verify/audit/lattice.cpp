// SPDX-License-Identifier: MIT
#include "verify/audit/lattice.h"

#include <fmt/core.h>

#include <algorithm>
#include <numeric>

#include "data/error.h"

namespace limitcheck::verify {

Lattice::Lattice(const data::ControlMesh& mesh, int depth)
    : mesh_(mesh),
      depth_(depth),
      n_(std::int64_t{1} << depth),
      first_edge_(static_cast<Id>(mesh.positions.size())) {
  if (depth < 0 || depth > 15) throw data::ArgumentError("Lattice: depth must be 0..15");

  // Edges: sort the sides of all faces by their vertices; the two sides of an edge come together.
  struct Side {
    std::int32_t a, b, face;
    int corner;
  };
  std::vector<Side> sides;
  sides.reserve(corner_count());
  vertex_face_.assign(mesh.positions.size(), -1);
  for (std::int32_t f = 0; f < face_count(); ++f)
    for (int k = 0; k < domain_.corners(); ++k) {
      const std::int32_t from = vertex(f, k), to = vertex(f, domain_.next(k));
      sides.push_back({std::min(from, to), std::max(from, to), f, k});
      if (vertex_face_[from] < 0) vertex_face_[from] = f;
    }
  std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
    return x.a != y.a ? x.a < y.a : x.b != y.b ? x.b < y.b : x.face < y.face;
  });
  face_edges_.resize(mesh.faces.size());
  for (const Side& s : sides) {
    if (edges_.empty() || edges_.back().a != s.a || edges_.back().b != s.b)
      edges_.push_back({s.a, s.b, {-1, -1}, {0, 0}});
    Edge& edge = edges_.back();
    const int slot = edge.face[0] < 0 ? 0 : 1;
    edge.face[slot] = s.face;
    edge.corner[slot] = static_cast<std::int8_t>(s.corner);
    face_edges_[s.face][s.corner] = static_cast<std::int32_t>(edges_.size() - 1);
  }
  first_interior_ = first_edge_ + (n_ - 1) * static_cast<Id>(edges_.size());

  row_start_.assign(static_cast<std::size_t>(n_) + 1, 0);
  for (std::int64_t j = 1; j < n_; ++j)
    row_start_[j + 1] = row_start_[j] + domain_.inner_points_in_row(j, n_);
  face_points_ = row_start_[n_] + 1;  // and the centre
}

Lattice::Id Lattice::id(const lc_provenance& p) const {
  if (p.face < 0 || p.face >= face_count() || p.denominator == 0) return kNone;
  const std::int64_t denominator = p.denominator;
  if (!domain_.contains(point_of(p), denominator)) return kNone;
  const Id first = first_interior_ + face_points_ * p.face;
  if ((p.i * n_) % denominator != 0 || (p.j * n_) % denominator != 0)
    return domain_.is_centre(point_of(p), denominator) ? first + face_points_ - 1 : kNone;
  const Coordinates at{p.i * n_ / denominator, p.j * n_ / denominator};
  const auto place = domain_.side_of(at, n_);
  if (!place) return first + row_start_[at.j] + at.i - 1;
  const auto [side, along] = *place;
  const std::int32_t from = vertex(p.face, side), to = vertex(p.face, domain_.next(side));
  if (along == 0) return from;
  const std::int64_t from_smaller = from < to ? along : n_ - along;
  return first_edge_ + (n_ - 1) * face_edges_[p.face][side] + from_smaller - 1;
}

std::optional<int> Lattice::corner_of(std::int32_t face, Id id) const {
  for (int k = 0; k < domain_.corners(); ++k)
    if (vertex(face, k) == id) return k;
  return std::nullopt;
}

std::optional<Lattice::Coordinates> Lattice::in_face(Id id, std::int32_t face) const {
  const std::int64_t thirds = domain_.centre_denominator();
  const auto on_side = [&](int k, std::int64_t along) { return domain_.on_side(k, thirds * along, scale()); };
  if (is_vertex(id)) {
    const auto k = corner_of(face, id);
    return k ? std::optional(on_side(*k, 0)) : std::nullopt;
  }
  if (is_shared(id)) {
    const auto edge = static_cast<std::int32_t>((id - first_edge_) / (n_ - 1));
    const std::int64_t from_smaller = (id - first_edge_) % (n_ - 1) + 1;
    for (int k = 0; k < domain_.corners(); ++k)
      if (face_edges_[face][k] == edge)
        return on_side(k, vertex(face, k) == edges_[edge].a ? from_smaller : n_ - from_smaller);
    return std::nullopt;
  }
  if ((id - first_interior_) / face_points_ != face) return std::nullopt;
  if (is_centre(id)) return Coordinates{n_, n_};
  const Id within = (id - first_interior_) % face_points_;
  const auto row = std::upper_bound(row_start_.begin() + 1, row_start_.begin() + n_, within) - 1;
  const std::int64_t j = row - row_start_.begin();
  return Coordinates{thirds * (within - *row + 1), thirds * j};
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
