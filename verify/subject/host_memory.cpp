// SPDX-License-Identifier: MIT
#include "verify/subject/host_memory.h"

#include <cstring>
#include <functional>
#include <new>

namespace limitcheck::verify::detail {
namespace {

constexpr std::byte kGuardByte{0xA5};

}  // namespace

void Memory::Free::operator()(std::byte* p) const {
  ::operator delete (p, std::align_val_t{kAlignment});
}

void* Memory::allocate(void* host, std::size_t bytes) noexcept {
  auto& self = *static_cast<Memory*>(host);
  if (bytes > kLimit - self.total_) return nullptr;
  try {
    self.owned_.reserve(self.owned_.size() + 1);
    self.blocks_.reserve(self.blocks_.size() + 1);
    auto* base = static_cast<std::byte*>(::operator new (bytes + 2 * kGuard, std::align_val_t{kAlignment}));
    self.owned_.emplace_back(base);
    std::memset(base, static_cast<int>(kGuardByte), kGuard);
    std::memset(base + kGuard, 0xFF, bytes);
    std::memset(base + kGuard + bytes, static_cast<int>(kGuardByte), kGuard);
    self.blocks_.push_back({base + kGuard, bytes});
    self.total_ += bytes;
    return base + kGuard;
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
}

const Memory::Block* Memory::find(const void* pointer) const {
  const auto* p = static_cast<const std::byte*>(pointer);
  const std::less_equal<> le;  // pointers into different objects: only std::less_equal is a total order
  for (const Block& block : blocks_) {
    if (le(block.data, p) && le(p, block.data + block.size)) return &block;
  }
  return nullptr;
}

std::int64_t Memory::written_before(const Block& block) {
  const std::byte* guard = block.data - kGuard;
  for (std::size_t i = 0; i < kGuard; ++i) {
    if (guard[i] != kGuardByte) return static_cast<std::int64_t>(kGuard - i);
  }
  return 0;
}

std::int64_t Memory::written_behind(const Block& block) {
  const std::byte* guard = block.data + block.size;
  for (std::size_t i = kGuard; i > 0; --i) {
    if (guard[i - 1] != kGuardByte) return static_cast<std::int64_t>(i);
  }
  return 0;
}

}  // namespace limitcheck::verify::detail
