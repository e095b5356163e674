// SPDX-License-Identifier: MIT
// A point of the limit surface: with its tangents, as the masks give it; as the tessellators deliver it; and in 16
// bytes in place of 24, for output whose speed is that of the memory.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "fast/mesh/vec3.h"

namespace limitcheck::fast {

/// Position and two tangents of the limit surface, all linear in the control points; du x dv points outward.
template <class N>
struct LimitFrame {
  Vec3<N> position, du, dv;
};

/// A point of the limit surface and its unit normal: 6 numbers, interleaved, as glVertexPointer and
/// glNormalPointer take them with a stride of sizeof(SurfaceVertex).
template <class N>
struct SurfaceVertex {
  Vec3<N> position, normal;
  friend constexpr bool operator==(const SurfaceVertex&, const SurfaceVertex&) = default;
};

/// Position as it is; the unit normal on the octahedron |x| + |y| + |z| = 1, whose lower half is folded over
/// the upper, as two signed 16-bit numbers: round(32767 u) in the lower half, round(32767 v) in the upper.
///
/// The normal is off by at most kCompactNormalBound: sqrt(4.5) / 32767 (u and v are off by half a step each,
/// z by both, on a face at distance 1 / sqrt(3) or more) and 1e-7 of rounding; measured 6.33e-5 rad.
struct CompactVertex {
  float position[3];
  std::uint32_t normal;
  friend bool operator==(const CompactVertex&, const CompactVertex&) = default;
};
static_assert(sizeof(CompactVertex) == 16);

inline constexpr double kCompactNormalBound = 6.5e-5;  // rad

/// A vertex in 16 bytes; its normal is off by at most kCompactNormalBound.
inline CompactVertex compacted(const SurfaceVertex<float>& v) {
  const auto [x, y, z] = v.normal;
  const float inverse = 1 / (std::abs(x) + std::abs(y) + std::abs(z));
  const float p = x * inverse, q = y * inverse;
  const float u = z < 0 ? std::copysign(1 - std::abs(q), x) : p;
  const float w = z < 0 ? std::copysign(1 - std::abs(p), y) : q;
  const auto a = static_cast<std::int32_t>(std::lrint(32767 * u));
  const auto b = static_cast<std::int32_t>(std::lrint(32767 * w));
  return {{v.position.x, v.position.y, v.position.z},
          (static_cast<std::uint32_t>(a) & 0xffff) | static_cast<std::uint32_t>(b) << 16};
}

/// The unit normal, as a shader unpacks it.
inline std::array<float, 3> unpacked_normal(const CompactVertex& v) {
  const float u = static_cast<float>(static_cast<std::int16_t>(v.normal & 0xffff)) / 32767;
  const float w = static_cast<float>(static_cast<std::int16_t>(v.normal >> 16)) / 32767;
  float x = u, y = w;
  const float z = 1 - std::abs(u) - std::abs(w);
  if (z < 0) x = std::copysign(1 - std::abs(w), u), y = std::copysign(1 - std::abs(u), w);
  const float size = std::sqrt(x * x + y * y + z * z);
  return {x / size, y / size, z / size};
}

/// Packs a row of vertices.
using CompactRow = void (*)(const SurfaceVertex<float>* from, std::size_t count, CompactVertex* to);
/// The one that needs no SIMD.
inline void compact_row(const SurfaceVertex<float>* from, std::size_t count, CompactVertex* to) {
  for (std::size_t k = 0; k < count; ++k) to[k] = compacted(from[k]);
}

}  // namespace limitcheck::fast
