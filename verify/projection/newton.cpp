// SPDX-License-Identifier: MIT
#include "verify/projection/newton.h"

#include <algorithm>
#include <cmath>

namespace limitcheck::verify {
namespace {

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

  Minimum run_quickly() {
    if (s_.at_corner) leave_corner();
    const bool stationary = newton();
    return {at_, position_, distance_, stationary};
  }

  Minimum run() {
    const FacePoint start = at_;
    const double from_start = distance_;
    if (s_.at_corner) leave_corner();
    if (newton() && distance_ <= from_start) return {at_, position_, distance_, true};
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
    if (std::isnan(out.l[0])) {  // parallel tangents: steepest descent
      const double size = a + c;
      if (!(size > 0)) return false;
      out.l = {(g1 + g2) / size, -g1 / size, -g2 / size};
    }
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

}  // namespace

Minimum descend(const LimitSurface& surface, const Vector& p, const FacePoint& start, double scale,
                bool quickly) {
  Descent descent(surface, p, start, scale);
  return quickly ? descent.run_quickly() : descent.run();
}

}  // namespace limitcheck::verify
