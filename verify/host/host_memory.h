// SPDX-License-Identifier: MIT
// The memory behind lc_request::allocate: filled with 0xFF, between guard zones, and these between pages
// without access.
//
//   | no access | guard zone | block | guard zone | no access |
//
// The zones hold a pattern that no subject can foresee: what is written there is seen afterwards. They are at
// least kGuard bytes long; what goes beyond, up to kNoAccess, ends the process on the spot. So a subject that
// may write anywhere belongs in a process of its own, where note_overruns() says which block it was.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "verify/subject/written_outside.h"

namespace limitcheck::verify::detail {

class Memory {
 public:
  static constexpr std::size_t kAlignment = 64;
  static constexpr std::size_t kGuard = kLeastGuardZone;
  static constexpr std::size_t kNoAccess = 256 << 10;  // bytes beyond each zone
  static constexpr std::size_t kMostBlocks = 1 << 14;  // what the kernel tells apart is limited
  /// Allocations beyond this sum are refused (NULL): a wild count must not exhaust the machine.
  static constexpr std::size_t kLimit = std::size_t{16} << 30;

  struct Block {
    std::byte* data = nullptr;
    std::size_t size = 0;
    std::size_t before = 0, behind = 0;  // bytes of the guard zones: they depend on the size alone
  };

  Memory();
  ~Memory();
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;

  /// A block of this size, in no Memory.
  static Block block_of(std::size_t size);

  /// The callback of lc_request: `host` is the Memory. Never throws.
  static void* allocate(void* host, std::size_t bytes) noexcept;

  /// The block that holds `pointer`, or nullptr. A pointer
  /// to the end of a block belongs to it (an empty array).
  const Block* find(const void* pointer) const;
  const std::vector<Block>& blocks() const { return blocks_; }

  /// Bytes between the block and the farthest guard byte that was changed; 0 if none was.
  std::int64_t written_before(const Block& block) const;
  std::int64_t written_behind(const Block& block) const;

  /// Has the process say on standard error, before SIGSEGV or SIGBUS ends it as ever, that a subject wrote or
  /// read beyond a guard zone of the Memory made last, and how far.
  static void note_overruns();

 private:
  std::byte pattern(const std::byte* place) const;

  std::vector<Block> blocks_;
  std::size_t total_ = 0;
  std::uint64_t secret_;
};

}  // namespace limitcheck::verify::detail
