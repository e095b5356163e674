// SPDX-License-Identifier: MIT
// What subjects in this process print: kept off the screen.
#pragma once

#include <cstdio>
#include <string>

namespace limitcheck::cli {

/// While it lives, what is written to standard output and standard error goes to a file without a name. If
/// the process is killed by a fault or an assertion, the end of it is written to standard error first.
class SubjectOutput {
 public:
  SubjectOutput();
  ~SubjectOutput() { (void)take(); }
  SubjectOutput(const SubjectOutput&) = delete;
  SubjectOutput& operator=(const SubjectOutput&) = delete;

  /// Standard error as it was, for a progress display.
  std::FILE* screen() { return screen_; }
  /// Ends it. Returns what was written: at most the first kLongest bytes.
  std::string take();
  static constexpr std::size_t kLongest = 1 << 20;

 private:
  int file_ = -1, out_ = -1, error_ = -1;
  std::FILE* screen_ = nullptr;
};

}  // namespace limitcheck::cli
