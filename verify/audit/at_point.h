// SPDX-License-Identifier: MIT
// What a subject delivers at one point of one control mesh, beside what it should deliver there.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "verify/evidence/audit_case.h"
#include "verify/evidence/vector.h"
#include "verify/subject/face_domain.h"

namespace limitcheck::verify {

/// One vertex that lies there.
struct VertexAtPoint {
  std::int64_t vertex = 0;
  Vector position{}, expected{};
  double distance = 0;  // in diagonals of the control mesh's bounding box; NaN if it is not finite
  std::optional<Vector> normal, expected_normal;
  double angle = 0;  // between the two, in degrees; NaN if the normal is not finite or has no length
  double angle_bound = 0;
};

struct AtPoint {
  bool refined = false;   // expected is the vertex of the refined control mesh, not the limit point
  bool in_float = false;  // the subject's precision
  double bound = 0;       // of distance
  std::vector<VertexAtPoint> vertices;
  bool same_bits = true;  // of the positions, and of the normals of one side

  /// Whether every vertex is within its bounds and has the bits of the others.
  bool held() const;
};

/// Tessellates the mesh at its depths and looks at the vertices at one point. What is expected is certified
/// for limit points. Throws data::ArgumentError: the point is none of the lattice of the mesh's depth;
/// SubjectError: the subject fails.
AtPoint look_at(const AuditSubject& subject, const AuditMesh& mesh, const Place& place, int threads);

}  // namespace limitcheck::verify
