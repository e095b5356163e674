// SPDX-License-Identifier: MIT
#include "verify/report/baseline.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <tuple>
#include <utility>
#include <vector>

#include "data/error.h"
#include "data/untrusted_json.h"
#include "verify/report/json.h"
#include "verify/row/commands.h"

namespace limitcheck::verify {
namespace {

constexpr std::string_view kTitle = "limitcheck baseline 1";

struct Comparison {
  std::vector<std::string> appeared, worse, gone;
  std::int64_t same = 0, before = 0;  // before: of a report, its findings
};

std::string worst_text(const std::optional<double>& worst) {
  return worst ? fmt::format("{:.2g}", *worst) : "-";
}

// --- Row by row.

using Key = std::tuple<std::string, std::string, Case>;  // subject, check
Key key_of(const Result& r) {
  return {r.subject, r.check, case_of(r)};
}

bool is_worse(const Result& now, const Result& before) {
  if (now.status != Status::kFinding)
    return before.status == Status::kFinding || before.status == Status::kWaived;
  // Of a finding, no number is the largest.
  const auto worst = [](const Result& r) {
    return r.worst.value_or(std::numeric_limits<double>::infinity());
  };
  const auto share = [](const Result& r) {
    return static_cast<double>(r.bad) / static_cast<double>(r.of > 0 ? r.of : 1);
  };
  return worst(now) > kWorse * worst(before) || share(now) > kWorse * share(before);
}

Comparison compare(const Report& report, const std::vector<Result>& rows) {
  Comparison c;
  std::map<Key, Result> before;
  for (const Result& r : rows) {
    before[key_of(r)] = r;
    c.before += is_bad(r);
  }
  for (const Result& r : report.results) {
    const auto found = before.find(key_of(r));
    const bool was =
        found != before.end() && (is_bad(found->second) || found->second.status == Status::kWaived);
    const std::string name = fmt::format("{} / {} on {}", r.subject, r.check, case_name(report, r));
    if (is_bad(r) && !was)
      c.appeared.push_back("new: " + name);
    else if (is_bad(r) && is_worse(r, found->second))
      c.worse.push_back(
          fmt::format("worse: {}, {} -> {}", name, worst_text(found->second.worst), worst_text(r.worst)));
    else if (is_bad(r))
      ++c.same;
    else if (was && (r.status == Status::kHeld || r.status == Status::kQualityWarning))
      c.gone.push_back("gone: " + name);
  }
  return c;
}

// --- By subject and check.

struct Sum {
  std::int64_t cases = 0;
  std::optional<double> worst;
};
using Sums = std::map<std::pair<std::string, std::string>, Sum>;

Sums sums_of(const Report& report) {
  Sums sums;
  for (const Result& r : report.results) {
    if (!is_bad(r)) continue;
    Sum& sum = sums[{r.subject, r.check}];
    ++sum.cases;
    if (r.worst) sum.worst = std::max(sum.worst.value_or(*r.worst), *r.worst);
  }
  return sums;
}

Sums baseline_sums(const std::string& text, const std::string& file) {
  Sums sums;
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    if (number == 1 || line.empty() || line.starts_with('#')) continue;
    std::istringstream words(line);
    std::string check, worst, subject;
    Sum sum;
    char* end = nullptr;
    words >> check >> sum.cases >> worst >> std::ws;
    if (words) std::getline(words, subject);
    if (worst != "-") sum.worst = std::strtod(worst.c_str(), &end);
    if (subject.empty() || sum.cases < 1 || (end != nullptr && *end != '\0') ||
        !sums.try_emplace({subject, check}, sum).second)
      throw data::ArgumentError(fmt::format(
          "--baseline {}:{}: no line of check, cases, worst value and subject, each subject and check once",
          file, number));
  }
  return sums;
}

Comparison compare(const Report& report, const Sums& before) {
  Comparison c;
  const Sums now = sums_of(report);
  const auto cases = [](const Sum& s) { return fmt::format("{} case{}", s.cases, s.cases == 1 ? "" : "s"); };
  for (const auto& [key, sum] : now) {
    const std::string name = fmt::format("{} / {}", key.first, key.second);
    const auto found = before.find(key);
    if (found == before.end()) {
      c.appeared.push_back(fmt::format("new: {} in {}, up to {}", name, cases(sum), worst_text(sum.worst)));
      continue;
    }
    const Sum& was = found->second;
    const bool larger = sum.worst && (!was.worst || *sum.worst > kWorse * *was.worst);
    if (larger || static_cast<double>(sum.cases) > kWorse * static_cast<double>(was.cases))
      c.worse.push_back(fmt::format("worse: {}, {} -> {} in {} -> {}", name, worst_text(was.worst),
                                    worst_text(sum.worst), was.cases, cases(sum)));
    else
      ++c.same;
  }
  for (const auto& [key, sum] : before)
    if (!now.contains(key) &&
        std::any_of(report.results.begin(), report.results.end(), [&key = key](const Result& r) {
          return r.subject == key.first && r.check == key.second && looked_at(r);
        }))
      c.gone.push_back(fmt::format("gone: {} / {}", key.first, key.second));
  return c;
}

}  // namespace

std::vector<Result> reported_rows(const std::string& text, const std::string& file) try {
  const nlohmann::json json = data::parse_untrusted(text);
  if (!json.is_object() || json.value("program", nlohmann::json()) != "limitcheck audit" ||
      !json.contains("results") || !json["results"].is_array())
    throw data::ArgumentError(
        fmt::format("{}: no report that limitcheck audit --json or --save-baseline wrote", file));
  std::vector<Result> rows;
  for (const nlohmann::json& row : json["results"]) {
    for (const char* key : {"subject", "mesh", "check", "status", "count", "of", "worst"}) (void)row.at(key);
    rows.push_back(reported_row(row));
  }
  for (Result& row : rows_in_short(json)) rows.push_back(std::move(row));
  return rows;
} catch (const nlohmann::json::exception& error) {
  throw data::ArgumentError(fmt::format("{}: {}", file, error.what()));
}

void compare_with_baseline(Report& report, const std::string& text, const std::string& file) {
  const bool is_text = text.starts_with(kTitle);
  const Comparison c =
      is_text ? compare(report, baseline_sums(text, file)) : compare(report, reported_rows(text, file));
  Report::Changes changes;
  changes.baseline = file;
  changes.appeared = static_cast<std::int64_t>(c.appeared.size());
  changes.worse = static_cast<std::int64_t>(c.worse.size());
  changes.gone = static_cast<std::int64_t>(c.gone.size());
  changes.same = c.same;
  changes.before = c.before;
  for (const auto* list : {&c.appeared, &c.worse, &c.gone})
    changes.named.insert(changes.named.end(), list->begin(), list->end());
  report.changes = std::move(changes);
}

std::string to_baseline(const Report& report) {
  std::string text = fmt::format(
      "{}\n# Check, cases in which it is wrong, worst value, subject: limitcheck audit --save-baseline\n",
      kTitle);
  for (const auto& [key, sum] : sums_of(report))
    text += fmt::format("{} {} {} {}\n", key.second, sum.cases, worst_text(sum.worst), key.first);
  return text;
}

}  // namespace limitcheck::verify
