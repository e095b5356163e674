// SPDX-License-Identifier: MIT
// A control mesh written differently: other orders and numbers, the same surface.
#pragma once

#include <cstdint>
#include <vector>

#include "data/control_mesh.h"
#include "data/scheme.h"
#include "data/splitmix64.h"
#include "verify/subject/face_domain.h"

namespace limitcheck::verify {

/// Numbers 0 .. count - 1 in a random order.
std::vector<std::int32_t> shuffled(std::size_t count, data::SplitMix64& random);

/// A mesh, and how its faces lie on those of the mesh that it was made of. Each change adds to the ones
/// before.
struct Rewriting {
  data::ControlMesh mesh;
  data::Scheme scheme = data::Scheme::kLoop;
  std::vector<std::int32_t> face;              // of the original, for each face
  std::vector<FaceDomain::Symmetry> symmetry;  // how each face lies on that one

  Rewriting() = default;
  /// The mesh as it is.
  Rewriting(data::ControlMesh original, data::Scheme of_scheme);

  void number_vertices(const std::vector<std::int32_t>& number);  // vertex v becomes number[v]
  void order_faces(const std::vector<std::int32_t>& order);       // face f becomes the one that was order[f]
  void turn_face(std::size_t f, int first);                       // it begins at the corner that was `first`
  void mirror_faces();                                            // corners in the opposite order

  /// The place on the original of a place on this mesh, which lies in its face.
  Place original(const Place& p) const;
};

}  // namespace limitcheck::verify
