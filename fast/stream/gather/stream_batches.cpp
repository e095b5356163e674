// SPDX-License-Identifier: MIT
#include "fast/stream/gather/stream_batches.h"

#include <algorithm>

namespace limitcheck::fast::row_stream {

namespace {

Delivery delivery_of(const Patch& patch, bool placed) {
  if (placed && patch.full()) return Delivery::kPlaced;
  const Half &first = patch.half[0], &second = patch.half[1];
  if (!first.uses_window() && !second.uses_window()) return Delivery::kNothing;
  if (first.display == Display::kStitch || second.display == Display::kStitch) return Delivery::kWhole;
  return first.uses_window() ? Delivery::kRowsFromC : Delivery::kRowsFromA;
}

}  // namespace

void StreamBatches::make(std::span<const Patch> patches, std::size_t lanes, std::size_t narrow, bool placed) {
  for (auto& list : sorted_) list.clear();
  batches_.clear();
  for (std::size_t i = 0; i < patches.size(); ++i)
    sorted_[static_cast<std::size_t>(delivery_of(patches[i], placed)) +
            kDeliveries * static_cast<std::size_t>(patches[i].depth)]
        .push_back(i);
  // What does not fill the lanes goes with the rows, which would leave lanes empty, too.
  for (std::size_t depth = 0; depth <= kMaxDepth && placed; ++depth) {
    auto& pairs = sorted_[kDeliveries * depth + static_cast<std::size_t>(Delivery::kPlaced)];
    auto& rows = sorted_[kDeliveries * depth + static_cast<std::size_t>(Delivery::kRowsFromC)];
    const std::size_t full = pairs.size() / lanes * lanes;
    rows.insert(rows.end(), pairs.begin() + static_cast<std::ptrdiff_t>(full), pairs.end());
    pairs.resize(full);
  }
  for (std::size_t k = 0; k < sorted_.size(); ++k) {
    const auto delivery = static_cast<Delivery>(k % kDeliveries);
    const std::size_t most = delivery == Delivery::kWhole ? narrow : lanes;
    const std::span<const std::size_t> list(sorted_[k]);
    for (std::size_t first = 0; first < list.size(); first += most)
      batches_.push_back({delivery, static_cast<int>(k / kDeliveries),
                          list.subspan(first, std::min(most, list.size() - first))});
  }
}

}  // namespace limitcheck::fast::row_stream
