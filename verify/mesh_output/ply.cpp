// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <bit>
#include <cstring>

#include "verify/mesh_output/atomic_file.h"
#include "verify/mesh_output/formats.h"

namespace limitcheck::verify {

namespace {

static_assert(std::endian::native == std::endian::little,
              "the records below are written as they lie in memory");
static_assert(sizeof(fast::SurfaceVertex<float>) == 24, "x y z nx ny nz, as the header of the file says");

}  // namespace

void write_ply(const std::filesystem::path& file, const fast::IndexedMesh<float>& mesh,
               const Colouring& colouring) {
  const bool coloured = !colouring.classes.empty();
  AtomicFile output(file);
  std::ostream& out = output.stream();
  out << fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment limitcheck\nelement vertex {}\nproperty float "
      "x\nproperty float y\n"
      "property float z\nproperty float nx\nproperty float ny\nproperty float nz\nelement face {}\n"
      "property list uchar int vertex_indices\n{}end_header\n",
      mesh.vertices.size(), mesh.triangles.size(),
      coloured ? "property uchar red\nproperty uchar green\nproperty uchar blue\n" : "");
  out.write(reinterpret_cast<const char*>(mesh.vertices.data()),
            static_cast<std::streamsize>(mesh.vertices.size() * sizeof(fast::SurfaceVertex<float>)));

  std::array<char, 16> record{};
  record[0] = 3;
  const std::streamsize size = coloured ? 16 : 13;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::memcpy(record.data() + 1, mesh.triangles[t].data(), 12);
    if (coloured) std::memcpy(record.data() + 13, colouring.classes[colouring.of_triangle[t]].rgb.data(), 3);
    out.write(record.data(), size);
  }
  output.commit();
}

}  // namespace limitcheck::verify
