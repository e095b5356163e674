// SPDX-License-Identifier: MIT
// A proof's rows as a table and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "verify/proof/certified_comparison.h"
#include "verify/proof/proof_set.h"

namespace limitcheck::verify {

class ProofReport {
 public:
  /// Both must outlive this; rows as `prove` returns them: a task without rows was not run.
  ProofReport(const ProofSet& set, const std::vector<std::vector<ProofRow>>& rows,
              std::vector<CertifiedLine> certified = {})
      : set_(set), rows_(rows), certified_(std::move(certified)) {}

  /// Whether every map that was proved is equal and no error exceeds its bound; those that are certified, once
  /// all rows are there to be compared with.
  bool held() const;
  /// Whether all of the set was done, certified lines and all.
  bool complete() const;
  /// A line per group and kernel, or with `each` per topology and kernel; then what failed, with its witness.
  std::string table(bool each) const;
  /// {"scheme": .., "held": .., "complete": .., "rows": [{"group", "topology", "kernel", "depths", "points",
  /// "map", "arithmetic", "digits", "witness", "bound", "worst", ..}], "impossible": [..], "certified": [{"mesh",
  /// "kernel", "depth", "points", "position", "normal", "position_bound", "normal_bound"}]}; bounds are null until
  /// all rows are there
  std::string json() const;

 private:
  bool has_all_rows() const;
  /// What the rows prove of the kernel that a certified line names.
  std::optional<ProvedBounds> proved_of(const CertifiedLine& line) const;

  const ProofSet& set_;
  const std::vector<std::vector<ProofRow>>& rows_;
  const std::vector<CertifiedLine> certified_;
};

/// The same as JSON that loses nothing, to go on with and to merge.
nlohmann::json proof_rows_json(const std::vector<ProofRow>& rows);
std::vector<ProofRow> proof_rows_of(const nlohmann::json& json);

nlohmann::json certified_json(const std::vector<CertifiedLine>& lines);
std::vector<CertifiedLine> certified_of(const nlohmann::json& json);

}  // namespace limitcheck::verify
