// SPDX-License-Identifier: MIT
// Meshes by name: "bumpy:800", "wheel:7", "icosahedron".
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "data/control_mesh.h"
#include "data/io/read.h"

namespace limitcheck::data {

/// The mesh of a specification NAME[:PARAMETER...], parameters separated by colons, as `named_meshes` lists
/// them. Throws InputError: NAME_UNKNOWN, or NAME_BAD_PARAMETER (too few, too many, not a number,
/// out of range; or the dual of a mesh that has none).
ControlMesh named_mesh(const std::string& specification);

/// One line of the list: `name` is "wheel:N[:RINGS]".
struct NamedMesh {
  std::string name;
  std::string description;
};
std::vector<NamedMesh> named_meshes();

/// Specifications of the small shapes that an audit runs on:
/// every interior valence class, every boundary situation.
std::vector<std::string> stock_shapes();

/// A mesh, how many of its faces were cut into triangles, how many unused vertices of its file were left
/// out, because the options asked for it, and what of the file was read otherwise than one may expect.
struct OpenedMesh {
  ControlMesh mesh;
  std::int64_t cut = 0, left_out = 0;
  std::vector<std::string> notes = {};
  std::optional<Scheme> scheme = {};  // that the file says it is meant for
};

/// What a user may write where a mesh is expected: an existing file is read, anything else is a
/// specification. Throws InputError as read_mesh and named_mesh do.
OpenedMesh open_mesh(const std::string& file_or_name, const ReadOptions& options = {});
/// The same for a name only.
OpenedMesh open_named_mesh(const std::string& specification, const ReadOptions& options = {});

}  // namespace limitcheck::data
