// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace limitcheck::bench {

/// 8-bit RGB, top row first.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
};

/// Throws std::runtime_error with the file's name; a file that was there before stays as it was then.
void write_png(const std::filesystem::path& path, const Image& image);

/// Side by side, `gap` white columns between them. All of one height.
Image beside(const std::vector<Image>& images, int gap = 16);

}  // namespace limitcheck::bench
