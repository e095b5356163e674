// SPDX-License-Identifier: MIT
#include "verify/shared_bits/shared_bits.h"

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cstring>

namespace limitcheck::verify {

namespace {

// What no evaluation yields: a NaN with this payload.
constexpr std::uint32_t kNothing = 0xffffffffu;

}  // namespace

SharedBits::SharedBits(const data::ControlMesh& mesh, int deepest)
    : mesh_(mesh), levels_(static_cast<std::size_t>(deepest) + 1) {}

SharedBits::Level& SharedBits::level(int depth) {
  auto& level = levels_.at(static_cast<std::size_t>(depth));
  if (!level) {
    level = std::make_unique<Level>(mesh_, depth);
    const auto edges = static_cast<std::int64_t>(level->lattice.edges().size());
    const auto shared = static_cast<std::int64_t>(mesh_.positions.size()) + edges * (level->lattice.n() - 1);
    Bits nothing;
    nothing.fill(kNothing);
    level->first.assign(static_cast<std::size_t>(shared), nothing);
  }
  return *level;
}

void SharedBits::add(int depth, std::int32_t face, const std::array<int, 3>& at, const float* vertex) {
  // A control vertex has the same bits at every depth: all of them go into the first table.
  const bool corner = std::max({at[0], at[1], at[2]}) == 1 << depth;
  if (!corner && at[0] != 0 && at[1] != 0 && at[2] != 0) return;
  Level& here = level(corner ? 0 : depth);
  const int shift = corner ? depth : 0;
  const lc_provenance place{face, static_cast<std::uint32_t>(at[1] >> shift),
                            static_cast<std::uint32_t>(at[2] >> shift),
                            static_cast<std::uint32_t>(here.lattice.n())};
  const Lattice::Id id = here.lattice.id(place);

  Bits bits;
  std::memcpy(bits.data(), vertex, sizeof bits);
  Bits& first = here.first[static_cast<std::size_t>(id)];
  if (first[0] == kNothing) {
    first = bits;
    ++points_;
    return;
  }
  ++compared_;
  if (first == bits) return;
  ++different_;
  for (std::size_t k = 0; k < 6; ++k) different_bits_ += std::popcount(first[k] ^ bits[k]);
  if (witness_.empty()) {
    witness_ =
        fmt::format("face {} at {}, {}, {} of {}, x y z and normal:", face, at[0], at[1], at[2], 1 << depth);
    for (std::size_t k = 0; k < 6; ++k)
      witness_ += fmt::format(" {}/{}", std::bit_cast<float>(first[k]), std::bit_cast<float>(bits[k]));
  }
}

std::uint64_t SharedBits::hash() const {
  std::uint64_t value = 0xcbf29ce484222325u;
  for (const auto& level : levels_) {
    if (!level) continue;
    for (const Bits& bits : level->first) {
      for (const std::uint32_t word : bits) value = (value ^ word) * 0x100000001b3u;
    }
  }
  return value;
}

}  // namespace limitcheck::verify
