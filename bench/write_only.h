// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

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

}  // namespace limitcheck::bench
