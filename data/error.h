// SPDX-License-Identifier: MIT
// What is wrong with an input, and where.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace limitcheck::data {

/// A file, a mesh or a name that cannot be used. what() is one line for the user:
///   cage.obj:17: MESH_NONMANIFOLD_EDGE: edge 4–9 has 3 faces (12, 13, 40) (numbers from 1)
/// Codes are stable; those of meshes are listed in data/validate.h, those of files in data/io/read.h.
class InputError : public std::runtime_error {
 public:
  /// `file` may be empty (no file involved); `line` counts from 1, 0 where the format has no lines.
  InputError(std::string code, std::string file, std::int64_t line, const std::string& message);

  const std::string& code() const noexcept { return code_; }
  const std::string& file() const noexcept { return file_; }
  std::int64_t line() const noexcept { return line_; }

 private:
  std::string code_;
  std::string file_;
  std::int64_t line_;
};

}  // namespace limitcheck::data
