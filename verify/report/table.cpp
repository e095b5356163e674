// SPDX-License-Identifier: MIT
#include "verify/report/forms.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "verify/row/commands.h"

namespace limitcheck::verify {
namespace {

// The rows of one subject and check: one line of the table.
struct Line {
  std::string check;
  std::vector<const Result*> results;  // one per mesh
  const Result* shown = nullptr;       // the one whose numbers stand in the line
  std::int64_t bad_meshes = 0, looked_at = 0;
};

// How a status is shown.
struct StatusWords {
  const char* verdict;
  int rank;  // of findings before rows that held
  const char* colour;
};
const StatusWords& words_of(Status status) {
  static constexpr StatusWords kWords[] = {
      {"held", 2, "32"},        {"FINDING", 4, "31"},      {"warning", 3, "2"}, {"waived", 3, "2"},
      {"STALE WAIVER", 3, "2"}, {"not supported", 1, "2"}, {"not run", 0, "2"}, {"CRASH", 5, "1;31"},
      {"TIMEOUT", 5, "1;31"},   {"ERROR", 5, "1;31"}};
  return kWords[static_cast<std::size_t>(status)];
}

// Whether x is worse than y: findings before rows that held, then by the worst value in units of its bound;
// for bound 0, and for equal values, by the share of bad elements.
bool worse(const Result& a, const Result& b) {
  const auto rank = [](const Result& r) { return words_of(r.status).rank; };
  if (rank(a) != rank(b)) return rank(a) > rank(b);
  const auto excess = [](const Result& r) {
    if (r.bound == 0) return 0.0;
    if (!r.worst) return r.bad > 0 ? std::numeric_limits<double>::infinity() : -1.0;
    return r.bound ? *r.worst / *r.bound : *r.worst;
  };
  if (excess(a) != excess(b)) return excess(a) > excess(b);
  const auto share = [](const Result& r) {
    return r.of > 0 ? static_cast<double>(r.bad) / static_cast<double>(r.of) : 0;
  };
  return share(a) > share(b);
}

std::vector<Line> lines_of(const Report& report, const std::string& subject) {
  std::vector<Line> lines;
  for (const Result& r : report.results) {
    if (r.subject != subject) continue;
    auto line = std::ranges::find_if(lines, [&](const Line& l) { return l.check == r.check; });
    if (line == lines.end()) line = lines.insert(lines.end(), Line{r.check, {}, nullptr, 0, 0});
    line->results.push_back(&r);
    line->bad_meshes += is_bad(r);
    line->looked_at += looked_at(r);
    if (line->shown == nullptr || worse(r, *line->shown)) line->shown = &r;
  }
  return lines;
}

bool is_breakdown(Status status) {
  return status == Status::kCrash || status == Status::kTimeout || status == Status::kError;
}

TableCell painted(Status status) {
  return {words_of(status).verdict, words_of(status).colour};
}

std::string amount(const std::optional<double>& x) {
  return x ? fmt::format("{:.2e}", *x) : "-";
}

// Numbers of a witness as their precision prints them: a float as a float.
std::string numbers(const std::vector<double>& list) {
  std::vector<std::string> words;
  for (const double x : list) {
    if (std::isnan(x)) {
      words.emplace_back("nan");
      continue;
    }
    const auto single = static_cast<float>(x);
    words.push_back(static_cast<double>(single) == x ? fmt::format("{}", single) : fmt::format("{}", x));
  }
  return fmt::format("{}", fmt::join(words, "  "));
}

std::string where(const Report& report, const Result& r) {
  if (!r.witness) return "";
  const std::string mesh = case_name(report, r);
  if (!r.witness->l1.empty())
    return fmt::format("{} face {} ({}, {})", mesh, r.witness->where(), r.witness->l1, r.witness->l2);
  if (r.witness->triangle >= 0) return fmt::format("{} triangle {}", mesh, r.witness->triangle);
  return mesh;
}

TableRow row_of(const Report& report, const Result& r, std::int64_t bad, std::int64_t of,
                const std::string& meshes, const std::string& depths) {
  const bool has_worst = r.worst.has_value() || r.rms.has_value();
  TableRow row{.weighty = is_bad(r)};
  row.cells = {{r.check},
               painted(r.status),
               {meshes},
               {of > 0 ? fmt::format("{}/{}", bad, of) : "-"},
               {has_worst ? (r.worst ? amount(r.worst) : "nan") : "-"},
               {has_worst ? amount(r.bound) : "-"},
               {has_worst ? amount(r.p99) : "-"},
               {r.unit}};
  if (report.depths == "plan") row.cells.push_back({depths});
  row.cells.push_back({where(report, r)});
  return row;
}

// The commands that a message of a process that broke down contains, each on a line of its own, to be copied.
std::string in_lines(std::string message) {
  for (const std::string_view mark : {"; again with: ", " / "})
    for (std::size_t k = 0; (k = message.find(mark, k)) != std::string::npos; k += 6)
      message.replace(k, mark.size(), mark == " / " ? "\n     " : "\n       ");
  return message;
}

void add_finding(std::string& out, const Report& report, int number, const Line& line, std::size_t width) {
  const Result& r = *line.shown;
  std::string said = fmt::format("\n{:>3}. {} / {}: ", number, r.subject, r.check);
  if (is_breakdown(r.status)) {
    out += said + fmt::format("{}: {}\n", case_name(report, r), in_lines(r.message));
    return;
  }
  said += r.of > 0 ? fmt::format("{} of {}", r.bad, r.of) : fmt::format("{}", r.bad);
  if (!r.rms) {
    said += r.unit.empty() ? "" : " " + r.unit;
  } else {
    said += r.bound == 0 ? " differ" : fmt::format(" beyond {:.2e} {}", r.bound.value_or(0), r.unit);
    said += r.worst ? fmt::format(", worst {:.3e} {}", *r.worst, r.unit) : ", worst not finite";
  }
  said += fmt::format("\n     on {}", case_name(report, r));
  std::vector<std::string> others;
  for (const Result* other : line.results)
    if (other != &r && is_bad(*other)) others.push_back(case_name(report, *other));
  constexpr std::size_t kNamed = 5;
  const std::size_t more = others.size() - std::min(others.size(), kNamed);
  others.resize(others.size() - more);
  if (!others.empty()) said += fmt::format("; also on {}", fmt::join(others, ", "));
  if (more > 0) said += fmt::format(" and {} more", more);
  said += "\n";
  out += wrapped(said, width, 5);
  if (!r.message.empty()) out += wrapped(fmt::format("     {}\n", in_lines(r.message)), width, 7);
  if (!r.witness) return;
  const Witness& w = *r.witness;
  std::vector<std::string> place;
  if (w.face >= 0) place.push_back(fmt::format("face {}", w.where()));
  if (!w.l1.empty())
    place.push_back(r.scheme == data::Scheme::kLoop ? fmt::format("l1 = {}, l2 = {}", w.l1, w.l2)
                                                    : fmt::format("u = {}, v = {}", w.l1, w.l2));
  if (w.vertex >= 0) place.push_back(fmt::format("vertex {}", w.vertex));
  if (w.triangle >= 0) place.push_back(fmt::format("triangle {}", w.triangle));
  if (!place.empty()) out += fmt::format("     witness   {}\n", fmt::join(place, ", "));
  if (!w.expected.empty()) out += fmt::format("     expected  {}\n", numbers(w.expected));
  if (!w.got.empty()) out += fmt::format("     got       {}\n", numbers(w.got));
  const std::string command = difference_command(r), truth = eval_command(r);
  if (!command.empty()) out += fmt::format("     {}\n", command);
  if (!truth.empty()) out += fmt::format("     {}\n", truth);
}

// Why meshes were not tessellated at all though nothing is wrong, and how places were found: each sentence once.
std::string reasons(const Report& report, const std::string& subject) {
  std::map<std::pair<Status, std::string>, std::vector<std::string>> meshes;
  for (const Result& r : report.results)
    if (r.subject == subject && r.check == "tessellates" && !r.message.empty() &&
        (r.status == Status::kNotSupported || r.status == Status::kHeld))
      meshes[{r.status, r.message}].push_back(case_name(report, r));
  std::string out;
  for (const auto& [said, names] : meshes)
    out += fmt::format("  {}{}{}: {}\n", said.first == Status::kHeld ? "" : "not supported: ", names.front(),
                       names.size() > 1 ? fmt::format(" and {} more", names.size() - 1) : "", said.second);
  return out;
}

std::string lines_table(const Report& report, const std::vector<Line>& lines, const Screen& screen) {
  const bool plan = report.depths == "plan";
  std::vector<Column> columns{{"check", 25},
                              {"verdict", 14},
                              {plan ? "cases" : "meshes", 7, true},
                              {"bad/looked at", 16, true, 2},
                              {"worst", 9, true, 2},
                              {"bound", 9, true, 1, 5},
                              {"99 %", 9, true, 1, 1},
                              {"unit", 9, false, 2, 4}};
  if (plan) columns.push_back({"depths", 9, false, 1, 2});
  columns.push_back({"where", 0, false, 1, 3});
  std::vector<TableRow> rows;
  for (const Line& line : lines) {
    std::int64_t bad = 0, of = 0;
    for (const Result* r : line.results) {
      bad += r->bad;
      of += r->of;
    }
    rows.push_back(row_of(report, *line.shown, bad, of,
                          fmt::format("{}/{}", line.looked_at - line.bad_meshes, line.results.size()),
                          depths_in_short(line.results)));
  }
  return table(std::move(columns), rows, screen, 2);
}

// Why checks looked at nothing: a line for each reason.
std::string not_looked_at(const Report& report, const std::vector<Line>& lines) {
  std::map<std::string, std::vector<std::string_view>> why;
  for (const Line& line : lines)
    if (line.looked_at == 0)
      why[line.shown->status == Status::kNotSupported ? "not supported" : "not run"].push_back(line.check);
  bool any = false;
  std::vector<std::string_view> absent;
  for (const CheckGroup& group : check_groups(report))
    for (const std::string_view check : group.checks) {
      const bool there = std::ranges::any_of(lines, [&](const Line& l) { return l.check == check; });
      any = any || there;
      // These rows are there only where they are needed.
      if (!there && check != "refined-positions" && check != "recognised") absent.push_back(check);
    }
  if (any && !absent.empty() && report.depths != "file") why["not asked"] = absent;
  std::string out;
  for (const auto& [reason, checks] : why) out += fmt::format("  {}: {}\n", reason, fmt::join(checks, ", "));
  return out;
}

// What the words of the table mean.
std::string words(const Report& report) {
  return fmt::format(
      "{0} a/b: held on a of b. bad/looked at: points, triangles or whatever the unit says, over all {0}; "
      "worst, bound and 99 % are those of the worst one. warning: within the bound, and worth a look. -: "
      "nothing to count or measure, or nothing was looked at. limitcheck audit --explain CHECK says what a "
      "check means and where its bound comes from.\n",
      report.depths == "plan" ? "cases" : "meshes");
}

}  // namespace

std::string check_lines(const Report& report, const std::string& subject, const Screen& screen) {
  std::vector<Line> lines = lines_of(report, subject);
  const std::string why_not = reasons(report, subject), not_looked = not_looked_at(report, lines);
  std::erase_if(lines, [](const Line& l) { return l.looked_at == 0; });
  if (lines.empty() && !why_not.empty()) return subject + "\n" + why_not;
  return subject + "\n" + lines_table(report, lines, screen) + not_looked + why_not;
}

std::string to_table(const Report& report, const Screen& screen) {
  const bool plan = report.depths == "plan";
  std::string out = header(report);
  std::vector<Line> findings;
  for (const std::string& subject : report.subjects) {
    std::vector<Line> lines = lines_of(report, subject);
    out += "\n" + subject + "\n";
    const std::string why_not = reasons(report, subject);
    if (!why_not.empty() && std::ranges::none_of(lines, [](const Line& l) { return l.looked_at > 0; })) {
      out += why_not;
      continue;
    }
    out += lines_table(report, lines, screen);
    for (Line& line : lines)
      if (line.bad_meshes > 0) findings.push_back(std::move(line));
    if (plan) out += fmt::format("  depths looked at: {}\n", depths_in_full(report, subject));
    out += why_not;
  }
  out += "\n" + words(report) + waiver_lines(report);
  if (!findings.empty())
    out +=
        "\nFindings, each at its worst. (Expected values are those of the control mesh rounded to the "
        "subject's precision.)\n";
  out = wrapped(out, screen.width);
  for (std::size_t k = 0; k < findings.size(); ++k)  // as they are, with commands to be copied
    add_finding(out, report, static_cast<int>(k) + 1, findings[k], screen.width);

  if (!report.printed.empty()) out += "\nPrinted by subjects:\n" + report.printed;
  return out + wrapped("\n" + changes_line(report) + summary(report), screen.width);
}

}  // namespace limitcheck::verify
