// SPDX-License-Identifier: MIT
// Control meshes to files: OBJ, OFF, PLY.
#pragma once

#include <filesystem>
#include <string>

#include "data/control_mesh.h"
#include "data/io/read.h"

namespace limitcheck::data {

/// Choices for writing a file.
struct WriteOptions {
  bool ascii_ply = false;  ///< PLY in text instead of binary little endian
};

/// Writes a mesh in the format that the extension says. read_mesh gives back the same mesh bit for bit:
/// positions are binary doubles or the shortest decimals that are read as the same double. The file appears
/// whole or not at all: it is written under a temporary name beside the final one and renamed. A file that is
/// not regular (a pipe, /dev/stdout) is written to directly.
///   sharpness  OBJ has all of it, as OpenSubdiv's tags; PLY sharp edges, as elements; infinity becomes 10
///   channels   OBJ has the one that is called uv, as texture coordinates; PLY too if it has two components, without
///              its rule, and values that are equal at a vertex become one; all else is left_out()
///   throws     InputError: FILE_UNKNOWN_FORMAT, FILE_UNSUPPORTED (STL, and a sharpness that the format has
///              no place for), FILE_CANNOT_WRITE (with the system's reason)
void write_mesh(const std::filesystem::path& file, const ControlMesh& mesh, const WriteOptions& options = {});

/// Which channels, and rules of channels, a format has no place for: "the channel colour"; empty: none.
std::string left_out(const ControlMesh& mesh, FileFormat format);

/// What write_mesh writes into the file.
std::string mesh_content(const ControlMesh& mesh, FileFormat format, const WriteOptions& options = {});

}  // namespace limitcheck::data
