// SPDX-License-Identifier: MIT
// The rules of either scheme with one of them changed: what the subjects `model` and `quad-model` compute with.
// What is right is that of reference/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "data/control_mesh.h"
#include "data/scheme.h"
#include "reference/catmull_clark/ringed_quad.h"
#include "reference/loop/masks.h"
#include "reference/mesh/topology.h"
#include "verify/subject/face_domain.h"

namespace limitcheck::verify {

struct Mutation {
  std::string_view name, description;
  std::string_view check;       // the row of the audit meant for it
  std::string_view claim = {};  // of the paper, where this is the paper taken literally
  bool in_float = false;        // delivered in float: small faults hide in wider bounds
  bool sharp = false;           // only sharp edges and vertices bring it out
};

/// All mutations of the rules of a scheme; the first is "none".
std::span<const Mutation> mutations(data::Scheme scheme);

/// A vertex with its neighbours and, in a mesh of quads, the far corners of its faces, where the mesh is cut along the
/// edges that stay sharp.
using MutantRing = reference::catmull_clark::RingedCorner<reference::Vec3<double>>;
/// The sum of e_i x e_{i+1}, from the vertex: of the triangles around, by their areas.
inline reference::Vec3<double> facets(const MutantRing& ring) {
  return reference::area_normal<double>(ring.point, ring.edge_span(), ring.on_boundary);
}

/// The rules under one mutation, in double. Points are those of a mesh at some level.
class MutantRules {
 public:
  using V = reference::Vec3<double>;
  using Points = std::vector<V>;
  explicit MutantRules(std::string_view mutation) : mutation_(mutation) {}
  virtual ~MutantRules() = default;

  bool is(std::string_view name) const { return mutation_ == name; }

  /// Step number `step`, from 0, of `depth`, as if nothing were sharp: vertex points in the order of the vertices, then
  /// edge points, then, of quads, face points.
  virtual Points refine(const reference::Topology& topology, const Points& points, int step,
                        int depth) const = 0;
  /// Of a vertex at level `depth`; the normal is of unit length.
  struct Limit {
    V position, normal;
  };
  virtual Limit limit(const MutantRing& ring, int depth) const = 0;

 private:
  std::string_view mutation_;
};

///   weights   the family that the subject declares
///   refined   limit() leaves points as they are
std::unique_ptr<MutantRules> loop_rules(std::string_view mutation, reference::Weights weights, bool refined);
///   triangles   the rule of the mesh for the edges of triangles in step 0
std::unique_ptr<MutantRules> quad_rules(std::string_view mutation, data::TriangleRule triangles);

/// A control mesh after `depth` steps, at least one where a face is no quad nor a triangle of Loop's, and the limits of
/// its vertices.
class MutantLevel {
 public:
  using V = MutantRules::V;
  MutantLevel(const data::ControlMesh& control, data::Scheme scheme, const MutantRules& rules, int depth);

  /// A point of a control face over 2^depth steps to a side: the number of a corner of this level's faces in which it
  /// lies, of a face inside that one.
  std::size_t corner(std::size_t control_face, FaceDomain::Point p) const;
  const V& position(std::size_t corner) const { return positions_[vertex(corner)]; }
  const V& normal(std::size_t corner) const { return normals_[corner]; }
  /// The whole ring of the vertex, if it is closed begun at edge `first`, counted round and round.
  MutantRing ring(std::size_t corner, std::size_t first) const;
  int depth() const { return depth_; }

 private:
  std::int32_t vertex(std::size_t corner) const { return topology_.faces().corners()[corner]; }

  data::Faces control_;
  data::Scheme scheme_;
  int depth_;
  reference::Topology topology_;
  std::vector<V> points_, positions_;  // of each vertex; its limit
  std::vector<V> normals_;             // of each corner of each face
};

}  // namespace limitcheck::verify
