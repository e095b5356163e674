// SPDX-License-Identifier: MIT
// A proof's rows as a table and as JSON.
#pragma once

#include <string>
#include <vector>

#include "verify/proof/proof_set.h"

namespace limitcheck::verify {

class ProofReport {
 public:
  /// Both must outlive this; rows as `prove` returns them.
  ProofReport(const ProofSet& set, const std::vector<std::vector<ProofRow>>& rows) : set_(set), rows_(rows) {}

  /// Whether every map is equal.
  bool held() const;
  /// A line per group and kernel, or with `each` per topology and kernel; then what failed, with its witness.
  std::string table(bool each) const;
  /// {"held": .., "rows": [{"group", "topology", "kernel", "depths", "points", "map", "arithmetic", "digits",
  /// "witness", "bound", "worst", ..}], "impossible": [..]}
  std::string json() const;

 private:
  const ProofSet& set_;
  const std::vector<std::vector<ProofRow>>& rows_;
};

}  // namespace limitcheck::verify
