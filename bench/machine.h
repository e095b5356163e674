// SPDX-License-Identifier: MIT
// What the machine allows and a run uses: memory that is only written, and the most that a run keeps.
#pragma once

#include <cstddef>
#include <functional>

namespace limitcheck::bench {

/// A block of memory that is only written: the least time that a route needs to deliver so many bytes.
class WriteOnly {
 public:
  explicit WriteOnly(std::size_t bytes);  // a multiple of 64
  ~WriteOnly();
  WriteOnly(const WriteOnly&) = delete;
  WriteOnly& operator=(const WriteOnly&) = delete;

  /// All of it once, with the widest vectors of this machine. streaming: past the caches.
  void run(bool streaming);
  std::size_t bytes() const { return bytes_; }

 private:
  float* memory_;
  std::size_t bytes_;
};

/// The most bytes by which the process grows while `work` runs, measured in a child process. Call it while
/// the process has one thread; `work` must start none. 0 if it cannot be measured.
double peak_memory(const std::function<void()>& work);

}  // namespace limitcheck::bench
