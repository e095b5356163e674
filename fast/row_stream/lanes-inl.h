// SPDX-License-Identifier: MIT
// Highway vectors as a number type of the kernel. Included by targets.cpp once per target.

namespace hn = hwy::HWY_NAMESPACE;

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
  HWY_ATTR static HWY_INLINE V inverse_root(V x) { return {hn::Div(hn::Set(D(), Scalar(1)), hn::Sqrt(x.v))}; }

#if HWY_NATIVE_FMA
  HWY_ATTR static HWY_INLINE V fma(V a, V b, V c) {
    return {hn::MulAdd(a.v, b.v, c.v)};
  }
  HWY_ATTR static HWY_INLINE V fms(V a, V b, V c) {
    return {hn::MulSub(a.v, b.v, c.v)};
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
#endif

  /// See ScalarNumber. Four numbers of four lanes at a time are transposed within the 128-bit blocks, and
  /// each block goes out by itself: of all ways tried the one with the fewest shuffles.
  HWY_ATTR static void scatter(const Scalar* soa, int count, Scalar* aos, std::ptrdiff_t lane_stride) {
    int k = 0;
    if constexpr (sizeof(Scalar) == 4) {
      const D d;
      const hn::RepartitionToWide<D> wide;
      for (; k + 4 <= count; k += 4, soa += 4 * lanes, aos += 4) {
        const auto a = hn::Load(d, soa), b = hn::Load(d, soa + lanes);
        const auto c = hn::Load(d, soa + 2 * lanes), e = hn::Load(d, soa + 3 * lanes);
        const auto ab0 = hn::BitCast(wide, hn::InterleaveLower(d, a, b));
        const auto ab1 = hn::BitCast(wide, hn::InterleaveUpper(d, a, b));
        const auto ce0 = hn::BitCast(wide, hn::InterleaveLower(d, c, e));
        const auto ce1 = hn::BitCast(wide, hn::InterleaveUpper(d, c, e));
        store_blocks(hn::BitCast(d, hn::InterleaveLower(wide, ab0, ce0)), aos, lane_stride);
        store_blocks(hn::BitCast(d, hn::InterleaveUpper(wide, ab0, ce0)), aos + lane_stride, lane_stride);
        store_blocks(hn::BitCast(d, hn::InterleaveLower(wide, ab1, ce1)), aos + 2 * lane_stride, lane_stride);
        store_blocks(hn::BitCast(d, hn::InterleaveUpper(wide, ab1, ce1)), aos + 3 * lane_stride, lane_stride);
      }
    }
    for (; k < count; ++k, soa += lanes, ++aos) {
      for (int lane = 0; lane < lanes; ++lane) aos[lane * lane_stride] = soa[lane];
    }
  }

 private:
  // Block b of v to p + 4 b lane_stride.
  HWY_ATTR static HWY_INLINE void store_blocks(hn::Vec<D> v, Scalar* p, std::ptrdiff_t lane_stride) {
    if constexpr (lanes == 4) {
      hn::StoreU(v, D(), p);
    } else if constexpr (lanes > 4) {
      const hn::Half<D> half;
      LaneNumber<hn::Half<D>>::store_blocks(hn::LowerHalf(half, v), p, lane_stride);
      LaneNumber<hn::Half<D>>::store_blocks(hn::UpperHalf(half, v), p + lanes / 2 * lane_stride, lane_stride);
    }
  }
  template <class>
  friend struct LaneNumber;
};
