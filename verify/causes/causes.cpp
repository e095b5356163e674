// SPDX-License-Identifier: MIT
#include "verify/causes/causes.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <tuple>

#include "verify/evidence/cells.h"
#include "verify/row/commands.h"

namespace limitcheck::verify {
namespace {

// The worst of one check among the rows that show a cause.
struct Worst {
  double worst = 0;
  std::int64_t bad = 0, of = 0;
  const Result* row = nullptr;
};

std::map<std::string, Worst> worst_of(const Report& report, const Cause& cause) {
  std::map<std::string, Worst> all;
  for (const std::size_t k : cause.direct) {
    const Result& r = report.results[k];
    Worst& w = all[r.check];
    w.bad += r.bad;
    w.of += r.of;
    if (w.row != nullptr && r.worst.value_or(0) <= w.worst) continue;
    w.worst = r.worst.value_or(0), w.row = &r;
  }
  return all;
}

std::string percent(std::int64_t bad, std::int64_t of) {
  const double share = of > 0 ? 100.0 * static_cast<double>(bad) / static_cast<double>(of) : 0;
  return share >= 1 ? fmt::format("{:.0f} %", share) : fmt::format("{:.1g} %", share);
}

std::string degrees(double x) {
  return x >= 10 ? fmt::format("{:.0f}°", x) : fmt::format("{:.2g}°", x);
}

void describe_surface(const Report& report, Cause& cause) {
  std::vector<std::string> what, size;
  double distance = 0, angle = 0;
  for (const auto& [check, w] : worst_of(report, cause)) {
    const bool normals = w.row->unit == "degrees";
    what.emplace_back(normals ? "normals" : check == "refined-positions" ? "refined points" : "positions");
    if (normals) {
      angle = w.worst;
      size.push_back(degrees(w.worst));
    } else {
      distance = std::max(distance, w.worst);
      size.insert(size.begin(), fmt::format("{:.1e} diagonals", w.worst));
    }
  }
  std::sort(what.rbegin(), what.rend());  // positions before normals
  what.erase(std::unique(what.begin(), what.end()), what.end());
  std::string title = fmt::format("{}", fmt::join(what, " and "));
  title[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(title[0])));
  const std::string loop = where_wrong(cause.places[0]), quads = where_wrong(cause.places[1]);
  const std::string where = loop.empty() || loop == quads ? quads
                            : quads.empty()               ? loop
                                                          : loop + " (Catmull-Clark: " + quads + ")";
  const bool all = is_everywhere(cause.places[loop.empty() ? 1 : 0]);
  cause.title = fmt::format("{} are off by up to {}{}{}", title, fmt::join(size, " and "),
                            where.empty() ? ""
                            : all         ? ", "
                                          : ", only ",
                            where);
  if (what.size() == 1 && what[0] == "normals") cause.look = "the points are right: look at the tangents";
  for (const std::size_t k : cause.direct)
    if (const auto& known = report.results[k].recognised) cause.look = "the points are " + known->what;
  if (cause.look.empty())
    cause.look = all             ? "rounding, or rules that every face has in common"
                 : where.empty() ? ""
                                 : "the rules and tables for just these places";
  cause.size = distance >= 1e-3 || angle >= 5 ? 3 : distance >= 1e-5 || angle >= 0.5 ? 2 : 1;
}

void describe_not_finite(const Report& report, Cause& cause) {
  const auto worst = worst_of(report, cause);
  std::vector<std::string> when;
  std::vector<PlaceCount> places;
  for (const std::size_t k : cause.direct)
    if (report.results[k].check == "finite") add(places, report.results[k].places);
  if (const std::string where = where_wrong(places); !where.empty()) when.push_back(where);
  if (worst.contains("degenerate-geometry"))
    when.emplace_back("where all control points are on one line or are one point");
  if (worst.contains("scaling")) when.emplace_back("on meshes 2^40 times smaller or larger");
  const bool lengths = worst.contains("normal-length") && !worst.contains("finite");
  cause.title = fmt::format(
      "{}{}{}", lengths ? "Normals that are not of unit length" : "NaN, infinity or a normal of length 0",
      when.empty() ? "" : ": ", fmt::join(when, "; "));
}

void describe_seams(const Report& report, Cause& cause) {
  const auto worst = worst_of(report, cause);
  std::vector<std::string> shares;
  double gap = 0, turn = 0;
  const auto share = [&](const char* check, const char* of, double& most) {
    const auto found = worst.find(check);
    if (found == worst.end()) return;
    shares.push_back(percent(found->second.bad, found->second.of) + of);
    most = found->second.worst;
  };
  share("shared-positions", " of the positions", gap);
  share("shared-normals", " of the normals", turn);
  if (shares.empty()) {
    cause.title = worst.contains("t-vertices") || worst.contains("watertight")
                      ? "Cracks: faces that meet do not end in the same vertices"
                      : "Faces that meet differ at common points by more than rounding";
    cause.look = "edges between faces of different depth";
    cause.size = 2;
    return;
  }
  cause.title = fmt::format("Points that faces share differ in bits: {}, by up to {:.1e} diagonals{}",
                            fmt::join(shares, " and "), gap, turn > 0 ? " and " + degrees(turn) : "");
}

// What a subject took that it should have refused, over all rows.
void describe_accepts(const Report& report, Cause& cause) {
  std::vector<std::string> taken;
  for (const std::size_t k : cause.direct)
    for (const std::string& what : report.results[k].accepted)
      if (std::ranges::find(taken, what) == taken.end()) taken.push_back(what);
  std::string list = taken.empty() ? "" : ": " + fmt::format("{}", fmt::join(taken, ", "));
  constexpr std::size_t kLongest = 160;
  if (list.size() > kLongest) list = list.substr(0, list.rfind(' ', kLongest)) + " ...";
  cause.title = "Broken meshes are accepted without a word" + list;
}

std::string first_sentence(const std::string& message) {
  const std::string text = message.substr(0, message.find_first_of("\n;"));
  return text.size() > 140 ? text.substr(0, 140) + " ..." : text;
}

// By the example's message, and of which checks.
void describe_checks(const Report& report, Cause& cause) {
  const Result& example = report.results[cause.example];
  const std::string sentence = first_sentence(example.message);
  std::set<std::string> checks;
  double worst = 0;
  for (const std::size_t k : cause.direct) {
    checks.insert(report.results[k].check);
    worst = std::max(worst, report.results[k].worst.value_or(0));
  }
  if (cause.kind == CauseKind::kOrder) {
    cause.title =
        fmt::format("The answer depends on what it must not depend on ({})", fmt::join(checks, ", "));
    cause.look = sentence;
  } else {
    cause.title = fmt::format("{}: {}", fmt::join(checks, ", "),
                              example.message.empty() ? "beyond its bound" : sentence);
  }
  if (worst > 1 && example.unit == "bounds")
    cause.title += fmt::format(", up to {:.2g} times what rounding explains", worst);
  cause.size = worst >= 100 ? 3 : 2;
}

void describe_breakdown(const Report& report, Cause& cause) {
  const Result& example = report.results[cause.example];
  const char* what = example.status == Status::kCrash     ? "Crashes"
                     : example.status == Status::kTimeout ? "Does not answer in time"
                                                          : "Fails";
  cause.title = fmt::format("{}: {}", what, first_sentence(example.message));
}

// Title, where to look and size of each kind, in the order of CauseKind. A title goes on with the first sentence of the
// example's message, unless the cause is described in its own way.
struct Words {
  const char *title, *look;
  int size;
  void (*describe)(const Report&, Cause&) = nullptr;
};
constexpr Words kWords[] = {
    {"", "", 3, describe_breakdown},
    {"A valid mesh is refused", "say so in the capabilities, or take it", 2},
    {"Arrays are not as announced", "", 3},
    {"", "where a vector is divided by its length: the length is 0, or its square is too small or large", 3,
     describe_not_finite},
    {"", "", 0, describe_surface},
    {"Faces are not tiled once, or triangles face the wrong way", "", 3},
    {"", "sums whose order depends on the face; compute what is shared once, or in one order", 1,
     describe_seams},
    {"", "", 0, describe_checks},
    {"", "what is checked of a mesh before it is used", 1, describe_accepts},
    {"", "", 0, describe_checks}};

void put_in_words(const Report& report, Cause& cause) {
  const auto& [title, look, size, describe] = kWords[static_cast<std::size_t>(cause.kind)];
  cause.title = fmt::format("{}: {}", title, first_sentence(report.results[cause.example].message));
  cause.look = look;
  cause.size = size;
  if (describe != nullptr) describe(report, cause);
}

using Pairs = std::set<std::pair<std::string, Case>>;  // of subject and case

Pairs pairs_of(const Report& report, const std::vector<std::size_t>& rows) {
  Pairs pairs;
  for (const std::size_t k : rows) pairs.emplace(report.results[k].subject, case_of(report.results[k]));
  return pairs;
}

// The kind of neighbourhood (verify/evidence/cells.h) that all cases with a cause look at and no other of the cases
// that were looked at for it: one feature, or a pair of them if it is no single one. "" if that leaves several.
std::string only_with(const Report& report, const Pairs& wrong, const Pairs& looked) {
  std::map<Case, const CaseCells*> known;
  for (const CaseCells& c : report.cases) known[c.at] = &c;
  std::map<Case, bool> is_wrong;  // of any of the subjects
  for (const auto& [subject, at] : looked) is_wrong[at] |= wrong.contains({subject, at});
  std::map<data::Scheme, CellSet> always, elsewhere;
  for (const auto& [at, bad] : is_wrong) {
    if (!known.contains(at)) return "";
    const CaseCells& c = *known[at];
    const auto [set, is_new] = (bad ? always : elsewhere).try_emplace(c.scheme, c.cells);
    for (std::size_t k = 0; k < c.cells.size(); ++k)
      set->second[k] = bad ? set->second[k] && c.cells[k] : set->second[k] || c.cells[k];
  }
  if (always.size() != 1) return "";
  const auto& [scheme, all] = *always.begin();
  const CellSet& others = elsewhere[scheme];
  std::vector<std::string> singles, pairs;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (!all[k] || others.empty() || others[k]) continue;
    const Cell& cell = cells(scheme)[k];
    (cell.first == cell.second ? singles : pairs).push_back(cell.name());
  }
  const std::vector<std::string>& names = singles.empty() ? pairs : singles;
  return names.size() == 1 ? names.front() : "";
}

std::int64_t faces_of(const Report& report, const Result& r) {
  for (const auto& m : report.meshes)
    if (m.name == r.mesh) return m.faces;
  return 0;
}

void complete(const Report& report, Cause& cause) {
  std::set<std::string> subjects, checks, consequences;
  for (const std::size_t k : cause.rows) subjects.insert(report.results[k].subject);
  for (const std::size_t k : cause.direct) checks.insert(report.results[k].check);
  for (const std::size_t k : cause.rows)
    if (!checks.contains(report.results[k].check)) consequences.insert(report.results[k].check);
  for (const std::string& s : report.subjects)
    if (subjects.contains(s)) cause.subjects.push_back(s);
  cause.consequences.assign(consequences.begin(), consequences.end());
  if (cause.direct.empty()) cause.direct = cause.rows;

  // The smallest mesh; a row whose point can be shown rather than another one.
  const auto rank = [&](std::size_t k) {
    const Result& r = report.results[k];
    return std::tuple(!r.sample.empty(), difference_command(r).empty(), faces_of(report, r), r.depth, k);
  };
  cause.example = *std::ranges::min_element(cause.direct,
                                            [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });

  std::vector<std::size_t> looked;
  for (std::size_t k = 0; k < report.results.size(); ++k) {
    const Result& r = report.results[k];
    if (subjects.contains(r.subject) && (checks.empty() || checks.contains(r.check)) && looked_at(r))
      looked.push_back(k);
  }
  const Pairs wrong = pairs_of(report, cause.direct), all = pairs_of(report, looked);
  cause.cases = static_cast<std::int64_t>(wrong.size());
  cause.of = static_cast<std::int64_t>(all.size());
  if (cause.kind == CauseKind::kSurface || cause.kind == CauseKind::kNotFinite)
    cause.only_with = only_with(report, wrong, all);
  cause.share = 2 * cause.cases >= cause.of ? 3 : 10 * cause.cases >= cause.of ? 2 : 1;
}

}  // namespace

std::string_view Cause::severity() const {
  const int product = size * share;
  return product >= 6 ? "high" : product >= 3 ? "medium" : "low";
}

std::vector<Cause> causes(const Report& report) {
  std::vector<Cause> all = sorted_into_causes(report);
  for (Cause& cause : all) {
    complete(report, cause);
    put_in_words(report, cause);
    if (!cause.only_with.empty()) cause.title += "; of all neighbourhoods only with " + cause.only_with;
  }
  const auto rank = [](const Cause& c) { return std::tuple(c.size * c.share, c.size, c.cases); };
  std::ranges::stable_sort(all, [&](const Cause& a, const Cause& b) { return rank(a) > rank(b); });
  return all;
}

std::string command_for(const Report& report, const Cause& cause, const std::string& level) {
  const Result& r = report.results[cause.example];
  if (const std::string command = difference_command(r); !command.empty()) return command;
  return audit_command(r, level) + " --details";
}

}  // namespace limitcheck::verify
