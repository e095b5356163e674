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

  /// See ScalarNumber. What limits this is the number of stores, then the shuffles that only one port can do.
  static constexpr int kBlock = lanes == 16 ? 8 : 4;
  HWY_ATTR static HWY_INLINE void scatter(const Scalar* soa, int count, Scalar* aos,
                                          std::ptrdiff_t lane_stride) {
    static_assert(sizeof(Scalar) == 4);
    int k = 0;
    for (; k + lanes <= count; k += lanes, soa += lanes * lanes, aos += lanes) square(soa, aos, lane_stride);
    for (; k + 4 <= count; k += 4, soa += 4 * lanes, aos += 4) four(soa, aos, lane_stride);
    for (; k < count; ++k, soa += lanes, ++aos) {
      for (int lane = 0; lane < lanes; ++lane) aos[lane * lane_stride] = soa[lane];
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

  // As many numbers as lanes: the blocks are put in place as they are loaded, so that each store fills a
  // vector.
  HWY_ATTR static HWY_INLINE void square(const Scalar* soa, Scalar* aos, std::ptrdiff_t lane_stride) {
    for (int block = 0; block < lanes / 4; ++block) {
      hn::Vec<D> v[4];
      for (int r = 0; r < 4; ++r) v[r] = load_blocks(soa + 4 * block + r * lanes);
      transpose_blocks(v);
      for (int r = 0; r < 4; ++r) hn::StoreU(v[r], D(), aos + (4 * block + r) * lane_stride);
    }
  }

  // The 128-bit blocks at p, p + 4 lanes, p + 8 lanes ...
  HWY_ATTR static HWY_INLINE hn::Vec<D> load_blocks(const Scalar* p) {
    const D d;
#if HWY_TARGET == HWY_AVX3
    if constexpr (lanes == 16) {
      __m512 v = _mm512_castps128_ps512(_mm_load_ps(p));
      v = _mm512_insertf32x4(v, _mm_load_ps(p + 4 * lanes), 1);
      v = _mm512_insertf32x4(v, _mm_load_ps(p + 8 * lanes), 2);
      return hn::Vec<D>{_mm512_insertf32x4(v, _mm_load_ps(p + 12 * lanes), 3)};
    }
#endif
    if constexpr (lanes == 8) {
      const hn::Half<D> half;
      return hn::Combine(d, hn::Load(half, p + 4 * lanes), hn::Load(half, p));
    } else {
      return hn::Load(d, p);
    }
  }

  // The last few numbers.
  HWY_ATTR static HWY_INLINE void four(const Scalar* soa, Scalar* aos, std::ptrdiff_t lane_stride) {
    const D d;
    hn::Vec<D> v[4];
    for (int r = 0; r < 4; ++r) v[r] = hn::Load(d, soa + r * lanes);
    transpose_blocks(v);
    const hn::CappedTag<Scalar, 4> quarter;
    for (int r = 0; r < 4; ++r) {
      alignas(64) Scalar lane[lanes];
      hn::Store(v[r], d, lane);
      for (int block = 0; block < lanes / 4; ++block)
        hn::StoreU(hn::Load(quarter, lane + 4 * block), quarter, aos + (4 * block + r) * lane_stride);
    }
  }
};
