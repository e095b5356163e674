// SPDX-License-Identifier: MIT
// Control meshes from files: OBJ, OFF, PLY, STL, USD as text.
//
// Codes of InputError beside those of data/validate.h:
//   FILE_CANNOT_OPEN      absent, unreadable, or not a file
//   FILE_TOO_LARGE        more than 4 GiB
//   FILE_UNKNOWN_FORMAT   none of .obj, .off, .ply, .stl, .usda
//   FILE_UNSUPPORTED      a part of the format that this program does not read, and that cannot be ignored
//   FILE_SYNTAX           not of the form the format prescribes
//   FILE_TRUNCATED        ends before what it announced
// A file is taken whole and as it is, or refused: there is no repair and no partial result. The readers skip
// what the formats have beside positions and faces (normals, colours, groups), and tags that move no point. Texture
// coordinates of OBJ and PLY become the channel "uv", primvars of USD channels of their own names; those that cannot
// be used are left out with a note.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "data/control_mesh.h"
#include "data/scheme.h"
#include "data/triangulate.h"

namespace limitcheck::data {

/// Choices for reading a file.
struct ReadOptions {
  Triangulation polygons = Triangulation::kKeep;
  /// The scheme that the mesh is validated for, after triangulation; by default the one that it is meant for,
  /// as the file says or natural_scheme().
  std::optional<Scheme> scheme{};
  /// Vertices that no face names are left out, and refuse no file.
  bool leave_out_unused = false;
};

/// The format of a file.
enum class FileFormat { kObj, kOff, kPly, kStl, kUsda };

/// Reads and validates a file. Its extension says its format.
///   vertices   in file order. STL has none: equal positions (-0 = 0) become one vertex, in the order seen
///   faces      in file order; the triangles of a polygon that is cut follow one another
///   precision  decimals are correctly rounded to double, binary doubles are taken bit for bit
/// Throws InputError for the first fault, with the line where the format has lines (binary ones: line 0).
ControlMesh read_mesh(const std::filesystem::path& file, const ReadOptions& options = {});

/// The same from memory; `name` stands for the file in messages.
ControlMesh read_mesh(std::string_view content, FileFormat format, const std::string& name,
                      const ReadOptions& options = {});

}  // namespace limitcheck::data
