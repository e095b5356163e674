// SPDX-License-Identifier: MIT
// What an audit has found so far, on the disk before the next mesh begins: whatever ends the program, the
// audit can go on where it was.
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

/// A file of JSON lines. The first says what is audited, each other one what was found of one subject in one
/// case (a mesh at its depths): {"subject", "case", "rows"}, whole and flushed. Cases count from 0 in the
/// order of the audit. What cannot be written is not kept, and costs the audit nothing.
class Journal {
 public:
  /// Begins a new file. With `resume`, reads what there is first, and goes on behind it; what the last line
  /// lacks of being whole is given up. Throws std::invalid_argument: with `resume`, there is no such file, or
  /// it is about another audit than `what` (a JSON text on one line).
  Journal(std::filesystem::path file, const std::string& what, bool resume);

  /// What it knows of this subject in this case.
  std::optional<std::vector<Result>> recall(const std::string& subject, std::size_t number) const;
  void keep(const std::string& subject, std::size_t number, const std::vector<Result>& results);
  /// It is no longer needed.
  void remove();

 private:
  std::filesystem::path file_;
  std::ofstream out_;
  std::map<std::pair<std::string, std::size_t>, std::vector<Result>> known_;
};

}  // namespace limitcheck::verify
