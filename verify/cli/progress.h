// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdio>
#include <string>

namespace limitcheck::cli {

/// One line on standard error that says what is being done now, rewritten in place; nothing at all if
/// standard error is no terminal. Not thread-safe.
class Progress {
 public:
  Progress();
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Shows `text` behind a bar of done / total; at most ten times a second, so call it as often as you like.
  void show(std::size_t done, std::size_t total, const std::string& text);
  /// Wipes the line.
  void clear();
  /// Where the line goes from now on; standard error at first.
  void to(std::FILE* stream) { stream_ = stream; }

 private:
  bool terminal_;
  std::FILE* stream_ = stderr;
  bool shown_ = false;
  std::chrono::steady_clock::time_point last_{};
};

/// A progress display elsewhere than on standard error, until it ends.
class ProgressTo {
 public:
  /// nullptr: where it was.
  ProgressTo(Progress& progress, std::FILE* stream) : progress_(progress) {
    if (stream != nullptr) progress_.to(stream);
  }
  ~ProgressTo() { end(); }
  ProgressTo(const ProgressTo&) = delete;
  ProgressTo& operator=(const ProgressTo&) = delete;
  void end() const {
    progress_.clear();
    progress_.to(stderr);
  }

 private:
  Progress& progress_;
};

}  // namespace limitcheck::cli
