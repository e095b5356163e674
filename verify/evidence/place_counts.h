// SPDX-License-Identifier: MIT
// Counts of what is wrong by the kind of place where it is.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "verify/evidence/lattice.h"
#include "verify/row/places.h"
#include "verify/row/result.h"

namespace limitcheck::verify {

/// The kinds of all lattice points of a mesh.                                              O(faces) to make
class Places {
 public:
  /// `lattice` outlives this.
  explicit Places(const Lattice& lattice);

  /// Kind, and number of faces where PlaceCount has one; nothing counted. `id` is a lattice point.
  PlaceCount of(Lattice::Id id) const;

 private:
  const Lattice& lattice_;
  std::vector<PlaceCount> vertex_;
  std::vector<PlaceKind> face_;
  std::vector<bool> sharp_edge_;
};

/// Fills in `places` of a row that is_bad; does nothing for others.
///   count   how many points were looked at
///   id      of each; kNone is skipped
///   state   1 wrong, 0 right, -1 not looked at
void count_places(Result& row, const Lattice& lattice, std::size_t count,
                  const std::function<Lattice::Id(std::size_t)>& id,
                  const std::function<int(std::size_t)>& state);

}  // namespace limitcheck::verify
