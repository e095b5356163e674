// SPDX-License-Identifier: MIT
// Memory that the points of patches are written to: whole vertices, or compact ones.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "fast/frame/compact_vertex.h"
#include "fast/frame/vertex_copy.h"
#include "fast/plan/lattice_point.h"
#include "fast/rules/surface_vertex.h"

namespace limitcheck::fast {

/// One of `vertices` and `compact`, which only float has, and provenance or null.
template <class Real>
struct PatchTarget {
  SurfaceVertex<Real>* vertices = nullptr;
  CompactVertex* compact = nullptr;
  LatticePoint* provenance = nullptr;
  CompactRow compact_row = &fast::compact_row;  // or one that gives the same bits sooner

  /// Whether whole vertices alone are wanted, so that who computes them may put them there.
  bool takes_vertices() const { return vertices != nullptr && compact == nullptr && provenance == nullptr; }

  PatchTarget from(std::int64_t first) const {
    return {vertices != nullptr ? vertices + first : nullptr, compact != nullptr ? compact + first : nullptr,
            provenance != nullptr ? provenance + first : nullptr, compact_row};
  }
  /// Vertices at .. at + count - 1.
  void put(std::uint32_t at, const SurfaceVertex<Real>* from, std::size_t count) const {
    if constexpr (std::is_same_v<Real, float>)
      if (compact != nullptr) return compact_row(from, count, compact + at);
    copy_vertices(from, count, vertices + at, Stores::kOrdinary);
  }
  void put(std::uint32_t at, const SurfaceVertex<Real>& vertex) const {
    if constexpr (std::is_same_v<Real, float>)
      if (compact != nullptr) return void(compact[at] = compacted(vertex));
    copy_vertices(&vertex, 1, vertices + at, Stores::kOrdinary);
  }
};

}  // namespace limitcheck::fast
