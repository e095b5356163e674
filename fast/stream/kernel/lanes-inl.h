// SPDX-License-Identifier: MIT
// Highway vectors as a number type of the kernel.

#if defined(LIMITCHECK_FAST_STREAM_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)  // per target
#ifdef LIMITCHECK_FAST_STREAM_LANES_INL_H_
#undef LIMITCHECK_FAST_STREAM_LANES_INL_H_
#else
#define LIMITCHECK_FAST_STREAM_LANES_INL_H_
#endif

#include <hwy/highway.h>

#include <cmath>
#include <cstddef>

#include "fast/stream/kernel/number.h"

#if HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128  // those run the scalar kernel

HWY_BEFORE_NAMESPACE();
namespace limitcheck::fast::row_stream::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Of the target that is being compiled, with so many lanes: "" where a kernel has no other number.
constexpr const char* target_name(int lanes) {
#if HWY_TARGET == HWY_AVX3
  return lanes == 16 ? "avx512" : lanes == 8 ? "avx512/8" : "avx512/4";
#elif HWY_TARGET == HWY_AVX2
  return lanes == 8 ? "avx2" : "avx2/4";
#elif HWY_ARCH_ARM
  return lanes == 4 ? "neon" : "";
#else
  return lanes == 4 ? "sse4" : "";
#endif
}

/// Same bits on every target: where the hardware has no fused multiply-add, std::fma takes its place, lane by
/// lane.
template <class D>
struct LaneNumber {
  using Scalar = hn::TFromD<D>;
  static constexpr int lanes = static_cast<int>(hn::MaxLanes(D()));

  struct V {
    hn::Vec<D> v;
    HWY_ATTR friend HWY_INLINE V operator+(V a, V b) { return {hn::Add(a.v, b.v)}; }
    HWY_ATTR friend HWY_INLINE V operator-(V a, V b) { return {hn::Sub(a.v, b.v)}; }
    HWY_ATTR friend HWY_INLINE V operator*(V a, V b) { return {hn::Mul(a.v, b.v)}; }
  };

  HWY_ATTR static HWY_INLINE V load(const Scalar* p) { return {hn::Load(D(), p)}; }
  HWY_ATTR static HWY_INLINE void store(V v, Scalar* p) { hn::Store(v.v, D(), p); }
  HWY_ATTR static HWY_INLINE V splat(double x) { return {hn::Set(D(), static_cast<Scalar>(x))}; }

  static constexpr bool kLinear = false;
  static constexpr bool kHasSeed = true;
  HWY_ATTR static HWY_INLINE V inverse_root_seed(V x) {
    const hn::RebindToSigned<D> bits;
    return {hn::BitCast(
        D(), hn::Sub(hn::Set(bits, kInverseRootMagic), hn::ShiftRight<1>(hn::BitCast(bits, x.v))))};
  }

#if HWY_NATIVE_FMA
  HWY_ATTR static HWY_INLINE V fma(V a, V b, V c) {
    return {hn::MulAdd(a.v, b.v, c.v)};
  }
  HWY_ATTR static HWY_INLINE V fms(V a, V b, V c) {
    return {hn::MulSub(a.v, b.v, c.v)};
  }
  HWY_ATTR static HWY_INLINE V fnma(V a, V b, V c) {
    return {hn::NegMulAdd(a.v, b.v, c.v)};
  }
#else
  HWY_ATTR static HWY_INLINE V fma(V a, V b, V c) {
    alignas(64) Scalar x[lanes], y[lanes], z[lanes];
    store(a, x), store(b, y), store(c, z);
    for (int k = 0; k < lanes; ++k) x[k] = std::fma(x[k], y[k], z[k]);
    return load(x);
  }
  HWY_ATTR static HWY_INLINE V fms(V a, V b, V c) {
    return fma(a, b, {hn::Neg(c.v)});
  }
  HWY_ATTR static HWY_INLINE V fnma(V a, V b, V c) {
    return fma({hn::Neg(a.v)}, b, c);
  }
#endif

  HWY_ATTR static HWY_INLINE V equal(V a, V b) {
    const D d;
    return {hn::IfThenElseZero(hn::Eq(a.v, b.v), hn::Set(d, Scalar(1)))};
  }
  HWY_ATTR static HWY_INLINE V select(V chosen, V a, V b) {
    return {hn::IfThenElse(hn::Eq(chosen.v, hn::Zero(D())), b.v, a.v)};
  }

  /// See ScalarNumber. Transposed within 128-bit blocks, which are stored as they are: that takes the fewest
  /// shuffles, which only one port can do.
  template <class Vertex>
  HWY_ATTR static HWY_INLINE void scatter_couple(const Vertex& a, const Vertex& b, Scalar* aos,
                                                 std::ptrdiff_t lane_stride) {
    hn::Vec<D> v[3][4] = {{a.position[0].v, a.position[1].v, a.position[2].v, a.normal[0].v},
                          {a.normal[1].v, a.normal[2].v, b.position[0].v, b.position[1].v},
                          {b.position[2].v, b.normal[0].v, b.normal[1].v, b.normal[2].v}};
    for (int t = 0; t < 3; ++t) transpose_blocks(v[t]);
    if constexpr (lanes == 16) {  // where the rows leave no room for the output in the first-level cache
      for (int lane = 0; lane < lanes; ++lane) __builtin_prefetch(aos + lane * lane_stride + 48, 1, 3);
    }
    for (int r = 0; r < 4; ++r, aos += lane_stride) {
      const hn::Vec<D> lanes_r[3] = {v[0][r], v[1][r], v[2][r]};
      store_blocks<0>(lanes_r, aos, lane_stride);
    }
  }

  HWY_ATTR static HWY_INLINE void expect([[maybe_unused]] Scalar* const* aos,
                                         [[maybe_unused]] std::ptrdiff_t offset) {
    if constexpr (lanes == 16) {
      for (int lane = 0; lane < lanes; ++lane) __builtin_prefetch(aos[lane] + offset, 1, 3);
    }
  }

  template <class Vertex>
  HWY_ATTR static HWY_INLINE void scatter_couple(const Vertex& a, const Vertex& b, Scalar* const* aos,
                                                 std::ptrdiff_t offset) {
    hn::Vec<D> v[3][4] = {{a.position[0].v, a.position[1].v, a.position[2].v, a.normal[0].v},
                          {a.normal[1].v, a.normal[2].v, b.position[0].v, b.position[1].v},
                          {b.position[2].v, b.normal[0].v, b.normal[1].v, b.normal[2].v}};
    for (int t = 0; t < 3; ++t) transpose_blocks(v[t]);
    for (int r = 0; r < 4; ++r) {
      const hn::Vec<D> lanes_r[3] = {v[0][r], v[1][r], v[2][r]};
      store_blocks<0>(lanes_r, aos + r, offset);
    }
  }

  template <class Vertex>
  HWY_ATTR static HWY_INLINE void scatter_vertex(const Vertex& a, Scalar* const* aos, std::ptrdiff_t offset) {
    hn::Vec<D> v[2][4] = {{a.position[0].v, a.position[1].v, a.position[2].v, a.normal[0].v},
                          {a.normal[1].v, a.normal[2].v, a.normal[1].v, a.normal[2].v}};
    for (int t = 0; t < 2; ++t) transpose_blocks(v[t]);
    for (int r = 0; r < 4; ++r) store_one<0>(v[0][r], v[1][r], aos + r, offset);
  }

  template <class Vertex>
  HWY_ATTR static HWY_INLINE void scatter_vertex(const Vertex& a, Scalar* aos, std::ptrdiff_t lane_stride) {
    alignas(64) Scalar soa[6 * lanes];
    a.store(soa);
    for (int lane = 0; lane < lanes; ++lane, aos += lane_stride) {
      for (int k = 0; k < 6; ++k) aos[k] = soa[k * lanes + lane];
    }
  }

 private:
  // Four vectors transposed within their 128-bit blocks.
  HWY_ATTR static HWY_INLINE void transpose_blocks(hn::Vec<D> (&v)[4]) {
    const D d;
    const hn::RepartitionToWide<D> wide;
    const auto ab0 = hn::BitCast(wide, hn::InterleaveLower(d, v[0], v[1]));
    const auto ab1 = hn::BitCast(wide, hn::InterleaveUpper(d, v[0], v[1]));
    const auto ce0 = hn::BitCast(wide, hn::InterleaveLower(d, v[2], v[3]));
    const auto ce1 = hn::BitCast(wide, hn::InterleaveUpper(d, v[2], v[3]));
    v[0] = hn::BitCast(d, hn::InterleaveLower(wide, ab0, ce0));
    v[1] = hn::BitCast(d, hn::InterleaveUpper(wide, ab0, ce0));
    v[2] = hn::BitCast(d, hn::InterleaveLower(wide, ab1, ce1));
    v[3] = hn::BitCast(d, hn::InterleaveUpper(wide, ab1, ce1));
  }

  // Block b of three vectors to the twelve numbers at aos + 4 b lane_stride.
  template <int b>
  HWY_ATTR static HWY_INLINE void store_blocks(const hn::Vec<D> (&v)[3], Scalar* aos,
                                               std::ptrdiff_t lane_stride) {
    if constexpr (4 * b < lanes) {
      const hn::CappedTag<Scalar, 4> quarter;
      for (int t = 0; t < 3; ++t) hn::StoreU(block<b>(v[t]), quarter, aos + 4 * t);
      store_blocks<b + 1>(v, aos + 4 * lane_stride, lane_stride);
    }
  }

  // The same where every lane has a pointer of its own.
  template <int b>
  HWY_ATTR static HWY_INLINE void store_blocks(const hn::Vec<D> (&v)[3], Scalar* const* aos,
                                               std::ptrdiff_t offset) {
    if constexpr (4 * b < lanes) {
      const hn::CappedTag<Scalar, 4> quarter;
      Scalar* to = aos[4 * b] + offset;
      for (int t = 0; t < 3; ++t) hn::StoreU(block<b>(v[t]), quarter, to + 4 * t);
      store_blocks<b + 1>(v, aos, offset);
    }
  }

  // Block b of the first and the first half of block b of the second.
  template <int b>
  HWY_ATTR static HWY_INLINE void store_one(hn::Vec<D> v, hn::Vec<D> half, Scalar* const* aos,
                                            std::ptrdiff_t offset) {
    if constexpr (4 * b < lanes) {
      const hn::CappedTag<Scalar, 4> quarter;
      const hn::Half<decltype(quarter)> two;
      Scalar* to = aos[4 * b] + offset;
      hn::StoreU(block<b>(v), quarter, to);
      hn::StoreU(hn::LowerHalf(two, block<b>(half)), two, to + 4);
      store_one<b + 1>(v, half, aos, offset);
    }
  }

  template <int b>
  HWY_ATTR static HWY_INLINE auto block(hn::Vec<D> v) {
    const hn::CappedTag<Scalar, 4> quarter;
    using Quarter [[maybe_unused]] = hn::Vec<decltype(quarter)>;
#if HWY_TARGET == HWY_AVX3
    if constexpr (lanes == 16) return Quarter{_mm512_extractf32x4_ps(v.raw, b)};
#endif
#if HWY_TARGET <= HWY_AVX2
    if constexpr (lanes == 8) return Quarter{_mm256_extractf128_ps(v.raw, b)};
#endif
    if constexpr (lanes == 4) return v;
  }
};

}  // namespace limitcheck::fast::row_stream::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif

#endif  // per target
