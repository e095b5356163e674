// SPDX-License-Identifier: MIT
// The patches of a frame in batches of one depth for the kernel's lanes.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "fast/frame/patch.h"
#include "fast/stream/gather/batch.h"

namespace limitcheck::fast::row_stream {

/// How the points of a batch reach their writers. A draw list takes the rows of a half from its own first on,
/// which for face0 is the row at C.
enum class Delivery : std::uint8_t {
  kPlaced,     // both faces, straight to their place
  kRowsFromC,  // face0, or both faces: as the rows come
  kRowsFromA,  // face1 alone: as the rows come
  kWhole,      // stitched faces: from whole grids, one after the other
  kNothing     // fans alone: nothing for the kernel
};
inline constexpr std::size_t kDeliveries = 5;

struct Batch {
  Delivery delivery;
  int depth;
  std::span<const std::size_t> patches;
};

/// Batches of at most `lanes` patches, or `narrow` of those delivered whole. In a fixed order.
class StreamBatches {
 public:
  /// placed: patches of two displayed faces have a place each, where the rows lie as they come from C.
  void make(std::span<const Patch> patches, std::size_t lanes, std::size_t narrow, bool placed);
  const std::vector<Batch>& list() const { return batches_; }

 private:
  std::array<std::vector<std::size_t>, kDeliveries*(kMaxDepth + 1)> sorted_;
  std::vector<Batch> batches_;
};

}  // namespace limitcheck::fast::row_stream
