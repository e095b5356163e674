// SPDX-License-Identifier: MIT
// What the values of a channel are, where they are not those that were asked for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "data/control_mesh.h"
#include "verify/row/result.h"

namespace limitcheck::verify {

/// Whose values a witness shows.
inline void name_channel(Witness& witness, const data::Channel& channel) {
  witness.channel = channel.name;
  witness.rule =
      data::kChannelRules[static_cast<std::size_t>(channel.rule.value_or(data::kUsualChannelRule))];
}

/// A channel with one value for each vertex: that of its first or its last face.
inline data::Channel without_seams(const data::ControlMesh& mesh, data::Channel channel, bool first) {
  std::map<std::int32_t, std::int32_t> value;
  const auto vertices = mesh.faces.corners();
  for (std::size_t c = 0; c < vertices.size(); ++c)
    if (first)
      value.emplace(vertices[c], channel.corners[c]);
    else
      value[vertices[c]] = channel.corners[c];
  for (std::size_t c = 0; c < vertices.size(); ++c) channel.corners[c] = value.at(vertices[c]);
  return channel;
}

/// Whether a channel explains what is wrong by the one that was asked for: by it all but a hundredth of all values are
/// right, and at least half of those that are not right by the other.
inline bool explains(std::int64_t bad, std::int64_t wrong, std::int64_t count) {
  return bad * 100 <= count && bad * 2 <= wrong;
}

/// A sentence that names the channels that explain what is wrong: of another rule, smooth across seams, with components
/// exchanged or counted from the other end. Empty if there is none.
///   fits   whether a channel by a rule does
template <class Fits>
std::string other_channels(const data::ControlMesh& mesh, const data::Channel& asked, Fits&& fits) {
  const data::ChannelRule rule = asked.rule.value_or(data::kUsualChannelRule);
  std::string rules;
  bool several = false;
  for (std::size_t k = 0; k < std::size(data::kChannelRules); ++k) {
    const auto other = static_cast<data::ChannelRule>(k);
    if (other == rule || !fits(asked, other)) continue;
    several = !rules.empty();
    rules += (several ? ", " : "") + std::string(data::kChannelRules[k]);
  }
  if (!rules.empty())
    return "the values are those of " + std::string(several ? "each of the rules " : "the rule ") + rules +
           ", where " + std::string(data::kChannelRules[static_cast<std::size_t>(rule)]) + " was asked for";
  const auto components = static_cast<std::size_t>(asked.components);
  const auto changed = [&](auto&& change) {
    data::Channel other = asked;
    for (std::size_t i = 0; components > 1 && i < other.values.size(); i += components)
      change(other.values[i], other.values[i + 1]);
    return other;
  };
  for (const bool first : {true, false})
    if (const data::Channel other = without_seams(mesh, asked, first); other.corners != asked.corners)
      for (const auto smooth : {data::ChannelRule::kNone, rule})
        if (fits(other, smooth))
          return "the values are those of the surface's smooth rule across seams, with the value that the " +
                 std::string(first ? "first" : "last") + " face at a vertex names for all of them";
  if (fits(changed([](double& u, double& v) { std::swap(u, v); }), rule))
    return "the values are right with two components exchanged";
  if (fits(changed([](double&, double& v) { v = 1 - v; }), rule))
    return "the values are right with the second component counted from the other end: 1 - v for v";
  return "";
}

}  // namespace limitcheck::verify
