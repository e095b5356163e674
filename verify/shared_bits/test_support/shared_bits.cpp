// SPDX-License-Identifier: MIT
#include "verify/shared_bits/test_support/shared_bits.h"

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
  auto& level = levels_.at(depth);
  if (!level) {
    level = std::make_unique<Level>(mesh_, depth);
    const auto edges = static_cast<std::int64_t>(level->lattice.edges().size());
    const auto shared = static_cast<std::int64_t>(mesh_.positions.size()) + edges * (level->lattice.n() - 1);
    Bits nothing;
    nothing.fill(kNothing);
    level->first.assign(shared, nothing);
  }
  return *level;
}

void SharedBits::add(const Place& at, const float* vertex) {
  const auto place = FaceDomain::triangle().side_of(point_of(at), at.denominator);
  if (!place) return;
  // A control vertex has the same bits at every depth: all of them go into the first table.
  Level& here = level(place->along == 0 ? 0 : std::countr_zero(at.denominator));
  const Lattice::Id id = here.lattice.id(at);

  Bits bits;
  std::memcpy(bits.data(), vertex, sizeof bits);
  Bits& first = here.first[id];
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
        fmt::format("face {} at ({}, {}) / {}, x y z and normal:", at.face, at.i, at.j, at.denominator);
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
