// SPDX-License-Identifier: MIT
#include "verify/shard/part.h"

#include <fmt/core.h>

#include <algorithm>

#include "data/error.h"
#include "data/untrusted_json.h"
#include "verify/shard/seal.h"

namespace limitcheck::verify {

using Json = nlohmann::json;

bool PartReport::is_complete() const {
  // Not a walk through the units of the plan: a file that somebody wrote may tell of 10^18.
  return results.size() == plan.size() && std::all_of(results.begin(), results.end(), [&](const auto& r) {
           return r.first < plan.units && plan.has(r.first);
         });
}

std::string to_json(const PartReport& part) {
  Json results = Json::array();
  for (const auto& [unit, result] : part.results) results.push_back({unit, result});
  const Json json{{"program", part.plan.program},    {"plan", part.plan.what},
                  {"units", part.plan.units},        {"together", part.plan.together},
                  {"shard", part.plan.shard.text()}, {"seconds", part.seconds},
                  {"containment", part.containment}, {"printed", part.printed},
                  {"incomplete", part.incomplete},   {"results", std::move(results)}};
  return sealed(json);
}

PartReport read_part(const std::string& text) try {
  Json json = data::parse_untrusted(text);
  if (!json.contains("shard") || !json.contains("together"))
    throw data::ArgumentError("this is no part that --shard has made");
  json = unsealed_object(std::move(json));
  PartReport part;
  json.at("program").get_to(part.plan.program);
  part.plan.what = std::move(json.at("plan"));
  json.at("units").get_to(part.plan.units), json.at("together").get_to(part.plan.together);
  part.plan.shard = parse_shard(json.at("shard").get<std::string>());
  json.at("seconds").get_to(part.seconds), json.at("containment").get_to(part.containment);
  json.at("printed").get_to(part.printed), json.at("incomplete").get_to(part.incomplete);
  if (part.plan.together == 0) throw data::ArgumentError("this is no part that --shard has made");
  for (Json& pair : json.at("results"))
    if (!part.results.emplace(pair.at(0).get<std::size_t>(), std::move(pair.at(1))).second)
      throw data::ArgumentError("it has a unit twice");
  return part;
} catch (const Json::exception& error) {
  throw data::ArgumentError(fmt::format("this is no part that --shard has made: {}", error.what()));
}

PartReport joined(const std::vector<PartReport>& parts) {
  std::vector<Shard> shards;
  for (const PartReport& p : parts) shards.push_back(p.plan.shard);
  if (shards.empty()) require_all(shards);
  PartReport whole;
  const Plan& first = parts.front().plan;
  for (const PartReport& p : parts) {
    const auto refuse = [&](const std::string& why) {
      throw data::ArgumentError(fmt::format("shard {} {}", p.plan.shard.text(), why));
    };
    if (p.plan.program != first.program || p.plan.what != first.what || p.plan.units != first.units ||
        p.plan.together != first.together)
      refuse("is of another plan than shard " + first.shard.text());
    if (!p.incomplete.empty()) refuse("is incomplete: " + p.incomplete);
    if (!p.is_complete()) refuse("is incomplete");
  }
  require_all(shards);
  whole.plan = first, whole.plan.shard = {};
  std::vector<const PartReport*> in_order(parts.size());
  for (const PartReport& p : parts) in_order[p.plan.shard.index] = &p;
  for (const PartReport* at : in_order) {
    const PartReport& p = *at;
    whole.results.insert(p.results.begin(), p.results.end());
    whole.seconds += p.seconds;
    whole.printed += p.printed;
    if (whole.containment.empty()) whole.containment = p.containment;
  }
  return whole;
}

}  // namespace limitcheck::verify
