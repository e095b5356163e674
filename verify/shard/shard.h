// SPDX-License-Identifier: MIT
// A part of work that is done in many processes or on many machines.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace limitcheck::verify {

/// Of units of work that are numbered from 0 on every `count`-th, from unit `index` on.
struct Shard {
  std::uint64_t index = 0, count = 1;

  bool has(std::uint64_t unit) const { return unit % count == index; }
  bool is_whole() const { return count == 1; }
  /// "3/8": the third of eight.
  std::string text() const { return std::to_string(index + 1) + "/" + std::to_string(count); }

  friend bool operator==(const Shard&, const Shard&) = default;
};

/// Throws data::ArgumentError for anything but "K/N" with 1 <= K <= N.
Shard parse_shard(const std::string& text);

/// Throws data::ArgumentError unless these are all shards of one whole, each once.
void require_all(const std::vector<Shard>& shards);

}  // namespace limitcheck::verify
