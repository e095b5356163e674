// SPDX-License-Identifier: MIT
#include "verify/mutants/models/model_sides.h"

#include <algorithm>
#include <cmath>

namespace limitcheck::verify {

using reference::Topology;
using V = ModelTags::V;
using Rule = ModelTags::Rule;

V unit_or_up(const V& n) {
  const double size = std::hypot(n.x, n.y, n.z);
  return size > 0 ? n * (1 / size) : V{0, 0, 1};
}

const V& ModelLimit::normal(const Topology& topology, std::int32_t v, std::int32_t a, std::int32_t b) const {
  const auto faces = topology.sector(v).faces;
  for (std::size_t i = 0; i < faces.size() && normals.size() > 1; ++i) {
    const auto corners = topology.faces()[faces[i]];
    const auto has = [&](std::int32_t w) {
      return std::find(corners.begin(), corners.end(), w) != corners.end();
    };
    if (has(a) && has(b)) return normals[i];
  }
  return normals[0];
}

ModelSides::ModelSides(const Topology& topology, const ModelTags& tags, std::int32_t v)
    : tags_(tags), sector_(topology.sector(v)), vertex_(v) {
  for (std::size_t i = 0; i < sector_.edges.size(); ++i)
    if (tags.lasts(topology, sector_.edges[i])) sharp_.push_back(i);
  rule_ = tags.vertex(v) == ModelTags::kForEver ? Rule::kCorner
          : sharp_.empty()                      ? Rule::kSmooth
          : sharp_.size() == 1                  ? Rule::kDart
          : sharp_.size() == 2                  ? Rule::kCrease
                                                : Rule::kCorner;
}

std::vector<V> ModelSides::turned(const std::vector<V>& ring, std::size_t first, std::size_t count) {
  std::vector<V> part;
  for (std::size_t i = 0; i < count; ++i) part.push_back(ring[(first + i) % ring.size()]);
  return part;
}

ModelLimit ModelSides::limit(const std::vector<V>& points, std::span<const std::int32_t> faces,
                             const std::function<V(std::size_t, std::size_t)>& normal) const {
  const std::size_t count = sector_.faces.size();
  const V& c = points[vertex_];
  ModelLimit result{c, {}};
  if (rule_ == Rule::kCrease || tags_.is("corner_limit_moved")) {
    const std::size_t first = sharp_.empty() ? 0 : sharp_.front(), last = sharp_.empty() ? 1 : sharp_.back();
    const V ends = points[sector_.neighbours[first]] + points[sector_.neighbours[last]];
    result.position = c * (2. / 3) + ends * (1. / 6);
  }
  if (sharp_.empty()) {
    result.normals = {normal(0, count)};
    return result;
  }

  std::vector<V> normals(count);
  const std::size_t stretches = sector_.closed ? sharp_.size() : sharp_.size() - 1;
  for (std::size_t k = 0; k < stretches; ++k) {
    const std::size_t first = sharp_[k], next = k + 1 < sharp_.size() ? sharp_[k + 1] : sharp_[0] + count;
    const V n = normal(first, next - first);
    for (std::size_t i = first; i < next; ++i) normals[i % count] = n;
  }
  if (tags_.is("normal_of_the_other_side"))
    std::rotate(normals.begin(), normals.begin() + static_cast<std::ptrdiff_t>(count / 2), normals.end());
  if (tags_.is("one_normal_for_all_sides")) normals.assign(count, V(normals[0]));
  if (tags_.is("mean_of_all_sides")) {
    V sum{};
    for (const V& n : normals) sum += n;
    normals.assign(count, unit_or_up(sum));
  }
  if (stretches == 1) {
    result.normals = {normals[0]};
    return result;
  }
  for (const std::int32_t f : faces) {
    const auto at = std::find(sector_.faces.begin(), sector_.faces.end(), f) - sector_.faces.begin();
    result.normals.push_back(normals[static_cast<std::size_t>(at)]);
  }
  return result;
}

}  // namespace limitcheck::verify
