// SPDX-License-Identifier: MIT
// Half-edges of a mesh of quads.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "data/control_mesh.h"

namespace limitcheck::fast {

class QuadAdjacency {
 public:
  explicit QuadAdjacency(const data::ControlMesh& mesh) {
    const auto corners = mesh.faces.corners();
    origin_.assign(corners.begin(), corners.end());
    std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> edges;
    const auto count = static_cast<std::int32_t>(origin_.size());
    for (std::int32_t h = 0; h < count; ++h) edges[{origin(h), target(h)}] = h;
    twin_.assign(origin_.size(), -1);
    for (std::int32_t h = 0; h < count; ++h) {
      const auto found = edges.find({target(h), origin(h)});
      if (found != edges.end()) twin_[h] = found->second;
    }
    std::vector<std::int32_t> outgoing(mesh.positions.size(), -1);
    for (std::int32_t h = count - 1; h >= 0; --h) outgoing[origin(h)] = h;
    for (std::int32_t h = 0; h < count; ++h)
      if (twin(h) < 0) outgoing[origin(h)] = h;
    first_.push_back(0);
    for (const std::int32_t start : outgoing) {
      int n = 0;
      for (std::int32_t h = start; h >= 0;) {
        fan_.push_back(h), ++n;
        h = twin(prev(h));
        if (h == start) break;
      }
      first_.push_back(static_cast<std::int32_t>(fan_.size()));
      max_valence_ = std::max(max_valence_, n + 1);
    }
  }
  int face_count() const { return static_cast<int>(origin_.size() / 4); }
  int vertex_count() const { return static_cast<int>(first_.size()) - 1; }
  static std::int32_t next(std::int32_t h) { return h % 4 == 3 ? h - 3 : h + 1; }
  static std::int32_t prev(std::int32_t h) { return h % 4 == 0 ? h + 3 : h - 1; }
  std::int32_t twin(std::int32_t h) const { return twin_[h]; }
  std::int32_t origin(std::int32_t h) const { return origin_[h]; }
  std::int32_t target(std::int32_t h) const { return origin(next(h)); }
  std::span<const std::int32_t> fan(std::int32_t v) const {
    return {fan_.data() + first_[v], fan_.data() + first_[v + 1]};
  }
  std::int32_t outgoing(std::int32_t v) const { return fan(v).empty() ? -1 : fan(v)[0]; }
  bool on_boundary(std::int32_t v) const { return outgoing(v) >= 0 && twin(outgoing(v)) < 0; }
  int max_valence() const { return max_valence_; }

 private:
  std::vector<std::int32_t> origin_, twin_, fan_, first_;
  int max_valence_ = 0;
};

}  // namespace limitcheck::fast
