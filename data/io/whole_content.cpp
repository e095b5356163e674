// SPDX-License-Identifier: MIT
#include "data/io/whole_content.h"

#include <fmt/core.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>

#include "data/error.h"

namespace limitcheck::data::io {
namespace {

// The content is held in memory, and what is made of it takes up to twelve times as much.
constexpr std::uintmax_t kMostBytes = std::uintmax_t{4} << 30;

}  // namespace

std::string whole_content(const std::filesystem::path& file) {
  const auto refuse = [&](const std::string& why) {
    throw InputError("FILE_CANNOT_OPEN", file.string(), 0, why);
  };
  std::error_code ignored;
  const auto type = std::filesystem::status(file, ignored).type();
  // A pipe is welcome; a device might never end.
  if (type != std::filesystem::file_type::not_found && type != std::filesystem::file_type::regular &&
      type != std::filesystem::file_type::fifo) {
    refuse("not a file");
  }
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(file.c_str(), "rb"), &std::fclose);
  if (!stream) refuse(std::strerror(errno));
  std::string content;
  const auto size = std::filesystem::file_size(file, ignored);
  const auto too_large = [&] {
    throw InputError("FILE_TOO_LARGE", file.string(), 0,
                     fmt::format("more than {} GiB, the largest file that is read", kMostBytes >> 30));
  };
  if (!ignored && size > kMostBytes) too_large();
  if (!ignored) content.reserve(size);
  char buffer[1 << 16];
  for (std::size_t count = 0; (count = std::fread(buffer, 1, sizeof buffer, stream.get())) > 0;) {
    if (content.size() + count > kMostBytes) too_large();  // of a pipe
    content.append(buffer, count);
  }
  if (std::ferror(stream.get()) != 0) refuse(std::strerror(errno));
  return content;
}

}  // namespace limitcheck::data::io
