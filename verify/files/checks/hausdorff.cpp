// SPDX-License-Identifier: MIT
#include "verify/files/checks/hausdorff.h"

#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "verify/files/checks/overlay.h"
#include "verify/interrupt/interrupt.h"
#include "verify/projection/surface_lattice.h"

namespace limitcheck::verify {
namespace {

constexpr int kSplits = 5,
              kCornerSplits = 14;  // towards an extraordinary vertex, where the bounds fall slowly
constexpr Barycentric kMiddles[] = {{1. / 3, 1. / 3, 1. / 3}, {.5, .5, 0}, {0, .5, .5}, {.5, 0, .5}};
constexpr int kLooseSplits = 3;
constexpr std::size_t kExact = 400;  // places at which the distance is computed

double longest_side(const Corners& t) {
  return std::max({norm(t[0] - t[1]), norm(t[1] - t[2]), norm(t[2] - t[0])});
}

// The bracket of one direction: exact distances where the bounds are largest, which raise its lower end, then
// finer bounds where they are still too far above.
class OneWay {
 public:
  OneWay(const FileEvidence& e, const Overlay& overlay, const std::vector<Bound>& bounds, bool forwards)
      : e_(e), overlay_(overlay), bounds_(bounds), forwards_(forwards), order_(bounds.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::sort(order_.begin(), order_.end(),
              [&](std::size_t x, std::size_t y) { return value(bounds_[x]) > value(bounds_[y]); });
  }

  Bracket run() {
    raise_lower_end();
    bracket_.at_most = bracket_.at_least;
    bound_pieces();
    if (forwards_) bound_loose();
    bracket_.at_most = std::max(bracket_.at_most, bracket_.at_least);
    return bracket_;
  }

 private:
  double value(const Bound& b) const { return forwards_ ? b.from_triangles : b.from_surface; }
  // What an upper bound need not go below.
  double enough() const { return bracket_.at_least * (1 + kTightness) + 1e-15 * e_.surface.diagonal(); }

  void raise_lower_end() {
    for (std::size_t k = 0; k < std::min(kExact, order_.size()); ++k) {
      const Bound& bound = bounds_[order_[k]];
      if (!forwards_ && !(bound.from_surface > 0)) break;
      if (forwards_ && (bound.triangle < 0 || reach(bound.triangle) <= enough())) continue;
      end_if_interrupted();
      if (forwards_)
        from_triangle(bound);
      else
        from_surface(bound, e_.surface.lattice().piece(order_[k]));
    }
    for (const std::int32_t t : overlay_.loose()) {
      if (!forwards_ || reach(t) <= enough()) continue;
      end_if_interrupted();
      sample(overlay_.corners(t));
    }
  }

  // From the largest on, until what is left cannot raise the result.
  void bound_pieces() {
    for (const std::size_t k : order_) {
      const double bound = value(bounds_[k]);
      if (bound <= std::max(enough(), bracket_.at_most)) {
        bracket_.at_most = std::max(bracket_.at_most, std::min(bound, enough()));
        return;
      }
      end_if_interrupted();
      const Piece piece = e_.surface.lattice().piece(k);
      const double most = refine(piece, Overlay::near(piece, overlay_.over(piece.face)), bracket_.at_most, 0);
      bracket_.at_most = std::max(bracket_.at_most, most);
    }
  }

  void bound_loose() {
    for (const std::int32_t t : overlay_.loose()) {
      const double known = std::max(enough(), bracket_.at_most), bound = reach(t);
      if (bound > known) end_if_interrupted();
      bracket_.at_most =
          std::max(bracket_.at_most, bound <= known ? bound : at_most(overlay_.corners(t), known, 0));
    }
  }

  // Where no triangle is, the distance at the middle is as good as any: it raises the lower end, too. A bound
  // of at most `known` is not refined, because the distance may be as large elsewhere.
  double refine(const Piece& piece, const std::vector<Over>& over, double known, int level) {
    const Bound bound = overlay_.look(piece, over);
    const bool bare = !forwards_ && bound.bare;
    if (bare) from_surface(bound.at_surface);
    if (value(bound) <= enough() || (value(bound) <= known && !bare) ||
        level >= (piece.irregular >= 0 ? kCornerSplits : kSplits))
      return value(bound);
    double most = 0;
    for (const Piece& child : e_.surface.lattice().split(piece, e_.surface.surface()))
      most = std::max(most, refine(child, Overlay::near(child, over), std::max(known, most), level + 1));
    return std::min(value(bound), most);
  }

  void raise(double distance, const FacePoint& where) {
    bracket_.at_least = distance;
    bracket_.where = where;
  }

  // The distance itself at the place where the bound is taken, and in the middle of the piece, where it tends
  // to be largest.
  void from_surface(const Bound& bound, const Piece& piece) {
    for (const Barycentric& weight : kMiddles) from_surface(piece.parameter(weight));
    if (bound.at_surface.face >= 0) from_surface(bound.at_surface);
  }
  void from_surface(const FacePoint& at) {
    const double distance = overlay_.distance_to_triangles(e_.surface.at(at, {}).position);
    if (distance > bracket_.at_least || bracket_.where.face < 0) raise(distance, at);
  }

  // The same from a triangle.
  void from_triangle(const Bound& bound) {
    const Corners& corners = overlay_.corners(bound.triangle);
    sample(corners);
    if (bound.at_triangles.face >= 0) from_triangle(mix(corners, bound.weight));
  }
  // A triangle's middle and those of its sides.
  void sample(const Corners& t) {
    for (const Barycentric& weight : kMiddles) from_triangle(mix(t, weight));
  }
  // Where a point of the surface is near enough the nearest need not be known.
  void from_triangle(const Vector& p) {
    const bool any = bracket_.where.face >= 0;
    if (any && e_.surface.at_most(p) <= bracket_.at_least * (1 + 1e-12)) return;
    const Foot foot = e_.surface.closest(p, any ? bracket_.at_least * (1 - 1e-12) : 0);
    if (foot.distance > bracket_.at_least || !any) raise(foot.distance, foot.at);
  }

  // No point of a triangle is farther from its nearest corner than 1 / sqrt 3 of its longest side, and the
  // distance to the surface changes no faster than the place. What is known of the corners costs nothing;
  // where much is equally near, as to a small file amid the surface, each search for a nearest point is long.
  double reach(std::int32_t t) const {
    double corner = 0;
    for (const std::int32_t v : e_.tessellation.triangles[t])
      corner = std::max(corner, e_.foot[e_.point_of(v)].distance);
    return corner + longest_side(overlay_.corners(t)) / std::sqrt(3.0);
  }

  // The same of a triangle that is not over one face, cut smaller.
  double at_most(const Corners& t, double enough, int level) const {
    double corner = 0;
    for (const Vector& p : t) corner = std::max(corner, e_.surface.at_most(p));
    const double bound = corner + longest_side(t) / std::sqrt(3.0);
    if (bound <= enough || level == kLooseSplits) return bound;
    const Corners m{.5 * (t[0] + t[1]), .5 * (t[1] + t[2]), .5 * (t[2] + t[0])};
    double most = 0;
    for (const auto& child : {std::array{t[0], m[0], m[2]}, {m[0], t[1], m[1]}, {m[2], m[1], t[2]}, m})
      most = std::max(most, at_most(child, std::max(enough, most), level + 1));
    return std::min(bound, most);
  }

  const FileEvidence& e_;
  const Overlay& overlay_;
  const std::vector<Bound>& bounds_;  // of the lattice's pieces
  const bool forwards_;               // from the triangles to the surface
  std::vector<std::size_t> order_;    // of the bounds, the largest first
  Bracket bracket_;
};

// A control face as one flat polygon of the limits of its corners, cut as files are: a fan from the first.
std::vector<Corners> one_polygon(const FileEvidence& e, std::int32_t face) {
  const LimitSurface& surface = e.surface.surface();
  std::vector<Vector> corner;
  for (std::size_t k = 0; k < e.control.faces[face].size(); ++k)
    corner.push_back(e.surface.at(surface.control_corner(face, static_cast<int>(k)), {}).position);
  std::vector<Corners> fan;
  for (std::size_t k = 1; k + 1 < corner.size(); ++k) fan.push_back({corner[0], corner[k], corner[k + 1]});
  return fan;
}

// The largest distance, at most, from the surface over a control face, holes left out, to one flat polygon of
// the limits of that face's corners; in the mesh's unit.
double from_one_polygon_each(const FileEvidence& e) {
  std::vector<std::optional<TriangleTree>> polygons(e.control.faces.size());
  tbb::parallel_for(std::size_t{0}, polygons.size(), [&](std::size_t f) {
    polygons[f].emplace(one_polygon(e, static_cast<std::int32_t>(f)));
  });
  const LimitSurface& surface = e.surface.surface();
  const SurfaceLattice& lattice = e.surface.lattice();
  std::vector<double> apart(static_cast<std::size_t>(e.surface.domain().face_count()), 0);
  const std::size_t per_face = lattice.size() / apart.size();
  tbb::parallel_for(std::size_t{0}, apart.size(), [&](std::size_t f) {
    const auto face = static_cast<std::int32_t>(f);
    if (surface.is_hole(face)) return;
    const TriangleTree& polygon = *polygons[surface.control_face(face)];
    for (std::size_t k = f * per_face; k < (f + 1) * per_face; ++k)
      for (const Vector& corner : lattice.corners(k))
        apart[f] = std::max(apart[f], polygon.distance(corner) + lattice.deviation(k));
  });
  return *std::max_element(apart.begin(), apart.end());
}

}  // namespace

Hausdorff hausdorff(const FileEvidence& e) {
  const Overlay overlay(e);
  const SurfaceLattice& lattice = e.surface.lattice();
  std::vector<Bound> bounds(lattice.size());
  tbb::parallel_for(std::size_t{0}, bounds.size(), [&](std::size_t k) {
    const Piece piece = lattice.piece(k);
    bounds[k] = overlay.look(piece, Overlay::near(piece, overlay.over(piece.face)));
  });
  Hausdorff result;
  result.loose = static_cast<std::int64_t>(overlay.loose().size());
  result.one_polygon_each = from_one_polygon_each(e);
  result.from_triangles = OneWay(e, overlay, bounds, true).run();
  result.from_surface = OneWay(e, overlay, bounds, false).run();
  return result;
}

std::vector<Result> check_file_hausdorff(const FileEvidence& e, std::optional<double> bound) {
  Result r = e.result("file-hausdorff", "diagonal");
  if (lacks(e.tessellation.triangles, "faces", r)) return {r};
  const Hausdorff h = hausdorff(e);
  const double size = e.surface.diagonal();
  const bool forwards = h.from_triangles.at_least >= h.from_surface.at_least;
  const Bracket& larger = forwards ? h.from_triangles : h.from_surface;
  r.of = 1;
  r.worst = r.rms = larger.at_least / size;
  r.worst_absolute = larger.at_least;
  r.bound = bound.value_or(h.one_polygon_each / size + e.tolerance);
  const double most = std::max(h.from_triangles.at_most, h.from_surface.at_most) / size;
  r.message = fmt::format(
      "Hausdorff distance between {:.3e} and {:.3e} diagonals (triangles to surface {:.3e} to {:.3e}, "
      "surface to triangles {:.3e} to {:.3e})",
      *r.worst, most, h.from_triangles.at_least / size, h.from_triangles.at_most / size,
      h.from_surface.at_least / size, h.from_surface.at_most / size);
  const bool loop = e.scheme() == data::Scheme::kLoop;
  if (!bound)
    r.message += fmt::format("; the bound is that of one {} per control face", loop ? "triangle" : "polygon");
  const std::size_t triangles_each = e.control.faces.corners().size() - 2 * e.control.faces.size();
  if (!bound && e.tessellation.triangles.size() <= triangles_each)
    r.message += ", which this file is: only --max-deviation can judge it";
  if (h.loose > 0)
    r.message += fmt::format(
        "; {} triangles reach over several control faces or cover none, for which the upper bounds of the "
        "distances are too large",
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
