// SPDX-License-Identifier: MIT
// A control mesh written differently or moved, and the map back to the original.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "data/control_mesh.h"
#include "data/scheme.h"
#include "data/splitmix64.h"
#include "verify/evidence/evidence.h"
#include "verify/evidence/vector.h"
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

/// A control mesh that describes the surface of the evidence, written differently or moved, and how its
/// points and faces belong to those of the original.
struct Variant : Rewriting {
  std::string name;  // "mirrored", "times 2^10", ...
  std::vector<std::int32_t> face_depth;
  std::function<Vector(const Vector&)> position, normal;  // back to the original
  double magnitude = 0;                                   // largest coordinate
  bool normals = true;                                    // to be compared
  bool same_numbers = false;                              // a difference in bits is worth a warning
};

/// The request as it was.
Variant identity(const Evidence& e);

/// One row of the audit and the variants it compares.
struct Relation {
  using Change = std::function<void(const Evidence&, Variant&)>;  // of the request as it was
  struct Way {
    const char* name;
    bool same_numbers;
    Change change;
  };
  std::string_view row;
  /// Whether there is anything to compare.
  bool (*applies)(const data::ControlMesh&, const Lattice&);
  std::vector<Way> ways;

  std::vector<Variant> variants(const Evidence& e) const;
};

/// From face-order to cut-by-hand, in the order of the table (verify/row/rows.cpp says what each is). From crease-order on
/// they need sharp edges or vertices.
const std::vector<Relation>& surface_relations();

/// Whether an edge or a vertex has a sharpness that ends.
bool has_semi_sharp(const data::ControlMesh& mesh);
/// The sharpness of all that do, if it is the same and there are some.
std::optional<float> common_sharpness(const data::ControlMesh& mesh);
/// The mesh with another one for all of them; 0 is none.
data::ControlMesh with_sharpness(data::ControlMesh mesh, float sharpness);

}  // namespace limitcheck::verify
