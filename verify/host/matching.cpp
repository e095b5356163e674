// SPDX-License-Identifier: MIT
#include "verify/host/matching.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <numeric>

namespace limitcheck::verify {
namespace {

using Point = std::array<double, 3>;

constexpr unsigned kNear =
    64;  // candidates that begin nearest to where one is expected, and as many that end so
constexpr std::size_t kSample = 63;             // vertices of a part at which ways are compared
constexpr std::int64_t kMostSteps = 5'000'000;  // sides looked at for a connected part

constexpr double kNowhere = std::numeric_limits<double>::infinity();

std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ x >> 30) * 0xBF58476D1CE4E5B9ULL;
  x = (x ^ x >> 27) * 0x94D049BB133111EBULL;
  return x ^ x >> 31;
}

// The number of each vertex after those at equal coordinates are one.
std::vector<std::int32_t> weld(const Bare& t, std::int64_t* count) {
  using Bits = std::array<std::uint64_t, 3>;
  const auto hash = [](const Bits& b) { return mixed(b[0] + mixed(b[1] + mixed(b[2]))); };
  std::unordered_map<Bits, std::int32_t, decltype(hash)> numbers(static_cast<std::size_t>(t.vertices), hash);
  std::vector<std::int32_t> number(t.vertices);
  for (std::int64_t v = 0; v < t.vertices; ++v)
    number[v] =
        numbers.try_emplace(std::bit_cast<Bits>(t.position(v)), static_cast<std::int32_t>(numbers.size()))
            .first->second;
  *count = static_cast<std::int64_t>(numbers.size());
  return number;
}

bool coincide(std::vector<Point> points) {
  std::sort(points.begin(), points.end());
  return std::adjacent_find(points.begin(), points.end()) != points.end();
}

// Triangles that follow one another and share sides, as one polygon; nothing if they do not.
std::optional<std::vector<std::int32_t>> polygon(std::span<const std::array<std::int32_t, 3>> triangles) {
  std::vector<std::int32_t> corners(triangles[0].begin(), triangles[0].end());
  for (const auto& t : triangles.subspan(1)) {
    bool found = false;
    for (std::size_t k = 0; k < corners.size() && !found; ++k)
      for (std::size_t m = 0; m < 3 && !found; ++m) {
        if (t[m] != corners[(k + 1) % corners.size()] || t[(m + 1) % 3] != corners[k]) continue;
        corners.insert(corners.begin() + static_cast<std::ptrdiff_t>(k) + 1, t[(m + 2) % 3]);
        found = true;
      }
    if (!found) return std::nullopt;
  }
  return corners;
}

// The delivered triangles as cells of the sizes that the refined mesh has, in any order if these are all the same.
std::optional<Cells> cells_of(const Cells& expected, const Bare& t, std::span<const std::int32_t> number,
                              std::int64_t count) {
  Cells cells;
  std::vector<std::array<std::int32_t, 3>> row;
  std::size_t next = 0;
  for (std::int64_t c = 0; c < expected.count(); ++c) {
    row.clear();
    for (std::int64_t k = 2; k < expected.size(c); ++k) {
      const auto& triangle = t.triangles[next++];
      row.push_back({number[triangle[0]], number[triangle[1]], number[triangle[2]]});
    }
    const auto corners = polygon(row);
    if (!corners) return std::nullopt;
    cells.corners.insert(cells.corners.end(), corners->begin(), corners->end());
    cells.first.push_back(static_cast<std::int64_t>(cells.corners.size()));
  }
  if (!cells.connect(count)) return std::nullopt;
  return cells;
}

// What two sides must have in common to lie on each other.
std::uint64_t signature(const Cells& c, std::int64_t side) {
  const auto end = [&c](std::int32_t v) {
    return std::min<std::uint64_t>(c.valence[v], 0x1FFFFF) << 1 | c.on_boundary[v];
  };
  const auto size = static_cast<std::uint64_t>(std::min<std::int64_t>(c.size(c.cell_of[side]), 0x1FFFF));
  return end(c.from(side)) << 41 ^ end(c.to(side)) << 19 ^ size << 1 ^ (c.across[side] < 0 ? 1U : 0U);
}

// The cells that are connected with a cell, itself first; `seen` has those that belong to a part.
std::vector<std::int64_t> part_of(const Cells& c, std::int64_t cell, std::vector<std::uint8_t>& seen) {
  std::vector<std::int64_t> part{cell};
  seen[cell] = 1;
  for (std::size_t k = 0; k < part.size(); ++k)
    for (std::int64_t s = c.first[part[k]]; s < c.first[part[k] + 1]; ++s) {
      if (c.across[s] < 0 || seen[c.cell_of[c.across[s]]] != 0) continue;
      seen[c.cell_of[c.across[s]]] = 1;
      part.push_back(c.cell_of[c.across[s]]);
    }
  return part;
}

// Of each side what it must have in common with one that it lies on: its own, and that of the whole connected part.
std::vector<std::uint64_t> marks(const Cells& c) {
  std::vector<std::uint64_t> mark(c.corners.size());
  for (std::int64_t s = 0; s < std::ssize(mark); ++s) mark[s] = mixed(signature(c, s));
  std::vector<std::uint8_t> seen(static_cast<std::size_t>(c.count()));
  for (std::int64_t start = 0; start < c.count(); ++start) {
    if (seen[start] != 0) continue;
    const auto part = part_of(c, start, seen);
    std::uint64_t sum = 0;
    for (const std::int64_t cell : part)
      for (std::int64_t s = c.first[cell]; s < c.first[cell + 1]; ++s) sum += mark[s];
    for (const std::int64_t cell : part)
      for (std::int64_t s = c.first[cell]; s < c.first[cell + 1]; ++s) mark[s] = mixed(mark[s] + mixed(sum));
  }
  return mark;
}

// Lays a connected part of the delivered cells on the expected ones, from one side on.
class Laying {
 public:
  Laying(const RefinedComplex& expected, const Cells& delivered)
      : complex_(expected),
        expected_(expected.cells),
        delivered_(delivered),
        vertex_(expected.side_at.size(), -1),
        taken_(delivered.valence.size(), -1),
        side_(expected.cells.corners.size(), -1) {}

  // Whether side `to` of what was delivered can lie on side `on`; then `sides` has those of the part, and side_ where they are.
  bool lay(std::int64_t on, std::int64_t to) {
    sides.clear();
    bool fits = put(on, to);
    for (std::size_t k = 0; fits && k < sides.size(); ++k) {
      const std::int64_t a = expected_.across[sides[k]], b = delivered_.across[side_[sides[k]]];
      if ((a < 0) != (b < 0)) fits = false;
      if (fits && a >= 0) fits = side_[a] < 0 ? put(a, b) : side_[a] == b;
    }
    if (!fits) take_away();
    return fits;
  }
  // Forgets the part that was laid last.
  void take_away() {
    for (const std::int64_t s : sides) {
      const std::int32_t v = expected_.from(s);
      if (vertex_[v] >= 0) taken_[vertex_[v]] = -1;
      vertex_[v] = -1;
      side_[s] = -1;
    }
  }
  // The median distance of a sample of its vertices from where the surface is.
  double distance(const std::function<Point(std::int32_t)>& position) const {
    std::vector<double> squares;
    const std::size_t count = std::min(kSample, sides.size());
    for (std::size_t k = 0; k < count; ++k) {
      const std::int32_t v = expected_.from(sides[k * sides.size() / count]);
      squares.push_back(square(position(vertex_[v]), v));
    }
    const auto middle = squares.begin() + static_cast<std::ptrdiff_t>(count / 2);
    std::nth_element(squares.begin(), middle, squares.end());
    return *middle;
  }
  double square(const Point& p, std::int32_t v) const {
    const Point q = complex_.on_surface(v);
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += (p[k] - q[k]) * (p[k] - q[k]);
    return std::isnan(sum) ? kNowhere : sum;
  }
  const std::vector<std::int32_t>& on_delivered_vertex() const { return taken_; }
  std::int64_t delivered_side(std::int64_t side) const { return side_[side]; }

  std::vector<std::int64_t> sides;  // of the part

 private:
  // A whole cell.
  bool put(std::int64_t on, std::int64_t to) {
    if (expected_.size(expected_.cell_of[on]) != delivered_.size(delivered_.cell_of[to])) return false;
    const std::int64_t begin = on;
    do {
      const std::int32_t v = expected_.from(on), w = delivered_.from(to);
      if (side_[on] >= 0 || (vertex_[v] >= 0 ? vertex_[v] != w : taken_[w] >= 0)) return false;
      vertex_[v] = w;
      taken_[w] = v;
      side_[on] = to;
      sides.push_back(on);
      on = expected_.next(on);
      to = delivered_.next(to);
    } while (on != begin);
    return true;
  }

  const RefinedComplex& complex_;
  const Cells& expected_;
  const Cells& delivered_;
  std::vector<std::int32_t> vertex_,
      taken_;                       // of an expected vertex the delivered one, and the other way round
  std::vector<std::int64_t> side_;  // of an expected side the delivered one
};

// Delivered sides that have their mark in common. Of many those are found first that begin or end nearest to where a side
// is expected; a mesh may be thousands of equal parts.
class Alike {
 public:
  std::vector<std::int64_t> sides;

  /// All, or of very many those near to the ends a and b of the side that is expected.
  template <class Ends>
  std::vector<std::int64_t> near(const Point& a, const Point& b, const Ends& ends) {
    if (!are_many()) return sides;
    for (std::size_t end = 0; end < 2 && trees_[end].empty(); ++end) {
      std::vector<Entry> entries;
      for (const std::int64_t s : sides) {
        const Point p = ends(s)[end];
        if (std::isfinite(p[0] + p[1] + p[2])) entries.push_back({at(p), s});
      }
      trees_[end] = Tree(entries);
    }
    std::vector<Entry> found;
    trees_[0].query(boost::geometry::index::nearest(at(a), kNear), std::back_inserter(found));
    trees_[1].query(boost::geometry::index::nearest(at(b), kNear), std::back_inserter(found));
    std::vector<std::int64_t> some;
    for (const Entry& e : found) some.push_back(e.second);
    std::sort(some.begin(), some.end());
    some.erase(std::unique(some.begin(), some.end()), some.end());
    return some;
  }
  bool are_many() const { return sides.size() > 4 * kNear; }

 private:
  using Corner = boost::geometry::model::point<double, 3, boost::geometry::cs::cartesian>;
  using Entry = std::pair<Corner, std::int64_t>;
  using Tree = boost::geometry::index::rtree<Entry, boost::geometry::index::quadratic<16>>;
  static Corner at(const Point& p) { return {p[0], p[1], p[2]}; }

  Tree trees_[2];  // of where they begin, of where they end
};

// Lays all parts; returns the sum of their distances, infinite if one has no place. `ways` as in Matching.
double lay_all(const RefinedComplex& expected, const Cells& delivered,
               const std::function<Point(std::int32_t)>& position, Laying& laying, std::int64_t& ways) {
  const std::vector<std::uint64_t> mark = marks(expected.cells), delivered_mark = marks(delivered);
  std::unordered_map<std::uint64_t, std::int64_t> count;
  for (const std::uint64_t m : delivered_mark) ++count[m];
  // Each part begins at its rarest side. The parts have the marks of their sides in common.
  std::vector<std::int64_t> begins;
  std::vector<std::uint8_t> seen(static_cast<std::size_t>(expected.cells.count()));
  for (std::int64_t c = 0; c < expected.cells.count(); ++c) {
    if (seen[c] != 0) continue;
    std::int64_t rarest = expected.cells.first[c];
    for (const std::int64_t cell : part_of(expected.cells, c, seen))
      for (std::int64_t s = expected.cells.first[cell]; s < expected.cells.first[cell + 1]; ++s) {
        const auto like = count.find(mark[s]);
        if (like == count.end()) return kNowhere;
        if (like->second < count.at(mark[rarest])) rarest = s;
      }
    begins.push_back(rarest);
  }
  std::unordered_map<std::uint64_t, Alike> alike;
  for (const std::int64_t s : begins) alike.try_emplace(mark[s]);
  for (std::int64_t s = 0; s < std::ssize(delivered_mark); ++s)
    if (const auto like = alike.find(delivered_mark[s]); like != alike.end()) like->second.sides.push_back(s);

  const auto ends = [&](std::int64_t side) {
    return std::array{position(delivered.from(side)), position(delivered.to(side))};
  };
  double sum = 0;
  for (const std::int64_t on : begins) {
    const std::int32_t a = expected.cells.from(on), b = expected.cells.to(on);
    std::int64_t best = -1, steps = 0;
    double least = kNowhere;
    std::int64_t fitting = 0;
    const auto try_out = [&](const std::vector<std::int64_t>& sides) {
      std::vector<std::pair<std::pair<double, double>, std::int64_t>> candidates;
      for (const std::int64_t to : sides) {
        if (laying.on_delivered_vertex()[delivered.from(to)] >= 0) continue;
        // A vertex that is wrong does not decide, if the other one is right.
        const auto [from, until] = ends(to);
        candidates.push_back({std::minmax({laying.square(from, a), laying.square(until, b)}), to});
      }
      std::sort(candidates.begin(), candidates.end());
      for (const auto& [distances, to] : candidates) {
        const bool fits = laying.lay(on, to);
        steps += std::ssize(laying.sides);
        if (fits) {
          const double distance = laying.distance(position);
          if (best < 0 || distance < least) best = to, least = distance;
          laying.take_away();
          ++fitting;
        }
        if (fitting == kMostWays || steps > std::max(kMostSteps, 8 * std::ssize(mark))) break;
      }
    };
    Alike& like = alike.at(mark[on]);
    try_out(like.near(expected.on_surface(a), expected.on_surface(b), ends));
    if (best < 0 && like.are_many()) try_out(like.sides);
    if (best < 0) return kNowhere;
    laying.lay(on, best);
    sum += least;
    ways = std::max(ways, fitting);
  }
  return std::min(sum, std::numeric_limits<double>::max());
}

}  // namespace

Matching match(const RefinedComplex& expected, const Bare& t) {
  const int depth = expected.depth;
  Matching result;
  std::int64_t triangles = 0;
  for (std::int64_t c = 0; c < expected.cells.count(); ++c) triangles += expected.cells.size(c) - 2;
  const std::int64_t vertices = expected.vertices;
  const auto failed = [&](std::string why) {
    result.failure = std::move(why);
    return result;
  };
  if (std::ssize(t.triangles) != triangles)
    return failed(fmt::format("{} triangles were delivered; the mesh has {} at depth {}", t.triangles.size(),
                              triangles, depth));
  std::vector<std::int32_t> number(t.vertices);
  std::int64_t count = t.vertices;
  std::iota(number.begin(), number.end(), 0);
  if (count != vertices) {
    number = weld(t, &count);
    result.welded = true;
  }
  std::vector<std::int32_t> any(count, -1);  // a vertex of each number
  for (std::int64_t v = 0; v < t.vertices; ++v) any[number[v]] = static_cast<std::int32_t>(v);
  if (count < vertices && coincide(expected.about)) {
    result.not_judged = true;
    return failed("points of the control mesh lie at one place, and so do points that were delivered apart");
  }
  if (count != vertices)
    return failed(fmt::format("{} vertices were delivered, at {} places; the mesh has {} at depth {}",
                              t.vertices, count, vertices, depth));
  auto delivered = cells_of(expected.cells, t, number, count);
  if (!delivered)
    return failed(fmt::format(
        "the triangles are no oriented manifold{}",
        triangles != expected.cells.count() ? " of quads whose two triangles follow one another" : ""));
  const auto position = [&](std::int32_t v) { return t.position(any[v]); };
  auto laying = std::make_unique<Laying>(expected, *delivered);
  const double distance = lay_all(expected, *delivered, position, *laying, result.ways);
  // A mesh that is its own mirror image lies on itself as it is and reversed: the nearer one is meant.
  Cells mirrored = delivered->reversed();
  auto other = std::make_unique<Laying>(expected, mirrored);
  std::int64_t ways = 1;
  const double far = lay_all(expected, mirrored, position, *other, ways);
  if (far == kNowhere && distance == kNowhere)
    return failed(fmt::format("the triangles are not connected as those of the mesh at depth {}", depth));
  if (far < distance) {
    result.reversed = true;
    result.ways = ways;
    delivered = std::move(mirrored);
    laying = std::move(other);
  }
  result.provenance.resize(t.vertices);
  result.corner.resize(t.vertices);
  const auto put = [&](std::uint32_t v, std::int64_t side) {
    result.provenance[v] = expected.place[side];
    result.corner[v] = expected.corner[side];
  };
  const std::vector<std::int32_t>& on = laying->on_delivered_vertex();
  for (std::int64_t v = 0; v < t.vertices; ++v)
    put(static_cast<std::uint32_t>(v), expected.side_at[on[number[v]]]);
  std::vector<std::int64_t> cell(delivered->count());  // of each that was delivered the expected one
  for (std::int64_t c = 0; c < expected.cells.count(); ++c)
    cell[delivered->cell_of[laying->delivered_side(expected.cells.first[c])]] = c;
  // A vertex is said to lie on a face whose triangles have it: normals may be those of one side of a sharp edge.
  std::size_t next = 0;
  for (const std::int64_t c : cell)
    for (std::int64_t k = 2; k < expected.cells.size(c); ++k) {
      result.triangle_face.push_back(expected.face_of_cell[c]);
      for (const std::uint32_t v : t.triangles[next++])
        for (std::int64_t s = expected.cells.first[c]; s < expected.cells.first[c + 1]; ++s)
          if (expected.cells.from(s) == on[number[v]]) put(v, s);
    }
  return result;
}

}  // namespace limitcheck::verify
