// SPDX-License-Identifier: MIT
// The pieces of a surface lattice near sharp edges. Heavy, as sharpness.h is: include from .cpp files.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "reference/mesh/sharpness.h"
#include "verify/projection/cut_mesh.h"

namespace limitcheck::verify {

/// What the sharp edges and vertices of a refined mesh mean for its pieces.
struct SharpPieces {
  using Points = std::vector<reference::Vec3<double>>;
  const reference::Topology& topology;
  const Points& positions;
  const reference::Sharpness& sharpness;
  CutMesh cut;
  std::vector<bool> rough;  // of each face

  SharpPieces(const reference::Topology& whole, const Points& points, const reference::Sharpness& sharp)
      : topology(whole),
        positions(points),
        sharpness(sharp),
        cut(whole, points, sharp),
        rough(sharp.needs_a_step(whole)) {}

  // Whether bounds are wanted for the vertex: in one of its sectors it is extraordinary, and no semi-sharp
  // tags are near.
  //   inside, boundary   the faces of an ordinary sector
  bool is_irregular(std::int32_t v, std::size_t inside, std::size_t boundary) const;
  SharpVertexOf at(std::int32_t v) const {
    return {&sharpness, cut.states[v] == reference::VertexState::kHeld};
  }

  // Of a face without an extraordinary vertex: as a polynomial, or, near semi-sharp tags, by its hull.
  struct Bound {
    double size;
    bool rough;
  };
  template <class Regular>
  Bound bound(std::size_t face, Regular regular) const {
    if (!rough[face])
      if (const std::optional<double> size = regular(cut)) return {*size, false};
    return {hull(static_cast<std::int32_t>(face)), true};
  }
  // The size of what the surface over a face depends on, a bound for all pieces of it.
  double hull(std::int32_t face) const;
};

/// Nothing without tags.
inline std::optional<SharpPieces> sharp_pieces(const reference::Topology& topology,
                                               const SharpPieces::Points& positions,
                                               const std::optional<reference::Sharpness>& sharpness) {
  if (!sharpness) return std::nullopt;
  return SharpPieces(topology, positions, *sharpness);
}

}  // namespace limitcheck::verify
