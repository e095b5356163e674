// SPDX-License-Identifier: MIT
// Limit points of sixteen lanes to memory, a cache line at a time, straight from the registers of the
// transposes.

#if defined(LIMITCHECK_FAST_STREAM_LINE_RUNS_INL_H_) == defined(HWY_TARGET_TOGGLE)  // per target
#ifdef LIMITCHECK_FAST_STREAM_LINE_RUNS_INL_H_
#undef LIMITCHECK_FAST_STREAM_LINE_RUNS_INL_H_
#else
#define LIMITCHECK_FAST_STREAM_LINE_RUNS_INL_H_
#endif

#include <cstddef>
#include <cstdint>

#include "fast/frame/stores.h"
#include "fast/stream/kernel/lanes-inl.h"
#include "fast/stream/kernel/rules-inl.h"

#if HWY_TARGET == HWY_AVX3

HWY_BEFORE_NAMESPACE();
namespace limitcheck::fast::row_stream::HWY_NAMESPACE {

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

  // 16 numbers of each lane, 16 lanes side by side.
  HWY_ATTR HWY_INLINE void write_line(const float* numbers) {
    for (int half = 0; half < L; half += 8) {
      __m512 low[4], high[4];  // of numbers 0..7 and 8..15: blocks of four numbers of lanes r and 4 + r
      for (int r = 0; r < 4; ++r) {
        low[r] = two_halves(numbers + L * r + half);
        high[r] = two_halves(numbers + L * (8 + r) + half);
      }
      transpose_blocks(low);
      transpose_blocks(high);
      for (int r = 0; r < 4; ++r) {
        put(half + r, _mm512_shuffle_f32x4(low[r], high[r], 0x88));
        put(half + 4 + r, _mm512_shuffle_f32x4(low[r], high[r], 0xdd));
      }
    }
    written_ += 16;
  }
  // Eight lanes of a number and of the fourth after it: from memory, which takes no shuffle.
  HWY_ATTR static HWY_INLINE __m512 two_halves(const float* at) {
    return _mm512_insertf32x8(_mm512_castps256_ps512(_mm256_load_ps(at)), _mm256_load_ps(at + 4 * L), 1);
  }
  HWY_ATTR static HWY_INLINE void transpose_blocks(__m512 (&v)[4]) {
    const __m512d ab0 = _mm512_castps_pd(_mm512_unpacklo_ps(v[0], v[1]));
    const __m512d ab1 = _mm512_castps_pd(_mm512_unpackhi_ps(v[0], v[1]));
    const __m512d cd0 = _mm512_castps_pd(_mm512_unpacklo_ps(v[2], v[3]));
    const __m512d cd1 = _mm512_castps_pd(_mm512_unpackhi_ps(v[2], v[3]));
    v[0] = _mm512_castpd_ps(_mm512_unpacklo_pd(ab0, cd0));
    v[1] = _mm512_castpd_ps(_mm512_unpackhi_pd(ab0, cd0));
    v[2] = _mm512_castpd_ps(_mm512_unpacklo_pd(ab1, cd1));
    v[3] = _mm512_castpd_ps(_mm512_unpackhi_pd(ab1, cd1));
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
  HWY_ATTR HWY_INLINE LineRow from(int /*i*/) const { return *this; }
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

}  // namespace limitcheck::fast::row_stream::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // AVX-512

#endif  // per target
