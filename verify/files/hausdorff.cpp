// SPDX-License-Identifier: MIT
#include "verify/files/hausdorff.h"

#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "verify/files/overlap.h"

namespace limitcheck::verify {
namespace {

constexpr int kSplits = 5,
              kCornerSplits = 14;  // towards an extraordinary vertex, where the bounds fall slowly
constexpr Barycentric kMiddles[] = {{1. / 3, 1. / 3, 1. / 3}, {.5, .5, 0}, {0, .5, .5}, {.5, 0, .5}};
constexpr int kLooseSplits = 3;
constexpr double kNoArea = 1e-14;    // of a face, in its parameters
constexpr std::size_t kExact = 400;  // places at which the distance is computed

// Triangles that lie together. Few are gone through, many are found by their boxes.
class Polygon {
 public:
  explicit Polygon(std::vector<std::array<Vector, 3>> triangles) : triangles_(std::move(triangles)) {
    if (triangles_.size() <= kFew) return;
    std::vector<BoxTree::Box> boxes;
    boxes.reserve(triangles_.size());
    for (const auto& t : triangles_) boxes.push_back(BoxTree::around({t[0], t[1], t[2]}));
    tree_.emplace(boxes);
  }

  double distance(const Vector& p) const {
    double least = std::numeric_limits<double>::infinity();
    const auto look = [&](std::size_t k) {
      return least = std::min(least, closest_on_triangle(p, triangles_[k]).distance);
    };
    if (tree_) tree_->near(p, look);
    for (std::size_t k = 0; k < triangles_.size() && !tree_; ++k) look(k);
    return least;
  }

 private:
  static constexpr std::size_t kFew = 16;
  std::vector<std::array<Vector, 3>> triangles_;
  std::optional<BoxTree> tree_;
};

class Measurer {
 public:
  Measurer(const FileEvidence& e, std::function<void()> tick)
      : e_(e), tick_(std::move(tick)), over_(e.surface.domain().face_count()) {
    const auto& list = e.tessellation.triangles;
    corners_.resize(list.size());
    std::vector<BoxTree::Box> boxes;
    for (std::size_t t = 0; t < list.size(); ++t) {
      std::array<std::int32_t, 3> p{};
      for (int c = 0; c < 3; ++c) p[c] = e.point_of(list[t][c]);
      if (std::min({p[0], p[1], p[2]}) < 0) continue;
      corners_[t] = {e.position(p[0]), e.position(p[1]), e.position(p[2])};
      boxes.push_back(BoxTree::around({corners_[t][0], corners_[t][1], corners_[t][2]}));
      boxed_.push_back(static_cast<std::int32_t>(t));
      if (p[0] == p[1] || p[1] == p[2] || p[2] == p[0]) continue;
      lay(static_cast<std::int32_t>(t), place_triangle(e, p));
    }
    tree_ = std::make_unique<BoxTree>(boxes);
  }

  Hausdorff run(double tightness) {
    tick_();
    Hausdorff result;
    result.loose = static_cast<std::int64_t>(loose_.size());
    const SurfaceLattice& lattice = e_.surface.lattice();
    const std::size_t per_face = lattice.size() / over_.size();
    bounds_.assign(lattice.size(), {});
    std::vector<double> apart(over_.size(), 0);
    std::vector<std::optional<Polygon>> polygons(e_.control.faces.size());
    tbb::parallel_for(std::size_t{0}, polygons.size(),
                      [&](std::size_t f) { polygons[f].emplace(one_polygon(static_cast<std::int32_t>(f))); });
    tbb::parallel_for(std::size_t{0}, over_.size(), [&](std::size_t f) {
      const Polygon& polygon = *polygons[e_.surface.surface().control_face(static_cast<std::int32_t>(f))];
      const bool hole = is_hole(static_cast<std::int32_t>(f));
      for (std::size_t k = 0; k < per_face; ++k) {
        const std::size_t index = f * per_face + k;
        const Piece piece = lattice.piece(index);
        bounds_[index] = look(piece, near(piece, over_[f]));
        if (hole) continue;
        for (const Vector& c : piece.corner)
          apart[f] = std::max(apart[f], polygon.distance(c) + piece.deviation);
      }
    });
    result.one_polygon_each = *std::max_element(apart.begin(), apart.end());

    // Exact distances where the bounds are largest, then bounds where they are still too far above.
    for (const bool forwards : {true, false}) {
      Bracket& bracket = forwards ? result.from_triangles : result.from_surface;
      const auto value = [&](const Bound& b) { return forwards ? b.from_triangles : b.from_surface; };
      std::vector<std::size_t> order(bounds_.size());
      for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
      std::sort(order.begin(), order.end(),
                [&](std::size_t x, std::size_t y) { return value(bounds_[x]) > value(bounds_[y]); });
      for (std::size_t k = 0; k < std::min(kExact, order.size()); ++k) {
        const Bound& bound = bounds_[order[k]];
        if (!forwards && !(bound.from_surface > 0)) break;
        if (forwards && (bound.triangle < 0 || reach(bound.triangle) <= enough_for(bracket, tightness)))
          continue;
        tick_();
        exact(bound, lattice.piece(order[k]), forwards, bracket);
      }
      if (forwards)
        for (const std::int32_t t : loose_) {
          if (reach(t) <= enough_for(bracket, tightness)) continue;
          tick_();
          sample(corners_[t], bracket);
        }

      // From the largest on, until what is left cannot raise the result.
      bracket.at_most = bracket.at_least;
      for (const std::size_t k : order) {
        const double enough = enough_for(bracket, tightness);
        const double bound = value(bounds_[k]);
        if (bound <= std::max(enough, bracket.at_most)) {
          bracket.at_most = std::max(bracket.at_most, std::min(bound, enough));
          break;
        }
        tick_();
        const Piece piece = lattice.piece(k);
        bracket.at_most = std::max(bracket.at_most, refine(piece, near(piece, over_[piece.face]), forwards,
                                                           tightness, bracket.at_most, bracket, 0));
      }
      if (forwards)
        for (const std::int32_t t : loose_) {
          const double enough = std::max(enough_for(bracket, tightness), bracket.at_most), bound = reach(t);
          if (bound > enough) tick_();
          bracket.at_most =
              std::max(bracket.at_most, bound <= enough ? bound : at_most(corners_[t], enough, 0));
        }
      bracket.at_most = std::max(bracket.at_most, bracket.at_least);
    }
    return result;
  }

 private:
  // Of the surface over holes nobody expects triangles.
  bool is_hole(std::int32_t face) const { return e_.surface.surface().is_hole(face); }

  struct Bound {
    double from_triangles = 0, from_surface = 0;
    FacePoint at_triangles, at_surface;  // where they are taken
    std::int32_t triangle = -1;          // from which, at at_triangles ...
    Barycentric weight{};                // ... with these coordinates
    bool bare = false;                   // some of the piece has no triangle over it
  };

  // A control face as one flat polygon of the limits of its corners, cut as files are: a fan from the first.
  std::vector<std::array<Vector, 3>> one_polygon(std::int32_t face) const {
    const LimitSurface& surface = e_.surface.surface();
    std::vector<Vector> corner;
    for (std::size_t k = 0; k < e_.control.faces[face].size(); ++k)
      corner.push_back(e_.surface.at(surface.control_corner(face, static_cast<int>(k)), {}).position);
    std::vector<std::array<Vector, 3>> fan;
    for (std::size_t k = 1; k + 1 < corner.size(); ++k) fan.push_back({corner[0], corner[k], corner[k + 1]});
    return fan;
  }

  // Over its face, and over the faces beyond the edges it crosses.
  void lay(std::int32_t triangle, const PlacedTriangle& placed) {
    const bool flat = std::abs(placed.area) < kNoArea;
    if (placed.face < 0 || placed.crosses || flat) loose_.push_back(triangle);
    if (placed.face < 0 || flat) return;
    over_[placed.face].push_back({triangle, placed.l});
    if (!placed.crosses) return;
    const Domain& domain = e_.surface.domain();
    const Chart chart = domain.chart();
    for (int k = 0; k < chart.corners(); ++k) {
      const auto height = [&](int c) { return chart.height(k, placed.l[c]); };
      if (std::min({height(0), height(1), height(2)}) >= 0) continue;
      const std::int32_t next = domain.across(placed.face, k);
      if (next < 0) continue;
      Over there{triangle, {}};
      for (int c = 0; c < 3; ++c) there.l[c] = domain.unfolded(placed.face, k, placed.l[c]);
      over_[next].push_back(there);
    }
  }

  // Those over the piece, judged by their extents.
  static std::vector<Over> near(const Piece& piece, const std::vector<Over>& all) {
    std::vector<Over> some;
    for (const Over& o : all) {
      bool apart = false;
      for (int k = 0; k < 3; ++k) {
        const auto [o_low, o_high] = std::minmax({o.l[0][k], o.l[1][k], o.l[2][k]});
        const auto [p_low, p_high] = std::minmax({piece.at[0][k], piece.at[1][k], piece.at[2][k]});
        apart = apart || o_low >= p_high || o_high <= p_low;
      }
      if (!apart) some.push_back(o);
    }
    return some;
  }

  Bound look(const Piece& piece, const std::vector<Over>& over) const {
    Bound bound;
    const double area = determinant(piece.at[0], piece.at[1], piece.at[2]);
    double left = area;
    for (const Over& o : over) {
      const double o_area = determinant(o.l[0], o.l[1], o.l[2]);
      if (std::abs(o_area) < kNoArea) continue;
      const Part part = clip(o.l, piece.at);
      if (part.size() < 3) continue;
      left -= area_of(part);
      const auto& triangle = corners_[o.triangle];
      for (const Barycentric& u : part) {
        const Barycentric on_piece = within(piece.at, area, u), on_triangle = within(o.l, o_area, u);
        const Vector p = piece.flat(on_piece), t = mix(triangle, on_triangle);
        const double from_surface = closest_on_triangle(p, triangle).distance + piece.deviation;
        const double from_triangles = closest_on_triangle(t, piece.corner).distance + piece.deviation;
        if (from_surface > bound.from_surface) {
          bound.from_surface = from_surface;
          bound.at_surface = {piece.face, piece.chart.clamp(u)};
        }
        if (from_triangles > bound.from_triangles) {
          bound.from_triangles = from_triangles;
          bound.at_triangles = {piece.face, piece.chart.clamp(u)};
          bound.triangle = o.triangle;
          bound.weight = on_triangle;
        }
      }
    }
    if (is_hole(piece.face)) {
      bound.from_surface = 0;
    } else if (left > 1e-6 * area) {  // not covered: the nearest triangle, wherever it is
      // No point of the piece is farther from its middle than a corner is, and the distance to the triangles
      // changes no faster than the place.
      constexpr Barycentric kMiddle{1. / 3, 1. / 3, 1. / 3};
      const Vector middle = piece.flat(kMiddle);
      double reach = 0;
      for (const Vector& corner : piece.corner) reach = std::max(reach, norm(corner - middle));
      bound.bare = true;
      bound.at_surface = piece.parameter(kMiddle);
      bound.from_surface =
          std::max(bound.from_surface, distance_to_triangles(middle) + reach + piece.deviation);
    }
    return bound;
  }

  double enough_for(const Bracket& bracket, double tightness) const {
    return bracket.at_least * (1 + tightness) + 1e-15 * e_.surface.diagonal();
  }

  // Where no triangle is, the distance at the middle is as good as any: it raises the lower end, too. A bound
  // of at most `known` is not refined, because the distance may be as large elsewhere.
  double refine(const Piece& piece, const std::vector<Over>& over, bool forwards, double tightness,
                double known, Bracket& bracket, int level) const {
    const Bound bound = look(piece, over);
    const bool bare = !forwards && bound.bare;
    if (bare) raise(bracket, bound.at_surface);
    const double value = forwards ? bound.from_triangles : bound.from_surface;
    if (value <= enough_for(bracket, tightness) || (value <= known && !bare) ||
        level >= (piece.irregular >= 0 ? kCornerSplits : kSplits))
      return value;
    double most = 0;
    for (const Piece& child : e_.surface.lattice().split(piece, e_.surface.surface()))
      most = std::max(most, refine(child, near(child, over), forwards, tightness, std::max(known, most),
                                   bracket, level + 1));
    return std::min(value, most);
  }

  void raise(Bracket& bracket, const FacePoint& at) const {
    const double distance = distance_to_triangles(e_.surface.at(at, {}).position);
    if (distance <= bracket.at_least) return;
    bracket.at_least = distance;
    bracket.where = at;
  }

  // The distance itself at the place where the bound is taken, and in the middle of the triangle or the
  // piece, where it tends to be largest.
  void exact(const Bound& bound, const Piece& piece, bool forwards, Bracket& bracket) const {
    if (forwards) sample(corners_[bound.triangle], bracket);
    for (const Barycentric& weight : kMiddles) {
      if (forwards) break;
      raise(bracket, piece.parameter(weight));
    }
    const FacePoint& at = forwards ? bound.at_triangles : bound.at_surface;
    if (at.face < 0) return;
    double d = 0;
    FacePoint where = at;
    if (forwards) {
      const Vector p = mix(corners_[bound.triangle], bound.weight);
      if (cannot_raise(p, bracket)) return;
      const Foot foot = e_.surface.closest(p, no_more(bracket));
      d = foot.distance;
      where = foot.at;
    } else {
      d = distance_to_triangles(e_.surface.at(at, {}).position);
    }
    if (d <= bracket.at_least && bracket.where.face >= 0) return;
    bracket.at_least = d;
    bracket.where = where;
  }

  // Where a point of the surface is near enough the nearest need not be known.
  static double no_more(const Bracket& bracket) {
    return bracket.where.face >= 0 ? bracket.at_least * (1 - 1e-12) : 0;
  }
  bool cannot_raise(const Vector& p, const Bracket& bracket) const {
    return bracket.where.face >= 0 && e_.surface.at_most(p) <= bracket.at_least * (1 + 1e-12);
  }

  // A triangle that is not over one face: its middle and those of its sides.
  void sample(const std::array<Vector, 3>& t, Bracket& bracket) const {
    for (const Barycentric& weight : kMiddles) {
      const Vector p = mix(t, weight);
      if (cannot_raise(p, bracket)) continue;
      const Foot foot = e_.surface.closest(p, no_more(bracket));
      if (foot.distance <= bracket.at_least && bracket.where.face >= 0) continue;
      bracket.at_least = foot.distance;
      bracket.where = foot.at;
    }
  }

  // No point of a triangle is farther from its nearest corner than 1 / sqrt 3 of its longest side, and the
  // distance to the surface changes no faster than the place. What is known of the corners costs nothing;
  // where much is equally near, as to a small file amid the surface, each search for a nearest point is long.
  double reach(std::int32_t t) const {
    double corner = 0;
    for (const std::int32_t v : e_.tessellation.triangles[t])
      corner = std::max(corner, e_.foot[e_.point_of(v)].distance);
    return corner + longest_side(corners_[t]) / std::sqrt(3.0);
  }

  static double longest_side(const std::array<Vector, 3>& t) {
    return std::max({norm(t[0] - t[1]), norm(t[1] - t[2]), norm(t[2] - t[0])});
  }

  // The same of a triangle that is not over one face, cut smaller.
  double at_most(const std::array<Vector, 3>& t, double enough, int level) const {
    double corner = 0;
    for (const Vector& p : t) corner = std::max(corner, e_.surface.at_most(p));
    const double bound = corner + longest_side(t) / std::sqrt(3.0);
    if (bound <= enough || level == kLooseSplits) return bound;
    const std::array<Vector, 3> m{.5 * (t[0] + t[1]), .5 * (t[1] + t[2]), .5 * (t[2] + t[0])};
    double most = 0;
    for (const auto& child : {std::array{t[0], m[0], m[2]}, {m[0], t[1], m[1]}, {m[2], m[1], t[2]}, m})
      most = std::max(most, at_most(child, std::max(enough, most), level + 1));
    return std::min(bound, most);
  }

  double distance_to_triangles(const Vector& p) const {
    double least = std::numeric_limits<double>::infinity();
    tree_->near(p, [&](std::size_t k) {
      return least = std::min(least, closest_on_triangle(p, corners_[boxed_[k]]).distance);
    });
    return least;
  }

  const FileEvidence& e_;
  std::function<void()> tick_;
  std::vector<std::vector<Over>> over_;         // of each face
  std::vector<std::array<Vector, 3>> corners_;  // of each triangle
  std::vector<std::int32_t> boxed_;             // triangles with finite corners
  std::unique_ptr<BoxTree> tree_;
  std::vector<Bound> bounds_;
  std::vector<std::int32_t> loose_;  // triangles not wholly over one face, or over no part of it
};

}  // namespace

Hausdorff hausdorff(const FileEvidence& evidence, const std::function<void()>& tick, double tightness) {
  return Measurer(evidence, tick).run(tightness);
}

std::vector<Result> check_file_hausdorff(const FileEvidence& e, double bound,
                                         const std::function<void()>& tick) {
  Result r = e.result("file-hausdorff");
  r.unit = "diagonal";
  if (e.tessellation.triangles.empty()) {
    r.status = Status::kNotSupported;
    r.message = "the file has no faces";
    return {r};
  }
  const Hausdorff h = hausdorff(e, tick);
  const double size = e.surface.diagonal();
  const bool forwards = h.from_triangles.at_least >= h.from_surface.at_least;
  const Bracket& larger = forwards ? h.from_triangles : h.from_surface;
  r.of = 1;
  r.worst = r.rms = larger.at_least / size;
  r.worst_absolute = larger.at_least;
  r.bound = bound >= 0 ? bound : h.one_polygon_each / size + e.tolerance;
  const double most = std::max(h.from_triangles.at_most, h.from_surface.at_most) / size;
  r.message = fmt::format(
      "Hausdorff distance between {:.3e} and {:.3e} diagonals (triangles to surface {:.3e} to {:.3e}, "
      "surface to triangles {:.3e} to {:.3e})",
      *r.worst, most, h.from_triangles.at_least / size, h.from_triangles.at_most / size,
      h.from_surface.at_least / size, h.from_surface.at_most / size);
  const bool loop = e.scheme() == data::Scheme::kLoop;
  if (bound < 0)
    r.message += fmt::format("; the bound is that of one {} per control face", loop ? "triangle" : "polygon");
  const std::size_t triangles_each = e.control.faces.corners().size() - 2 * e.control.faces.size();
  if (bound < 0 && e.tessellation.triangles.size() <= triangles_each)
    r.message += ", which this file is: only --max-deviation can judge it";
  if (h.loose > 0)
    r.message += fmt::format(
        "; {} triangles reach over several control faces or cover none, which makes the upper ends large",
        h.loose);
  if (*r.worst > *r.bound) {
    r.status = Status::kFinding;
    r.bad = 1;
  } else if (most > *r.bound) {
    r.message += "; the bound lies in between: not decided, taken as held";
  }
  r.witness = e.at_point(larger.where);
  return {r};
}

}  // namespace limitcheck::verify
