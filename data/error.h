// SPDX-License-Identifier: MIT
// What this project throws. Besides these only what the standard library throws by itself (std::bad_alloc),
// and std::logic_error where this project would contradict itself.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace limitcheck::data {

/// Everything that a caller may have to handle. what() is one line for the user.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A call that cannot be answered: an argument out of range, or one that asks for more than there is room
/// for.
class ArgumentError : public Error {
 public:
  using Error::Error;
};

/// A file, a mesh or a name that cannot be used. what() is one line for the user:
///   cage.obj:17: MESH_NONMANIFOLD_EDGE: edge 4–9 has 3 faces (12, 13, 40) (numbers from 1)
/// Codes are stable; those of meshes are listed in data/validate.h, those of files in data/io/read.h.
class InputError : public Error {
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
