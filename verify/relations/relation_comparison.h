// SPDX-License-Identifier: MIT
// Two tessellations of one surface, point by point.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "verify/relations/relation_variants.h"

namespace limitcheck::verify {

/// What one variant came to.
struct Comparison {
  std::int64_t of = 0, bad = 0, other_bits = 0;
  double position = 0, normal = 0;  // the largest differences: diagonals, degrees
  double worst = 0;                 // the largest of both in units of its bound
  std::optional<Witness> witness;
  std::string message;
};

/// Compares with the tessellation of the evidence, which outlives this.
class Compared {
 public:
  explicit Compared(const Evidence& e);

  /// `t` is what the subject made of `v`; `slack` is how many results' errors may add up. Points that are not
  /// finite on either side are left out, as long as there are no more of them than in the original.
  Comparison with(const Tessellation& t, const Variant& v, double slack) const;

 private:
  using Key = std::int64_t;  // of a point and a face
  // The vertices by which a face delivers a point. There may be as many as a polygon has corners.
  struct Delivered {
    std::int64_t first, last;
  };
  struct Digest {
    Key key;
    std::uint64_t bits;
    std::int64_t vertex;
    auto operator<=>(const Digest&) const = default;
  };

  bool same(const Tessellation& t, std::int64_t k, const Variant& v, std::int64_t mine) const;
  // The first vertex of several that has the same bits.
  std::optional<std::int64_t> with_same_bits(const Tessellation& t, std::int64_t k, const Variant& v,
                                             Key key) const;

  const Evidence& e_;
  const bool uniform_;
  std::unordered_map<Key, Delivered> by_face_;
  std::vector<Digest> several_;  // all vertices where a face delivers a point more than once, sorted
  std::unordered_map<Lattice::Id, std::int64_t> by_point_;
  std::unordered_set<Lattice::Id> not_finite_;  // points
};

}  // namespace limitcheck::verify
