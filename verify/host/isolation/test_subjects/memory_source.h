// SPDX-License-Identifier: MIT
// Answers from memory: for tests and the fuzzer.
#pragma once

#include <cstring>
#include <string>
#include <string_view>

#include "verify/host/isolation/protocol.h"

namespace limitcheck::verify::protocol {

class MemorySource final : public Source {
 public:
  /// `bytes` outlives this.
  explicit MemorySource(std::string_view bytes) : left_(bytes) {}
  void read(std::span<std::byte> to) override {
    if (left_.size() < to.size()) throw Error("ends too early");
    if (!to.empty()) std::memcpy(to.data(), left_.data(), to.size());
    left_.remove_prefix(to.size());
  }
  std::string line(std::size_t longest) override {
    const std::size_t end = left_.find('\n');
    if (end == std::string_view::npos || end > longest) throw Error("no line end");
    std::string result(left_.substr(0, end));
    left_.remove_prefix(end + 1);
    return result;
  }

 private:
  std::string_view left_;
};

}  // namespace limitcheck::verify::protocol
