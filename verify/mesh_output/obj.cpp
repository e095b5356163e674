// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <iterator>
#include <string>

#include "verify/mesh_output/atomic_file.h"
#include "verify/mesh_output/formats.h"

namespace limitcheck::verify {

namespace {

void write_materials(const std::filesystem::path& file, const Colouring& colouring) {
  AtomicFile output(file);
  for (const ColourClass& c : colouring.classes) {
    output.stream() << fmt::format("newmtl {}\nKd {:.4f} {:.4f} {:.4f}\n", c.name, c.rgb[0] / 255.,
                                   c.rgb[1] / 255., c.rgb[2] / 255.);
  }
  output.commit();
}

}  // namespace

void write_obj(const std::filesystem::path& file, const fast::IndexedMesh<float>& mesh,
               const Colouring& colouring) {
  const bool coloured = !colouring.classes.empty();
  AtomicFile output(file);
  fmt::memory_buffer text;
  const auto add = [&](auto format, const auto&... values) {
    fmt::format_to(std::back_inserter(text), format, values...);
    if (text.size() > (1 << 16)) {
      output.stream().write(text.data(), static_cast<std::streamsize>(text.size()));
      text.clear();
    }
  };

  auto materials = file;
  materials.replace_extension(".mtl");
  if (coloured) add(FMT_STRING("mtllib {}\n"), materials.filename().string());
  for (const auto& v : mesh.vertices)
    add(FMT_STRING("v {} {} {}\n"), v.position.x, v.position.y, v.position.z);
  for (const auto& v : mesh.vertices) add(FMT_STRING("vn {} {} {}\n"), v.normal.x, v.normal.y, v.normal.z);
  const auto lists = triangles_by_class(mesh, colouring);
  for (std::size_t c = 0; c < lists.size(); ++c) {
    if (coloured && !lists[c].empty()) add(FMT_STRING("usemtl {}\n"), colouring.classes[c].name);
    for (const std::uint32_t t : lists[c]) {
      const std::uint64_t i = mesh.triangles[t][0] + std::uint64_t{1},
                          j = mesh.triangles[t][1] + std::uint64_t{1},
                          k = mesh.triangles[t][2] + std::uint64_t{1};
      add(FMT_STRING("f {}//{} {}//{} {}//{}\n"), i, i, j, j, k, k);
    }
  }
  output.stream().write(text.data(), static_cast<std::streamsize>(text.size()));
  output.commit();
  if (coloured) write_materials(materials, colouring);
}

}  // namespace limitcheck::verify
