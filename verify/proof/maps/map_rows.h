// SPDX-License-Identifier: MIT
// What the proofs of both schemes do with a kernel: run it on rows of weights, compare, make a row of the
// table. For .cpp files.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include "fast/stream/kernel/layout.h"
#include "fast/stream/kernel/number.h"
#include "verify/proof/maps/map_comparison.h"
#include "verify/proof/maps/prove_map.h"
#include "verify/proof/maps/thread_clock.h"

namespace limitcheck::verify::detail {

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

/// Whether a float or double engine scales limit points by the number next to what the proof's own numbers
/// are scaled by: fast::row_stream::scaled has a branch for them. A sample of units stands for all, which are
/// powers of two.
///   times, twos   what points of the depth are too large by: times 2^twos
template <class T, class Scaled>
bool scales_rightly(int depth, Scaled&& scaled, double times, int twos) {
  for (int e = -60; e <= 60; e += 20) {
    const T unit = std::ldexp(T(1), e);
    const double found = std::ldexp(static_cast<double>(scaled(unit, depth)), twos);
    // times * found - unit is exact; half a unit in the last place of `found` is allowed.
    const double half = std::ldexp(0.5, std::ilogb(found) + 1 - std::numeric_limits<T>::digits);
    if (!(std::abs(std::fma(times, found, -static_cast<double>(unit))) <= times * half)) return false;
  }
  return true;
}
template <class T, class Scaled>
bool scales_rightly(int depth, Scaled&& scaled) {
  return scales_rightly<T>(depth, scaled, 12, 3 * depth);
}
template <class T>
bool scales_rightly(int depth) {
  return scales_rightly<T>(depth, [](T unit, int d) {
    return fast::row_stream::scaled(fast::row_stream::KernelPlacement<T>{{{}, unit}}, d).unit;
  });
}

/// A row whose depths are not all scaled rightly is no proof.
template <class Rightly>
void check_scale(ProofRow& row, Rightly&& rightly) {
  for (int depth = row.first_depth; depth <= row.last_depth && row.map.equal; ++depth) {
    if (rightly(depth)) continue;
    row.map.equal = false;
    row.map.witness = MapWitness{fmt::format("depth {}", depth), "scale of limit points", -1, 0, 0};
  }
}

inline void check_scale(ProofRow& row) {
  check_scale(row, [](int depth) { return scales_rightly<float>(depth) && scales_rightly<double>(depth); });
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

}  // namespace limitcheck::verify::detail
