// SPDX-License-Identifier: MIT
// The control mesh of a command, and the scheme that is meant: --scheme, --triangulate, and the first line of
// the output, which says what was chosen.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "data/control_mesh.h"
#include "data/io/read.h"
#include "data/scheme.h"

namespace limitcheck::cli {

/// As given on the command line; empty: not given.
struct MeshOptions {
  std::string scheme, triangulate;
};

void add_mesh_options(CLI::App& command, MeshOptions& options);

/// What of them the readers understand.
data::ReadOptions read_options(const MeshOptions& options);

/// Which scheme a mesh was opened for, and at what price.
struct MeshScheme {
  data::Scheme scheme = data::Scheme::kLoop;
  std::int64_t cut = 0;  // so many faces were cut into triangles
};
struct OpenedMesh {
  data::ControlMesh mesh;
  MeshScheme chosen;
};

/// The scheme asked for, else the mesh's own.
MeshScheme scheme_of(const data::ControlMesh& mesh, std::int64_t cut, const MeshOptions& options);

/// A file or a generator's name. Vertices that no face names are left out, with a warning on standard error.
///   throws   data::InputError as data::open_mesh; data::ArgumentError: Loop's scheme was asked for, and the
///            mesh has polygons that nobody allowed to be cut
OpenedMesh open_mesh(const std::string& file_or_name, const MeshOptions& options);
/// A generator's name only.
OpenedMesh open_named_mesh(const std::string& specification, const MeshOptions& options);

/// "scheme: loop (all faces are triangles)", of one mesh or of all meshes of a command.
std::string scheme_line(const std::vector<MeshScheme>& meshes, const MeshOptions& options);

}  // namespace limitcheck::cli
