// SPDX-License-Identifier: MIT
#include "verify/report/result_json.h"

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "verify/report/json.h"
#include "verify/row/explain.h"

namespace limitcheck::verify {
namespace {

using Json = nlohmann::json;

double number_of(const Json& json) {
  return json.is_string() ? std::strtod(json.get_ref<const std::string&>().c_str(), nullptr)
                          : json.get<double>();
}
Json to_json(const std::optional<double>& x) {
  return x ? Json(number(*x)) : Json(nullptr);
}
std::optional<double> maybe(const Json& json) {
  return json.is_null() ? std::nullopt : std::optional(number_of(json));
}
std::vector<double> numbers_of(const Json& json) {
  std::vector<double> list;
  for (const Json& x : json) list.push_back(number_of(x));
  return list;
}

// The structured binding names all members: with a new one this does not compile until it is written, too.
Json to_json(const Witness& w) {
  const auto& [face, l1, l2, vertex, triangle, expected, got, digits, corner] = w;
  return Json::array(
      {face, l1, l2, vertex, triangle, Json(numbers(expected)), Json(numbers(got)), digits, corner});
}
Witness witness(const Json& j) {
  return {j.at(0), j.at(1), j.at(2), j.at(3), j.at(4), numbers_of(j.at(5)), numbers_of(j.at(6)),
          j.at(7), j.at(8)};
}
Json to_json(const IllConditioned& c) {
  const auto& [count, bound, worst] = c;
  return Json::array({count, Json(number(bound)), Json(number(worst))});
}
IllConditioned ill_conditioned(const Json& j) {
  return {j.at(0), number_of(j.at(1)), number_of(j.at(2))};
}
Json to_json(const std::vector<PlaceCount>& counts) {
  Json list = Json::array();
  for (const auto& [kind, faces, bad, of] : counts)
    list.push_back(Json::array({static_cast<int>(kind), faces, bad, of}));
  return list;
}
std::vector<PlaceCount> places(const Json& j) {
  std::vector<PlaceCount> counts;
  for (const Json& c : j)
    counts.push_back({static_cast<PlaceKind>(c.at(0).get<int>()), c.at(1), c.at(2), c.at(3)});
  return counts;
}
Json to_json(const Recognised& known) {
  const auto& [what, scheme, steps, limit, tags] = known;
  return Json::array({what, scheme, steps, limit, tags});
}
Recognised recognised(const Json& j) {
  return {j.at(0), j.at(1), j.at(2), j.at(3), j.at(4)};
}
Json to_json(const Result& r) {
  const auto& [subject, mesh, check, depth, depths, sample, in_float, scheme, cut, weights, status, bad, of,
               worst, bound, rms, p99, unit, absolute, ulps, ill, place, message, places, decades, seconds,
               known] = r;
  return Json::array({subject,
                      mesh,
                      check,
                      depth,
                      depths,
                      sample,
                      in_float,
                      static_cast<int>(scheme),
                      cut,
                      static_cast<int>(weights),
                      static_cast<int>(status),
                      bad,
                      of,
                      to_json(worst),
                      to_json(bound),
                      to_json(rms),
                      to_json(p99),
                      unit,
                      to_json(absolute),
                      to_json(ulps),
                      ill ? to_json(*ill) : Json(nullptr),
                      place ? to_json(*place) : Json(nullptr),
                      message,
                      to_json(places),
                      decades,
                      seconds,
                      known ? to_json(*known) : Json(nullptr)});
}
Result result(const Json& j) {
  return {j.at(0),
          j.at(1),
          std::string(current_name(j.at(2).get<std::string>())),
          j.at(3),
          j.at(4),
          j.at(5),
          j.at(6),
          static_cast<data::Scheme>(j.at(7).get<int>()),
          j.at(8),
          static_cast<reference::Weights>(j.at(9).get<int>()),
          static_cast<Status>(j.at(10).get<int>()),
          j.at(11),
          j.at(12),
          maybe(j.at(13)),
          maybe(j.at(14)),
          maybe(j.at(15)),
          maybe(j.at(16)),
          j.at(17),
          maybe(j.at(18)),
          maybe(j.at(19)),
          j.at(20).is_null() ? std::nullopt : std::optional(ill_conditioned(j.at(20))),
          j.at(21).is_null() ? std::nullopt : std::optional(witness(j.at(21))),
          j.at(22),
          places(j.at(23)),
          j.at(24),
          j.at(25),
          j.at(26).is_null() ? std::nullopt : std::optional(recognised(j.at(26)))};
}

Json header_json(const Report::Mesh& m) {
  const auto& [name, vertices, faces, scheme, cut, diagonal] = m;
  return Json::array({name, vertices, faces, static_cast<int>(scheme), cut, diagonal});
}

}  // namespace

Json rows_json(const std::vector<Result>& rows) {
  Json list = Json::array();
  for (const Result& r : rows) list.push_back(to_json(r));
  return list;
}

std::vector<Result> rows_of(const Json& json) {
  std::vector<Result> rows;
  for (const Json& row : json) rows.push_back(result(row));
  return rows;
}

Json header_json(const Report& report) {
  Json meshes = Json::array();
  for (const Report::Mesh& m : report.meshes) meshes.push_back(header_json(m));
  return {{"version", report.version},   {"depth", report.depth},
          {"depths", report.depths},     {"seed", report.seed ? Json(*report.seed) : Json(nullptr)},
          {"sample", report.sample},     {"meshes", meshes},
          {"subjects", report.subjects}, {"descriptions", report.descriptions}};
}

Report header_of(const Json& json) {
  Report report;
  json.at("version").get_to(report.version), json.at("depth").get_to(report.depth);
  json.at("depths").get_to(report.depths), json.at("sample").get_to(report.sample);
  if (!json.at("seed").is_null()) report.seed = json.at("seed").get<std::uint64_t>();
  for (const Json& m : json.at("meshes"))
    report.meshes.push_back(
        {m.at(0), m.at(1), m.at(2), static_cast<data::Scheme>(m.at(3).get<int>()), m.at(4), m.at(5)});
  json.at("subjects").get_to(report.subjects), json.at("descriptions").get_to(report.descriptions);
  return report;
}

}  // namespace limitcheck::verify
