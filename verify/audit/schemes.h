// SPDX-License-Identifier: MIT
// What other subdivision schemes make of a control mesh: to recognise a tessellation that is not what it
// should be.
#pragma once

#include <string>
#include <vector>

#include "data/control_mesh.h"
#include "verify/audit/vector.h"
#include "verify/subject/subject.h"

namespace limitcheck::verify {

enum class Scheme {
  kLoop,          // Loop's weights of 1987
  kWarren,        // the simplified a(n) = 3/8 for n > 3, 9/16 for n = 3
  kLinear,        // midpoints: the flat control mesh with more vertices
  kCatmullClark,  // quads after the first step
};

/// Vertices after `steps` steps, `limit`: moved to the limit surface of that scheme. Boundaries by the cubic
/// B-spline (Linear: midpoints). The mesh is valid (data/validate.h). Simple and slow.
///   limit masks  Loop, Warren: (3 v + (8a / n) sum v_i) / (3 + 8a), eq. 3 with their a(n);
///                Catmull-Clark: (n^2 v + 4 sum e_i + sum f_i) / (n (n + 5)), e_i and f_i the neighbours in
///                the n quads (Halstead, Kass, DeRose 1993); not for zero steps, where faces are no quads
std::vector<Vector> scheme_points(const data::ControlMesh& mesh, Scheme scheme, int steps, bool limit);

/// The same points with their places on the control mesh: the lattice of depth `steps` has them. A vertex
/// that is none of its points (Catmull and Clark's inside of faces) has denominator 0.
struct SchemePoints {
  std::vector<Vector> position;
  std::vector<lc_provenance> place;
};
SchemePoints placed_scheme_points(const data::ControlMesh& mesh, Scheme scheme, int steps, bool limit);

/// "the limit points of Loop's rule with Warren's simplified weights (1 step)"
std::string describe(Scheme scheme, int steps, bool limit);

}  // namespace limitcheck::verify
