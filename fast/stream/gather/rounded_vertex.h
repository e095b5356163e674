// SPDX-License-Identifier: MIT
// A vertex of the sliding window in double, as row streaming delivers it.
#pragma once

#include "fast/rules/surface_vertex.h"
#include "fast/stream/kernel/vertex.h"

namespace limitcheck::fast::row_stream {

/// Zeros have no sign.
inline Vertex rounded(const SurfaceVertex<double>& v) {
  const auto number = [](double x) { return static_cast<float>(x) + 0.F; };
  return {{number(v.position.x), number(v.position.y), number(v.position.z)},
          {number(v.normal.x), number(v.normal.y), number(v.normal.z)}};
}

}  // namespace limitcheck::fast::row_stream
