// SPDX-License-Identifier: MIT
#include "verify/proof/proof_report.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace limitcheck::verify {
namespace {

using Json = nlohmann::json;

// JSON has no infinity and no NaN.
Json number(double x) {
  if (std::isfinite(x)) return x;
  return std::isnan(x) ? "nan" : x > 0 ? "inf" : "-inf";
}
double number_of(const Json& json) {
  if (json.is_number()) return json.get<double>();
  if (json == "nan") return std::numeric_limits<double>::quiet_NaN();
  return json == "inf" ? HUGE_VAL : -HUGE_VAL;
}

// The structured bindings name all members: with a new one this does not compile until it is written, too.
Json to_json(const MapProof& map) {
  const auto& [equal, arithmetic, digits, witness] = map;
  Json at;
  if (witness) {
    const auto& [point, quantity, control_point, found, expected] = *witness;
    at = Json::array({point, quantity, control_point, number(found), number(expected)});
  }
  return Json::array({equal, arithmetic, number(digits), at});
}
MapProof map_of(const Json& j) {
  MapProof map{j.at(0), j.at(1), number_of(j.at(2)), {}};
  if (const Json& w = j.at(3); !w.is_null())
    map.witness = MapWitness{w.at(0), w.at(1), w.at(2), number_of(w.at(3)), number_of(w.at(4))};
  return map;
}

Json to_json(const std::optional<BoundProof>& bound) {
  if (!bound) return nullptr;
  const auto& [first, last, position, position_worst, tangent, tangent_worst, normal, product, share, alike,
               shipped] = *bound;
  const auto& [position_share, normal_share, targets, unlike] = shipped;
  return Json::array({first, last, number(position), number(position_worst), number(tangent),
                      number(tangent_worst), number(normal), number(product), number(share), alike,
                      number(position_share), number(normal_share), targets, unlike});
}
std::optional<BoundProof> bound_of(const Json& j) {
  if (j.is_null()) return std::nullopt;
  return BoundProof{j.at(0),
                    j.at(1),
                    number_of(j.at(2)),
                    number_of(j.at(3)),
                    number_of(j.at(4)),
                    number_of(j.at(5)),
                    number_of(j.at(6)),
                    number_of(j.at(7)),
                    number_of(j.at(8)),
                    j.at(9),
                    {number_of(j.at(10)), number_of(j.at(11)), j.at(12), j.at(13)}};
}

Json to_json(const std::optional<CostProof>& cost) {
  if (!cost) return nullptr;
  const auto& [flops, vectors] = *cost;
  return Json::array({number(flops), number(vectors)});
}
std::optional<CostProof> cost_of(const Json& j) {
  if (j.is_null()) return std::nullopt;
  return CostProof{number_of(j.at(0)), number_of(j.at(1))};
}

}  // namespace

Json proof_rows_json(const std::vector<ProofRow>& rows) {
  Json list = Json::array();
  for (const ProofRow& row : rows) {
    const auto& [topology, kernel, first, last, points, seconds, map, bound, cost] = row;
    list.push_back(Json::array(
        {topology, kernel, first, last, points, seconds, to_json(map), to_json(bound), to_json(cost)}));
  }
  return list;
}

std::vector<ProofRow> proof_rows_of(const Json& json) {
  std::vector<ProofRow> rows;
  for (const Json& j : json)
    rows.push_back({j.at(0), j.at(1), j.at(2), j.at(3), j.at(4), j.at(5), map_of(j.at(6)), bound_of(j.at(7)),
                    cost_of(j.at(8))});
  return rows;
}

Json certified_json(const std::vector<CertifiedLine>& lines) {
  Json list = Json::array();
  for (const CertifiedLine& line : lines) {
    const auto& [mesh, kernel, depth, errors] = line;
    const auto& [points, position, normal, radius, face, l1, l2, corner, unit, condition, placing] = errors;
    list.push_back(Json::array({mesh, kernel, depth, points, number(position), number(normal), number(radius),
                                face, l1, l2, corner, number(unit), number(condition), number(placing)}));
  }
  return list;
}

std::vector<CertifiedLine> certified_of(const Json& json) {
  std::vector<CertifiedLine> lines;
  for (const Json& j : json)
    lines.push_back({j.at(0),
                     j.at(1),
                     j.at(2),
                     {j.at(3), number_of(j.at(4)), number_of(j.at(5)), number_of(j.at(6)), j.at(7), j.at(8),
                      j.at(9), j.at(10), number_of(j.at(11)), number_of(j.at(12)), number_of(j.at(13))}});
  return lines;
}

}  // namespace limitcheck::verify
