// SPDX-License-Identifier: MIT
#include "verify/audit/json.h"

#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "verify/audit/judged.h"
#include "verify/audit/table.h"
#include "verify/mesh_output/atomic_file.h"

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
          {"reproduce", is_bad(r) ? Json(audit_command(r, level)) : Json(nullptr)}};
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
           {"never_judged", Json::array()}};
  for (const NeverJudged& none : never_judged(report))
    out["never_judged"].push_back(
        {{"subject", none.subject}, {"check", none.check}, {"reason", text(none.reason)}});
  out["subjects"] = report.subjects;
  out["meshes"] = Json::array();
  for (const auto& m : report.meshes)
    out["meshes"].push_back({{"name", m.name},
                             {"vertices", m.vertices},
                             {"faces", m.faces},
                             {"scheme", data::name_of(m.scheme)},
                             {"triangulated", text(m.triangulated)}});
  out["results"] = Json::array();
  for (const Result& r : report.results)
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
                              {"message", text(r.message)},
                              {"witness", witness(r, level)}});
  return out.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_text(const std::filesystem::path& file, const std::string& content) {
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
  AtomicFile out(file);
  out.stream() << content;
  out.commit();
}

}  // namespace limitcheck::verify
