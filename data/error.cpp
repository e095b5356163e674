// SPDX-License-Identifier: MIT
#include "data/error.h"

#include <fmt/core.h>

#include <utility>

namespace limitcheck::data {
namespace {

std::string one_line(const std::string& code, const std::string& file, std::int64_t line,
                     const std::string& message) {
  if (file.empty()) return fmt::format("{}: {}", code, message);
  if (line <= 0) return fmt::format("{}: {}: {}", file, code, message);
  return fmt::format("{}:{}: {}: {}", file, line, code, message);
}

}  // namespace

InputError::InputError(std::string code, std::string file, std::int64_t line, const std::string& message)
    : Error(one_line(code, file, line, message)),
      code_(std::move(code)),
      file_(std::move(file)),
      line_(line) {}

}  // namespace limitcheck::data
