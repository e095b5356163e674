// SPDX-License-Identifier: MIT
// The control mesh of a command, and the scheme that is meant: --scheme, --triangulate, and the first line of
// the output, which says what was chosen.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "data/control_mesh.h"
#include "data/io/read.h"
#include "data/scheme.h"

namespace limitcheck::cli {

/// --scheme, empty if it is not given.
CLI::Option* add_scheme(CLI::App& command, std::optional<data::Scheme>& scheme, const std::string& text);
/// --scheme and --triangulate.
void add_mesh_options(CLI::App& command, data::ReadOptions& options);
/// --channel-rule, empty if it is not given.
CLI::Option* add_channel_rule(CLI::App& command, std::optional<data::ChannelRule>& rule);
/// "fan", "shortest-diagonal"; empty: polygons are kept.
std::string word(data::Triangulation polygons);
/// Of a word of these.
data::Triangulation triangulation(const std::string& word);

/// Which scheme a mesh was opened for, and at what price.
struct MeshScheme {
  data::Scheme scheme = data::Scheme::kLoop;
  std::int64_t cut = 0;   // so many faces were cut into triangles
  bool declared = false;  // by the file
};
struct OpenedMesh {
  data::ControlMesh mesh;
  MeshScheme chosen;
};

/// A file or a generator's name. Vertices that no face names are left out, with a warning on standard error.
///   throws   data::InputError as data::open_mesh; data::ArgumentError: Loop's scheme was asked for, and the
///            mesh has polygons that nobody allowed to be cut
OpenedMesh open_control_mesh(const std::string& file_or_name, const data::ReadOptions& options);
/// A generator's name only.
OpenedMesh open_generated_mesh(const std::string& specification, const data::ReadOptions& options);

/// "scheme: loop (all faces are triangles)", of one mesh or of all meshes of a command.
std::string scheme_line(const std::vector<MeshScheme>& meshes, const data::ReadOptions& options);

}  // namespace limitcheck::cli
