// SPDX-License-Identifier: MIT
// The report of one shard: its results as they are, for the report of the whole to be made of.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "verify/shard/journal.h"

namespace limitcheck::verify {

struct PartReport {
  Plan plan;
  std::map<std::size_t, nlohmann::json> results;  // by unit
  double seconds = 0;
  std::string containment, printed;  // as in Report (verify/row/result.h)
  std::string incomplete;            // why not all of the shard is done; empty: all is

  /// Whether each unit of the shard is there, and no other.
  bool is_complete() const;
};

/// Keys: program, plan, units, together, shard, seconds, containment, printed, incomplete, results (pairs of
/// unit and result).
std::string to_json(const PartReport& part);
/// Throws data::ArgumentError: the text is no part.
PartReport read_part(const std::string& text);

/// All results, with the seconds of all shards and what they printed. Throws data::ArgumentError: they are
/// of different plans, or a shard is missing, there twice, or incomplete.
PartReport joined(const std::vector<PartReport>& parts);

}  // namespace limitcheck::verify
