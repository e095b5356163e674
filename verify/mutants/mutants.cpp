// SPDX-License-Identifier: MIT
#include "verify/mutants/mutants.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "data/error.h"
#include "verify/audit/audit.h"
#include "verify/audit/default_plan.h"
#include "verify/checks/checks.h"
#include "verify/mutants/faulty_subjects.h"
#include "verify/mutants/mutant_rules.h"
#include "verify/relations/relations.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

constexpr const char* kBase = "model";
constexpr const char* kQuadBase = "quad-model";

bool is_relation(const std::string& check) {
  const auto& rows = relation_rows();
  return std::find(rows.begin(), rows.end(), check) != rows.end();
}

// Triangles at the deepest level: what a case costs without its relations.
double cost(const AuditMesh& m) {
  const auto& shown = m.sample ? m.sample->part() : m.mesh;
  return std::ldexp(static_cast<double>(shown.faces.size()), 2 * m.depth);
}

// The model refines all faces of a mesh to the deepest level: more than these it is not asked for.
constexpr double kModelTriangles = 70000;
bool too_much(const AuditMesh& m) {
  return std::ldexp(static_cast<double>(m.mesh.faces.size()), 2 * m.depth) > kModelTriangles;
}
bool is_model(const std::string& subject, const std::string& options) {
  return subject == kBase || options.find(fmt::format("of={}", kBase)) != std::string::npos;
}

// All right subjects but the quad model are audited by Loop's scheme.
data::Scheme scheme_of(const AuditSubject& s) {
  return s.label().ends_with(kQuadBase) ? data::Scheme::kCatmullClark : data::Scheme::kLoop;
}

bool is_uniform(const AuditMesh& m) {
  return m.depths.empty() || m.depths == "uniform";
}
std::string label(const AuditMesh& m) {
  return is_uniform(m) ? fmt::format("{} (depth {})", m.name, m.depth)
                       : fmt::format("{} ({})", m.name, m.depths);
}

}  // namespace

const std::vector<Mutant>& mutants() {
  static const std::vector<Mutant> list = [] {
    std::vector<Mutant> all;
    for (const data::Scheme scheme : {data::Scheme::kLoop, data::Scheme::kCatmullClark})
      for (const Change& m : mutations(scheme)) {
        const bool loop = scheme == data::Scheme::kLoop;
        if (m.name != "none")
          all.push_back({(loop ? "" : "quad_") + m.name, m.description, loop ? kBase : kQuadBase,
                         fmt::format("mutation={}{}{}", m.name, m.options.empty() ? "" : ",", m.options),
                         m.check, m.claim, /*sharp=*/false, scheme});
      }
    for (const Fault& f : all_faults())
      for (const data::Scheme scheme : {data::Scheme::kLoop, data::Scheme::kCatmullClark}) {
        const bool loop = scheme == data::Scheme::kLoop;
        if (f.name == "none" || f.on == (loop ? Change::On::kQuads : Change::On::kLoop)) continue;
        const std::string of = !f.of.empty() ? f.of : f.rare ? "naive" : loop ? kBase : kQuadBase;
        const char* prefix = !loop ? "quad_" : f.rare ? "loop_" : "";
        all.push_back({prefix + f.name, f.description, "faulty", faulty_options(f.name, of, f.options),
                       f.check, f.claim, f.sharp, scheme,
                       [&f, scheme](const data::ControlMesh& mesh, int depth) {
                         return (!f.deep || depth > 0) && (!f.shows || f.shows(Asked(mesh, scheme, depth)));
                       }});
      }
    all.push_back({"wrong_refined_points", "refined points 1e-5 too far from the origin", "faulty",
                   faulty_options("wrong_edge_mask", kBase, "points=refined"), "refined-positions", "",
                   false});
    all.push_back({"no_limit_and_swapped_points", "refined points for limit points, two of them exchanged",
                   "faulty", faulty_options("swapped_points", kBase, "mutation=no_limit"), "recognised", "",
                   false});
    for (const auto& [fault, check] :
         std::initializer_list<std::pair<const char*, const char*>>{{"wrong_edge_mask", "positions"},
                                                                    {"one_flipped_normal", "normals"},
                                                                    {"one_ulp_crack", "shared-positions"},
                                                                    {"missing_triangle", "coverage"},
                                                                    {"t_vertex", "t-vertices"}})
      all.push_back({fmt::format("anywhere_{}", fault), "at points off the lattice", "faulty",
                     faulty_options(fault, "anywhere"), check, "", false});
    return all;
  }();
  return list;
}

bool KillTable::held() const {
  return idle.empty() && red_on_correct.empty() &&
         std::all_of(kills.begin(), kills.end(), [](const Kill& k) { return k.by_its_check(); });
}

Plan mutants_plan(const std::string& version, bool without_provenance) {
  const std::size_t cases = default_plan(Level::kStandard).size();
  nlohmann::json what{{"version", version}, {"cases", cases}};
  if (without_provenance) what["without_provenance"] = true;
  for (const Mutant& m : mutants()) what["mutants"].push_back(m.name);
  return {"limitcheck mutants", std::move(what), cases + mutants().size()};
}

void run_mutants(Journal& journal,
                 const std::function<void(const std::string&, std::size_t, std::size_t)>& on_step,
                 const std::function<bool()>& stop) {
  constexpr int kThreads = 2;
  std::vector<AuditMesh> plan = default_plan(Level::kStandard);
  const std::size_t cases = plan.size();
  const auto to_do = [&](std::size_t unit) {
    return journal.plan().has(unit) && journal.recall(unit) == nullptr;
  };
  std::size_t total = 0, done = 0;
  for (std::size_t unit = 0; unit < journal.plan().units; ++unit) total += to_do(unit) ? 1 : 0;
  const auto step = [&](const std::string& subject, const AuditMesh& m) {
    if (on_step) on_step(fmt::format("{} on {}", subject, label(m)), done, total);
  };
  const auto keep = [&](std::size_t unit, nlohmann::json result) {
    journal.keep(unit, std::move(result));
    ++done;
  };

  // Right subjects are audited in all cases of the plan.
  const bool bare = journal.plan().what.value("without_provenance", false);
  std::vector<AuditSubject> correct{{find_subject(kBase), ""},
                                    {find_subject(kQuadBase), ""},
                                    {find_subject("row-stream"), "repair=stitch"},
                                    {find_subject("row-stream"), "frames=4"},
                                    {find_subject("sliding-window"), "precision=double,repair=stitch"}};
  if (bare)
    for (const char* subject : {"row-stream", kQuadBase})
      correct.push_back({find_subject("bare"), fmt::format("bare={}", subject)});
  Auditor auditor(0, kThreads, {}, Level::kStandard);
  for (std::size_t unit = 0; unit < cases; ++unit) {
    if (!to_do(unit)) continue;
    const AuditMesh& m = plan[unit];
    nlohmann::json red = nlohmann::json::array();
    for (const AuditSubject& s : correct) {
      if (stop && stop()) return;
      step(s.subject->name, m);
      if (m.scheme() != scheme_of(s) || (is_model(s.subject->name, s.options) && too_much(m))) continue;
      for (const Result& r : auditor.run(s, m))
        if (is_bad(r))
          red.push_back(fmt::format("{} / {} / {}: {}", r.subject, label(m), r.check, r.message));
    }
    keep(unit, std::move(red));
  }

  // Mutants are audited in the cheap cases first, each until its own check has found it; case by case, so
  // that they share the reference.
  constexpr int kMoreCases = 20;
  struct Open {
    std::size_t unit;
    Kill kill;
    int more = kMoreCases;
    bool closed = false;
  };
  std::vector<Open> open;
  for (std::size_t k = 0; k < mutants().size(); ++k)
    if (to_do(cases + k)) open.push_back({cases + k, {&mutants()[k], {}, "", {}, bare ? 0 : -1}});
  const auto close = [&](Open& at) {
    const Kill& k = at.kill;
    nlohmann::json result{{"mutant", k.mutant->name}, {"killed_by", k.killed_by}, {"on", k.on}};
    if (bare) result["bare"] = {{"killed_by", k.bare_killed_by}, {"cases", k.bare_cases}};
    keep(at.unit, std::move(result));
    at.closed = true;
  };
  std::stable_sort(plan.begin(), plan.end(),
                   [](const AuditMesh& a, const AuditMesh& b) { return cost(a) < cost(b); });
  for (AuditMesh& m : plan) {
    const bool relations = m.relations, turned = m.turned;
    for (Open& at : open) {
      Kill& k = at.kill;
      const bool relation = is_relation(k.mutant->check);
      const bool by_turning = turned && k.mutant->check == "corner-rotation";
      if (at.closed || (relation && !relations && !by_turning) || m.scheme() != k.mutant->scheme) continue;
      if (k.mutant->sharp == m.mesh.sharpness.empty()) continue;
      if (is_model(k.mutant->subject, k.mutant->options) && too_much(m)) continue;
      if (k.mutant->shows && !k.mutant->shows(m.mesh, m.depth)) continue;
      if (stop && stop()) return;
      step(k.mutant->name, m);
      m.relations = relation && relations;
      m.turned = by_turning;
      m.asked_again = false;
      const auto audit = [&](const AuditSubject& subject, std::set<std::string>& killed_by) {
        for (const Result& r : auditor.run(subject, m))
          if (is_bad(r)) killed_by.insert(r.check);
      };
      if (!k.by_its_check()) {
        audit({find_subject(k.mutant->subject), k.mutant->options}, k.killed_by);
        if (k.by_its_check()) k.on = label(m);
      } else {
        --at.more;
      }
      if (bare && is_uniform(m) && !k.bare_killed_by.contains(k.mutant->check)) {
        audit({find_subject("bare"), fmt::format("bare={},{}", k.mutant->subject, k.mutant->options)},
              k.bare_killed_by);
        ++k.bare_cases;
      }
      if (k.by_its_check() && (!bare || at.more == 0 || k.bare_killed_by.contains(k.mutant->check)))
        close(at);
    }
  }
  for (Open& at : open)
    if (!at.closed) close(at);
}

KillTable kill_table(const std::map<std::size_t, nlohmann::json>& results) {
  KillTable table;
  if (results.size() < mutants().size())
    throw data::ArgumentError(fmt::format("{} results, and {} mutants", results.size(), mutants().size()));
  const std::size_t cases = results.size() - mutants().size();
  for (const auto& [unit, result] : results) {
    if (result.is_array() != (unit < cases))
      throw data::ArgumentError(fmt::format("unit {} is {}, and its result is of another kind", unit,
                                            unit < cases ? "a case of right subjects" : "a mutant"));
    if (unit < cases) {
      for (const nlohmann::json& red : result) table.red_on_correct.push_back(red.get<std::string>());
      continue;
    }
    const Mutant& mutant = mutants().at(unit - cases);
    if (result.at("mutant") != mutant.name)
      throw data::ArgumentError(fmt::format("unit {} is {}, and its result is of {}", unit, mutant.name,
                                            result.at("mutant").dump()));
    table.kills.push_back(
        {&mutant, result.at("killed_by").get<std::set<std::string>>(), result.at("on").get<std::string>()});
    if (!result.contains("bare")) continue;
    const nlohmann::json& bare = result.at("bare");
    table.kills.back().bare_killed_by = bare.at("killed_by").get<std::set<std::string>>();
    table.kills.back().bare_cases = bare.at("cases").get<int>();
  }
  std::set<std::string> rows{"tessellates", "refined-positions", "recognised"}, useful;
  for (const Check& c : checks()) rows.insert(c.rows.begin(), c.rows.end());
  rows.insert(relation_rows().begin(), relation_rows().end());
  for (const Kill& k : table.kills)
    if (k.by_its_check()) useful.insert(k.mutant->check);
  std::set_difference(rows.begin(), rows.end(), useful.begin(), useful.end(), std::back_inserter(table.idle));
  return table;
}

}  // namespace limitcheck::verify
