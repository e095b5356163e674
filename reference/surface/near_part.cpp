// SPDX-License-Identifier: MIT
#include "reference/surface/near_part.h"

#include <algorithm>
#include <map>

#include "data/cut_out.h"
#include "reference/catmull_clark/refine.h"
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
      arf_set_d(arb_midref(term_.raw()), p[c]);
      arf_add(arb_midref(sum_[c].raw()), arb_midref(sum_[c].raw()), arb_midref(term_.raw()), ARF_PREC_EXACT,
              ARF_RND_DOWN);
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

/// A sum of multiples of points, and of one point that is none of the mesh, exactly.
class WeightedSum {
 public:
  /// A multiple by a fraction.
  void add(long numerator, long denominator, const std::array<double, 3>& p) {
    by_weight_[{denominator, numerator}].add(p);
  }
  void add_middle(long denominator) { ++middles_[denominator]; }
  Position value(const Position& middle = {}) const {
    Position all{};
    for (const auto& [weight, sum] : by_weight_)
      all = all + sum.value() * Rational(weight.second, weight.first);
    for (const auto& [denominator, count] : middles_) all = all + middle * Rational(count, denominator);
    return all;
  }

 private:
  std::map<std::pair<long, long>, Sum> by_weight_;
  std::map<long, long> middles_;
};

class Search {
 public:
  Search(const Topology& topology, const std::function<std::array<double, 3>(std::int32_t)>& position,
         int most)
      : topology_(topology), position_(position), most_(static_cast<std::size_t>(most)) {}

  /// Of a face of many corners. After one step its middle is a vertex of as many quads, and the point lies in the quad
  /// at one of the corners, with the same parameters.
  std::optional<NearPart> of_polygon(std::size_t face, int corner, const Rational& to_middle) const {
    const auto corners = topology_.faces()[face];
    const auto n = static_cast<long>(corners.size());
    if (to_middle == 0 || 2 * reach(to_middle) + 6 >= n) return std::nullopt;
    const auto after_step = middle_and_sums(face);
    if (!after_step) return std::nullopt;
    const auto& [middle, edge_points, vertex_points] = *after_step;

    // The faces around the corners that are near. Of the face itself, these corners and one that makes up its middle.
    std::map<std::int32_t, std::int32_t> number;
    std::vector<Vec3<Rational>> positions;
    const auto add = [&](std::int32_t v) {
      const auto [at, fresh] = number.try_emplace(v, static_cast<std::int32_t>(positions.size()));
      if (fresh) positions.push_back(point(exact(v)));
      return at->second;
    };
    data::Faces faces;
    std::vector<std::int32_t> polygon, near;
    Position kept{};
    for (long i = -reach(to_middle) - 1; i <= reach(to_middle) + 1; ++i) {
      const std::int32_t v = corners[static_cast<std::size_t>(((corner + i) % n + n) % n)];
      polygon.push_back(add(v));
      kept = kept + exact(v);
      for (const std::int32_t f : topology_.sector(v).faces)
        if (f != static_cast<std::int32_t>(face) && std::find(near.begin(), near.end(), f) == near.end())
          near.push_back(f);
    }
    polygon.push_back(static_cast<std::int32_t>(positions.size()));
    positions.push_back(point(middle * Rational(static_cast<long>(polygon.size())) - kept));
    faces.push_back(polygon);
    for (const std::int32_t f : near) {
      std::vector<std::int32_t> its;
      for (const std::int32_t v : topology_.faces()[static_cast<std::size_t>(f)]) its.push_back(add(v));
      faces.push_back(its);
    }
    for (const std::int32_t v : data::split_fans(faces, positions.size()))
      positions.push_back(positions[static_cast<std::size_t>(v)]);

    // Of the step the quads at these corners but the outermost, and those that touch the one with the point.
    const Topology coarse(positions.size(), faces);
    const std::vector<Vec3<Rational>> refined = catmull_clark::points_after_step(coarse, positions);
    const data::Faces quads = catmull_clark::refined_faces(coarse);
    const std::size_t size = polygon.size(), here = size / 2 - 1;
    std::vector<std::int32_t> chosen{static_cast<std::int32_t>(here)};
    for (std::size_t q = 1; q < quads.size(); ++q) {
      const bool touches = std::ranges::find_first_of(quads[q], quads[here]) != quads[q].end();
      if (q != here && (q < size ? q + 2 < size : touches)) chosen.push_back(static_cast<std::int32_t>(q));
    }
    const data::CutOut cut = data::cut_out(quads, chosen);
    NearPart part{cut.faces, {}, {}, 0};
    for (const std::int32_t v : cut.vertices) {
      const Vec3<Rational>& p = refined[static_cast<std::size_t>(v)];
      part.positions.push_back({p.x, p.y, p.z});
    }
    const Position centroids =
        (vertex_points + edge_points * Rational(2) + middle * Rational(n)) * Rational(1, 4);
    close(part, Topology(cut.vertices.size(), cut.faces), cut.faces[0][2], n, edge_points, &centroids);
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
    for (const std::size_t k : large) {
      const Sector all = topology_.sector(corners[k]);
      Sum neighbours;
      for (const std::int32_t r : all.neighbours) neighbours.add(position_(r));
      WeightedSum centroids;
      for (const std::int32_t f : all.faces) {
        const auto its = topology_.faces()[static_cast<std::size_t>(f)];
        for (const std::int32_t c : its) centroids.add(1, static_cast<long>(its.size()), position_(c));
      }
      const Position of_faces = centroids.value();
      close(part, open, cut.faces[0][k], static_cast<long>(all.faces.size()), neighbours.value(),
            quads ? &of_faces : nullptr);
    }
    return part;
  }

 private:
  static long reach(const Rational& distance) { return kReach + steps_to_corner(distance); }
  Position exact(std::int32_t v) const {
    const auto p = position_(v);
    return {Rational(p[0]), Rational(p[1]), Rational(p[2])};
  }

  static Vec3<Rational> point(const Position& p) { return {p[0], p[1], p[2]}; }

  /// The centroid of a face, and after a step the sums of the points of its edges and of its corners (masks.h). Nothing
  /// where one of the faces around it has many corners, too.
  std::optional<std::array<Position, 3>> middle_and_sums(std::size_t face) const {
    const auto corners = topology_.faces()[face];
    const auto n = static_cast<long>(corners.size());
    Sum all;
    for (const std::int32_t v : corners) all.add(position_(v));
    const Position middle = all.value() * Rational(1, n);
    WeightedSum edge_points, vertex_points;
    const auto add_face = [&](WeightedSum& sum, std::int32_t f, long share) {
      if (f == static_cast<std::int32_t>(face)) return sum.add_middle(share), true;
      const auto its = topology_.faces()[static_cast<std::size_t>(f)];
      for (const std::int32_t c : its) sum.add(1, share * static_cast<long>(its.size()), position_(c));
      return its.size() <= most_;
    };
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const std::int32_t v = corners[k];
      const Edge& edge = topology_.edges()[static_cast<std::size_t>(topology_.edge(face, k))];
      for (const std::int32_t end : {edge.a, edge.b})
        edge_points.add(1, edge.on_boundary() ? 2 : 4, position_(end));
      if (!edge.on_boundary())
        for (const std::int32_t f : {edge.left_face, edge.right_face})
          if (!add_face(edge_points, f, 4)) return std::nullopt;
      const Sector sector = topology_.sector(v);
      const auto valence = static_cast<long>(sector.faces.size());
      if (!sector.closed) {
        vertex_points.add(3, 4, position_(v));
        for (const std::int32_t end : {sector.neighbours.front(), sector.neighbours.back()})
          vertex_points.add(1, 8, position_(end));
        continue;
      }
      vertex_points.add(valence - 2, valence, position_(v));
      for (const std::int32_t r : sector.neighbours) vertex_points.add(1, valence * valence, position_(r));
      for (const std::int32_t f : sector.faces)
        if (!add_face(vertex_points, f, valence * valence)) return std::nullopt;
    }
    return std::array{middle, edge_points.value(middle), vertex_points.value(middle)};
  }

  /// Adds two faces between the ends of the fan at a vertex, whose points make up the means.
  ///   n, neighbours, centroids   how many faces the vertex has in the mesh, and the sums of its neighbours and of the
  ///                              faces' centroids; none: of triangles
  static void close(NearPart& part, const Topology& open, std::int32_t v, long n, const Position& neighbours,
                    const Position* centroids) {
    const Sector kept = open.sector(v);
    const std::int32_t front = kept.neighbours.front(), back = kept.neighbours.back();
    const auto fresh = static_cast<std::int32_t>(part.positions.size());
    const auto m = static_cast<long>(kept.faces.size()) + 2;
    const auto at = [&](std::int32_t p) -> const Position& {
      return part.positions[static_cast<std::size_t>(p)];
    };
    Position missing = neighbours * Rational(m, n);
    for (const std::int32_t r : kept.neighbours) missing = missing - at(r);
    part.valences[v] = static_cast<int>(n);
    if (centroids == nullptr) {
      part.faces.push_back({v, back, fresh});
      part.faces.push_back({v, fresh, front});
      part.positions.push_back(missing);
      return;
    }
    Position still = *centroids * Rational(m, n);
    for (const std::int32_t f : kept.faces) {
      const auto face = open.faces()[static_cast<std::size_t>(f)];
      for (const std::int32_t c : face) still = still - at(c) * Rational(1, static_cast<long>(face.size()));
    }
    const Position far =
        (still * Rational(4) - at(v) * Rational(2) - at(front) - at(back) - missing * Rational(2)) *
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
    return search.of_polygon(f, corner, std::max(Rational(1 - a), Rational(1 - b)));
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
