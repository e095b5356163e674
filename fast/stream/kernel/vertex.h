// SPDX-License-Identifier: MIT
#pragma once

namespace limitcheck::fast::row_stream {

/// Position and unit normal, 24 bytes.
struct Vertex {
  float position[3];
  float normal[3];
};

}  // namespace limitcheck::fast::row_stream
