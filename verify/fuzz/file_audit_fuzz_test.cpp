// SPDX-License-Identifier: MIT
// libFuzzer target: whatever a file holds beside a small control mesh, it is refused or gives the seven rows
// of the file audit, with a closest point for every finite vertex. The first byte chooses the control mesh,
// its scheme and the form of the file.
#include <fcntl.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <string>

#include "data/error.h"
#include "data/generators/polygon_meshes.h"
#include "data/shapes.h"
#include "verify/files/audit_files.h"

using namespace limitcheck;

namespace {

void require(bool condition) {
  if (!condition) std::abort();
}

// The readers take files.
std::string as_file(const char* extension, const std::uint8_t* data, std::size_t size) {
  static const std::string stem = "/dev/shm/limitcheck-fuzz-" + std::to_string(getpid());
  const std::string name = stem + extension;
  const int fd = open(name.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  require(fd >= 0 && write(fd, data, size) == static_cast<ssize_t>(size));
  close(fd);
  return name;
}

// A polygon among quads with a sharp edge and a hole, or triangles.
data::ControlMesh control_of(std::uint8_t choice) {
  if ((choice & 64U) == 0) return choice & 4U ? data::tetrahedron() : data::strip(2);
  data::ControlMesh prism = data::polygon_prism(5);
  if (choice & 4U) {
    prism.sharpness.edges.push_back({prism.faces[0][0], prism.faces[0][1], 2.5F});
    prism.holes.push_back(3);
  }
  return prism;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  if (size == 0) return 0;
  constexpr const char* kExtensions[] = {".obj", ".ply", ".off", ".stl"};
  const std::string file = as_file(kExtensions[data[0] % 4], data + 1, size - 1);
  const data::ControlMesh control = control_of(data[0]);
  verify::FilesOptions options;
  options.pieces = 512;  // a hundred times as many files in a second as with all
  options.needs_normals = (data[0] & 8U) != 0;
  options.fit = data[0] & 16U ? verify::Fit::kSimilarity : verify::Fit::kNone;
  if (data[0] & 32U) options.scheme = data::Scheme::kCatmullClark;
  try {
    verify::FileTessellation tessellation = verify::read_tessellation(file);
    const auto audit = verify::audit_files("control", control, std::move(tessellation), {}, options,
                                           [](const std::string&, std::size_t, std::size_t) {});
    require(audit.results.size() >= 7);
    for (const verify::Result& r : audit.results)
      require(r.status != verify::Status::kError && r.bad <= r.of);
  } catch (const data::InputError&) {
  }
  unlink(file.c_str());
  return 0;
}
