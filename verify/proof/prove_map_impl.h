// SPDX-License-Identifier: MIT
// Definitions behind prove_map.h, for the .cpp files that instantiate them.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "fast/stream/layout.h"
#include "reference/loop/stam.h"
#include "verify/proof/kernel_runs.h"
#include "verify/proof/map_comparison.h"
#include "verify/proof/prove_map.h"
#include "verify/proof/stream_runs.h"
#include "verify/proof/thread_clock.h"

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
  using Lane = fast::row_stream::LinearNumber<Stencil<C>, tangent>;
};

inline std::string describe(int depth, const fast::LatticePoint& p) {
  return fmt::format("depth {}, face {} at ({}/{}, {}/{})", depth, p.face, p.i, p.denominator, p.j,
                     p.denominator);
}

/// Whether a float or double engine scales limit points by the number next to what the proof's own numbers
/// are scaled by: fast::row_stream::scaled has a branch for them. A sample of units stands for all, which are
/// powers of two.
template <class T, class Scaled>
bool scales_rightly(int depth, Scaled&& scaled) {
  for (int e = -60; e <= 60; e += 20) {
    const T unit = std::ldexp(T(1), e);
    const double found = std::ldexp(static_cast<double>(scaled(unit, depth)), 3 * depth);
    // 12 found - unit is exact; half a unit in the last place of `found` is allowed.
    const double half = std::ldexp(0.5, std::ilogb(found) + 1 - std::numeric_limits<T>::digits);
    if (!(std::abs(std::fma(12., found, -static_cast<double>(unit))) <= 12 * half)) return false;
  }
  return true;
}
template <class T>
bool scales_rightly(int depth) {
  return scales_rightly<T>(depth, [](T unit, int d) {
    return fast::row_stream::scaled(fast::row_stream::KernelPlacement<T>{{{}, unit}}, d).unit;
  });
}

/// A row whose depths are not all scaled rightly is no proof.
inline void check_scale(ProofRow& row) {
  for (int depth = row.first_depth; depth <= row.last_depth && row.map.equal; ++depth) {
    if (scales_rightly<float>(depth) && scales_rightly<double>(depth)) continue;
    row.map.equal = false;
    row.map.witness = MapWitness{fmt::format("depth {}", depth), "scale of limit points", -1, 0, 0};
  }
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

/// Maps: a tuple of ReferenceMap.
template <class C, class Maps>
std::vector<ProofRow> prove_map(const Neighbourhood& neighbourhood, const MapOptions& options, Maps maps) {
  std::vector<ProofRow> rows;
  const std::int32_t faces = neighbourhood.mesh.faces.size() == 1 ? 1 : 2;
  const auto points = identity<C>(neighbourhood.mesh.positions.size());
  if (options.sliding_window) {
    const WindowRuns<Stencil<C>, LinearSurface<Stencil<C>>> runs(neighbourhood.mesh, points);
    rows.push_back(compare<C>(neighbourhood, "sliding-window", options, maps,
                              [&](int depth, auto&& visit) { runs.pair(depth, visit); }));
    rows.push_back(compare<C>(neighbourhood, "crack-edge", options, maps, [&](int depth, auto&& visit) {
      for (std::int32_t h = 0; h < 3 * faces; ++h) runs.edge(h, depth, visit);
    }));
    MapOptions once = options;
    once.first_depth = once.last_depth = 0;
    rows.push_back(compare<C>(neighbourhood, "crack-centre", once, maps, [&](int, auto&& visit) {
      for (std::int32_t face = 0; face < faces; ++face) runs.centre(face, visit);
    }));
  }
  if (options.row_stream) {
    const StreamRuns<Stencil<C>, StencilLane<C>::template Lane> runs(neighbourhood.mesh, points);
    rows.push_back(compare<C>(neighbourhood, "row-stream", options, maps,
                              [&](int depth, auto&& visit) { runs.pair(depth, visit); }));
    rows.push_back(compare<C>(neighbourhood, "row-stream-edge", options, maps, [&](int depth, auto&& visit) {
      for (std::int32_t h = 0; h < 3 * faces; ++h) runs.edge(h, depth, visit);
    }));
    check_scale(rows[rows.size() - 2]);
    check_scale(rows.back());
  }
  return rows;
}

}  // namespace limitcheck::verify::detail
