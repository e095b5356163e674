// SPDX-License-Identifier: MIT
// The memory behind lc_request::allocate: filled with 0xFF, with guard zones on both sides.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace limitcheck::verify::detail {

class Memory {
 public:
  static constexpr std::size_t kAlignment = 64;
  static constexpr std::size_t kGuard = 1024;  // bytes on each side; writes beyond it are not seen
  /// Refuses (NULL) what would take the sum over this many
  /// bytes: a count gone wild must not take the machine down.
  static constexpr std::size_t kLimit = std::size_t{16} << 30;

  struct Block {
    std::byte* data;
    std::size_t size;
  };

  /// The callback of lc_request: `host` is the Memory. Never throws.
  static void* allocate(void* host, std::size_t bytes) noexcept;

  /// The block that holds `pointer`, or nullptr. A pointer
  /// to the end of a block belongs to it (an empty array).
  const Block* find(const void* pointer) const;
  const std::vector<Block>& blocks() const { return blocks_; }

  /// Bytes between the block and the farthest guard byte that was changed; 0 if none was.
  static std::int64_t written_before(const Block& block);
  static std::int64_t written_behind(const Block& block);

 private:
  struct Free {
    void operator()(std::byte* p) const;
  };
  std::vector<std::unique_ptr<std::byte, Free>> owned_;
  std::vector<Block> blocks_;
  std::size_t total_ = 0;
};

}  // namespace limitcheck::verify::detail
