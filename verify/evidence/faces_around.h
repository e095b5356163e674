// SPDX-License-Identifier: MIT
// The faces around each control vertex.
#pragma once

#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "data/faces.h"

namespace limitcheck::verify {

/// For each vertex its faces in ascending order, all in one array.
class FacesAround {
 public:
  /// The faces name vertices 0 .. vertices - 1.
  FacesAround(const data::Faces& faces, std::size_t vertices) : start_(vertices + 1) {
    for (const std::int32_t v : faces.corners()) ++start_[v + 1];
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    faces_.resize(start_.back());
    std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
    for (std::size_t f = 0; f < faces.size(); ++f)
      for (const std::int32_t v : faces[f]) faces_[next[v]++] = static_cast<std::int32_t>(f);
  }

  std::span<const std::int32_t> of(std::int32_t vertex) const {
    return {faces_.data() + start_[vertex], start_[vertex + 1] - start_[vertex]};
  }

 private:
  std::vector<std::size_t> start_;
  std::vector<std::int32_t> faces_;
};

}  // namespace limitcheck::verify
