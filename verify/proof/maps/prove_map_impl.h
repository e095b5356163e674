// SPDX-License-Identifier: MIT
// Definitions behind prove_map.h, for the .cpp files that instantiate them: one for each arithmetic.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "data/splitmix64.h"
#include "fast/rules/surface_vertex.h"
#include "fast/stream/kernel/layout.h"
#include "fast/stream/kernel/number.h"
#include "verify/proof/maps/prove_map.h"
#include "verify/proof/maps/reference_map.h"
#include "verify/proof/maps/scheme_runs.h"
#include "verify/proof/numbers/quad_weights.h"
#include "verify/proof/numbers/stencil.h"

namespace limitcheck::verify {

// A kernel on rows of weights, its limit points against the reference's map, and the row of the table that comes of it.

/// What y and z of control point k are in the runs of the kernels: numbers of 60 random bits below 1, the
/// same in every run.
template <class C>
std::vector<std::array<C, 2>> probes(std::size_t n) {
  data::SplitMix64 random(2);
  const C step = Coefficient<C>::ratio(1, 1 << 30);
  const auto part = [&] { return C(static_cast<int>(random.next() >> 34)); };
  std::vector<std::array<C, 2>> result(n);
  for (auto& probe : result)
    for (C& c : probe) {
      const C high = part() * step;
      c = high + part() * step * step;
    }
  return result;
}

/// Compares points one by one and keeps the first that differs.
///   position   every weight equals the reference's; the weights sum to 1, none is negative         [C24]
///   tangents   du = a d1 + b d2 and dv = c d1 + d d2 for every control point, with a d > b c: the same
///              plane and side for any geometry, whichever two tangents either side prefers;
///              the weights sum to 0
///   y, z       are what the weights of x make of the probes, in position and tangents: a kernel that treats
///              them otherwise than x would do so by a chance of 2^-60
template <class C>
class MapComparison {
 public:
  using Row = std::vector<C>;
  using K = Coefficient<C>;

  /// `where` describes the point if it fails.
  template <class Where>
  void check(const fast::LimitFrame<Stencil<C>>& found, const MapRow<C>& expected, Where&& where) {
    ++points_;
    if (witness_) return;
    if (!check_position(found.position.x, expected.position) ||
        (expected.has_tangents && !check_tangents(found.du.x, found.dv.x, expected)) ||
        !check_others("position", found.position, expected.position.size()) ||
        !check_others("first tangent", found.du, expected.position.size()) ||
        !check_others("second tangent", found.dv, expected.position.size()))
      witness_->point = where();
  }

  std::int64_t points() const { return points_; }
  const std::optional<MapWitness>& witness() const { return witness_; }
  /// Largest difference of two weights that are equal to within the tolerance.
  double largest_difference() const { return worst_; }

 private:
  static Row dense(const Stencil<C>& s, std::size_t n) {
    Row row(n);
    for (const auto& entry : s.entries()) row[entry.point] = entry.weight;
    return row;
  }
  /// `point`: -1 is none.
  bool fail(const std::string& quantity, std::ptrdiff_t point, const C& found, const C& expected) {
    witness_ =
        MapWitness{"", quantity, static_cast<int>(point), K::approximate(found), K::approximate(expected)};
    return false;
  }
  bool equal(const C& a, const C& b) {
    if (!K::equal(a, b)) return false;
    if (!(a == b)) worst_ = std::max(worst_, std::abs(K::approximate(C(a - b))));
    return true;
  }
  bool check_sum(const char* quantity, const Stencil<C>& s, int expected) {
    C sum(0);
    for (const auto& entry : s.entries()) sum += entry.weight;
    return (equal(sum, C(expected)) && K::is_zero(s.constant())) || fail(quantity, -1, sum, C(expected));
  }

  bool check_position(const Stencil<C>& found, const Row& expected) {
    const Row row = dense(found, expected.size());
    for (std::size_t k = 0; k < row.size(); ++k) {
      if (!equal(row[k], expected[k])) return fail("position", k, row[k], expected[k]);
      if (K::approximate(row[k]) < 0) return fail("negative weight", k, row[k], expected[k]);
    }
    return check_sum("sum of the position's weights", found, 1);
  }

  bool check_others(const std::string& quantity, const fast::Vec3<Stencil<C>>& found, std::size_t n) {
    if (probes_.size() != n) probes_ = probes<C>(n);
    C y(0), z(0);
    for (const auto& entry : found.x.entries()) {
      const auto& probe = probes_[entry.point];
      y += entry.weight * probe[0];
      z += entry.weight * probe[1];
    }
    return check_other(quantity + " in y", found.y, y) && check_other(quantity + " in z", found.z, z);
  }
  bool check_other(const std::string& quantity, const Stencil<C>& found, const C& expected) {
    return (found.entries().empty() && equal(found.constant(), expected)) ||
           fail(quantity, -1, found.constant(), expected);
  }

  // du, dv in terms of d1, d2, as two of the control points have it.
  struct Frame {
    C a, b, c, d;
  };
  static Frame solve(const Row& du, const Row& dv, const MapRow<C>& e, std::size_t p, std::size_t q) {
    const C inverse = C(1) / (e.d1[p] * e.d2[q] - e.d1[q] * e.d2[p]);
    return {(du[p] * e.d2[q] - du[q] * e.d2[p]) * inverse, (du[q] * e.d1[p] - du[p] * e.d1[q]) * inverse,
            (dv[p] * e.d2[q] - dv[q] * e.d2[p]) * inverse, (dv[q] * e.d1[p] - dv[p] * e.d1[q]) * inverse};
  }
  static C combine(const C& a, const C& b, const MapRow<C>& e, std::size_t k) {
    return a * e.d1[k] + b * e.d2[k];
  }
  static double determinant(const MapRow<C>& e, std::size_t p, std::size_t q) {
    return K::approximate(e.d1[p]) * K::approximate(e.d2[q]) -
           K::approximate(e.d1[q]) * K::approximate(e.d2[p]);
  }

  bool check_tangents(const Stencil<C>& first, const Stencil<C>& second, const MapRow<C>& e) {
    const std::size_t n = e.d1.size();
    const Row du = dense(first, n), dv = dense(second, n);
    std::size_t p = 0, q = 1;
    for (std::size_t k = 0; k < n; ++k)
      if (std::abs(K::approximate(e.d1[k])) > std::abs(K::approximate(e.d1[p]))) p = k;
    for (std::size_t k = 0; k < n; ++k)
      if (std::abs(determinant(e, p, k)) > std::abs(determinant(e, p, q))) q = k;
    const Frame frame = solve(du, dv, e, p, q);
    bool held = true;
    for (std::size_t k = 0; held && k < n; ++k)
      held = equal(du[k], combine(frame.a, frame.b, e, k)) && equal(dv[k], combine(frame.c, frame.d, e, k));
    if (!held) return blame(du, dv, e);
    if (K::approximate(frame.a) * K::approximate(frame.d) <=
        K::approximate(frame.b) * K::approximate(frame.c))
      return fail("side of the tangent plane", p, du[p], e.d1[p]);
    return check_sum("sum of a tangent's weights", first, 0) &&
           check_sum("sum of a tangent's weights", second, 0);
  }

  // The tangents differ: of all pairs of control points to solve with, the one that leaves the
  // fewest others wrong.
  bool blame(const Row& du, const Row& dv, const MapRow<C>& e) {
    const std::size_t n = du.size();
    fail("tangents", 0, du[0], e.d1[0]);
    std::size_t fewest = n + 1;
    for (std::size_t p = 0; p < n; ++p) {
      for (std::size_t q = p + 1; q < n; ++q) {
        if (std::abs(determinant(e, p, q)) < 1e-9) continue;
        const Frame frame = solve(du, dv, e, p, q);
        std::size_t wrong = 0;
        std::optional<MapWitness> first;
        for (std::size_t k = 0; k < n; ++k) {
          const C u = combine(frame.a, frame.b, e, k), v = combine(frame.c, frame.d, e, k);
          const bool u_held = K::equal(du[k], u);
          if (u_held && K::equal(dv[k], v)) continue;
          if (++wrong == 1)
            first = MapWitness{"", "tangents", static_cast<int>(k), K::approximate(u_held ? dv[k] : du[k]),
                               K::approximate(u_held ? v : u)};
        }
        if (wrong < fewest && first) fewest = wrong, witness_ = first;
      }
    }
    return false;
  }

  std::int64_t points_ = 0;
  double worst_ = 0;
  std::vector<std::array<C, 2>> probes_;
  std::optional<MapWitness> witness_;
};

namespace detail {

/// Control points whose x is the control point itself, and whose y and z are known numbers: what a kernel
/// does to y and z it must then do to numbers as the weights of x say (MapComparison).
template <class C>
std::vector<fast::Vec3<Stencil<C>>> identity(std::size_t n) {
  std::vector<fast::Vec3<Stencil<C>>> points(n);
  const std::vector<std::array<C, 2>> known = probes<C>(n);
  for (std::size_t k = 0; k < n; ++k)
    points[k] = {Stencil<C>::control_point(static_cast<int>(k)), Stencil<C>(known[k][0]),
                 Stencil<C>(known[k][1])};
  return points;
}

template <class C>
struct StencilLane {
  template <int tangent>
  struct Lane : fast::row_stream::LinearNumber<Stencil<C>, tangent> {
    using V = Stencil<C>;
    // Of constants: which lane is meant is no question to control points.
    static V equal(const V& a, const V& b) { return V(is(a, b.constant()) && b.entries().empty() ? 1 : 0); }
    static V select(const V& chosen, const V& a, const V& b) { return is(chosen, C(0)) ? b : a; }

   private:
    static bool is(const V& a, const C& b) { return a.entries().empty() && a.constant() == b; }
  };
};

inline std::string describe(int depth, const fast::LatticePoint& p) {
  return fmt::format("depth {}, face {} at ({}/{}, {}/{})", depth, p.face, p.i, p.denominator, p.j,
                     p.denominator);
}

/// Compares what `run(depth, visit)` delivers at every depth.
template <class C, class Maps, class Run>
ProofRow compare(const Neighbourhood& neighbourhood, const char* kernel, const MapOptions& options,
                 Maps& maps, Run&& run) {
  MapComparison<C> comparison;
  const ThreadClock clock;
  for (int depth = options.first_depth; depth <= options.last_depth; ++depth) {
    run(depth, [&](const fast::LatticePoint& at, const fast::LimitFrame<Stencil<C>>& frame) {
      const auto where = [&] { return describe(depth, at); };
      std::apply([&](auto&... map) { (comparison.check(frame, map.at(at), where), ...); }, maps);
    });
  }
  ProofRow row;
  row.topology = neighbourhood.name;
  row.kernel = kernel;
  row.first_depth = options.first_depth;
  row.last_depth = options.last_depth;
  row.points = comparison.points() / static_cast<std::int64_t>(std::tuple_size_v<Maps>);
  row.seconds = clock.seconds();
  row.map.equal = !comparison.witness();
  row.map.digits = comparison.largest_difference() > 0 ? -std::log10(comparison.largest_difference())
                                                       : std::numeric_limits<double>::infinity();
  row.map.witness = comparison.witness();
  return row;
}

/// Whether a float or double engine scales limit points by the number next to what the proof's own numbers
/// are scaled by: fast::row_stream::scaled has a branch for them. A sample of units stands for all, which are
/// powers of two.
template <class Scheme, class T, class Scaled>
bool scales_rightly(int depth, Scaled&& scaled) {
  for (int e = -60; e <= 60; e += 20) {
    const T unit = std::ldexp(T(1), e);
    const double found = std::ldexp(static_cast<double>(scaled(unit, depth)), Scheme::kTwos * depth);
    // times * found - unit is exact; half a unit in the last place of `found` is allowed.
    const double half = std::ldexp(0.5, std::ilogb(found) + 1 - std::numeric_limits<T>::digits);
    constexpr double kTimes = Scheme::kTimes;
    if (!(std::abs(std::fma(kTimes, found, -static_cast<double>(unit))) <= kTimes * half)) return false;
  }
  return true;
}
template <class Scheme, class T>
bool scales_rightly(int depth) {
  return scales_rightly<Scheme, T>(depth, Scheme::template scaled<T>);
}

/// A row whose depths are not all scaled rightly is no proof.
template <class Scheme>
void check_scale(ProofRow& row) {
  for (int depth = row.first_depth; depth <= row.last_depth && row.map.equal; ++depth) {
    if (scales_rightly<Scheme, float>(depth) && scales_rightly<Scheme, double>(depth)) continue;
    row.map.equal = false;
    row.map.witness = MapWitness{fmt::format("depth {}", depth), "scale of limit points", -1, 0, 0};
  }
}

///   Maps   the reference's
template <class Scheme, class C, class... Maps>
std::vector<ProofRow> prove_map(const Neighbourhood& neighbourhood, const MapOptions& options) {
  std::vector<ProofRow> rows;
  const data::ControlMesh& mesh = neighbourhood.mesh;
  SchemeRuns<Scheme, Stencil<C>, StencilLane<C>::template Lane> runs(mesh,
                                                                     identity<C>(mesh.positions.size()));
  std::tuple<Maps...> maps{Maps(mesh)...};
  for (const ProvedKernel kernel : kProvedKernels) {
    if (!(is_stream(kernel) ? options.row_stream : options.sliding_window) || !runs.has(kernel)) continue;
    MapOptions depths = options;
    if (kernel == ProvedKernel::kCrackCentre)
      depths.first_depth = depths.last_depth = 0;  // it knows no depth
    rows.push_back(compare<C>(neighbourhood, name_of(kernel), depths, maps,
                              [&](int depth, auto&& visit) { runs.run(kernel, depth, visit); }));
    if (kernel == ProvedKernel::kRowStream || kernel == ProvedKernel::kRowStreamEdge)
      check_scale<Scheme>(rows.back());
  }
  return rows;
}

/// In weights of either scheme, against these maps of the reference.
template <class OfTriangles, class OfQuads, template <class, bool> class... Map>
std::vector<ProofRow> prove_in(const Neighbourhood& neighbourhood, const MapOptions& options) {
  return by_scheme(neighbourhood.mesh, [&]<class Scheme>(Scheme) {
    using C = std::conditional_t<Scheme::kQuads, OfQuads, OfTriangles>;
    return prove_map<Scheme, C, Map<C, Scheme::kQuads>...>(neighbourhood, options);
  });
}

}  // namespace detail
}  // namespace limitcheck::verify
