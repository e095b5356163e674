// SPDX-License-Identifier: MIT
#include "verify/host/host_memory.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/random.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstring>
#include <functional>
#include <new>

namespace limitcheck::verify::detail {
namespace {

std::size_t up(std::size_t bytes, std::size_t unit) {
  return (bytes + unit - 1) / unit * unit;
}

std::size_t page() {
  static const auto size = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  return size;
}

// The size of the mapping for a block, its zones included.
std::size_t mapped(const Memory::Block& b) {
  return b.before + b.size + b.behind + 2 * Memory::kNoAccess;
}

std::atomic<const Memory*> latest{nullptr};

// The process is about to die: nothing but async-signal-safe calls, and the heap may be broken.
extern "C" void tell_overrun(int signal, siginfo_t* info, void*) {
  const Memory* memory = latest.load();
  const auto* const place = static_cast<const std::byte*>(info->si_addr);
  if (memory != nullptr && info->si_code > 0) {
    for (const Memory::Block& b : memory->blocks()) {
      const std::byte* const end = b.data + b.size;
      const bool behind = place >= end && place < end + b.behind + Memory::kNoAccess;
      const bool before = place < b.data && place >= b.data - b.before - Memory::kNoAccess;
      if (!behind && !before) continue;
      std::array<char, 200> text{};
      const auto written = fmt::format_to_n(
          text.data(), text.size(), "limitcheck: byte {} {} block of {} bytes from allocate() was touched\n",
          behind ? place - end + 1 : b.data - place, behind ? "behind a" : "in front of a", b.size);
      (void)!write(STDERR_FILENO, text.data(), std::min(text.size(), written.size));
      break;
    }
  }
  // SA_RESETHAND has restored the default action, so the same access now ends the process. A signal that was
  // sent by kill() must be raised again.
  if (info->si_code <= 0) raise(signal);
}

}  // namespace

Memory::Memory() : secret_(0) {
  if (getrandom(&secret_, sizeof secret_, GRND_NONBLOCK) != sizeof secret_)
    secret_ = reinterpret_cast<std::uintptr_t>(this);
  latest = this;
}

Memory::~Memory() {
  const Memory* self = this;
  latest.compare_exchange_strong(self, nullptr);
  for (const Block& b : blocks_) munmap(b.data - b.before - kNoAccess, mapped(b));
}

// From 0x81 to 0xBE: numbers in use end, in memory, with a sign and an exponent near that of 1 or with zeros
// or ones, and begin with zeros often. So what is written is told from the pattern up to its last byte.
std::byte Memory::pattern(const std::byte* place) const {
  std::uint64_t x = (secret_ + reinterpret_cast<std::uintptr_t>(place)) * 0x9E3779B97F4A7C15ULL;
  x = (x ^ (x >> 32)) * 0xD6E8FEB86659FD93ULL;
  return static_cast<std::byte>(0x81 + (x >> 56) % 62);
}

Memory::Block Memory::block_of(std::size_t size) {
  // The end of the zone behind is the end of a page.
  Block block{nullptr, size, 0, up(size + kGuard, kAlignment) - size};
  block.before = up(kGuard + size + block.behind, page()) - size - block.behind;
  return block;
}

void* Memory::allocate(void* host, std::size_t bytes) noexcept {
  auto& self = *static_cast<Memory*>(host);
  if (bytes > kLimit - self.total_ || self.blocks_.size() == kMostBlocks) return nullptr;
  try {
    self.blocks_.reserve(self.blocks_.size() + 1);
  } catch (const std::bad_alloc&) {
    return nullptr;
  }
  Block block = block_of(bytes);
  const std::size_t usable = mapped(block) - 2 * kNoAccess;
  void* const all =
      mmap(nullptr, mapped(block), PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (all == MAP_FAILED) return nullptr;
  std::byte* const base = static_cast<std::byte*>(all) + kNoAccess;
  if (mprotect(base, usable, PROT_READ | PROT_WRITE) != 0) {
    munmap(all, mapped(block));
    return nullptr;
  }
  block.data = base + block.before;
  std::memset(block.data, 0xFF, bytes);
  for (std::byte* p = base; p < block.data; ++p) *p = self.pattern(p);
  for (std::byte* p = block.data + bytes; p < base + usable; ++p) *p = self.pattern(p);
  self.blocks_.push_back(block);
  self.total_ += bytes;
  return block.data;
}

const Memory::Block* Memory::find(const void* pointer) const {
  const auto* p = static_cast<const std::byte*>(pointer);
  const std::less_equal<> le;  // pointers into different objects: only std::less_equal is a total order
  for (const Block& block : blocks_) {
    if (le(block.data, p) && le(p, block.data + block.size)) return &block;
  }
  return nullptr;
}

std::int64_t Memory::written_before(const Block& block) const {
  for (std::size_t k = block.before; k > 0; --k)
    if (*(block.data - k) != pattern(block.data - k)) return static_cast<std::int64_t>(k);
  return 0;
}

std::int64_t Memory::written_behind(const Block& block) const {
  const std::byte* guard = block.data + block.size;
  for (std::size_t k = block.behind; k > 0; --k)
    if (guard[k - 1] != pattern(guard + k - 1)) return static_cast<std::int64_t>(k);
  return 0;
}

void Memory::note_overruns() {
  struct sigaction action {};
  action.sa_sigaction = tell_overrun;
  action.sa_flags = static_cast<int>(SA_SIGINFO | SA_RESETHAND);
  for (const int signal : {SIGSEGV, SIGBUS}) sigaction(signal, &action, nullptr);
}

}  // namespace limitcheck::verify::detail
