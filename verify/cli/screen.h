// SPDX-License-Identifier: MIT
// What the user sees while an audit works: a line that says what is done, and nothing of what subjects print.
#pragma once

#include <chrono>
#include <cstdio>
#include <string>

namespace limitcheck::cli {

/// Whether a file descriptor is a terminal that takes escape sequences: not one whose TERM is "dumb".
bool takes_escapes(int fd);
/// How many columns there are: those of the terminal, or what COLUMNS says; 0: any number, as in a file.
std::size_t screen_width(int fd);

/// Says on standard error what is being done now and how long it may still take: on a terminal in one line that is
/// rewritten in place, elsewhere (a pipe, a log of CI) in a line every ten seconds. Not thread-safe.
class Progress {
 public:
  /// between   two lines where standard error is no terminal
  explicit Progress(std::chrono::milliseconds between = std::chrono::seconds(10));
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Shows `text` behind done / total; on a terminal at most ten times a second, so call it as often as you like.
  void show(std::size_t done, std::size_t total, const std::string& text);
  /// Wipes the line.
  void clear();
  /// Where the line goes from now on; standard error at first.
  void to(std::FILE* stream) { stream_ = stream; }

 private:
  using Clock = std::chrono::steady_clock;

  bool terminal_;
  std::chrono::milliseconds between_;
  std::FILE* stream_ = stderr;
  bool shown_ = false;  // a line that is to be wiped
  Clock::time_point start_ = Clock::now(), last_ = start_;
};

/// While it lives, what is written to standard output and standard error goes to a file without a name. If
/// the process is killed by a fault or an assertion, the end of it is written to standard error first.
///   progress   is shown where standard error was
class SubjectOutput {
 public:
  explicit SubjectOutput(Progress* progress = nullptr);
  ~SubjectOutput() { (void)take(); }
  SubjectOutput(const SubjectOutput&) = delete;
  SubjectOutput& operator=(const SubjectOutput&) = delete;

  /// Ends it. Returns what was written: at most the first kLongest bytes.
  std::string take();
  static constexpr std::size_t kLongest = 1 << 20;

 private:
  Progress* progress_;
  int file_ = -1, out_ = -1, error_ = -1;
  std::FILE* screen_ = nullptr;  // standard error as it was
};

}  // namespace limitcheck::cli
