// SPDX-License-Identifier: MIT
// A proof's rows as a table and as JSON.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "verify/proof/certified_comparison.h"
#include "verify/proof/proof_set.h"

namespace limitcheck::verify {

class ProofReport {
 public:
  /// Both must outlive this; rows as `prove` returns them: none of a task says that it was not done.
  ProofReport(const ProofSet& set, const std::vector<std::vector<ProofRow>>& rows,
              std::vector<CertifiedLine> certified = {})
      : set_(set), rows_(rows), certified_(std::move(certified)) {}

  /// Whether every map that was proved is equal and no error exceeds its bound.
  bool held() const;
  /// Whether all of the set was done.
  bool complete() const;
  /// A line per group and kernel, or with `each` per topology and kernel; then what failed, with its witness.
  std::string table(bool each) const;
  /// {"scheme": .., "held": .., "complete": .., "rows": [{"group", "topology", "kernel", "depths", "points",
  /// "map", "arithmetic", "digits", "witness", "bound", "worst", ..}], "impossible": [..], "certified": [{"mesh",
  /// "kernel", "depth", "points", "position", "normal"}]}
  std::string json() const;

 private:
  const ProofSet& set_;
  const std::vector<std::vector<ProofRow>>& rows_;
  const std::vector<CertifiedLine> certified_;
};

}  // namespace limitcheck::verify
