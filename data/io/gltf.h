// SPDX-License-Identifier: MIT
// glTF 2.0, as a tessellation and as a control mesh. A target of its own: data/ does without tinygltf.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "data/io/polygon_soup.h"

namespace limitcheck::data::io {

/// .gltf or .glb, in any case.
bool is_gltf(const std::filesystem::path& file);

/// All triangles (lists, strips and fans) of all meshes that the default scene shows, each where its node
/// puts it; without scenes all meshes as they are. Primitives that share their vertices share them here.
///   precision  floats bit for bit under nodes without a transformation, else double arithmetic
///   throws     data::InputError: FILE_CANNOT_OPEN, FILE_SYNTAX (not glTF 2.0, or an accessor out of its
///              buffer), FILE_UNSUPPORTED (positions that are not floats, sparse or compressed accessors,
///              JSON that nests too deep, an extension that is required and changes the shape); a node that
///              occurs twice is FILE_SYNTAX. Buffers beside the file must be regular files.
PolygonSoup read_gltf(const std::filesystem::path& file);

/// The same from memory. `binary`: GLB. `folder`: where buffers beside the file are. `name`: for messages.
PolygonSoup read_gltf(std::string_view content, bool binary, const std::string& folder,
                      const std::string& name);

/// The soup of a control mesh: read_soup(), or of a glTF, which has a vertex for each normal and texture coordinate,
/// with equal positions as one vertex; a note says how many there were.
PolygonSoup read_control_soup(const std::filesystem::path& file);

}  // namespace limitcheck::data::io
