// SPDX-License-Identifier: MIT
// The vector loops of the output forms, for every target.
#include <cmath>
#include <cstdint>

#include "fast/stream/kernel/output_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fast/stream/kernel/output_targets.cpp"
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace limitcheck::fast::row_stream::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

HWY_ATTR void stream_floats(const float* from, std::size_t count, float* to) {
  const hn::CappedTag<float, 16> d;  // a line, or a power of two less
  for (std::size_t k = 0; k < count; k += hn::Lanes(d)) hn::Stream(hn::LoadU(d, from + k), d, to + k);
}

#if HWY_TARGET != HWY_SCALAR

// Vertices come apart as three vectors of alternating positions and normals; both halves are encoded, the
// positions' codes thrown away.
template <class D, class V = hn::Vec<D>>
HWY_ATTR HWY_INLINE V octahedral(D d, V x, V y, V z) {
  const hn::RebindToSigned<D> bits;
  const auto one = hn::Set(d, 1.f);
  const auto inverse = hn::Div(one, hn::Add(hn::Add(hn::Abs(x), hn::Abs(y)), hn::Abs(z)));
  const auto p = hn::Mul(x, inverse), q = hn::Mul(y, inverse);
  const auto below = hn::Lt(z, hn::Zero(d));
  const auto u = hn::IfThenElse(below, hn::CopySign(hn::Sub(one, hn::Abs(q)), x), p);
  const auto w = hn::IfThenElse(below, hn::CopySign(hn::Sub(one, hn::Abs(p)), y), q);
  const auto scale = hn::Set(d, 32767.f);
  const auto a = hn::NearestInt(hn::Mul(scale, u)), b = hn::NearestInt(hn::Mul(scale, w));
  return hn::BitCast(d, hn::Or(hn::And(a, hn::Set(bits, 0xffff)), hn::ShiftLeft<16>(b)));
}

template <class D>
HWY_ATTR HWY_INLINE void compact_one_vector(D d, const float* in, float* out) {
  const std::size_t lanes = hn::Lanes(d);
  hn::Vec<D> x0, y0, z0, x1, y1, z1;
  hn::LoadInterleaved3(d, in, x0, y0, z0);
  hn::LoadInterleaved3(d, in + 3 * lanes, x1, y1, z1);
  const auto n0 = octahedral(d, x0, y0, z0), n1 = octahedral(d, x1, y1, z1);
  hn::StoreInterleaved4(hn::ConcatEven(d, x1, x0), hn::ConcatEven(d, y1, y0), hn::ConcatEven(d, z1, z0),
                        hn::ConcatOdd(d, n1, n0), d, out);
}

HWY_ATTR void compact_vectors(const Vertex* from, std::size_t count, CompactVertex* to) {
  const hn::CappedTag<float, 16> wide;
  const hn::CappedTag<float, 4> four;
  const std::size_t lanes = hn::Lanes(wide), lanes_four = hn::Lanes(four);
  const auto* in = reinterpret_cast<const float*>(from);
  auto* out = reinterpret_cast<float*>(to);
  std::size_t k = 0;
  for (; k + lanes <= count; k += lanes) compact_one_vector(wide, in + 6 * k, out + 4 * k);
  for (; k + lanes_four <= count; k += lanes_four) compact_one_vector(four, in + 6 * k, out + 4 * k);
  compact_row(from + k, count - k, to + k);
}

#else

void compact_vectors(const Vertex* from, std::size_t count, CompactVertex* to) {
  compact_row(from, count, to);
}

#endif

}  // namespace limitcheck::fast::row_stream::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limitcheck::fast::row_stream {

HWY_EXPORT(stream_floats);
HWY_EXPORT(compact_vectors);

void stream_lines(const std::byte* from, std::size_t lines, std::byte* to) {
  HWY_DYNAMIC_DISPATCH(stream_floats)
  (reinterpret_cast<const float*>(from), 16 * lines, reinterpret_cast<float*>(to));
}

void compact(const Vertex* vertices, std::size_t count, CompactVertex* out) {
  HWY_DYNAMIC_DISPATCH(compact_vectors)(vertices, count, out);
}

}  // namespace limitcheck::fast::row_stream
#endif  // HWY_ONCE
