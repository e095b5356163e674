// SPDX-License-Identifier: MIT
#include "verify/report/known.h"

#include <fmt/core.h>
#include <fnmatch.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>

#include "data/error.h"
#include "data/untrusted_json.h"
#include "verify/report/json.h"
#include "verify/row/commands.h"
#include "verify/row/rows.h"

namespace limitcheck::verify {
namespace {

constexpr std::string_view kDigits = "0123456789";

// Of nine digits at most each.
std::vector<int> numbers(const std::string& version) {
  std::vector<int> parts;
  for (std::size_t at = 0; (at = version.find_first_of(kDigits, at)) != std::string::npos;) {
    const std::size_t end = std::min(version.find_first_not_of(kDigits, at), version.size());
    parts.push_back(std::stoi(version.substr(at, std::min<std::size_t>(end - at, 9))));
    at = end;
  }
  return parts;
}

bool matches(const std::string& pattern, const std::string& text) {
  return fnmatch(pattern.c_str(), text.c_str(), 0) == 0;
}

bool covers(const Waiver& w, const Result& r, const std::map<std::string, std::string>& versions) {
  if (!matches(w.subject, r.subject) || !matches(w.check, r.check) || !matches(w.shape, r.mesh)) return false;
  if (w.from.empty() && w.before.empty()) return true;
  const auto found = versions.find(r.subject);
  if (found == versions.end() || found->second.empty()) return false;
  const auto version = numbers(found->second);
  return (w.from.empty() || version >= numbers(w.from)) && (w.before.empty() || version < numbers(w.before));
}

bool is_a_day(const std::string& date) {
  constexpr std::string_view kForm = "0000-00-00";
  std::string form = date;
  std::replace_if(
      form.begin(), form.end(), [](char c) { return kDigits.find(c) != std::string_view::npos; }, '0');
  if (form != kForm) return false;
  const auto number = [&](std::size_t at, std::size_t count) { return std::stoi(date.substr(at, count)); };
  return std::chrono::year_month_day(std::chrono::year(number(0, 4)),
                                     std::chrono::month(static_cast<unsigned>(number(5, 2))),
                                     std::chrono::day(static_cast<unsigned>(number(8, 2))))
      .ok();
}

nlohmann::json parse(const std::string& text) try {
  return data::parse_untrusted(text);
} catch (const data::ArgumentError& error) {
  throw data::ArgumentError(fmt::format("waivers: {}", error.what()));
}

}  // namespace

std::vector<Waiver> parse_waivers(const std::string& text) {
  const auto json = parse(text);
  if (json.is_discarded() || !json.is_object() || !json.contains("waivers") || !json["waivers"].is_array())
    throw data::ArgumentError("waivers: not a JSON object with an array \"waivers\"");
  static const std::set<std::string> known{"subject", "versions", "check", "shape",
                                           "bound",   "reason",   "link",  "expires"};
  std::vector<Waiver> list;
  for (const auto& row : json["waivers"]) {
    const auto refuse = [&](const std::string& what) {
      throw data::ArgumentError(fmt::format("waiver {}: {}", list.size() + 1, what));
    };
    if (!row.is_object()) refuse("not an object");
    for (const auto& [key, value] : row.items())
      if (!known.contains(key)) refuse(fmt::format("there is no field \"{}\"", key));
    const auto field = [&](const nlohmann::json& in, const char* key, const char* fallback) {
      if (!in.contains(key)) {
        if (fallback != nullptr) return std::string(fallback);
        refuse(fmt::format("\"{}\" is missing", key));
      }
      if (!in[key].is_string()) refuse(fmt::format("\"{}\" is not text", key));
      return in[key].get<std::string>();
    };
    Waiver w;
    w.subject = field(row, "subject", nullptr);
    w.check = current_name(field(row, "check", nullptr));
    w.shape = field(row, "shape", "*");
    w.reason = field(row, "reason", nullptr);
    w.link = field(row, "link", "");
    w.expires = field(row, "expires", nullptr);
    if (!is_a_day(w.expires)) refuse("\"expires\" is no date as 2027-01-31");
    if (row.contains("versions")) {
      if (!row["versions"].is_object()) refuse("\"versions\" is not an object");
      w.from = field(row["versions"], "from", "");
      w.before = field(row["versions"], "before", "");
    }
    if (row.contains("bound")) {
      if (!row["bound"].is_number()) refuse("\"bound\" is not a number");
      w.bound = row["bound"].get<double>();
    }
    list.push_back(std::move(w));
  }
  return list;
}

void apply_waivers(Report& report, const std::vector<Waiver>& waivers,
                   const std::map<std::string, std::string>& versions, const std::string& today) {
  std::vector<Result> notes;
  for (std::size_t k = 0; k < waivers.size(); ++k) {
    const Waiver& w = waivers[k];
    const auto note = [&](const std::string& what) {
      Result r;
      r.subject = w.subject;
      r.mesh = w.shape;
      r.check = "waiver";
      r.depth = report.depth;
      r.status = Status::kQualityWarning;
      r.message = fmt::format("waiver {} ({} of {}) {}", k + 1, w.check, w.subject, what);
      notes.push_back(std::move(r));
    };
    if (today > w.expires) {
      note(fmt::format("expired on {}", w.expires));
      continue;
    }
    std::vector<Result*> held;
    bool used = false, any = false;
    for (Result& r : report.results) {
      if (!covers(w, r, versions)) continue;
      any = true;
      if (r.status == Status::kHeld) held.push_back(&r);
      if (!is_bad(r)) continue;
      used = true;
      // A breakdown has no worst value that a bound could be held against.
      const bool within = r.status != Status::kFinding || !w.bound || (r.worst && *r.worst <= *w.bound);
      if (within) r.status = Status::kWaived;
      r.waiver = fmt::format("{} until {}: {}{}", within ? "waived" : "beyond the waiver", w.expires,
                             w.reason, w.link.empty() ? "" : fmt::format(" ({})", w.link));
      say(r, r.waiver);
    }
    if (!any) note("covers nothing that was audited");
    if (used || !any) continue;
    for (Result* r : held) {
      r->status = Status::kUnexpectedPass;
      r->message = r->waiver = fmt::format("holds, though waiver {} expects a finding: {}", k + 1, w.reason);
    }
    if (held.empty()) note("covers no finding");
  }
  for (Result& r : notes) report.results.push_back(std::move(r));
}

std::string version_in(const std::string& description) {
  const std::size_t begin = description.find_first_of(kDigits);
  if (begin == std::string::npos) return "";
  std::size_t end = description.find_first_not_of(kDigits, begin);
  while (end + 1 < description.size() && description[end] == '.' &&
         kDigits.find(description[end + 1]) != std::string_view::npos)
    end = description.find_first_not_of(kDigits, end + 1);
  return description.substr(begin, end - begin);
}

}  // namespace limitcheck::verify
