// SPDX-License-Identifier: MIT
// Files with Catmull-Clark's quads, as Blender writes them. For tests of this folder.
#pragma once

#include <fmt/core.h>

#include <unistd.h>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "reference/catmull_clark/refined_mesh.h"
#include "reference/loop/refine.h"
#include "verify/files/read/tessellation_file.h"

namespace limitcheck::verify::test {

/// The mesh refined so many times, moved to the limit or not, as the text of an OBJ file of quads (at depth
/// 0: of the control faces) with the limit's normals.
inline std::string obj_of_quads(const data::ControlMesh& mesh, int depth, bool limit) {
  reference::catmull_clark::RefinedMesh<double> refined(mesh.faces, reference::positions_of<double>(mesh));
  for (int step = 0; step < depth; ++step) refined.refine();
  const auto limits = refined.limits();
  std::string text;
  for (const auto& p : limit ? limits.positions : refined.positions())
    text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
  for (const auto& n : limits.normals) text += fmt::format("vn {} {} {}\n", n.x, n.y, n.z);
  const data::Faces& faces = refined.topology().faces();
  for (std::size_t f = 0; f < faces.size(); ++f) {
    text += "f";
    for (const std::int32_t v : faces[f]) text += fmt::format(" {0}//{0}", v + 1);
    text += "\n";
  }
  return text;
}

/// As the door reads it.
inline FileTessellation read_obj(const std::string& text) {
  const auto file = std::filesystem::temp_directory_path() / fmt::format("limitcheck-quads-{}.obj", getpid());
  std::ofstream(file) << text;
  FileTessellation t = read_tessellation(file);
  std::filesystem::remove(file);
  return t;
}

inline FileTessellation quad_file(const data::ControlMesh& mesh, int depth, bool limit = true) {
  return read_obj(obj_of_quads(mesh, depth, limit));
}

}  // namespace limitcheck::verify::test
