// SPDX-License-Identifier: MIT
#include "verify/projection/closest_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "data/bounding_box.h"
#include "verify/interrupt/interrupt.h"

namespace limitcheck::verify {
namespace {

struct Minimum {
  FacePoint at;
  Vector position{};
  double distance = 0;
  bool stationary = false;
};

// From `start` to a local minimum of |s - p|. `scale`: the size of the mesh, which says what counts as rounding.
class Descent {
 public:
  Descent(const LimitSurface& surface, const Vector& p, const FacePoint& start, double scale)
      : surface_(surface),
        domain_(surface.domain()),
        chart_(domain_.chart()),
        p_(p),
        at_(start),
        scale_(scale) {
    evaluate(at_);
  }

  // `quickly`: by Newton's iteration alone.
  Minimum run(bool quickly) {
    const FacePoint start = at_;
    const double from_start = distance_;
    if (s_.at_corner) leave_corner();
    const bool stationary = newton();
    if (quickly || (stationary && distance_ <= from_start)) return {at_, position_, distance_, stationary};
    if (from_start < distance_) evaluate(start);
    pattern_search();
    return {at_, position_, distance_, newton() || pattern_is_minimal_};
  }

 private:
  double distance_at(const FacePoint& at) const { return norm(surface_.position(at) - p_); }
  void evaluate(const FacePoint& at) {
    at_ = at;
    s_ = surface_.evaluate(at, reference::Order::kSecond);
    position_ = vector_of(s_.position);
    distance_ = norm(position_ - p_);
  }

  // An extraordinary corner has no derivatives to go by (none, or they vanish), a point near it does.
  void leave_corner() {
    constexpr double kAside = 1. / 256;
    FacePoint aside = at_;
    const Chart::Affine centre = chart_.centre();
    for (int k = 0; k < 3; ++k) aside.l[k] += kAside * (centre[k] - aside.l[k]);
    evaluate(aside);
  }

  struct Step {
    Chart::Affine l;
    double length;  // in space
    double slope;   // of |s - p|^2 / 2 along it
  };

  // Newton's step, or Gauss and Newton's where the second derivatives do not make for a minimum; kept on the
  // boundary, and on an edge that stays sharp, where it would leave the surface.
  bool step(Step& out) const {
    if (s_.at_corner) return false;
    const Vector r = position_ - p_, d1 = vector_of(s_.d1), d2 = vector_of(s_.d2);
    const double g1 = dot(r, d1), g2 = dot(r, d2);
    const double a = dot(d1, d1), b = dot(d1, d2), c = dot(d2, d2);
    if (!(a + c > 0)) return false;
    double ha = a, hb = b, hc = c;
    if (s_.second_exist) {
      ha += dot(r, vector_of(s_.d11));
      hb += dot(r, vector_of(s_.d12));
      hc += dot(r, vector_of(s_.d22));
    }
    const auto solve = [&](double A, double B, double C) -> Chart::Affine {
      const double det = A * C - B * B;
      if (!(A > 0 && C > 0 && det > 1e-14 * A * C) || !std::isfinite(det)) return {NAN, NAN, NAN};
      const double u = (B * g2 - C * g1) / det, v = (B * g1 - A * g2) / det;
      return {-u - v, u, v};
    };
    out.l = solve(ha, hb, hc);
    if (std::isnan(out.l[0])) out.l = solve(a, b, c);
    if (std::isnan(out.l[0]))  // parallel tangents: steepest descent
      out.l = {(g1 + g2) / (a + c), -g1 / (a + c), -g2 / (a + c)};
    for (int k = 0; k < chart_.corners(); ++k) {
      if (chart_.height(k, at_.l) != 0 || chart_.slope(k, out.l) >= 0 || domain_.goes_on(at_.face, k))
        continue;
      // One dimension is left: along the edge.
      const Chart::Affine e = chart_.along(k);
      const double g = e[1] * g1 + e[2] * g2;
      double h = e[1] * e[1] * ha + 2 * e[1] * e[2] * hb + e[2] * e[2] * hc;
      if (!(h > 0)) h = e[1] * e[1] * a + 2 * e[1] * e[2] * b + e[2] * e[2] * c;
      if (!(h > 0)) return false;
      for (int i = 0; i < 3; ++i) out.l[i] = -g / h * e[i];
      break;
    }
    out.length = norm(out.l[1] * d1 + out.l[2] * d2);
    out.slope = out.l[1] * g1 + out.l[2] * g2;
    return std::isfinite(out.length);
  }

  // True at a minimum, to rounding.
  bool newton() {
    const double tiny = 2e-16 * scale_;
    for (int round = 0; round < 60; ++round) {
      if (distance_ <= tiny) return true;
      Step way{};
      if (!step(way)) return false;
      if (way.length <= tiny) return true;
      double t = 1;
      FacePoint next;
      double there = 0;
      for (int halving = 0;; ++halving, t /= 2) {
        if (halving == 40) return way.length <= 1e-14 * scale_;
        next = domain_.walk(at_, {t * way.l[0], t * way.l[1], t * way.l[2]});
        there = distance_at(next);
        // Near the minimum the distance cannot decide any more: a whole step is taken if the distances are
        // nearly equal.
        if (there * there <= distance_ * distance_ + 2e-4 * t * std::min(way.slope, 0.0)) break;
        if (t == 1 && there <= distance_ * (1 + 4e-16) + tiny && way.length < 1e-7 * scale_) break;
      }
      const bool stuck = next.face == at_.face && next.l == at_.l;
      evaluate(next);
      if (stuck) return false;
    }
    return false;
  }

  // Six directions, the step halved when none of them descends: slow, and needs no derivatives.
  void pattern_search() {
    pattern_is_minimal_ = false;
    for (double h = 1. / 8; h > 1e-17; h /= 2) {
      for (int round = 0; round < 64; ++round) {
        FacePoint best = at_;
        double least = distance_;
        for (int k = 0; k < 6; ++k) {
          Chart::Affine way{};
          way[k % 3] = h;
          way[(k % 3 + (k < 3 ? 1 : 2)) % 3] = -h;
          const FacePoint there = domain_.walk(at_, way);
          const double d = distance_at(there);
          if (d < least) {
            least = d;
            best = there;
          }
        }
        if (!(least < distance_)) break;
        evaluate(best);
      }
    }
    pattern_is_minimal_ = true;
  }

  const LimitSurface& surface_;
  const Domain& domain_;
  Chart chart_;
  Vector p_;
  FacePoint at_;
  double scale_;
  reference::SurfacePoint<double> s_;
  Vector position_{};
  double distance_ = 0;
  bool pattern_is_minimal_ = false;
};

constexpr int kCuts = 12;  // as dear as one descent, about

// Of the pieces of the surface, not of the flat triangles.
std::vector<BoxTree::Box> boxes(const SurfaceLattice& lattice) {
  std::vector<BoxTree::Box> list(lattice.size());
  for (std::size_t t = 0; t < list.size(); ++t) {
    const auto c = lattice.corners(t);
    list[t] = BoxTree::around({c[0], c[1], c[2]}, lattice.deviation(t));
  }
  return list;
}

// Whether the surface over a piece may be nearer to p than `distance`, as far as so many cuts tell.
bool may_be_nearer(const SurfaceLattice& lattice, const LimitSurface& surface, const Piece& piece,
                   const Vector& p, double distance, int& cuts) {
  if (closest_on_triangle(p, piece.corner).distance - piece.deviation >= distance) return false;
  if (cuts-- <= 0) return true;
  const auto children = lattice.split(piece, surface);
  return std::any_of(children.begin(), children.end(), [&](const Piece& child) {
    return may_be_nearer(lattice, surface, child, p, distance, cuts);
  });
}

}  // namespace

ClosestPoint::ClosestPoint(const data::ControlMesh& mesh, data::Scheme scheme, std::size_t pieces)
    : surface_(mesh, scheme),
      lattice_(surface_.mesh(), SurfaceLattice::depth_for(surface_.mesh(), pieces, surface_.tags()),
               surface_.tags()),
      tree_(boxes(lattice_)),
      diagonal_(data::box_diagonal(mesh)) {}

Foot ClosestPoint::at(const FacePoint& where, const Vector& p) const {
  const auto s = surface_.evaluate(where, reference::Order::kFirst);
  Foot foot;
  foot.at = where;
  foot.position = vector_of(s.position);
  foot.normal = vector_of(s.normal);
  foot.has_normal = s.normal_kind == reference::NormalKind::kRegular;
  foot.distance = norm(p - foot.position);
  return foot;
}

Piece ClosestPoint::nearest_flat(const Vector& p, OnTriangle& flat) const {
  std::size_t nearest = 0;
  flat.distance = std::numeric_limits<double>::infinity();
  tree_.near(p, [&](std::size_t index) {
    const OnTriangle here = closest_on_triangle(p, lattice_.corners(index));
    if (here.distance < flat.distance) {
      flat = here;
      nearest = index;
    }
    return flat.distance;
  });
  return lattice_.piece(nearest);
}

double ClosestPoint::at_most(const Vector& p) const {
  OnTriangle flat;
  const Piece piece = nearest_flat(p, flat);
  double least = Descent(surface_, p, piece.parameter(flat.weight), diagonal_).run(true).distance;
  for (const Vector& corner : piece.corner) least = std::min(least, norm(p - corner));
  return least;
}

std::optional<Foot> ClosestPoint::on_surface(const Vector& p, double within) const {
  OnTriangle flat;
  const Piece piece = nearest_flat(p, flat);
  if (flat.distance > within + piece.deviation) return std::nullopt;
  const Minimum found = Descent(surface_, p, piece.parameter(flat.weight), diagonal_).run(true);
  // Next to an extraordinary vertex Newton's iteration may end nearby; the vertex itself is on the surface.
  for (int k = 0; k < 3; ++k)
    if (const double d = norm(p - piece.corner[k]);
        d <= within && d <= found.distance && domain().chart().corner_at(piece.at[k]) >= 0)
      return at({piece.face, piece.at[k]}, p);
  if (!found.stationary || found.distance > within) return std::nullopt;
  return at(found.at, p);
}

Foot ClosestPoint::closest(const Vector& p, double enough) const {
  // A nearer point that could only be nearer by rounding is not worth looking for.
  const double rounding = 1e-16 * diagonal_;
  Minimum best;
  best.distance = std::numeric_limits<double>::infinity();
  double at_least = best.distance;
  int descents = 0;
  tree_.near(p, [&](std::size_t index) {
    end_if_interrupted();
    const auto corners = lattice_.corners(index);
    const OnTriangle flat = closest_on_triangle(p, corners);
    const double bound = flat.distance - lattice_.deviation(index);
    at_least = std::min(at_least, bound);
    if (bound >= best.distance - rounding) return best.distance - rounding;

    const Piece piece = lattice_.piece(index);
    for (int k = 0; k < 3; ++k) {  // where Newton's iteration may be slow: at extraordinary vertices
      const double d = norm(p - corners[k]);
      if (d >= best.distance) continue;
      FacePoint corner{piece.face, piece.at[k]};
      best = {corner, corners[k], d, false};
    }
    if (best.distance <= std::max(rounding, enough)) return 0.0;
    int cuts = best.stationary ? kCuts : 0;
    if (!may_be_nearer(lattice_, surface_, piece, p, best.distance - rounding, cuts))
      return best.distance - rounding;
    if (descents++ < 256) {
      // Where Newton's iteration fails, the slow search is for the first minimum: others that it alone would
      // find lie at kinks of the surface, which corners of pieces show too.
      const Minimum found =
          Descent(surface_, p, piece.parameter(flat.weight), diagonal_).run(best.stationary);
      if (found.distance < best.distance || (found.stationary && found.distance <= best.distance + rounding))
        best = found;
    }
    return best.distance <= enough ? 0.0 : best.distance - rounding;
  });
  Foot foot = at(best.at, p);
  const bool ended_early = enough > 0 && best.distance <= enough;
  foot.at_least = ended_early || foot.distance <= rounding ? 0 : std::clamp(at_least, 0.0, foot.distance);
  const bool at_corner = domain().chart().corner_at(best.at.l) >= 0;
  foot.stationary = best.stationary || foot.distance <= rounding ||
                    (at_corner && norm(cross(p - foot.position, foot.normal)) <= 1e-12 * diagonal_);
  return foot;
}

}  // namespace limitcheck::verify
