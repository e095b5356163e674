// SPDX-License-Identifier: MIT
// A vertex in 16 bytes: where memory is the limit, a third less of it.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "fast/stream/vertex.h"

namespace limitcheck::fast::row_stream {

/// Position as it is; the unit normal on the octahedron |x| + |y| + |z| = 1, whose lower half is folded over
/// the upper, as two signed 16-bit numbers: round(32767 u) in the lower half, round(32767 v) in the upper.
///
/// Error of the normal: at most sqrt(4.5) / 32767 = 6.5e-5 rad (u and v are off by half a step each, z by
/// both, on a face at distance 1 / sqrt(3) or more), and 1e-7 of rounding; measured 6.33e-5.
struct CompactVertex {
  float position[3];
  std::uint32_t normal;
  friend bool operator==(const CompactVertex&, const CompactVertex&) = default;
};
static_assert(sizeof(CompactVertex) == 16);

inline constexpr double kCompactNormalBound = 6.5e-5;  // rad

/// One vertex; the vectors below give the same bits.
inline CompactVertex compacted(const Vertex& v) {
  const float x = v.normal[0], y = v.normal[1], z = v.normal[2];
  const float inverse = 1 / (std::abs(x) + std::abs(y) + std::abs(z));
  const float p = x * inverse, q = y * inverse;
  const float u = z < 0 ? std::copysign(1 - std::abs(q), x) : p;
  const float w = z < 0 ? std::copysign(1 - std::abs(p), y) : q;
  const auto a = static_cast<std::int32_t>(std::lrint(32767 * u));
  const auto b = static_cast<std::int32_t>(std::lrint(32767 * w));
  return {{v.position[0], v.position[1], v.position[2]},
          (static_cast<std::uint32_t>(a) & 0xffff) | static_cast<std::uint32_t>(b) << 16};
}

/// As a shader does it; unit length to rounding.
inline std::array<float, 3> unpacked_normal(const CompactVertex& v) {
  const float u = static_cast<float>(static_cast<std::int16_t>(v.normal & 0xffff)) / 32767;
  const float w = static_cast<float>(static_cast<std::int16_t>(v.normal >> 16)) / 32767;
  float x = u, y = w;
  const float z = 1 - std::abs(u) - std::abs(w);
  if (z < 0) x = std::copysign(1 - std::abs(w), u), y = std::copysign(1 - std::abs(u), w);
  const float size = std::sqrt(x * x + y * y + z * z);
  return {x / size, y / size, z / size};
}

/// All of them, in vectors: the same bits on every machine. `out` holds as many.
void compact(std::span<const Vertex> vertices, CompactVertex* out);

}  // namespace limitcheck::fast::row_stream
