// SPDX-License-Identifier: MIT
// Two tessellations of one surface, point by point.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>

#include "verify/audit/relation_variants.h"

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
  bool same(const Tessellation& t, std::int64_t k, const Variant& v, std::int64_t mine) const;

  const Evidence& e_;
  const bool uniform_;
  std::unordered_multimap<std::int64_t, std::int64_t> by_face_;  // a face may deliver a point more than once
  std::unordered_map<Lattice::Id, std::int64_t> by_point_;
  std::unordered_set<Lattice::Id> not_finite_;  // points
};

}  // namespace limitcheck::verify
