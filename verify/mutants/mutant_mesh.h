// SPDX-License-Identifier: MIT
// The meshes of the model from level to level, and the limits of the vertices of the deepest.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "data/control_mesh.h"
#include "reference/mesh/topology.h"
#include "verify/mutants/mutant_rules.h"
#include "verify/subject/face_domain.h"

namespace limitcheck::verify {

/// Triangles of Loop's scheme, or polygons of Catmull and Clark's, which are quads after a step.
struct MutantMesh {
  reference::Topology topology;
  MutantRules::Points points;
  MutantTags tags;

  /// After step number `step` of `depth`. Face f of four children has those from 4 f on, a face of n corners in
  /// quads one for each corner, all faces in order.
  MutantMesh refined(const MutantRules& rules, int step, int depth) const;
  /// The given faces, which come first, and all that touch one of these: the points next to the vertices that
  /// have all their faces among the given, and the tags at these, are what they are in the whole mesh.
  ///   v   becomes its number there
  MutantMesh around(std::vector<std::int32_t> faces, std::int32_t& v) const;
};

/// A limit position, and the normals in the faces around, in the order of the sector; one if all are the same.
struct MutantLimit {
  MutantRules::V position;
  std::vector<MutantRules::V> normals;
};

/// A control mesh after `depth` steps, at least one where a face is no quad nor a triangle of Loop's.
class MutantLevel {
 public:
  MutantLevel(const data::ControlMesh& control, data::Scheme scheme, const MutantRules& rules, int depth);

  struct Corner {
    std::int32_t face, vertex;  // of this level
  };
  /// A point of a control face over 2^depth steps to a side, as the corner of a face inside it.
  Corner corner(std::size_t control_face, FaceDomain::Point p) const;
  const MutantRules::V& position(const Corner& at) const { return limits_[at.vertex].position; }
  const MutantRules::V& normal(const Corner& at) const;
  MutantRing ring(const Corner& at) const { return MutantRing::of(mesh_.topology, mesh_.points, at.vertex); }
  int depth() const { return depth_; }

 private:
  data::Faces control_;
  data::Scheme scheme_;
  int depth_;
  MutantMesh mesh_;
  std::vector<MutantLimit> limits_;
};

}  // namespace limitcheck::verify
