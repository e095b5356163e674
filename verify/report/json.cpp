// SPDX-License-Identifier: MIT
#include "verify/report/json.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "verify/causes/causes.h"
#include "verify/mesh_output/atomic_file.h"
#include "verify/report/judged.h"
#include "verify/row/reproduce.h"

namespace limitcheck::verify {
namespace {

using Json = nlohmann::ordered_json;

Json finite(const std::optional<double>& x) {
  return x && std::isfinite(*x) ? Json(*x) : Json(nullptr);
}
Json index(std::int64_t k) {
  return k >= 0 ? Json(k) : Json(nullptr);
}
Json text(const std::string& s) {
  return s.empty() ? Json(nullptr) : Json(s);
}

Json ill_conditioned(const Result& r) {
  if (!r.ill_conditioned) return nullptr;
  return {{"count", r.ill_conditioned->count},
          {"bound", finite(r.ill_conditioned->bound)},
          {"worst", finite(r.ill_conditioned->worst)}};
}

Json places(const Result& r) {
  if (r.places.empty()) return nullptr;
  Json list = Json::array();
  for (const PlaceCount& c : r.places)
    list.push_back({{"where", word(c.kind)},
                    {"faces", c.faces > 0 ? Json(c.faces) : Json(nullptr)},
                    {"count", c.bad},
                    {"of", c.of}});
  return list;
}

Json witness(const Result& r, const std::string& level) {
  const std::optional<Witness>& w = r.witness;
  if (!w) return nullptr;
  return {{"face", index(w->face)},
          {"corner", index(w->corner)},
          {"l1", text(w->l1)},
          {"l2", text(w->l2)},
          {"vertex", index(w->vertex)},
          {"triangle", index(w->triangle)},
          {"expected", numbers(w->expected)},
          {"got", numbers(w->got)},
          {"expected_digits", w->expected_digits.empty() ? Json(nullptr) : Json(w->expected_digits)},
          {"command", text(eval_command(r))},
          {"difference", text(difference_command(r))},
          {"reproduce", is_bad(r) ? Json(audit_command(r, level)) : Json(nullptr)}};
}

Json recognised(const Result& r) {
  if (!r.recognised) return nullptr;
  const auto& [what, scheme, steps, limit, tags] = *r.recognised;
  return {{"what", what}, {"scheme", scheme}, {"steps", steps}, {"limit", limit}, {"tags", tags}};
}

Json changes(const Report& report) {
  if (!report.changes) return nullptr;
  const auto& c = *report.changes;
  return {{"baseline", c.baseline}, {"new", c.appeared}, {"worse", c.worse},
          {"gone", c.gone},         {"same", c.same},    {"named", c.named}};
}

// The causes, and for each row the number of its cause.
Json causes_json(const Report& report, const std::string& level, std::vector<int>& cause_of) {
  Json list = Json::array();
  for (const Cause& c : causes(report)) {
    const int number = static_cast<int>(list.size()) + 1;
    for (const std::size_t k : c.rows) cause_of[k] = number;
    const Result& example = report.results[c.example];
    list.push_back({{"number", number},
                    {"who", c.who},
                    {"kind", word(c.kind)},
                    {"severity", c.severity()},
                    {"title", c.title},
                    {"look", text(c.look)},
                    {"subjects", c.subjects},
                    {"cases", c.cases},
                    {"of", c.of},
                    {"rows", c.rows.size()},
                    {"consequences", c.consequences},
                    {"mesh", example.mesh},
                    {"depth", example.depth},
                    {"depths", text(example.depths)},
                    {"command", text(command_for(report, c, level))}});
  }
  return list;
}

}  // namespace

Json number(double x) {
  return std::isnan(x) ? Json("nan") : std::isinf(x) ? Json(x > 0 ? "inf" : "-inf") : Json(x);
}

Json numbers(const std::vector<double>& list) {
  if (list.empty()) return nullptr;
  Json out = Json::array();
  for (const double x : list) out.push_back(number(x));
  return out;
}

std::string to_json(const Report& report, const std::string& level) {
  Json out{{"program", "limitcheck audit"},
           {"version", report.version},
           {"depth", report.depth},
           {"depths", report.depths},
           {"seed", report.seed ? Json(*report.seed) : Json(nullptr)},
           {"sample", text(report.sample)},
           {"seconds", report.seconds},
           {"held", report.held()},
           {"containment", text(report.containment)},
           {"incomplete", text(report.incomplete)},
           {"printed", text(report.printed)},
           {"changes", changes(report)},
           {"never_judged", Json::array()}};
  for (const NeverJudged& none : never_judged(report))
    out["never_judged"].push_back(
        {{"subject", none.subject}, {"check", none.check}, {"reason", text(none.reason)}});
  out["coverage"] = Json::array();
  for (const Coverage& c : report.coverage) {
    constexpr std::size_t kNamed = 100;
    const std::vector<std::string> named(
        c.never.begin(), c.never.begin() + static_cast<std::ptrdiff_t>(std::min(kNamed, c.never.size())));
    out["coverage"].push_back({{"subject", c.subject},
                               {"scheme", data::name_of(c.scheme)},
                               {"looked_at", c.looked},
                               {"declared", c.declared()},
                               {"not_declared", c.not_declared},
                               {"never", named}});
  }
  out["subjects"] = report.subjects;
  out["meshes"] = Json::array();
  for (const auto& m : report.meshes)
    out["meshes"].push_back({{"name", m.name},
                             {"vertices", m.vertices},
                             {"faces", m.faces},
                             {"diagonal", m.diagonal},
                             {"scheme", data::name_of(m.scheme)},
                             {"triangulated", text(m.triangulated)}});
  std::vector<int> cause_of(report.results.size(), -1);
  out["causes"] = causes_json(report, level, cause_of);
  out["results"] = Json::array();
  for (std::size_t k = 0; k < report.results.size(); ++k) {
    const Result& r = report.results[k];
    out["results"].push_back({{"subject", r.subject},
                              {"mesh", r.mesh},
                              {"depth", r.depth},
                              {"depths", text(r.depths)},
                              {"sample", text(r.sample)},
                              {"scheme", data::name_of(r.scheme)},
                              {"triangulated", text(r.triangulated)},
                              {"precision", r.in_float ? "float" : "double"},
                              {"check", r.check},
                              {"status", word(r.status)},
                              {"count", r.bad},
                              {"of", r.of},
                              {"worst", finite(r.worst)},
                              {"bound", finite(r.bound)},
                              {"unit", text(r.unit)},
                              {"rms", finite(r.rms)},
                              {"p99", finite(r.p99)},
                              {"worst_absolute", finite(r.worst_absolute)},
                              {"worst_ulps", finite(r.worst_ulps)},
                              {"ill_conditioned", ill_conditioned(r)},
                              {"places", places(r)},
                              {"recognised", recognised(r)},
                              {"seconds", r.seconds},
                              {"message", text(r.message)},
                              {"cause", index(cause_of[k])},
                              {"witness", witness(r, level)}});
  }
  return out.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_text(const std::filesystem::path& file, const std::string& content) {
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
  AtomicFile out(file);
  out.stream() << content;
  out.commit();
}

}  // namespace limitcheck::verify
