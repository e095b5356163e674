// SPDX-License-Identifier: MIT
#include "verify/report/baseline.h"

#include <fmt/core.h>

#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>

#include "data/error.h"
#include "data/untrusted_json.h"
#include "verify/row/case_names.h"
#include "verify/row/explain.h"

namespace limitcheck::verify {
namespace {

using Json = nlohmann::json;
using Key = std::tuple<std::string, std::string, int, std::string, std::string, std::string>;

struct Known {
  std::string status;
  double worst = 0, share = 0;
  bool red() const {
    return status == "finding" || status == "crash" || status == "timeout" || status == "error" ||
           status == "waived";
  }
};

double share(double bad, double of) {
  return of > 0 ? bad / of : bad;
}

std::string text(const Json& row, const char* key) {
  return row.contains(key) && row[key].is_string() ? row[key].get<std::string>() : "";
}

std::map<Key, Known> rows_of(const std::string& text_of_file, const std::string& file) {
  const Json json = data::parse_untrusted(text_of_file);
  if (!json.is_object() || text(json, "program") != "limitcheck audit" || !json.contains("results") ||
      !json["results"].is_array())
    throw data::ArgumentError(
        fmt::format("--baseline {}: no report that limitcheck audit --json wrote", file));
  std::map<Key, Known> rows;
  try {
    for (const Json& row : json["results"]) {
      Known known{row.at("status"), 0, share(row.at("count").get<double>(), row.at("of").get<double>())};
      // Of a finding, no number is the largest.
      known.worst = row.at("worst").is_number() ? row.at("worst").get<double>()
                                                : std::numeric_limits<double>::infinity();
      rows[{row.at("subject"), row.at("mesh"), row.value("depth", 0), text(row, "depths"),
            text(row, "sample"), std::string(current_name(row.at("check").get<std::string>()))}] = known;
    }
  } catch (const Json::exception& error) {
    throw data::ArgumentError(fmt::format("--baseline {}: {}", file, error.what()));
  }
  return rows;
}

bool is_worse(const Result& now, const Known& before) {
  if (now.status != Status::kFinding) return before.status == "finding" || before.status == "waived";
  const double worst = now.worst.value_or(std::numeric_limits<double>::infinity());
  return worst > kWorse * before.worst ||
         share(static_cast<double>(now.bad), static_cast<double>(now.of)) > kWorse * before.share;
}

}  // namespace

void compare_with_baseline(Report& report, const std::string& json, const std::string& file) {
  const std::map<Key, Known> before = rows_of(json, file);
  Report::Changes changes;
  changes.baseline = file;
  std::vector<std::string> appeared, worse, gone;
  for (const Result& r : report.results) {
    const auto found = before.find({r.subject, r.mesh, r.depth, r.depths, r.sample, r.check});
    const bool was = found != before.end() && found->second.red();
    const std::string name = fmt::format("{} / {} on {}", r.subject, r.check, case_name(report, r));
    if (is_bad(r) && !was)
      appeared.push_back("new: " + name);
    else if (is_bad(r) && is_worse(r, found->second))
      worse.push_back("worse: " + name);
    else if (is_bad(r))
      ++changes.same;
    else if (was && (r.status == Status::kHeld || r.status == Status::kQualityWarning))
      gone.push_back("gone: " + name);
  }
  changes.appeared = static_cast<std::int64_t>(appeared.size());
  changes.worse = static_cast<std::int64_t>(worse.size());
  changes.gone = static_cast<std::int64_t>(gone.size());
  for (auto* list : {&appeared, &worse, &gone})
    changes.named.insert(changes.named.end(), list->begin(), list->end());
  report.changes = std::move(changes);
}

}  // namespace limitcheck::verify
