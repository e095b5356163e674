// SPDX-License-Identifier: MIT
// The C library's allocator under its other names; its operator new calls malloc, so this sees both. Bytes
// are those asked for: what the allocator makes of them differs from version to version.
#include "bench/allocation_count.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <mutex>
#include <unordered_map>

extern "C" {
void* __libc_malloc(std::size_t);                 // NOLINT(bugprone-reserved-identifier)
void* __libc_calloc(std::size_t, std::size_t);    // NOLINT(bugprone-reserved-identifier)
void* __libc_realloc(void*, std::size_t);         // NOLINT(bugprone-reserved-identifier)
void* __libc_memalign(std::size_t, std::size_t);  // NOLINT(bugprone-reserved-identifier)
void __libc_free(void*);                          // NOLINT(bugprone-reserved-identifier)
}

namespace limitcheck::bench {

namespace {

std::atomic<bool> counting = false;
thread_local bool inside = false;  // the books allocate, too

struct Books {
  std::mutex mutex;
  std::unordered_map<void*, std::size_t> sizes;
  Allocations sum;
};

Books& books() {
  static Books all;
  return all;
}

void enter(void* block, std::size_t size) {
  if (!counting || inside || !block) return;
  inside = true;
  {
    Books& b = books();
    const std::lock_guard lock(b.mutex);
    b.sizes[block] = size;
    ++b.sum.count;
    b.sum.kept += static_cast<std::int64_t>(size);
    b.sum.peak = std::max(b.sum.peak, b.sum.kept);
  }
  inside = false;
}

void strike_out(void* block) {
  if (!counting || inside || !block) return;
  inside = true;
  {
    Books& b = books();
    const std::lock_guard lock(b.mutex);
    const auto found = b.sizes.find(block);
    if (found != b.sizes.end()) {
      b.sum.kept -= static_cast<std::int64_t>(found->second);
      b.sizes.erase(found);
    }
  }
  inside = false;
}

}  // namespace

Allocations count_allocations(const std::function<void()>& work) {
  books().sizes.clear();
  books().sum = {};
  counting = true;
  work();
  counting = false;
  return books().sum;
}

}  // namespace limitcheck::bench

extern "C" {

void* malloc(std::size_t size) noexcept {
  void* block = __libc_malloc(size);
  limitcheck::bench::enter(block, size);
  return block;
}

void* calloc(std::size_t count, std::size_t size) noexcept {
  void* block = __libc_calloc(count, size);
  limitcheck::bench::enter(block, count * size);
  return block;
}

void* realloc(void* old, std::size_t size) noexcept {
  limitcheck::bench::strike_out(old);
  void* block = __libc_realloc(old, size);
  limitcheck::bench::enter(block, size);
  return block;
}

void* memalign(std::size_t alignment, std::size_t size) noexcept {
  void* block = __libc_memalign(alignment, size);
  limitcheck::bench::enter(block, size);
  return block;
}

void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  return memalign(alignment, size);
}

int posix_memalign(void** out, std::size_t alignment, std::size_t size) noexcept {
  void* block = memalign(alignment, size);
  if (!block) return ENOMEM;
  *out = block;
  return 0;
}

void free(void* block) noexcept {
  limitcheck::bench::strike_out(block);
  __libc_free(block);
}

}  // extern "C"
