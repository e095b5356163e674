// SPDX-License-Identifier: MIT
#include "verify/shard/shard.h"

#include <fmt/core.h>

#include <charconv>
#include <set>
#include <system_error>

#include "data/error.h"

namespace limitcheck::verify {

Shard parse_shard(const std::string& text) {
  const auto refuse = [&] {
    throw data::ArgumentError(fmt::format("--shard {}: K/N with 1 <= K <= N, for example 3/8", text));
  };
  Shard shard;
  const char* const end = text.data() + text.size();
  std::uint64_t k = 0;
  auto [at, error] = std::from_chars(text.data(), end, k);
  if (error != std::errc() || at == end || *at != '/') refuse();
  const auto count = std::from_chars(at + 1, end, shard.count);
  if (count.ec != std::errc() || count.ptr != end || k < 1 || k > shard.count || shard.count > 1'000'000)
    refuse();
  shard.index = k - 1;
  return shard;
}

void require_all(const std::vector<Shard>& shards) {
  if (shards.empty()) throw data::ArgumentError("there is nothing to merge");
  const std::uint64_t count = shards.front().count;
  std::set<std::uint64_t> there;
  for (const Shard& s : shards) {
    if (s.count != count)
      throw data::ArgumentError(fmt::format("shard {} is not of {} shards", s.text(), count));
    if (!there.insert(s.index).second)
      throw data::ArgumentError(fmt::format("shard {} is there twice", s.text()));
  }
  for (std::uint64_t k = 0; k < count; ++k)
    if (!there.contains(k))
      throw data::ArgumentError(fmt::format("shard {} is missing", Shard{k, count}.text()));
}

}  // namespace limitcheck::verify
