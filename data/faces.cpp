// SPDX-License-Identifier: MIT
#include "data/faces.h"

#include <limits>

namespace limitcheck::data {

void Faces::push_back(std::span<const std::int32_t> face) {
  if (face.size() > std::numeric_limits<std::int32_t>::max() - corners_.size())
    throw ArgumentError("the faces have more than 2^31 - 1 corners");
  corners_.insert(corners_.end(), face.begin(), face.end());
  ends_.push_back(static_cast<std::int32_t>(corners_.size()));
  triangles_ += face.size() == 3 ? 1 : 0;
}

}  // namespace limitcheck::data
