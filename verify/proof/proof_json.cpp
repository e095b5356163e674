// SPDX-License-Identifier: MIT
#include <cmath>
#include <concepts>
#include <limits>
#include <nlohmann/json.hpp>
#include <type_traits>

#include "verify/proof/proof_report.h"

namespace limitcheck::verify {
namespace {

using Json = nlohmann::json;

/// The fields of a result, in the order in which they are written: visit(field, ..). The structured bindings name all
/// members: with a new one this does not compile until it is written, too.
template <class T, class Of>
concept Maybe = std::same_as<std::remove_const_t<T>, Of>;
void fields(Maybe<MapWitness> auto& w, auto&& visit) {
  auto& [point, quantity, control_point, found, expected] = w;
  visit(point, quantity, control_point, found, expected);
}
void fields(Maybe<MapProof> auto& m, auto&& visit) {
  auto& [equal, arithmetic, digits, witness] = m;
  visit(equal, arithmetic, digits, witness);
}
void fields(Maybe<BoundProof> auto& b, auto&& visit) {
  auto& [first, last, position, position_worst, tangent, tangent_worst, normal, product, share, alike,
         shipped] = b;
  auto& [position_share, normal_share, targets, unlike] = shipped;
  visit(first, last, position, position_worst, tangent, tangent_worst, normal, product, share, alike,
        position_share, normal_share, targets, unlike);
}
void fields(Maybe<CostProof> auto& c, auto&& visit) {
  auto& [flops, vectors] = c;
  visit(flops, vectors);
}
void fields(Maybe<ProofRow> auto& r, auto&& visit) {
  auto& [topology, kernel, first, last, points, seconds, map, bound, cost] = r;
  visit(topology, kernel, first, last, points, seconds, map, bound, cost);
}
void fields(Maybe<CertifiedLine> auto& l, auto&& visit) {
  auto& [mesh, kernel, depth, errors] = l;
  auto& [points, position, normal, radius, face, l1, l2, corner, unit, condition, placing] = errors;
  visit(mesh, kernel, depth, points, position, normal, radius, face, l1, l2, corner, unit, condition,
        placing);
}

/// A value as JSON and back: a result as the array of its fields, nothing as null; JSON has no infinity and no NaN.
template <class T>
Json written(const T& value) {
  if constexpr (std::is_same_v<T, double>) {
    if (std::isfinite(value)) return value;
    return std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
  } else if constexpr (requires { value.has_value(); }) {
    return value ? written(*value) : Json();
  } else if constexpr (requires { fields(value, [](const auto&...) {}); }) {
    Json list = Json::array();
    fields(value, [&](const auto&... field) { (list.push_back(written(field)), ...); });
    return list;
  } else {
    return value;
  }
}
template <class T>
void read(const Json& json, T& value) {
  if constexpr (std::is_same_v<T, double>) {
    if (json.is_number())
      value = json.get<double>();
    else
      value = json == "nan" ? std::numeric_limits<double>::quiet_NaN() : json == "inf" ? HUGE_VAL : -HUGE_VAL;
  } else if constexpr (requires { value.has_value(); }) {
    if (!json.is_null()) read(json, value.emplace());
  } else if constexpr (requires { fields(value, [](auto&...) {}); }) {
    std::size_t at = 0;
    fields(value, [&](auto&... field) { (read(json.at(at++), field), ...); });
  } else {
    value = json.get<T>();
  }
}

template <class T>
Json list_json(const std::vector<T>& values) {
  Json list = Json::array();
  for (const T& value : values) list.push_back(written(value));
  return list;
}
template <class T>
std::vector<T> list_of(const Json& json) {
  std::vector<T> list;
  for (const Json& j : json) read(j, list.emplace_back());
  return list;
}

}  // namespace

Json proof_rows_json(const std::vector<ProofRow>& rows) {
  return list_json(rows);
}
std::vector<ProofRow> proof_rows_of(const Json& json) {
  return list_of<ProofRow>(json);
}
Json certified_json(const std::vector<CertifiedLine>& lines) {
  return list_json(lines);
}
std::vector<CertifiedLine> certified_of(const Json& json) {
  return list_of<CertifiedLine>(json);
}

}  // namespace limitcheck::verify
