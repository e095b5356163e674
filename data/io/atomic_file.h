// SPDX-License-Identifier: MIT
// A file that appears whole or not at all.
#pragma once

#include <filesystem>
#include <fstream>
#include <ostream>
#include <vector>

namespace limitcheck::data {

/// Written under `FILE.partial-PID` beside the final name and renamed by commit(). Without commit() the
/// temporary is removed: by the destructor, or, if the process is ended by SIGINT, SIGTERM or SIGHUP, by a
/// signal handler that then lets the signal take its course. Only SIGKILL and power failures leave it behind,
/// never a half-written FILE. What exists and is not a regular file (a pipe, /dev/stdout) is written to
/// directly. One such file at a time per process; not thread-safe.
class AtomicFile {
 public:
  /// Throws InputError FILE_CANNOT_WRITE with the system's reason.
  explicit AtomicFile(std::filesystem::path file);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  std::ostream& stream() { return stream_; }
  /// Throws InputError FILE_CANNOT_WRITE: the disk is full, the name is taken by a directory ...
  void commit();

 private:
  [[noreturn]] void refuse();

  std::filesystem::path file_, temporary_;  // temporary_ empty: written to directly
  std::vector<char> buffer_;
  std::ofstream stream_;
};

}  // namespace limitcheck::data
