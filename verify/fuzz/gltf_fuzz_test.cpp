// SPDX-License-Identifier: MIT
// libFuzzer target: any bytes are either refused as glTF, or are triangles whose corners are there or marked.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "data/error.h"
#include "data/io/gltf.h"

using namespace limitcheck;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    const auto soup = data::io::read_gltf(bytes, bytes.starts_with("glTF"), "/nonexistent", "input");
    if (soup.corners.size() != 3 * soup.polygon_end.size()) std::abort();
    for (const std::int64_t c : soup.corners)
      if (c < -1 || c >= static_cast<std::int64_t>(soup.positions.size())) std::abort();
    if (!soup.normals.empty() && soup.normals.size() != soup.positions.size()) std::abort();
  } catch (const data::InputError&) {
  }
  return 0;
}
