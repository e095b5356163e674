// SPDX-License-Identifier: MIT
// The paper's test object. [mueller2000, section 6; C71]
#pragma once

#include <cstdint>

#include "data/control_mesh.h"

namespace limitcheck::data {

/// A bumpy sphere: V = faces / 2 + 2 uniformly distributed directions, the unit sphere triangulated over them
/// (their convex hull, hence Delaunay on the sphere), and each vertex moved to a radius uniform in
/// [rmin, rmax]. The paper leaves distribution, triangulation and seed open; here they are rejection from the
/// cube, exact predicates and SplitMix64.
///   faces    even, 4 .. 20 million
///   result   F = 2V - 4; vertices in the order drawn; each face with its smallest vertex first; faces sorted
///            Bit for bit the same with every compiler (only +, *, /, sqrt and exact predicates are used)
///   throws   InputError NAME_BAD_PARAMETER
ControlMesh bumpy_sphere(int faces, std::uint64_t seed, double rmin = 0.5, double rmax = 1.5);

}  // namespace limitcheck::data
