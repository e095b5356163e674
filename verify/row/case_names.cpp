// SPDX-License-Identifier: MIT
#include "verify/row/case_names.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <vector>

namespace limitcheck::verify {
namespace {

bool looked_at(const Result& r) {
  return r.status != Status::kNotSupported && r.status != Status::kNotRun;
}
bool uniform(const Result& r) {
  return r.depths.empty() || r.depths == "uniform";
}

}  // namespace

std::string case_name(const Report& report, const Result& r) {
  if (report.depths != "plan") return r.mesh;
  return fmt::format("{} ({}{}{})", r.mesh, uniform(r) ? fmt::format("depth {}", r.depth) : r.depths,
                     r.sample.empty() ? "" : ", sample ", r.sample);
}

std::string depths_in_short(std::span<const Result* const> results) {
  std::set<int> depths;
  bool unequal = false;
  for (const Result* r : results) {
    if (!looked_at(*r)) continue;
    if (uniform(*r))
      depths.insert(r->depth);
    else
      unequal = true;
  }
  std::vector<std::string> runs;
  for (auto first = depths.begin(); first != depths.end();) {
    auto last = first;
    while (std::next(last) != depths.end() && *std::next(last) == *last + 1) ++last;
    runs.push_back(first == last ? fmt::format("{}", *first) : fmt::format("{}-{}", *first, *last));
    first = std::next(last);
  }
  return fmt::format("{}{}", fmt::join(runs, " "), unequal ? "*" : "");
}

std::string depths_in_full(const Report& report, const std::string& subject) {
  std::set<int> depths;
  std::vector<std::string> unequal;
  for (const Result& r : report.results) {
    if (r.subject != subject || !looked_at(r)) continue;
    if (uniform(r))
      depths.insert(r.depth);
    else if (std::find(unequal.begin(), unequal.end(), r.depths) == unequal.end())
      unequal.push_back(r.depths);
  }
  return fmt::format("{}{}{}", fmt::join(depths, " "),
                     unequal.empty() ? "" : "; *: ", fmt::join(unequal, ", "));
}

}  // namespace limitcheck::verify
