// SPDX-License-Identifier: MIT
#include "verify/report/known.h"

#include <fmt/chrono.h>
#include <fnmatch.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string_view>
#include <tuple>
#include <utility>

#include "data/error.h"
#include "data/untrusted_json.h"
#include "verify/report/json.h"
#include "verify/row/commands.h"
#include "verify/row/rows.h"

namespace limitcheck::verify {
namespace {

// --- Waivers.

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
  std::tm day{};
  const char* const end = strptime(date.c_str(), "%Y-%m-%d", &day);
  if (end == nullptr || *end != '\0') return false;
  timegm(&day);  // 31 February becomes 3 March
  return fmt::format("{:%Y-%m-%d}", day) == date;
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

// --- Baselines.

namespace {

constexpr std::string_view kTitle = "limitcheck baseline 1";

struct Comparison {
  std::vector<std::string> appeared, worse, gone, not_compared;
  std::int64_t same = 0, before = 0;  // before: of a report, its findings
};

std::string worst_text(const std::optional<double>& worst) {
  return worst ? fmt::format("{:.2g}", *worst) : "-";
}

// --- Row by row.

using KnownKey = std::tuple<std::string, std::string, Case>;  // subject, check
KnownKey key_of(const Result& r) {
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
  std::map<KnownKey, Result> before;
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

// "# opensubdiv-gl on llvmpipe, OpenGL 4.5": to what was written before there were such lines a comment.
std::string device_line(const std::string& subject, const std::string& device) {
  return fmt::format("# {} on {}", subject, device);
}

// Subjects that the baseline has on other devices, which round otherwise.
std::set<std::string> on_other_devices(const Report& report, const std::string& text) {
  std::set<std::string> subjects;
  const auto has = [&](const std::string& line) { return text.find(line) != std::string::npos; };
  for (const auto& [subject, device] : report.devices)
    if (has(device_line(subject, "")) && !has(device_line(subject, device) + "\n")) subjects.insert(subject);
  return subjects;
}

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

Comparison compare(const Report& report, const Sums& before, const std::set<std::string>& elsewhere) {
  Comparison c;
  Sums now = sums_of(report);
  for (const std::string& subject : elsewhere)
    c.not_compared.push_back(
        fmt::format("not compared: {}, of which the baseline is of another device", subject));
  std::erase_if(now, [&](const auto& sum) {
    const std::string& subject = sum.first.first;
    return elsewhere.contains(subject.substr(0, subject.find(':')));
  });
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
    if (!elsewhere.contains(key.first.substr(0, key.first.find(':'))) && !now.contains(key) &&
        std::ranges::any_of(report.results, [&key = key](const Result& r) {
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
  const Comparison c = is_text ? compare(report, baseline_sums(text, file), on_other_devices(report, text))
                               : compare(report, reported_rows(text, file));
  Report::Changes& changes = *(report.changes = Report::Changes{});
  changes.baseline = file;
  changes.same = c.same;
  changes.before = c.before;
  for (const auto& [list, count] : {std::pair(&c.appeared, &changes.appeared),
                                    std::pair(&c.worse, &changes.worse), std::pair(&c.gone, &changes.gone)}) {
    *count = std::ssize(*list);
    changes.named.insert(changes.named.end(), list->begin(), list->end());
  }
  changes.named.insert(changes.named.end(), c.not_compared.begin(), c.not_compared.end());
}

std::string to_baseline(const Report& report) {
  std::string text = fmt::format(
      "{}\n# Check, cases in which it is wrong, worst value, subject: limitcheck audit --save-baseline\n",
      kTitle);
  for (const auto& [subject, device] : report.devices) text += device_line(subject, device) + "\n";
  for (const auto& [key, sum] : sums_of(report))
    text += fmt::format("{} {} {} {}\n", key.second, sum.cases, worst_text(sum.worst), key.first);
  return text;
}

}  // namespace limitcheck::verify
