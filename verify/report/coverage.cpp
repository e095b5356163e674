// SPDX-License-Identifier: MIT
#include "verify/report/coverage.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>
#include <utility>

#include "data/generators/every_neighbourhood.h"
#include "data/untrusted_json.h"
#include "verify/host/host.h"

namespace limitcheck::verify {
namespace {

using Json = nlohmann::json;

bool is_declared(const Cell& cell, const Declared& by) {
  if ((cell.needs() & ~by.abilities) != 0) return false;
  for (const std::size_t f : {cell.first, cell.second})
    if (const auto [axis, k] = on_axis(f); axis == Axis::kDepth && static_cast<int>(k) > by.max_depth)
      return false;
  return true;
}

bool is_of_judged_points(const Result& r) {
  return (r.check == "positions" || r.check == "refined-positions") && r.of > 0 && looked_at(r);
}

// "Loop", or of several subjects "Loop (naive)".
std::string who(const Report& report, data::Scheme scheme, const std::string& subject) {
  return std::string(data::name_of(scheme)) + (report.subjects.size() > 1 ? " (" + subject + ")" : "");
}

}  // namespace

CoverageQuestion coverage_question(const std::vector<AuditSubject>& subjects,
                                   const std::vector<AuditMesh>& meshes) {
  CoverageQuestion question;
  std::set<data::Scheme> schemes;
  bool relations = false;
  for (const AuditMesh& m : meshes) {
    relations = relations || m.relations;
    schemes.insert(m.scheme());
    question.cases.push_back({case_of(m), m.scheme(), cells_of(m)});
  }
  for (const AuditSubject& s : subjects)
    for (const data::Scheme scheme : schemes) try {
        const lc_capabilities c = capabilities(*s.subject, s.options, scheme);
        if (!does(c, scheme)) continue;
        question.declared.push_back({s.label(), scheme,
                                     c.sharp | (c.boundary != LC_BOUNDARY_NONE ? kNeedsBoundary : 0) |
                                         (c.per_face_depth != 0 ? kNeedsDepths : 0) |
                                         (c.quads_only == 0 ? kNeedsOtherFaces : 0) |
                                         (relations ? kNeedsRelations : 0),
                                     c.max_depth});
      } catch (const std::exception&) {  // the rows say why
      }
  return question;
}

Json coverage_json(const CoverageQuestion& question) {
  Json cases = Json::array(), declared = Json::array();
  for (const auto& [at, scheme, set] : question.cases) {
    const auto& [mesh, depth, depths, sample] = at;
    cases.push_back({mesh, depths, sample, depth, static_cast<int>(scheme), text_of(set)});
  }
  for (const auto& [subject, scheme, abilities, max_depth] : question.declared)
    declared.push_back({subject, static_cast<int>(scheme), abilities, max_depth});
  return {{"cases", cases}, {"declared", declared}};
}

CoverageQuestion coverage_question(const Json& json) {
  CoverageQuestion question;
  for (const Json& c : json.at("cases")) {
    const auto scheme = static_cast<data::Scheme>(data::value_of<int>(c.at(4)));
    question.cases.push_back({Case(c.at(0), c.at(3), c.at(1), c.at(2)), scheme, cell_set(c.at(5), scheme)});
  }
  for (const Json& d : json.at("declared"))
    question.declared.push_back(
        {d.at(0), static_cast<data::Scheme>(data::value_of<int>(d.at(1))), d.at(2), d.at(3)});
  return question;
}

std::vector<Coverage> coverage_of(const std::vector<Result>& results, const CoverageQuestion& question) {
  std::set<std::tuple<std::string, Case, data::Scheme>> judged;
  for (const Result& r : results)
    if (is_of_judged_points(r)) judged.emplace(r.subject, case_of(r), r.scheme);
  std::vector<Coverage> list;
  for (const Declared& by : question.declared) {
    const std::vector<Cell>& all = cells(by.scheme);
    CellSet looked(all.size());
    for (const CaseCells& c : question.cases)
      if (c.scheme == by.scheme && judged.contains({by.subject, c.at, c.scheme})) add_cells(looked, c.cells);
    Coverage& coverage = list.emplace_back();
    coverage.subject = by.subject, coverage.scheme = by.scheme;
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (!is_declared(all[k], by))
        ++coverage.not_declared;
      else if (looked[k])
        ++coverage.looked;
      else
        coverage.never.push_back(all[k].name());
    }
  }
  return list;
}

void add_coverage(Report& report, CoverageQuestion question) {
  report.coverage = coverage_of(report.results, question);
  report.cases = std::move(question.cases);
}

std::string coverage_lines(const Report& report) {
  constexpr std::size_t kNamed = 3;
  std::string out;
  for (const data::Scheme scheme : {data::Scheme::kLoop, data::Scheme::kCatmullClark}) {
    const Coverage* least = nullptr;
    for (const Coverage& c : report.coverage)
      if (c.scheme == scheme && (least == nullptr || c.never.size() > least->never.size())) least = &c;
    if (least == nullptr) continue;
    out += fmt::format("{}: {} of {} kinds of neighbourhood were looked at",
                       who(report, scheme, least->subject), least->looked, least->declared());
    if (least->not_declared > 0) out += fmt::format(" ({} more are not declared)", least->not_declared);
    const std::size_t named = std::min(kNamed, least->never.size());
    if (named > 0)
      out += fmt::format(
          "; never: {}",
          fmt::join(least->never.begin(), least->never.begin() + static_cast<std::ptrdiff_t>(named), " / "));
    if (least->never.size() > named) out += fmt::format(" and {} more", least->never.size() - named);
    out += "\n";
  }
  return out;
}

namespace {

constexpr int kDepths = 3;
constexpr std::size_t kExamples = 5;

// "neighbourhoods:MOST:KINDS:K"
struct Name {
  bool triangles = true;
  int most = 0;
  std::int32_t kinds = 0;
  std::size_t number = 0;  // K - 1
  const std::vector<data::Stars>& meshes() const { return data::every_neighbourhood(triangles, most, kinds); }
};
bool parse(const std::string& text, Name& name) {
  name.triangles = !text.starts_with("quad-");
  return std::sscanf(text.c_str() + (name.triangles ? 0 : 5), "neighbourhoods:%d:%" SCNd32 ":%zu", &name.most,
                     &name.kinds, &name.number) == 3 &&
         name.number-- > 0;
}

struct Seen {
  std::map<std::size_t, std::set<int>> judged;  // depths of each mesh
  std::set<std::pair<std::size_t, int>> cases, wrong;
  std::map<std::string, std::pair<std::size_t, std::string>>
      examples;  // of each check the shortest, by its length
};

// The neighbourhood that a finding is at, as it is typed.
std::string example(const Name& name, const Result& r) {
  const std::string place = fmt::format(" (depth {}, {})", r.depth, r.check);
  if (!r.witness || r.witness->face < 0) return r.mesh + place;
  data::Stars stars = name.meshes().at(name.number);
  stars.stars = {data::star_of_face(stars, data::star_mesh(stars, name.triangles),
                                    static_cast<std::size_t>(r.witness->face))};
  return fmt::format("{}star:{}{}", name.triangles ? "" : "quad-", stars.text(), place);
}

}  // namespace

std::vector<Exhaustive> exhaustive_of(const std::vector<Result>& results) {
  std::map<std::tuple<std::string, data::Scheme, int, std::int32_t>, Seen> all;
  for (const Result& r : results) {
    Name name;
    if (!parse(r.mesh, name)) continue;
    Seen& seen = all[{r.subject, r.scheme, name.most, name.kinds}];
    const std::pair at{name.number, r.depth};
    seen.cases.insert(at);
    if (is_of_judged_points(r)) seen.judged[name.number].insert(r.depth);
    if (!is_bad(r)) continue;
    seen.wrong.insert(at);
    std::string text = example(name, r);
    const std::pair found{text.size(), std::move(text)};
    auto& shortest = seen.examples.try_emplace(r.check, found).first->second;
    shortest = std::min(shortest, found);
  }
  std::vector<Exhaustive> list;
  for (const auto& [key, seen] : all) {
    const auto& [subject, scheme, most, kinds] = key;
    Exhaustive& e = list.emplace_back();
    e.subject = subject, e.scheme = scheme, e.most = most;
    const auto& meshes = data::every_neighbourhood(scheme == data::Scheme::kLoop, most, kinds);
    for (std::size_t k = 0; k < meshes.size(); ++k) {
      const auto count = static_cast<std::int64_t>(meshes[k].stars.size());
      e.neighbourhoods += count;
      if (const auto found = seen.judged.find(k);
          found != seen.judged.end() && found->second.size() == kDepths)
        e.looked += count;
    }
    e.cases = static_cast<std::int64_t>(seen.cases.size());
    e.wrong = static_cast<std::int64_t>(seen.wrong.size());
    for (const auto& [check, shortest] : seen.examples)
      if (e.examples.size() < kExamples) e.examples.push_back(shortest.second);
  }
  return list;
}

std::string exhaustive_lines(const Report& report) {
  std::string out;
  if (report.coverage.empty()) return out;  // a part of a report
  for (const Exhaustive& e : exhaustive_of(report.results)) {
    out += who(report, e.scheme, e.subject);
    out += e.all_right()
               ? fmt::format(": right on every neighbourhood up to valence {}: {}, at depths 0, 1 and 2",
                             e.most, e.neighbourhoods)
               : fmt::format(": {} of {} neighbourhoods up to valence {} were judged at depths 0, 1 and 2",
                             e.looked, e.neighbourhoods, e.most);
    if (e.wrong > 0)
      out += fmt::format("; wrong in {} of {} meshes and depths: {}", e.wrong, e.cases,
                         fmt::join(e.examples, ", "));
    out += "\n";
  }
  return out;
}

}  // namespace limitcheck::verify
