// SPDX-License-Identifier: MIT
// The results of an audit so far, on the disk before the next mesh begins: whatever ends the program, the
// audit can be resumed.
#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "verify/audit/result.h"

namespace limitcheck::verify {

/// A file of JSON lines. The first line says what is audited; each other line holds the rows of one subject
/// in one case (a mesh at its depths): {"subject", "case", "rows"}. A line is written whole and flushed.
/// Cases count from 0 in the order of the audit. If the file cannot be written, the audit goes on without it.
class Journal {
 public:
  /// Begins a new file. With `resume`, reads the lines of an existing file and appends to them; an incomplete
  /// last line is dropped. Throws data::ArgumentError: with `resume`, there is no such file, or it is of
  /// another audit than `what` (a JSON text on one line).
  Journal(std::filesystem::path file, const std::string& what, bool resume);

  /// The rows of this subject in this case, if the file has them.
  std::optional<std::vector<Result>> recall(const std::string& subject, std::size_t number) const;
  void keep(const std::string& subject, std::size_t number, const std::vector<Result>& results);
  /// Deletes the file.
  void remove();

 private:
  std::filesystem::path file_;
  std::ofstream out_;
  std::map<std::pair<std::string, std::size_t>, std::vector<Result>> known_;
};

}  // namespace limitcheck::verify
