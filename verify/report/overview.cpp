// SPDX-License-Identifier: MIT

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "verify/report/coverage.h"
#include "verify/report/forms.h"
#include "verify/row/commands.h"
#include "verify/row/rows.h"

namespace limitcheck::verify {
namespace {

std::string coloured(const std::string& text, const char* code, bool colour) {
  return colour ? fmt::format("\033[{}m{}\033[0m", code, text) : text;
}

const char* colour_of(const GroupVerdict& v) {
  return v.bad > 0 ? "31" : v.looked_at == 0 || v.waived || v.stale ? "2" : "32";
}

std::string matrix(const Report& report, const Screen& screen) {
  std::vector<Column> columns{{"subject", 7}};
  for (const CheckGroup& g : check_groups(report)) columns.push_back({std::string(g.title), 10, true});
  std::vector<TableRow> rows;
  for (const std::string& subject : report.subjects) {
    TableRow row;
    row.cells.push_back({subject});
    for (const CheckGroup& g : check_groups(report)) {
      const GroupVerdict v = verdict_of(report, subject, g);
      row.cells.push_back({v.text(), colour_of(v)});
    }
    rows.push_back(std::move(row));
  }
  return table_in_blocks(columns, rows, screen, 0);
}

std::string one_line(const Cause& cause, std::size_t number, bool colour) {
  const char* code = cause.severity() == "high" ? "31" : cause.severity() == "medium" ? "33" : "2";
  const std::string cases = cause.of > 1 ? fmt::format(" (in {} of {} cases)", cause.cases, cause.of) : "";
  return fmt::format("{:>2} {} {}: {}{}\n", number,
                     coloured(fmt::format("{:<6}", cause.severity()), code, colour), cause.label(),
                     cause.title, cases);
}

}  // namespace

const std::vector<CheckGroup>& check_groups(const Report& report) {
  const auto of = [](bool files) {
    std::vector<CheckGroup> all;
    for (const RowKind& row : row_kinds()) {
      if (row.group.empty() || row.check.starts_with("file-") != files) continue;
      auto group = std::ranges::find_if(all, [&](const CheckGroup& g) { return g.title == row.group; });
      if (group == all.end()) group = all.insert(all.end(), {row.group, {}});
      group->checks.push_back(row.check);
    }
    return all;
  };
  static const std::vector<CheckGroup> subjects = of(false), files = of(true);
  return report.depths == "file" ? files : subjects;
}

std::string GroupVerdict::text() const {
  if (bad > 0) return fmt::format("{}/{}", bad, looked_at);
  if (stale || waived || looked_at > 0) return stale ? "stale" : waived ? "waived" : "held";
  return !asked ? "not asked" : supported ? "not run" : "unsupported";
}

GroupVerdict verdict_of(const Report& report, const std::string& subject, const CheckGroup& group) {
  std::set<Case> bad, looked;
  GroupVerdict v;
  for (const Result& r : report.results) {
    if (r.subject != subject || std::ranges::find(group.checks, r.check) == group.checks.end()) continue;
    v.asked = true;
    v.supported = v.supported || r.status != Status::kNotSupported;
    if (looked_at(r)) looked.insert(case_of(r));
    if (is_bad(r)) bad.insert(case_of(r));
    v.waived = v.waived || r.status == Status::kWaived;
    v.stale = v.stale || r.status == Status::kUnexpectedPass;
  }
  v.bad = static_cast<std::int64_t>(bad.size());
  v.looked_at = static_cast<std::int64_t>(looked.size());
  return v;
}

std::string header(const Report& report) {
  std::int64_t faces = 0;
  for (const auto& m : report.meshes) faces += m.faces;
  std::string depth = fmt::format("depth {}", report.depth);
  if (report.depths == "file")
    depth = "a finished tessellation";
  else if (report.depths == "plan")
    depth = fmt::format("depths 0 to {}", report.depth);
  else if (report.depths != "uniform")
    depth += fmt::format(" at most, {}", report.depths);
  if (report.seed) depth += fmt::format(" (seed {})", *report.seed);
  if (!report.sample.empty()) depth += fmt::format(", a sample of faces ({})", report.sample);
  std::string out = fmt::format(
      "limitcheck {}: {} on {} ({} faces)\n", report.version, depth,
      report.meshes.size() == 1 ? report.meshes[0].name : fmt::format("{} meshes", report.meshes.size()),
      faces);
  if (!report.containment.empty())
    out += fmt::format("subjects in processes of their own: {}\n", report.containment);
  for (const auto& [subject, device] : report.devices) out += fmt::format("{} on {}\n", subject, device);
  if (report.left_out.empty()) return out;
  std::vector<std::string_view> kept;
  for (const CheckGroup& g : check_groups(report))
    for (const std::string_view check : g.checks)
      if (std::ranges::find(report.left_out, check) == report.left_out.end()) kept.push_back(check);
  out += kept.size() < report.left_out.size()
             ? fmt::format("only these checks, {} are left out and not judged: {}\n", report.left_out.size(),
                           fmt::join(kept, ", "))
             : fmt::format("left out and not judged: {}\n", fmt::join(report.left_out, ", "));
  return out;
}

std::string waiver_lines(const Report& report) {
  std::string out;
  std::map<std::pair<std::string, std::string>, std::pair<int, std::string>> groups;  // how many, the first
  for (const Result& r : report.results) {
    if (r.check == "waiver") out += r.message + "\n";
    if (r.status != Status::kWaived && r.status != Status::kUnexpectedPass) continue;
    const char* what = r.status == Status::kWaived ? "waived" : "stale waiver";
    auto& [count, first] = groups[{what, fmt::format("{} / {}", r.subject, r.check)}];
    if (++count == 1) first = r.waiver;
  }
  for (const auto& [key, group] : groups)
    out += fmt::format("{}: {}, {} case{}: {}\n", key.first, key.second, group.first,
                       group.first == 1 ? "" : "s", group.second);
  return out;
}

std::string summary(const Report& report) {
  std::int64_t held = 0, bad = 0, noted = 0, other = 0;
  for (const Result& r : report.results) {
    const bool note = r.status == Status::kQualityWarning || r.status == Status::kWaived ||
                      r.status == Status::kUnexpectedPass;
    (r.status == Status::kHeld ? held : is_bad(r) ? bad : note ? noted : other) += 1;
  }
  std::string out =
      fmt::format("{} held, {} findings, {}{} not supported or not run; {:.1f} s\n", held, bad,
                  noted > 0 ? fmt::format("{} warnings or waived, ", noted) : "", other, report.seconds);
  out += coverage_lines(report) + exhaustive_lines(report);
  for (const Unjudged& none : unjudged(report)) out += none.text() + "\n";
  if (!report.incomplete.empty()) out += fmt::format("INCOMPLETE: {}\n", report.incomplete);
  return out;
}

std::string legend(const Report& report) {
  if (report.depths == "file")
    return "held: looked at, nothing wrong; 1/1: wrong; unsupported: the file has nothing of the kind; not "
           "asked: an option leaves it out; not run: something before it failed.\n"
           "diagonal: of the control mesh's bounding box.\n";
  return fmt::format(
      "held: looked at, nothing wrong; 5/126: wrong in 5 of 126 {}; unsupported: the subject does not do it; "
      "not asked: --level or --checks leaves it out, the mesh has more than 200 faces, or no sharp edges to "
      "ask for; not run: something before it failed.\n"
      "irregular: at a vertex of another valence than 6 (Loop) or 4 (Catmull-Clark), or no quad; diagonal: "
      "of the mesh's bounding box.\n",
      report.depths == "plan" ? "cases (a mesh at its depths)" : "meshes");
}

std::string changes_line(const Report& report) {
  if (!report.changes) return "";
  const auto& c = *report.changes;
  std::string out = fmt::format("since {}: {} new, {} worse, {} gone, {} as before\n", c.baseline, c.appeared,
                                c.worse, c.gone, c.same);
  if (!report.rerun.empty()) {
    const std::int64_t there = c.same + c.worse, missed = c.before - c.gone - there;
    out = fmt::format("of {} findings in {}: {} gone, {} still there{}{}{}\n", c.before, c.baseline, c.gone,
                      there, c.worse > 0 ? fmt::format(" ({} worse)", c.worse) : "",
                      missed > 0 ? fmt::format(", {} not judged", missed) : "",
                      c.appeared > 0 ? fmt::format("; {} new", c.appeared) : "");
  }
  constexpr std::size_t kNamed = 8;
  for (std::size_t k = 0; k < c.named.size() && k < kNamed; ++k) out += "  " + c.named[k] + "\n";
  if (c.named.size() > kNamed) out += fmt::format("  and {} more\n", c.named.size() - kNamed);
  return out;
}

std::string to_overview(const Report& report, const std::vector<Cause>& causes, const Screen& screen,
                        const std::string& scheme_line, const std::string& level, const std::string& full) {
  std::string top = scheme_line + "\n" + header(report) + "\n";
  if (report.subjects.size() == 1)
    top += check_lines(report, report.subjects.front(), screen);
  else
    top += matrix(report, screen) + legend(report);
  top = wrapped(top + waiver_lines(report), screen.width);
  const std::string bottom = wrapped("\n" + changes_line(report) + summary(report) + full, screen.width);

  std::string brief, long_form;
  for (std::size_t k = 0; k < causes.size(); ++k) {
    const std::string line = wrapped(one_line(causes[k], k + 1, screen.colour), screen.width, 10);
    brief += line;
    const std::string command = command_for(report, causes[k], level);
    long_form += line + (command.empty() ? "" : "          " + command + "\n");
  }
  const auto lines = [](const std::string& text) { return std::ranges::count(text, '\n'); };
  const bool all = lines(top) + lines(bottom) + lines(long_form) + 2 <= kScreen;
  std::string middle;
  if (!causes.empty())
    middle = wrapped(fmt::format("\n{} root cause{} of all findings, the gravest first{}\n", causes.size(),
                                 causes.size() == 1 ? "" : "s",
                                 all ? ", each with the command that shows it" : ""),
                     screen.width) +
             (all ? long_form : brief);
  return top + middle + bottom;
}

std::string causes_in_full(const Report& report, const std::vector<Cause>& causes, const std::string& level) {
  std::string out;
  for (std::size_t k = 0; k < causes.size(); ++k) {
    const Cause& c = causes[k];
    out += one_line(c, k + 1, false);
    if (c.subjects.size() > 1) out += fmt::format("   subjects     {}\n", fmt::join(c.subjects, ", "));
    if (!c.look.empty()) out += fmt::format("   look at      {}\n", c.look);
    if (!c.consequences.empty()) out += fmt::format("   consequences {}\n", fmt::join(c.consequences, ", "));
    out += fmt::format("   smallest     {}, {} row{} in all\n", case_name(report, report.results[c.example]),
                       c.rows.size(), c.rows.size() == 1 ? "" : "s");
    if (const std::string command = command_for(report, c, level); !command.empty())
      out += fmt::format("   see it       {}\n", command);
    out += "\n";
  }
  return out;
}

std::string Unjudged::text() const {
  return fmt::format("{} of {} {} never judged{}{}", check, subject, check.ends_with('s') ? "were" : "was",
                     reason.empty() ? "" : ": ", reason);
}

std::vector<Unjudged> unjudged(const Report& report, const std::vector<std::string>& checks) {
  std::vector<Unjudged> missing;
  for (const std::string& subject : report.subjects)
    for (const std::string& check : checks) {
      const bool left_out = std::ranges::find(report.left_out, check) != report.left_out.end();
      Unjudged none{subject, check, left_out ? "left out by --checks" : "", false};
      bool judged = false;
      for (const Result& r : report.results) {
        if (r.subject != subject || r.check != check) continue;
        judged = judged || looked_at(r);
        if (none.reason.empty() && !r.message.empty())
          none.reason = r.message, none.not_asked = r.status == Status::kNotSupported;
      }
      if (!judged) missing.push_back(std::move(none));
    }
  return missing;
}

std::vector<Unjudged> unjudged(const Report& report) {
  std::vector<Unjudged> missing = unjudged(report, {"positions", "normals", "rejected-inputs"});
  std::erase_if(missing, [&](const Unjudged& none) {
    if (none.check == "rejected-inputs") return !none.not_asked;
    const auto any = [&](const auto& of) {
      return std::ranges::any_of(report.results,
                                 [&](const Result& r) { return r.subject == none.subject && of(r); });
    };
    // What it tessellates nothing of, because it does not do the scheme, the table says.
    return !any([&](const Result& r) { return r.check == none.check; }) ||
           !any([&](const Result& r) { return r.check == "tessellates" && looked_at(r); }) ||
           (none.check == "positions" &&
            any([](const Result& r) { return r.check == "refined-positions" && looked_at(r); }));
  });
  return missing;
}

}  // namespace limitcheck::verify
