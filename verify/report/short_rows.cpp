// SPDX-License-Identifier: MIT
// The rows of a large report that its JSON has in short: an audit of everything has 50 000 rows, of 45 MB in full.
#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include "verify/report/json.h"
#include "verify/row/fields.h"

namespace limitcheck::verify {
namespace {

using Ordered = nlohmann::ordered_json;

// Rows that say more come first: what causes are shown by, then the largest of what is wrong, then what is right.
using Importance = std::tuple<bool, bool, bool, double>;
Importance importance(const Result& r, bool shows_a_cause) {
  const double excess = !r.worst ? 0 : r.bound && *r.bound > 0 ? *r.worst / *r.bound : *r.worst;
  return {!shows_a_cause, !is_bad(r), !looked_at(r), -excess};
}

// Of a list that is written as it was read.
template <class T>
T field(const nlohmann::json& list, std::size_t k) {
  return data::value_of<T>(list.at(k));
}

}  // namespace

std::vector<bool> rows_in_full(const Report& report) {
  std::vector<bool> full(report.results.size(), report.results.size() <= kMostInFull);
  if (report.results.size() <= kMostInFull) return full;
  std::vector<bool> shows_a_cause(report.results.size());
  for (const Cause& c : causes(report)) shows_a_cause[c.example] = true;
  std::vector<std::size_t> order(report.results.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    return importance(report.results[a], shows_a_cause[a]) < importance(report.results[b], shows_a_cause[b]);
  });
  std::map<std::pair<std::string, std::string>, std::size_t> chosen;
  for (const std::size_t k : order)
    full[k] = chosen[{report.results[k].subject, report.results[k].check}]++ < kInFull;
  return full;
}

Ordered in_short(const Report& report, const std::vector<bool>& full) {
  using At = std::tuple<Case, data::Scheme, std::string>;
  std::map<At, std::size_t> number_of;
  Ordered cases = Ordered::array(), rows = Ordered::array();
  std::map<std::string, std::int64_t> left_out;
  std::map<std::pair<std::string, std::string>, std::size_t> place;
  for (std::size_t k = 0; k < report.results.size(); ++k) {
    const Result& r = report.results[k];
    if (full[k]) continue;
    if (!is_bad(r) && r.status != Status::kWaived) {
      ++left_out[std::string(word(r.status))];
      continue;
    }
    const auto [at, is_new] = number_of.try_emplace({case_of(r), r.scheme, r.triangulated}, cases.size());
    if (is_new)
      cases.push_back({r.mesh, r.depth, r.depths, r.sample, data::name_of(r.scheme), r.triangulated});
    const auto [row, of_new_check] = place.try_emplace({r.subject, r.check}, rows.size());
    if (of_new_check)
      rows.push_back({{"subject", r.subject}, {"check", r.check}, {"findings", Ordered::array()}});
    rows[row->second]["findings"].push_back(
        {at->second, word(r.status), r.bad, r.of, r.worst ? verify::number(*r.worst) : Ordered(nullptr)});
  }
  return {{"left_out", left_out}, {"cases", std::move(cases)}, {"rows", std::move(rows)}};
}

std::vector<Result> rows_in_short(const nlohmann::json& report) {
  std::vector<Result> all;
  const nlohmann::json json = report.value("in_short", nlohmann::json());
  if (!json.is_object()) return all;
  for (const nlohmann::json& row : json.at("rows"))
    for (const nlohmann::json& finding : row.at("findings")) {
      const nlohmann::json& at = json.at("cases").at(field<std::size_t>(finding, 0));
      all.push_back(reported_row({{"subject", row.at("subject")},
                                  {"check", row.at("check")},
                                  {"mesh", at.at(0)},
                                  {"depth", at.at(1)},
                                  {"depths", at.at(2)},
                                  {"sample", at.at(3)},
                                  {"scheme", at.at(4)},
                                  {"triangulated", at.at(5)},
                                  {"status", finding.at(1)},
                                  {"count", finding.at(2)},
                                  {"of", finding.at(3)},
                                  {"worst", finding.at(4)}}));
    }
  return all;
}

}  // namespace limitcheck::verify
