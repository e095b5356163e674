// SPDX-License-Identifier: MIT
#include "verify/subject/lattice.h"

#include <fmt/core.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

#include "data/error.h"

namespace limitcheck::verify {
namespace {

std::set<std::pair<std::int32_t, std::int32_t>> lasting_edges(const data::ControlMesh& mesh) {
  std::set<std::pair<std::int32_t, std::int32_t>> edges;
  for (const data::SharpEdge& e : mesh.sharpness.edges)
    if (e.sharpness >= data::kInfiniteSharpness) edges.insert(std::minmax(e.a, e.b));
  return edges;
}

}  // namespace

Lattice::Lattice(const data::ControlMesh& mesh, data::Scheme scheme, int depth, std::span<const Place> others)
    : mesh_(mesh),
      scheme_(scheme),
      depth_(depth),
      n_(std::int64_t{1} << depth),
      scale_((scheme == data::Scheme::kLoop ? 3 : 2) * n_),
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
    for (int k = 0; k < domain(f).corners(); ++k) {
      const std::int32_t from = vertex(f, k), to = vertex(f, domain(f).next(k));
      sides.push_back({std::min(from, to), std::max(from, to), f, k});
      if (vertex_face_[from] < 0) vertex_face_[from] = f;
    }
  std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
    return x.a != y.a ? x.a < y.a : x.b != y.b ? x.b < y.b : x.face < y.face;
  });
  corner_edge_.resize(corner_count());
  for (const Side& s : sides) {
    if (edges_.empty() || edges_.back().a != s.a || edges_.back().b != s.b)
      edges_.push_back({s.a, s.b, {-1, -1}, {0, 0}});
    Edge& edge = edges_.back();
    const int slot = edge.face[0] < 0 ? 0 : 1;
    edge.face[slot] = s.face;
    edge.corner[slot] = s.corner;
    corner_edge_[corner_number(s.face, s.corner)] = static_cast<std::int32_t>(edges_.size() - 1);
  }

  first_inner_.reserve(mesh.faces.size() + 1);
  first_inner_.push_back(first_edge_ + (n_ - 1) * static_cast<Id>(edges_.size()));
  for (std::int32_t f = 0; f < face_count(); ++f) {
    const bool bare = n_ % domain(f).centre_denominator() != 0;
    first_inner_.push_back(first_inner_.back() + domain(f).inner_count(n_) + bare);
  }
  list_corners_of_vertices();
  first_other_ = first_inner_.back();
  add_others(others);
}

namespace {

// In as few steps to a side as it can be said.
std::pair<FaceDomain::Point, std::int64_t> reduced(FaceDomain::Point p, std::int64_t steps) {
  const std::int64_t divisor = std::gcd(std::gcd(p.i, p.j), steps);
  return {{p.i / divisor, p.j / divisor, p.part}, steps / divisor};
}

}  // namespace

Lattice::Other Lattice::named(std::int32_t face, Coordinates at) const {
  const FaceDomain its = domain(face);
  if (const auto on_side = its.side_of(at, scale_)) {
    const auto [side, along] = *on_side;
    const bool up = vertex(face, side) < vertex(face, its.next(side));
    return {false, corner_edge_[corner_number(face, side)], 0, up ? along : scale_ - along, 0};
  }
  const Coordinates c = its.canonical(at, scale_);
  return {true, face, c.part, c.i, c.j};
}

void Lattice::add_others(std::span<const Place> others) {
  constexpr std::int64_t kMostScale = std::int64_t{1} << 32;
  std::vector<Place> off;
  for (const Place& p : others) {
    if (p.face < 0 || p.face >= face_count() || p.denominator == 0 || id(p) != kNone) continue;
    const std::int64_t whole = domain(p.face).steps(p.denominator);
    if (!domain(p.face).contains(point_of(p), whole)) continue;
    const std::int64_t steps = reduced(point_of(p), whole).second, finer = steps / std::gcd(steps, scale_);
    if (finer > (kMostScale - 1) / scale_) continue;
    scale_ *= finer;
    off.push_back(p);
  }
  for (const Place& p : off)
    others_.push_back(named(p.face, *at_scale(p.face, point_of(p), domain(p.face).steps(p.denominator))));
  std::sort(others_.begin(), others_.end());
  others_.erase(std::unique(others_.begin(), others_.end()), others_.end());
}

std::optional<Lattice::Coordinates> Lattice::at_scale(std::int32_t face, FaceDomain::Point p,
                                                      std::int64_t steps) const {
  if (!domain(face).contains(p, steps)) return std::nullopt;
  const auto [least, of] = reduced(p, steps);
  if (scale_ % of != 0) return std::nullopt;
  return Coordinates{least.i * (scale_ / of), least.j * (scale_ / of), p.part};
}

// Of a point off the lattice.
Lattice::Id Lattice::id_of_other(std::int32_t face, FaceDomain::Point p, std::int64_t steps) const {
  const auto at = others_.empty() ? std::nullopt : at_scale(face, p, steps);
  if (!at) return kNone;
  const Other name = named(face, *at);
  const auto found = std::lower_bound(others_.begin(), others_.end(), name);
  return found != others_.end() && *found == name ? first_other_ + (found - others_.begin()) : kNone;
}

Lattice::Id Lattice::id(const Place& p) const {
  if (p.face < 0 || p.face >= face_count() || p.denominator == 0) return kNone;
  return id(p.face, point_of(p), domain(p.face).steps(p.denominator));
}

Lattice::Id Lattice::id(std::int32_t face, FaceDomain::Point p, std::int64_t steps) const {
  const FaceDomain its = domain(face);
  if (!its.contains(p, steps)) return kNone;
  if ((p.i * n_) % steps != 0 || (p.j * n_) % steps != 0)
    return its.is_centre(p, steps) ? first_inner_[face + 1] - 1 : id_of_other(face, p, steps);
  const Coordinates at{p.i * n_ / steps, p.j * n_ / steps, p.part};
  const auto on_side = its.side_of(at, n_);
  if (!on_side) return first_inner_[face] + its.inner_number(at, n_);
  const auto [side, along] = *on_side;
  const std::int32_t from = vertex(face, side), to = vertex(face, its.next(side));
  if (along == 0) return from;
  const std::int64_t from_smaller = from < to ? along : n_ - along;
  return first_on_edge(corner_edge_[corner_number(face, side)]) + from_smaller - 1;
}

std::optional<int> Lattice::corner_of(std::int32_t face, Id id) const {
  const auto begin = vertex_corners_.begin() + first_at_vertex_[id],
             end = vertex_corners_.begin() + first_at_vertex_[id + 1];
  const std::int32_t first = corner_number(face, 0);
  const auto found = std::lower_bound(begin, end, first);
  return found != end && *found < first + domain(face).corners() ? std::optional(*found - first)
                                                                 : std::nullopt;
}

void Lattice::list_corners_of_vertices() {
  const std::span<const std::int32_t> corners = mesh_.faces.corners();
  first_at_vertex_.assign(mesh_.positions.size() + 1, 0);
  for (const std::int32_t v : corners) ++first_at_vertex_[v + 1];
  std::partial_sum(first_at_vertex_.begin(), first_at_vertex_.end(), first_at_vertex_.begin());
  vertex_corners_.resize(corners.size());
  std::vector<std::int32_t> next(first_at_vertex_.begin(), first_at_vertex_.end() - 1);
  for (std::int32_t c = 0; c < corner_count(); ++c) vertex_corners_[next[corners[c]]++] = c;
}

std::int32_t Lattice::face_of_inner(Id id) const {
  if (!is_on_lattice(id)) return others_[id - first_other_].of;
  return static_cast<std::int32_t>(std::upper_bound(first_inner_.begin(), first_inner_.end(), id) -
                                   first_inner_.begin()) -
         1;
}

bool Lattice::is_bare_centre(Id id) const {
  if (is_shared(id) || !is_on_lattice(id)) return false;
  const std::int32_t face = face_of_inner(id);
  return id - first_inner_[face] == domain(face).inner_count(n_);
}

std::optional<Lattice::Coordinates> Lattice::in_face(Id id, std::int32_t face) const {
  const FaceDomain its = domain(face);
  const std::int64_t finer = scale() / n_;
  if (is_vertex(id)) {
    const auto k = corner_of(face, id);
    return k ? std::optional(its.corner_point(*k, scale())) : std::nullopt;
  }
  if (is_shared(id)) {
    const Edge& edge = edges_[edge_of(id)];
    const std::int64_t from_smaller =
        is_on_lattice(id) ? finer * (id - first_on_edge(edge_of(id)) + 1) : others_[id - first_other_].i;
    for (std::size_t s = 0; s < 2; ++s)
      if (edge.face[s] == face)
        return its.on_side(edge.corner[s],
                           vertex(face, edge.corner[s]) == edge.a ? from_smaller : scale() - from_smaller,
                           scale());
    return std::nullopt;
  }
  if (!is_on_lattice(id)) {
    const Other& at = others_[id - first_other_];
    return at.of == face ? std::optional(Coordinates{at.i, at.j, at.part}) : std::nullopt;
  }
  if (id < first_inner_[face] || id >= first_inner_[face + 1]) return std::nullopt;
  const Id within = id - first_inner_[face];
  if (within == its.inner_count(n_)) {
    const std::int64_t middle = scale() / its.centre_denominator();
    return Coordinates{middle, middle};
  }
  const FaceDomain::Point p = its.inner_point(within, n_);
  return Coordinates{finer * p.i, finer * p.j, p.part};
}

Place Lattice::place(Id id) const {
  const std::int32_t face = is_vertex(id)   ? vertex_face_[id]
                            : is_shared(id) ? edges_[edge_of(id)].face[0]
                                            : face_of_inner(id);
  return place(face, *in_face(id, face));
}

Place Lattice::place(std::int32_t face, Coordinates at) const {
  const std::int64_t whole = domain(face).denominator(scale()),
                     divisor = std::gcd(std::gcd(at.i, at.j), whole);
  const auto number = [&](std::int64_t k) { return static_cast<std::uint32_t>(k / divisor); };
  return {face, number(at.i), number(at.j), number(whole), at.part};
}

std::vector<std::int32_t> fans_of_corners(const Lattice& lattice,
                                          const std::function<bool(const Lattice::Edge&)>& joins,
                                          const std::function<bool(std::int32_t)>& counts) {
  // Sets of corners that grow together.
  std::vector<std::int32_t> parent(lattice.corner_count());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](std::int32_t c) {
    while (parent[c] != c) c = parent[c] = parent[parent[c]];
    return c;
  };
  for (const Lattice::Edge& edge : lattice.edges()) {
    if (edge.on_boundary() || !joins(edge)) continue;
    for (int s = 0; s < 2; ++s) {  // the two faces run along it in opposite directions
      const std::int32_t f = edge.face[s], g = edge.face[1 - s];
      parent[root(lattice.corner_number(f, edge.corner[s]))] =
          root(lattice.corner_number(g, lattice.domain(g).next(edge.corner[1 - s])));
    }
  }
  std::vector<std::int32_t> fan(parent.size(), 0), number(parent.size(), -1);  // number: of each root
  std::vector<std::int32_t> met(lattice.mesh().positions.size(), 0);           // fans of each vertex
  for (std::int32_t f = 0; f < lattice.face_count(); ++f)
    for (int k = 0; k < lattice.domain(f).corners() && counts(f); ++k) {
      const std::int32_t c = lattice.corner_number(f, k);
      std::int32_t& its = number[root(c)];
      if (its < 0) its = met[lattice.vertex(f, k)]++;
      fan[c] = its;
    }
  return fan;
}

Sides::Sides(const Lattice& lattice) : lattice_(lattice) {
  const auto lasting = lasting_edges(lattice.mesh());
  if (lasting.empty()) return;

  // Around a vertex, faces are of one sector that meet in an edge which does not stay sharp.
  const auto stays_sharp = [&](const Lattice::Edge& e) { return lasting.contains({e.a, e.b}); };
  sector_ = fans_of_corners(
      lattice, [&](const Lattice::Edge& e) { return !stays_sharp(e); }, [](std::int32_t) { return true; });
  for (std::size_t k = 0; k < lattice.edges().size(); ++k) {
    const Lattice::Edge& e = lattice.edges()[k];
    if (e.on_boundary() || !stays_sharp(e)) continue;
    for (Lattice::Id i = 0; i < lattice.n() - 1; ++i)
      others_.push_back({lattice.first_on_edge(k) + i, e.face[1]});
  }
  for (Id point = lattice.first_other(); point < lattice.size() && lattice.is_shared(point); ++point) {
    const Lattice::Edge& e = lattice.edges()[lattice.edge_of(point)];
    if (!e.on_boundary() && stays_sharp(e)) others_.push_back({point, e.face[1]});
  }
  first_of_vertices_ = std::ssize(others_);
  // The first face of each sector after that which has the id of the vertex.
  std::vector<std::vector<std::int32_t>> first_face(lattice.mesh().positions.size());
  for (std::int32_t f = 0; f < lattice.face_count(); ++f)
    for (int k = 0; k < lattice.domain(f).corners(); ++k) {
      auto& met = first_face[lattice.vertex(f, k)];
      if (sector_[lattice.corner_number(f, k)] > std::ssize(met)) met.push_back(f);
    }
  for (std::size_t v = 0; v < first_face.size(); ++v)
    for (const std::int32_t f : first_face[v]) others_.push_back({static_cast<Lattice::Id>(v), f});
}

Sides::Id Sides::first_other(Lattice::Id point) const {
  if (none() || !lattice_.is_shared(point)) return -1;
  const auto middle = others_.begin() + first_of_vertices_;
  const auto begin = lattice_.is_vertex(point) ? middle : others_.begin(),
             end = lattice_.is_vertex(point) ? others_.end() : middle;
  const auto found =
      std::lower_bound(begin, end, point, [](const Other& other, Id id) { return other.point < id; });
  return found != end && found->point == point ? lattice_.size() + (found - others_.begin()) : -1;
}

Sides::Id Sides::of(Lattice::Id point, std::int32_t face) const {
  const Id first = first_other(point);
  if (first < 0) return point;
  if (!lattice_.is_vertex(point))
    return lattice_.edges()[lattice_.edge_of(point)].face[1] == face ? first : point;
  const auto k = lattice_.corner_of(face, point);
  const std::int32_t sector = k ? sector_[lattice_.corner_number(face, *k)] : 0;
  return sector == 0 ? point : first + sector - 1;
}

Place Sides::place(Id side) const {
  if (side < lattice_.size()) return lattice_.place(side);
  const Other& other = others_[side - lattice_.size()];
  return lattice_.place(other.face, *lattice_.in_face(other.point, other.face));
}

std::string fraction(std::uint64_t numerator, std::uint64_t denominator) {
  const std::uint64_t divisor = std::gcd(numerator, denominator);
  if (numerator == 0 || divisor == 0) return "0";
  if (numerator == denominator) return "1";
  return fmt::format("{}/{}", numerator / divisor, denominator / divisor);
}

}  // namespace limitcheck::verify
