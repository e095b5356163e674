// SPDX-License-Identifier: MIT
// What other subdivision schemes make of a control mesh: to recognise a tessellation that is not what it
// should be.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "data/control_mesh.h"
#include "verify/evidence/vector.h"
#include "verify/subject/face_domain.h"

namespace limitcheck::verify {

enum class Scheme {
  kLoop,          // Loop's weights of 1987
  kWarren,        // the simplified a(n) = 3/8 for n > 3, 9/16 for n = 3
  kLinear,        // midpoints: the flat control mesh with more vertices
  kCatmullClark,  // quads after the first step
};

/// Vertices after `steps` steps, `limit`: moved to the limit surface of that scheme, but for Catmull-Clark
/// after zero steps. Boundaries by the cubic B-spline (Linear: midpoints). The mesh is valid
/// (data/validate.h); all but Catmull-Clark need triangles. Sharp edges and vertices are as the mesh has
/// them. Computed by the reference.
std::vector<Vector> scheme_points(const data::ControlMesh& mesh, Scheme scheme, int steps, bool limit);

/// The same points with their places on the control mesh: the lattice of depth `steps` has them. A vertex
/// that is none of its points (Catmull and Clark's inside of Loop's faces) has denominator 0.
struct SchemePoints {
  std::vector<Vector> position;
  std::vector<Place> place;
};
///   lattice  of which scheme the places are
SchemePoints placed_scheme_points(const data::ControlMesh& mesh, Scheme scheme, int steps, bool limit,
                                  data::Scheme lattice = data::Scheme::kLoop);

/// The mesh as somebody has it who knows nothing of sharp edges and vertices.
data::ControlMesh without_tags(const data::ControlMesh& mesh);

/// "catmull-clark": stable.
std::string_view word(Scheme scheme);
/// "the limit points of Loop's rule with Warren's simplified weights (1 step)"
std::string describe(Scheme scheme, int steps, bool limit);

}  // namespace limitcheck::verify
