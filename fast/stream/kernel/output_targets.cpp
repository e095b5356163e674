// SPDX-License-Identifier: MIT
// The vector loops of input and output, for every target.
#include <algorithm>

#include "fast/stream/kernel/output_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fast/stream/kernel/output_targets.cpp"
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "fast/stream/kernel/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limitcheck::fast::row_stream::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128

// Four numbers of every fourth lane, a block each.
template <class D>
HWY_ATTR HWY_INLINE hn::Vec<D> load_blocks(D d, const float* const* from, int first) {
  if constexpr (hn::MaxLanes(D()) == 4) {
    return hn::LoadU(d, from[0] + first);
  } else {
    const hn::Half<D> half;
    return hn::Combine(d, load_blocks(half, from + hn::MaxLanes(half), first),
                       load_blocks(half, from, first));
  }
}

template <class D>
HWY_ATTR void fill_lanes(D d, const float* const* from, int count, float* out) {
  const auto put = [&](hn::Vec<D> v, int k) HWY_ATTR { hn::Store(v, d, out + k * hn::MaxLanes(D())); };
  int k = 0;
#if HWY_TARGET == HWY_AVX3
  if constexpr (hn::MaxLanes(D()) == 16) {  // eight numbers at a time: fewer loads, a third less time
    for (; k + 4 < count && count >= 8; k += 8) {
      const int first = std::min(k, count - 8);  // the last may overlap others
      const hn::Half<D> half;
      hn::Vec<D> low[4], high[4];  // of lanes 0..7 and 8..15: numbers of lanes r and 4 + r
      for (int r = 0; r < 4; ++r) {
        const float* const* at = from + r;
        low[r] = hn::Combine(d, hn::LoadU(half, at[4] + first), hn::LoadU(half, at[0] + first));
        high[r] = hn::Combine(d, hn::LoadU(half, at[12] + first), hn::LoadU(half, at[8] + first));
      }
      LaneNumber<D>::transpose_blocks(low);
      LaneNumber<D>::transpose_blocks(high);
      for (int r = 0; r < 4; ++r) {
        const __m512 l = low[r].raw, h = high[r].raw;
        put(hn::Vec<D>{_mm512_shuffle_f32x4(l, h, 0x88)}, first + r);
        put(hn::Vec<D>{_mm512_shuffle_f32x4(l, h, 0xdd)}, first + 4 + r);
      }
    }
  }
#endif
  for (; k < count; k += 4) {
    const int first = k + 4 > count && count > 4 ? count - 4 : k;
    hn::Vec<D> v[4];
    for (int r = 0; r < 4; ++r) v[r] = load_blocks(d, from + r, first);
    LaneNumber<D>::transpose_blocks(v);
    for (int r = 0; r < 4 && first + r < count; ++r) put(v[r], first + r);
  }
}

#endif

// Plainly where this target lacks the lanes: another thread may be trying it just now, see ask_every_target().
HWY_ATTR void lanes_of_floats(const float* const* from, int count, int lanes, float* out) {
#if HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128
  constexpr hn::CappedTag<float, 16> sixteen;
  constexpr hn::CappedTag<float, 8> eight;
  if (lanes == 16 && hn::MaxLanes(sixteen) == 16) return fill_lanes(sixteen, from, count, out);
  if (lanes == 8 && hn::MaxLanes(eight) == 8) return fill_lanes(eight, from, count, out);
  if (lanes == 4) return fill_lanes(hn::CappedTag<float, 4>(), from, count, out);
#endif
  for (int i = 0; i < count * lanes; ++i) out[i] = from[i % lanes][i / lanes];
}

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

HWY_ATTR void compact_vectors(const row_stream::Vertex* from, std::size_t count, CompactVertex* to) {
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

void compact_vectors(const row_stream::Vertex* from, std::size_t count, CompactVertex* to) {
  compact_row(from, count, to);
}

#endif

}  // namespace limitcheck::fast::row_stream::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limitcheck::fast::row_stream {

HWY_EXPORT(lanes_of_floats);
HWY_EXPORT(stream_floats);
HWY_EXPORT(compact_vectors);

void float_lanes(const float* const* from, int count, int lanes, float* out) {
  HWY_DYNAMIC_DISPATCH(lanes_of_floats)(from, count, lanes, out);
}

void stream_lines(const std::byte* from, std::size_t lines, std::byte* to) {
  HWY_DYNAMIC_DISPATCH(stream_floats)
  (reinterpret_cast<const float*>(from), 16 * lines, reinterpret_cast<float*>(to));
}

void compact(const Vertex* vertices, std::size_t count, CompactVertex* out) {
  HWY_DYNAMIC_DISPATCH(compact_vectors)(vertices, count, out);
}

}  // namespace limitcheck::fast::row_stream
#endif  // HWY_ONCE
