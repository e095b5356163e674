// SPDX-License-Identifier: MIT
// Vertices in 16 bytes (frame/compact_vertex.h), many at a time.
#pragma once

#include <span>

#include "fast/frame/compact_vertex.h"
#include "fast/stream/kernel/vertex.h"

namespace limitcheck::fast::row_stream {

using fast::CompactVertex, fast::kCompactNormalBound, fast::unpacked_normal;

/// One vertex, to the bits that compact() gives.
inline CompactVertex compacted(const Vertex& v) {
  const auto &p = v.position, &n = v.normal;
  return fast::compacted({{p[0], p[1], p[2]}, {n[0], n[1], n[2]}});
}

/// All of `vertices` into `out`, which holds as many; the same bits on every machine.
void compact(std::span<const Vertex> vertices, CompactVertex* out);
/// The same as a CompactRow.
void compact(const SurfaceVertex<float>* vertices, std::size_t count, CompactVertex* out);

}  // namespace limitcheck::fast::row_stream
