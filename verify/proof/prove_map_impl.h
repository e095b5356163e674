// SPDX-License-Identifier: MIT
// Definitions behind prove_map.h, for the .cpp files that instantiate them.
#pragma once

#include <fmt/format.h>

#include <limits>

#include "reference/stam.h"
#include "verify/proof/kernel_runs.h"
#include "verify/proof/map_comparison.h"
#include "verify/proof/prove_map.h"
#include "verify/proof/stream_runs.h"
#include "verify/proof/thread_clock.h"

namespace limitcheck::verify::detail {

/// The control points themselves.
template <class C>
std::vector<fast::Vec3<Stencil<C>>> identity(std::size_t n) {
  std::vector<fast::Vec3<Stencil<C>>> points(n);
  for (std::size_t k = 0; k < n; ++k) points[k].x = Stencil<C>::control_point(static_cast<int>(k));
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
  const std::int32_t faces = neighbourhood.mesh.triangles.size() == 1 ? 1 : 2;
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
  }
  return rows;
}

}  // namespace limitcheck::verify::detail
