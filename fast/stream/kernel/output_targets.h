// SPDX-License-Identifier: MIT
// What has vector loops of its own beside the kernels: the lanes of their input; vertices in 16 bytes, many at a time;
// and memory written past the caches, for output that is larger than they are and that nobody reads soon.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "fast/stream/kernel/layout.h"

namespace limitcheck::fast::row_stream {

using fast::CompactVertex, fast::compacted, fast::kCompactNormalBound, fast::unpacked_normal;

/// out[k * lanes + lane] = from[lane][k], k < count. lanes: 4, 8 or 16; out is aligned to as many numbers. Four numbers
/// are readable from any pointer.
void float_lanes(const float* const* from, int count, int lanes, float* out);

/// `count` vertices into `out`, which holds as many: a CompactRow, with the bits of compacted() on every machine.
void compact(const Vertex* vertices, std::size_t count, CompactVertex* out);

/// `lines` times 64 bytes by non-temporal stores, see fence(). to: aligned to 64 bytes; from: to 4.
void stream_lines(const std::byte* from, std::size_t lines, std::byte* to);

/// One contiguous run of output that arrives in pieces. Whole cache lines are streamed; the piece of a line
/// at either end of the run, and nothing else, is written by ordinary stores. Pieces: multiples of 4 bytes.
class LineStream {
 public:
  static constexpr std::size_t kLine = 64;

  /// The run begins at `to`, aligned to 4 bytes.
  void start(std::byte* to) {
    const std::size_t before = reinterpret_cast<std::uintptr_t>(to) % kLine;
    line_ = to - before;
    filled_ = first_ = before;
  }

  void append(const std::byte* from, std::size_t size) {
    if (filled_ > 0) {
      const std::size_t take = size < kLine - filled_ ? size : kLine - filled_;
      std::memcpy(rest_.data() + filled_, from, take);
      filled_ += take, from += take, size -= take;
      if (filled_ < kLine) return;
      if (first_ > 0) {
        std::memcpy(line_ + first_, rest_.data() + first_, kLine - first_);
      } else {
        stream_lines(rest_.data(), 1, line_);
      }
      line_ += kLine;
      filled_ = first_ = 0;
    }
    const std::size_t lines = size / kLine;
    stream_lines(from, lines, line_);
    line_ += lines * kLine;
    filled_ = size - lines * kLine;
    std::memcpy(rest_.data(), from + lines * kLine, filled_);
  }

  void finish() {
    if (filled_ > first_) std::memcpy(line_ + first_, rest_.data() + first_, filled_ - first_);
    filled_ = first_ = 0;
  }

 private:
  alignas(64) std::array<std::byte, kLine> rest_;
  std::byte* line_ = nullptr;  // where rest_ goes
  std::size_t filled_ = 0;     // bytes of the line that are known, from first_ on
  std::size_t first_ = 0;
};

}  // namespace limitcheck::fast::row_stream
