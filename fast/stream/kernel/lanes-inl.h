// SPDX-License-Identifier: MIT
// Highway vectors as a number type of the kernel; and limit points of sixteen lanes to memory, a cache line at a
// time, straight from the registers of the transposes.

#if defined(LIMITCHECK_FAST_STREAM_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)  // per target
#ifdef LIMITCHECK_FAST_STREAM_LANES_INL_H_
#undef LIMITCHECK_FAST_STREAM_LANES_INL_H_
#else
#define LIMITCHECK_FAST_STREAM_LANES_INL_H_
#endif

#include <hwy/highway.h>

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "fast/frame/stores.h"
#include "fast/stream/kernel/number.h"
#include "fast/stream/kernel/vertex-inl.h"

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
  static constexpr bool kInRegisters = HWY_NATIVE_FMA != 0;
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
  template <class Vertex, class Place>
  HWY_ATTR static HWY_INLINE void scatter_couple(const Vertex& a, const Vertex& b, const Place& to) {
    hn::Vec<D> v[3][4] = {{a.position[0].v, a.position[1].v, a.position[2].v, a.normal[0].v},
                          {a.normal[1].v, a.normal[2].v, b.position[0].v, b.position[1].v},
                          {b.position[2].v, b.normal[0].v, b.normal[1].v, b.normal[2].v}};
    for (int t = 0; t < 3; ++t) transpose_blocks(v[t]);
    for (int r = 0; r < 4; ++r) {
      const hn::Vec<D> lanes_r[3] = {v[0][r], v[1][r], v[2][r]};
      store_blocks<0>(lanes_r, to, r);
    }
  }
  template <class Vertex, class Place>
  HWY_ATTR static HWY_INLINE void scatter_vertex(const Vertex& a, const Place& to) {
    hn::Vec<D> v[2][4] = {{a.position[0].v, a.position[1].v, a.position[2].v, a.normal[0].v},
                          {a.normal[1].v, a.normal[2].v, a.normal[1].v, a.normal[2].v}};
    for (int t = 0; t < 2; ++t) transpose_blocks(v[t]);
    for (int r = 0; r < 4; ++r) store_one<0>(v[0][r], v[1][r], to, r);
  }
  template <class Place>
  HWY_ATTR static HWY_INLINE void expect([[maybe_unused]] const Place& to) {
    if constexpr (lanes == 16) {
      for (int lane = 0; lane < lanes; ++lane) __builtin_prefetch(to(lane % 4, lane / 4), 1, 3);
    }
  }

  /// Four vectors transposed within their 128-bit blocks.
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

 private:
  // Block b of three vectors to the twelve numbers of lane 4 b + r.
  template <int b, class Place>
  HWY_ATTR static HWY_INLINE void store_blocks(const hn::Vec<D> (&v)[3], const Place& to, int r) {
    if constexpr (4 * b < lanes) {
      const hn::CappedTag<Scalar, 4> quarter;
      Scalar* const at = to(r, b);
      for (int t = 0; t < 3; ++t) hn::StoreU(block<b>(v[t]), quarter, at + 4 * t);
      store_blocks<b + 1>(v, to, r);
    }
  }

  // Block b of the first and the first half of block b of the second.
  template <int b, class Place>
  HWY_ATTR static HWY_INLINE void store_one(hn::Vec<D> v, hn::Vec<D> half, const Place& to, int r) {
    if constexpr (4 * b < lanes) {
      const hn::CappedTag<Scalar, 4> quarter;
      const hn::Half<decltype(quarter)> two;
      Scalar* const at = to(r, b);
      hn::StoreU(block<b>(v), quarter, at);
      hn::StoreU(hn::LowerHalf(two, block<b>(half)), two, at + 4);
      store_one<b + 1>(v, half, to, r);
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

#if HWY_TARGET == HWY_AVX3

/// Sixteen runs of vertices, one for each lane, that arrive a vertex of each at a time. Sixteen numbers of a
/// run, 2 2/3 vertices, are one line: they leave as soon as they are there, so that the processor's few line
/// buffers empty while the next are computed. A run may begin anywhere: what it has before the end of a line
/// is kept until the next numbers complete it, and its first and last line, which it may share with others,
/// are written by ordinary stores, its own bytes alone.
///
/// 5.3 KB of the caller's stack; no workspace beyond the kernel's.
template <class N>
class LineRuns {
 public:
  static constexpr int L = 16;

  /// lane[0 .. 15]: where the runs begin, aligned to 4 bytes. Several may be the same if their vertices are.
  HWY_ATTR LineRuns(float* const* lane, Stores stores) : stores_(stores) {
    const __m512i numbers = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    for (int k = 0; k < L; ++k) {
      before_[k] = static_cast<int>(reinterpret_cast<std::uintptr_t>(lane[k]) % 64 / 4);
      line_[k] = lane[k] - before_[k];
      _mm512_store_si512(index_[k], _mm512_add_epi32(numbers, _mm512_set1_epi32(L - before_[k])));
      _mm512_store_ps(kept_[k], _mm512_setzero_ps());
    }
  }

  HWY_ATTR HWY_INLINE void add(const Vertex<N>& v) {
    v.store(numbers_ + 6 * L * vertices_);
    ++vertices_;
    if (6 * vertices_ < 16 * (lines_ + 1)) return;
    write_line(numbers_ + 16 * L * lines_);
    ++lines_;
    if (vertices_ == kVertices) vertices_ = lines_ = 0;
  }

  /// After the last vertex.
  HWY_ATTR void finish() {
    const int first = 16 * lines_, end = 6 * vertices_;
    for (int k = 0; k < L; ++k) {
      float* to = line_[k] + written_;
      for (int i = 0; i < before_[k] && written_ > 0; ++i) to[i] = kept_[k][L - before_[k] + i];
      for (int i = first; i < end; ++i) to[before_[k] + i - first] = numbers_[L * i + k];
    }
  }

 private:
  static constexpr int kVertices = 8;  // three lines
  using Sixteen = hn::Vec<hn::CappedTag<float, L>>;

  // 16 numbers of each lane, 16 lanes side by side.
  HWY_ATTR HWY_INLINE void write_line(const float* numbers) {
    for (int half = 0; half < L; half += 8) {
      Sixteen low[4], high[4];  // of numbers 0..7 and 8..15: blocks of four numbers of lanes r and 4 + r
      for (int r = 0; r < 4; ++r) {
        low[r].raw = two_halves(numbers + L * r + half);
        high[r].raw = two_halves(numbers + L * (8 + r) + half);
      }
      N::transpose_blocks(low);
      N::transpose_blocks(high);
      for (int r = 0; r < 4; ++r) {
        put(half + r, _mm512_shuffle_f32x4(low[r].raw, high[r].raw, 0x88));
        put(half + 4 + r, _mm512_shuffle_f32x4(low[r].raw, high[r].raw, 0xdd));
      }
    }
    written_ += 16;
  }
  // Eight lanes of a number and of the fourth after it: from memory, which takes no shuffle.
  HWY_ATTR static HWY_INLINE __m512 two_halves(const float* at) {
    return _mm512_insertf32x8(_mm512_castps256_ps512(_mm256_load_ps(at)), _mm256_load_ps(at + 4 * L), 1);
  }

  // The line that the last numbers of a lane and these complete.
  HWY_ATTR HWY_INLINE void put(int lane, __m512 now) {
    const __m512 line =
        _mm512_permutex2var_ps(_mm512_load_ps(kept_[lane]), _mm512_load_si512(index_[lane]), now);
    _mm512_store_ps(kept_[lane], now);
    float* const to = line_[lane] + written_;
    if (written_ == 0) {
      _mm512_mask_storeu_ps(to, static_cast<__mmask16>(0xffffu << before_[lane]), line);
    } else if (stores_ == Stores::kPastCaches) {
      _mm512_stream_ps(to, line);
    } else {
      _mm512_store_ps(to, line);
    }
  }

  alignas(64) float numbers_[6 * kVertices * L];  // of the vertices that wait, as vectors of lanes
  alignas(64) float kept_[L][16];                 // the last sixteen numbers of each run that left
  alignas(64) std::int32_t index_[L][16];         // which of them, and of the next, make a line
  Stores stores_;
  float* line_[L];                // the line in which each run begins,
  int before_[L];                 // and so many numbers of it before
  int vertices_ = 0, lines_ = 0;  // that wait; of them the lines that have left
  std::ptrdiff_t written_ = 0;    // numbers of each run that have left
};

/// The rows of a batch, one after the other, as a kernel wants them.
template <class N>
struct LineRow {
  LineRuns<N>* runs;
  HWY_ATTR HWY_INLINE void couple(int /*i*/, const Vertex<N>& a, const Vertex<N>& b) const {
    runs->add(a);
    runs->add(b);
  }
  HWY_ATTR HWY_INLINE void vertex(int /*i*/, const Vertex<N>& a) const { runs->add(a); }
  HWY_ATTR HWY_INLINE void expect(int /*i*/) const {}
};
template <class N>
struct LineTarget {
  using Row = LineRow<N>;
  LineRuns<N>* runs;
  HWY_ATTR HWY_INLINE Row row(int /*j*/) const { return {runs}; }
  HWY_ATTR HWY_INLINE void done(int /*j*/) const {}
};

#endif  // AVX-512

/// add.operator()<lanes>() for each number of lanes that this target has variants of, the most first.
template <class Add>
void for_each_lane_count(Add&& add) {
#if HWY_TARGET == HWY_AVX3
  add.template operator()<16>();
#elif HWY_TARGET == HWY_AVX2
  add.template operator()<8>();
#endif
  add.template operator()<4>();
}

}  // namespace limitcheck::fast::row_stream::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif

#if HWY_ONCE
namespace limitcheck::fast::row_stream {

/// ask() once for each target that this machine can run: Highway's own choice first, which is the best.
template <class Ask>
void ask_every_target(Ask&& ask) {
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    ask();
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace limitcheck::fast::row_stream
#endif  // HWY_ONCE

#endif  // per target
