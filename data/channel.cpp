// SPDX-License-Identifier: MIT
#include "data/channel.h"

#include <fmt/format.h>

#include <cmath>
#include <unordered_map>

#include "data/control_mesh.h"
#include "data/error.h"

namespace limitcheck::data {

Channel Channel::some(int first, int count) const {
  Channel result{name, count, {}, corners, rule};
  for (std::size_t i = static_cast<std::size_t>(first); i < values.size();
       i += static_cast<std::size_t>(components))
    result.values.insert(result.values.end(), values.begin() + static_cast<std::ptrdiff_t>(i),
                         values.begin() + static_cast<std::ptrdiff_t>(i) + count);
  return result;
}

std::string fault_of(const Channel& channel, const ControlMesh& mesh, std::int64_t first) {
  if (channel.components < 1 || channel.components > kMostComponents)
    return fmt::format("a value has 1 to {} components, not {}", kMostComponents, channel.components);
  const auto components = static_cast<std::size_t>(channel.components);
  if (channel.values.size() % components != 0)
    return fmt::format("{} numbers are no values of {} components", channel.values.size(), components);
  const std::size_t values = channel.values.size() / components, corners = mesh.faces.corners().size();
  for (std::size_t i = 0; i < channel.values.size(); ++i)
    if (!std::isfinite(channel.values[i]))
      return fmt::format("value {} is not finite", first + static_cast<std::int64_t>(i / components));
  if (channel.corners.size() != corners)
    return fmt::format("it has {} corners, the mesh has {}", channel.corners.size(), corners);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (std::size_t c = mesh.faces.first_corner(f); c < mesh.faces.first_corner(f + 1); ++c) {
      const std::int64_t index = channel.corners[c], face = first + static_cast<std::int64_t>(f);
      if (index < 0) return fmt::format("face {} has a corner without a value", face);
      if (static_cast<std::size_t>(index) >= values)
        return fmt::format("face {} names value {}, there are {}", face, first + index, values);
    }
  return "";
}

std::vector<Channel> channels_of(const std::vector<Channel>& whole, const Faces& whole_faces,
                                 std::span<const std::int32_t> faces) {
  std::vector<Channel> result;
  for (const Channel& c : whole) {
    Channel& part = result.emplace_back(Channel{c.name, c.components, {}, {}, c.rule});
    std::unordered_map<std::int32_t, std::int32_t> number;
    for (const std::int32_t f : faces)
      for (std::size_t at = whole_faces.first_corner(f); at < whole_faces.first_corner(f + 1); ++at) {
        const auto [entry, is_new] =
            number.try_emplace(c.corners[at], static_cast<std::int32_t>(number.size()));
        for (int k = 0; is_new && k < c.components; ++k) part.values.push_back(c.at(at, k));
        part.corners.push_back(entry->second);
      }
  }
  return result;
}

const Channel& channel_of(const ControlMesh& mesh, std::string_view name) {
  std::string known;
  for (const Channel& channel : mesh.channels) {
    if (channel.name == name) return channel;
    known += (known.empty() ? "" : ", ") + channel.name;
  }
  throw ArgumentError(fmt::format("the mesh has no channel '{}'; {}", name,
                                  known.empty() ? "it has none" : "it has " + known));
}

}  // namespace limitcheck::data
