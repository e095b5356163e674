// SPDX-License-Identifier: MIT
// The limit surface of a control mesh over a domain whose faces are all alike.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "data/control_mesh.h"
#include "data/scheme.h"
#include "reference/mesh/sharp_tags.h"
#include "reference/mesh/topology.h"
#include "reference/surface/surface.h"
#include "verify/evidence/vector.h"
#include "verify/projection/domain.h"

namespace limitcheck::verify {

/// The faces of the domain are
///   of Loop's scheme         the control mesh's triangles
///   of Catmull-Clark's       its quads; or, if it has other faces, the quads of the mesh after one step: one
///                            for each corner of each control face, in order. Their limit surface is the
///                            same.
/// Points are evaluated on the control mesh, with its own sharp edges and vertices, semi-sharp ones included.
class LimitSurface {
 public:
  /// `mesh` is valid for the scheme (data/validate.h) and outlives this.
  LimitSurface(const data::ControlMesh& mesh, data::Scheme scheme);

  data::Scheme scheme() const { return scheme_; }
  /// Whose faces are those of the domain. The first vertices are the control vertices.
  const data::ControlMesh& mesh() const { return refined_ ? refined_->mesh : control_; }
  /// Its sharp edges and vertices, exactly: those of the control mesh, or what a step leaves of them. (The
  /// refined mesh has none of its own, which floats could not hold.)
  const reference::SharpTags& tags() const { return refined_ ? refined_->tags : control_tags_; }
  /// Whether a face of the domain lies in a face of the control mesh that is not shown.
  bool is_hole(std::int32_t face) const { return !hole_.empty() && hole_[control_face(face)]; }
  const Domain& domain() const { return domain_; }
  /// Whether the faces of the domain are the control faces.
  bool has_control_faces() const { return refined_ == nullptr; }

  /// d1 and d2 are by the second and the third coordinate of the point.
  reference::SurfacePoint<double> evaluate(const FacePoint& at, reference::Order order) const;
  Vector position(const FacePoint& at) const {
    return vector_of(evaluate(at, reference::Order::kPosition).position);
  }

  /// A point as reports name it: a control face, of one that is cut into quads a corner (else -1), and l1 and
  /// l2 or u and v.
  struct ControlPoint {
    std::int32_t face = -1;
    int corner = -1;
    double first = 0, second = 0;
  };
  ControlPoint control_point(const FacePoint& at) const;
  /// Back again; of a quad any corner will do.
  FacePoint at(const ControlPoint& point) const;

  /// Corner k of a control face.
  FacePoint control_corner(std::int32_t face, int k) const;
  /// The control face in which a face of the domain lies.
  std::int32_t control_face(std::int32_t face) const { return refined_ ? control_face_[face] : face; }
  /// Whether a side of a face lies on an edge of the control mesh, not inside a control face.
  bool on_control_edge(std::int32_t face, int side) const;

 private:
  // Of a quad of the refined mesh: which corner of its control face it has, and whether that is a quad
  // itself.
  int control_corner_of(std::int32_t face) const {
    return face - static_cast<std::int32_t>(control_.faces.first_corner(control_face_[face]));
  }
  bool is_quarter(std::int32_t face) const { return control_.faces[control_face_[face]].size() == 4; }

  struct Refined {
    data::ControlMesh mesh;
    reference::SharpTags tags;
  };
  static std::unique_ptr<const Refined> refined_once(const data::ControlMesh& mesh, data::Scheme scheme);

  const data::ControlMesh& control_;
  data::Scheme scheme_;
  reference::SharpTags control_tags_;
  std::unique_ptr<const Refined> refined_;  // if the domain has its faces
  std::vector<std::int32_t> control_face_;  // of each of those
  std::vector<bool> hole_;                  // of each control face; empty if there is none
  Domain domain_;
  reference::Surface surface_;
};

}  // namespace limitcheck::verify
