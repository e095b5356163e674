// SPDX-License-Identifier: MIT
// What an audit on every neighbourhood up to a valence (limitcheck audit --exhaustive) has shown.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "verify/row/result.h"

namespace limitcheck::verify {

/// Of a subject and a scheme (data/generators/every_neighbourhood.h).
struct Exhaustive {
  std::string subject;
  data::Scheme scheme = data::Scheme::kLoop;
  int most = 0;                         // faces around a vertex
  std::int64_t neighbourhoods = 0;      // that there are ..
  std::int64_t looked = 0;              // .. in meshes whose points were judged at depths 0, 1 and 2
  std::int64_t cases = 0, wrong = 0;    // meshes at a depth, and those with findings
  std::vector<std::string> examples{};  // "star:3:w=J.e (depth 1, positions)": the shortest first
  bool all_right() const { return wrong == 0 && looked == neighbourhoods; }
};

/// By the names of the meshes that the rows are of; nothing if none is one of "neighbourhoods:..".
std::vector<Exhaustive> exhaustive_of(const std::vector<Result>& results);

/// A line for each: "Loop: right on every neighbourhood up to valence 6: 9120, at depths 0, 1 and 2".
std::string exhaustive_lines(const Report& report);

}  // namespace limitcheck::verify
