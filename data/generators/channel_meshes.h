// SPDX-License-Identifier: MIT
// Meshes with texture coordinates: the channel "uv", of two components.
#pragma once

#include <cstdint>

#include "data/control_mesh.h"

namespace limitcheck::data {

/// The cube of quads with a chart for each of its faces, three by two in the unit square.
ControlMesh cube_with_atlas();
/// A sphere of quads with triangles around its poles and a seam along a meridian. As exporters write it, a pole has a
/// value for each of its triangles. Throws InputError
/// NAME_BAD_PARAMETER: fewer than 3 faces around or 2 from pole to pole.
ControlMesh globe(int around, int across);
/// The torus of quads in one chart: cut along a circle of either kind, which cross at a vertex.
ControlMesh torus_in_a_chart(int around, int across);
/// Any mesh with charts drawn by chance, some of whose values are joined across their seams: seams that end, values on
/// both sides of one, and values that meet at a vertex alone. The seed decides the channel's rule, too.
ControlMesh with_random_channel(ControlMesh mesh, std::uint64_t seed);
/// The same with values from -8 to 24, and a channel "colour" of four components, with charts and a rule of its own.
ControlMesh with_random_channels(ControlMesh mesh, std::uint64_t seed);

}  // namespace limitcheck::data
