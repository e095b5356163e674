// SPDX-License-Identifier: MIT
#include "data/validate_tags.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>

namespace limitcheck::data {
namespace {

using Key = std::pair<std::int32_t, std::int32_t>;
constexpr float kNone = std::numeric_limits<float>::quiet_NaN();  // until a tag has been seen

}  // namespace

std::vector<MeshFinding> tag_findings(const ControlMesh& mesh, const std::set<Key>& edges,
                                      std::int64_t first) {
  std::vector<MeshFinding> findings;
  std::int64_t tag = 0;
  const auto check = [&](const std::string& what, std::vector<std::int64_t> elements, bool exists,
                         float value, float& before) {
    const auto refuse = [&](std::string message) {
      findings.push_back({MeshFault::kSharpness, elements, std::move(message), -1, -1, tag});
    };
    if (!exists)
      refuse(fmt::format("{} has a sharpness and is none", what));
    else if (!(value >= 0))
      refuse(fmt::format("{} has the sharpness {}", what, value));
    else if (before != value && !std::isnan(before))
      refuse(fmt::format("{} has the sharpness {} and {}", what, before, value));
    else
      before = value;
    ++tag;
  };
  std::map<Key, float> of_edge;
  for (const SharpEdge& e : mesh.sharpness.edges) {
    const Key key = std::minmax(e.a, e.b);
    check(fmt::format("edge {}–{}", e.a + first, e.b + first), {e.a, e.b}, edges.count(key) > 0, e.sharpness,
          of_edge.emplace(key, kNone).first->second);
  }
  std::map<std::int32_t, float> of_vertex;
  for (const SharpVertex& v : mesh.sharpness.vertices)
    check(fmt::format("vertex {}", v.vertex + first), {v.vertex},
          v.vertex >= 0 && static_cast<std::size_t>(v.vertex) < mesh.positions.size(), v.sharpness,
          of_vertex.emplace(v.vertex, kNone).first->second);

  std::int32_t before = -1;
  for (const std::int32_t f : mesh.holes) {
    if (f < 0 || static_cast<std::size_t>(f) >= mesh.faces.size())
      findings.push_back({MeshFault::kHole, {f}, fmt::format("the hole {} is no face", f + first)});
    else if (f <= before)
      findings.push_back({MeshFault::kHole, {f}, fmt::format("the hole {} is out of order", f + first), f});
    before = f;
  }
  return findings;
}

}  // namespace limitcheck::data
