// SPDX-License-Identifier: MIT
// libFuzzer target, one for each format: any bytes are either refused by an InputError or give a mesh that
// the writers and readers carry unchanged.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "data/error.h"
#include "data/io/read.h"
#include "data/io/write.h"
#include "data/validate.h"

using namespace limitcheck::data;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  // Every rule for polygons gets its share; the seeds stay ordinary files.
  const ReadOptions options{
      std::array{Triangulation::kKeep, Triangulation::kFan, Triangulation::kShortestDiagonal}[size % 3]};
  ControlMesh mesh;
  try {
    mesh = read_mesh(std::string_view(reinterpret_cast<const char*>(bytes), size),
                     FileFormat::LIMITCHECK_FUZZ_FORMAT, "input", options);
  } catch (const InputError&) {
    return 0;
  }
  // A mesh of triangles may say that it is meant for Catmull-Clark's scheme, which other files cannot.
  if (FileFormat::LIMITCHECK_FUZZ_FORMAT == FileFormat::kUsda) return 0;
  if (!validate(mesh).empty()) std::abort();
  // 10 and more are one sharpness, and written as 10.
  for (SharpEdge& e : mesh.sharpness.edges) e.sharpness = std::min(e.sharpness, 10.F);
  for (SharpVertex& v : mesh.sharpness.vertices) v.sharpness = std::min(v.sharpness, 10.F);
  for (const FileFormat format : {FileFormat::kObj, FileFormat::kOff, FileFormat::kPly}) {
    std::string written;
    try {
      written = mesh_content(mesh, format);
    } catch (const InputError&) {
      // OBJ has a place for everything.
      if (format == FileFormat::kObj) std::abort();
      continue;
    }
    const ControlMesh again = read_mesh(written, format, "written");
    if (again != mesh) std::abort();
  }
  return 0;
}
