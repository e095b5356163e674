// SPDX-License-Identifier: MIT
#include "verify/report/coverage.h"
#include "data/untrusted_json.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

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

}  // namespace

CoverageQuestion coverage_question(const std::vector<AuditSubject>& subjects,
                                   const std::vector<AuditMesh>& meshes) {
  CoverageQuestion question;
  std::set<data::Scheme> schemes;
  bool relations = false;
  for (const AuditMesh& m : meshes) {
    relations = relations || m.relations;
    schemes.insert(m.scheme());
    const Case at(m.name, m.depth, m.depths, m.sample ? m.sample->text() : "");
    question.cases.push_back({at, m.scheme(), cells_of(m)});
  }
  for (const AuditSubject& s : subjects)
    for (const data::Scheme scheme : schemes) try {
        const lc_capabilities c = capabilities(*s.subject, s.options, scheme);
        if (!does(c, scheme)) continue;
        question.declared.push_back({s.label(), scheme,
                                     c.sharp | (c.boundary != LC_BOUNDARY_NONE ? kNeedsBoundary : 0) |
                                         (c.per_face_depth != 0 ? kNeedsDepths : 0) |
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
    if ((r.check == "positions" || r.check == "refined-positions") && r.of > 0 && looked_at(r))
      judged.emplace(r.subject, case_of(r), r.scheme);
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
    out += fmt::format("{}{}: {} of {} kinds of neighbourhood were looked at", data::name_of(scheme),
                       report.subjects.size() > 1 ? " (" + least->subject + ")" : "", least->looked,
                       least->declared());
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

}  // namespace limitcheck::verify
