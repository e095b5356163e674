// SPDX-License-Identifier: MIT
#include "bench/render/image.h"

#include <fmt/core.h>
#include <png.h>

#include <algorithm>
#include <stdexcept>

#include "data/error.h"
#include "verify/mesh_output/atomic_file.h"

namespace limitcheck::bench {

void write_png(const std::filesystem::path& path, const Image& image) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = 0;
  std::vector<char> bytes;
  const auto encode = [&](void* memory) {
    if (png_image_write_to_memory(&png, memory, &size, 0, image.rgb.data(), 0, nullptr) == 0)
      throw std::runtime_error(fmt::format("{}: {}", path.string(), png.message));
  };
  encode(nullptr);
  bytes.resize(size);
  encode(bytes.data());
  verify::AtomicFile file(path);
  file.stream().write(bytes.data(), static_cast<std::streamsize>(size));
  file.commit();
}

Image beside(const std::vector<Image>& images, int gap) {
  Image all;
  for (const Image& image : images) {
    if (image.height != images.front().height)
      throw data::ArgumentError("images beside each other need one height");
    all.width += image.width + (all.width > 0 ? gap : 0);
  }
  all.height = images.front().height;
  all.rgb.assign(3 * static_cast<std::size_t>(all.width) * static_cast<std::size_t>(all.height), 255);
  int left = 0;
  for (const Image& image : images) {
    const auto row = static_cast<std::size_t>(3 * image.width);
    for (int y = 0; y < all.height; ++y) {
      std::copy_n(image.rgb.begin() + static_cast<std::ptrdiff_t>(row) * y, row,
                  all.rgb.begin() + 3 * (static_cast<std::ptrdiff_t>(all.width) * y + left));
    }
    left += image.width + gap;
  }
  return all;
}

}  // namespace limitcheck::bench
