// SPDX-License-Identifier: MIT
// A corner of the faces in the middle of a neighbourhood, in words.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "fast/mesh/adjacency.h"

namespace limitcheck::verify {

/// "5" for an interior vertex of that valence; "2|1" on the boundary, for two faces before the middle's own and one
/// after, counter-clockwise.
///   own   faces of the middle at the vertex, from that of half-edge h on
template <int K>
std::string corner_name(const fast::BasicAdjacency<K>& adjacency, std::int32_t h, std::ptrdiff_t own) {
  const std::int32_t v = adjacency.origin(h);
  const auto fan = adjacency.fan(v);
  if (!adjacency.on_boundary(v)) return fmt::format("{}", fan.size());
  const std::ptrdiff_t before = std::ranges::find(fan, h) - fan.begin();
  return fmt::format("{}|{}", before, std::ssize(fan) - own - before);
}

}  // namespace limitcheck::verify
