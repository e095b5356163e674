// SPDX-License-Identifier: MIT
#include "reference/surface/near_part.h"

#include <algorithm>
#include <map>

#include "data/cut_out.h"
#include "reference/number/ball.h"
#include "reference/point/parameter_exact.h"

namespace limitcheck::reference {
namespace {

using Position = std::array<Rational, 3>;

// Beyond the steps before a point is away from a vertex: those that the evaluators take at first, and what the last one
// reaches.
constexpr long kReach = 8;

/// A sum of points, exactly.
class Sum {
 public:
  void add(const std::array<double, 3>& p) {
    for (std::size_t c = 0; c < 3; ++c) {
      arb_set_d(term_.raw(), p[c]);
      arb_add(sum_[c].raw(), sum_[c].raw(), term_.raw(), ARF_PREC_EXACT);
    }
  }
  Position value() const {
    Position result;
    for (std::size_t c = 0; c < 3; ++c) {
      fmpq_t x;
      fmpq_init(x);
      arf_get_fmpq(x, arb_midref(sum_[c].raw()));
      fmpq_get_mpz_frac(mpq_numref(result[c].backend().data()), mpq_denref(result[c].backend().data()), x);
      fmpq_clear(x);
    }
    return result;
  }

 private:
  std::array<Ball, 3> sum_;
  Ball term_;
};

Position operator+(Position a, const Position& b) {
  for (std::size_t c = 0; c < 3; ++c) a[c] += b[c];
  return a;
}
Position operator*(Position a, const Rational& s) {
  for (Rational& x : a) x *= s;
  return a;
}
Position operator-(const Position& a, const Position& b) {
  return a + b * Rational(-1);
}

class Search {
 public:
  Search(const Topology& topology, const std::function<std::array<double, 3>(std::int32_t)>& position,
         int most)
      : topology_(topology), position_(position), most_(static_cast<std::size_t>(most)) {}

  /// The corners of a face that touches no other, around one of them, and a last corner that makes up the centroid.
  std::optional<NearPart> of_polygon(std::size_t face, int corner, const Rational& to_middle) const {
    const auto corners = topology_.faces()[face];
    const auto n = static_cast<long>(corners.size());
    const auto alone = [&](std::int32_t v) { return topology_.sector(v).faces.size() == 1; };
    if (to_middle == 0 || 2 * reach(to_middle) + 2 >= n ||
        !std::all_of(corners.begin(), corners.end(), alone))
      return std::nullopt;
    Sum all, kept;
    for (const std::int32_t v : corners) all.add(position_(v));
    NearPart part;
    for (long i = -reach(to_middle); i <= reach(to_middle); ++i) {
      const std::int32_t v = corners[static_cast<std::size_t>(((corner + i) % n + n) % n)];
      kept.add(position_(v));
      part.positions.push_back(exact(v));
    }
    part.corner = static_cast<int>(reach(to_middle));
    const auto m = static_cast<std::int32_t>(part.positions.size()) + 1;
    part.positions.push_back(all.value() * Rational(m, n) - kept.value());
    std::vector<std::int32_t> polygon;
    for (std::int32_t i = 0; i < m; ++i) polygon.push_back(i);
    part.faces.push_back(polygon);
    part.valences[2 * m] = static_cast<int>(n);  // after the m vertices and edges of a step
    return part;
  }

  ///   distances   of the point from each corner of the face, at most 1
  std::optional<NearPart> of_vertices(std::size_t face, const std::vector<Rational>& distances,
                                      bool quads) const {
    std::vector<std::int32_t> near{static_cast<std::int32_t>(face)};
    std::vector<std::size_t> large;  // corners of the face
    const auto corners = topology_.faces()[face];
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Sector sector = topology_.sector(corners[k]);
      const auto n = static_cast<long>(sector.faces.size());
      long first = 0, last = n - 1;
      if (sector.faces.size() > most_) {
        if (!sector.closed || distances[k] == 0) return std::nullopt;
        const long at = topology_.ring_index(face, k), on_either_side = reach(distances[k]);
        if (2 * on_either_side + 2 < n) {
          large.push_back(k);
          first = at - on_either_side, last = at + on_either_side;
        }
      }
      for (long i = first; i <= last; ++i)
        near.push_back(sector.faces[static_cast<std::size_t>((i + n) % n)]);
    }
    if (large.empty()) return std::nullopt;
    std::vector<std::int32_t> once;
    for (const std::int32_t f : near) {
      if (topology_.faces()[static_cast<std::size_t>(f)].size() > most_) return std::nullopt;
      if (std::find(once.begin(), once.end(), f) == once.end()) once.push_back(f);
    }
    const data::CutOut cut = data::cut_out(topology_.faces(), once);
    const Topology open(cut.vertices.size(), cut.faces);
    NearPart part{cut.faces, {}, {}, 0};
    for (const std::int32_t v : cut.vertices) part.positions.push_back(exact(v));
    for (const std::size_t k : large) close(part, open, cut.faces[0][k], corners[k], quads);
    return part;
  }

 private:
  static long reach(const Rational& distance) { return kReach + steps_to_corner(distance); }
  Position exact(std::int32_t v) const {
    const auto p = position_(v);
    return {Rational(p[0]), Rational(p[1]), Rational(p[2])};
  }

  /// Adds two faces between the ends of the fan at a vertex, whose points make up the means.
  ///   v, whole   the vertex in the part, and in the mesh
  void close(NearPart& part, const Topology& open, std::int32_t v, std::int32_t whole, bool quads) const {
    const Sector all = topology_.sector(whole), kept = open.sector(v);
    const std::int32_t front = kept.neighbours.front(), back = kept.neighbours.back();
    const auto fresh = static_cast<std::int32_t>(part.positions.size());
    const auto m = static_cast<int>(kept.faces.size()) + 2, n = static_cast<int>(all.faces.size());
    const auto at = [&](std::int32_t p) -> const Position& {
      return part.positions[static_cast<std::size_t>(p)];
    };
    Sum neighbours;
    for (const std::int32_t r : all.neighbours) neighbours.add(position_(r));
    Position missing = neighbours.value() * Rational(m, n);
    for (const std::int32_t r : kept.neighbours) missing = missing - at(r);
    part.valences[v] = n;
    if (!quads) {
      part.faces.push_back({v, back, fresh});
      part.faces.push_back({v, fresh, front});
      part.positions.push_back(missing);
      return;
    }
    std::map<std::size_t, Sum> by_size;  // of the faces
    for (const std::int32_t f : all.faces) {
      const auto face = topology_.faces()[static_cast<std::size_t>(f)];
      Sum& sum = by_size[face.size()];
      for (const std::int32_t c : face) sum.add(position_(c));
    }
    Position centroids{};
    for (const auto& [size, sum] : by_size)
      centroids = centroids + sum.value() * Rational(m, static_cast<long>(n) * static_cast<long>(size));
    for (const std::int32_t f : kept.faces) {
      const auto face = open.faces()[static_cast<std::size_t>(f)];
      for (const std::int32_t c : face)
        centroids = centroids - at(c) * Rational(1, static_cast<long>(face.size()));
    }
    const Position far =
        (centroids * Rational(4) - at(v) * Rational(2) - at(front) - at(back) - missing * Rational(2)) *
        Rational(1, 2);
    part.faces.push_back({v, back, fresh + 1, fresh});
    part.faces.push_back({v, fresh, fresh + 2, front});
    part.positions.insert(part.positions.end(), {missing, far, far});
  }

  const Topology& topology_;
  const std::function<std::array<double, 3>(std::int32_t)>& position_;
  std::size_t most_;
};

}  // namespace

std::optional<NearPart> near_part(const Topology& topology,
                                  const std::function<std::array<double, 3>(std::int32_t)>& position,
                                  data::Scheme scheme, int face, int corner, const Parameter& u,
                                  const Parameter& v, int most) {
  const auto f = static_cast<std::size_t>(face);
  const std::size_t corners = topology.faces()[f].size();
  const Rational a = exact_value(u), b = exact_value(v), half(1, 2);
  if (a < 0 || b < 0 || a > 1 || b > 1 || corner < 0 || static_cast<std::size_t>(corner) >= corners)
    return std::nullopt;  // who evaluates says what is wrong
  const Search search(topology, position, most);
  if (scheme == data::Scheme::kLoop) {
    if (a + b > 1) return std::nullopt;
    return search.of_vertices(f, {a + b, 1 - a, 1 - b}, false);
  }
  if (corners > static_cast<std::size_t>(most))
    return search.of_polygon(f, corner, std::max(Rational(1 - a), Rational(1 - b)) * half);
  std::vector<Rational> distances(corners, half);
  if (corners == 4) {
    const Rational right = 1 - a, up = 1 - b;
    distances = {std::max(a, b), std::max(right, b), std::max(right, up), std::max(a, up)};
  } else {
    distances[static_cast<std::size_t>(corner)] = std::max(a, b) * half;
  }
  std::optional<NearPart> part = search.of_vertices(f, distances, true);
  if (part) part->corner = corner;
  return part;
}

}  // namespace limitcheck::reference
