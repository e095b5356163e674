// SPDX-License-Identifier: MIT
// What the threads of our contenders work with.
#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace limitcheck::bench {

/// A workspace for each thread that runs, kept from run to run.
template <class T>
class Pool {
 public:
  template <class Make>
  std::unique_ptr<T> take(const Make& make) {
    const std::lock_guard lock(mutex_);
    if (free_.empty()) return make();
    auto last = std::move(free_.back());
    free_.pop_back();
    return last;
  }
  void give(std::unique_ptr<T> item) {
    const std::lock_guard lock(mutex_);
    free_.push_back(std::move(item));
  }

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<T>> free_;
};

}  // namespace limitcheck::bench
