// SPDX-License-Identifier: MIT
// The rules of either scheme with one of them changed: what the subjects `model` and `quad-model` compute with.
// What is right is that of reference/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "data/control_mesh.h"
#include "data/scheme.h"
#include "reference/catmull_clark/ringed_quad.h"
#include "reference/loop/masks.h"
#include "reference/mesh/topology.h"
#include "verify/mutants/faulty_subjects.h"
#include "verify/subject/face_domain.h"

namespace limitcheck::verify {

/// All mutations of the rules of a scheme, with their options beside `mutation=NAME`; the first is "none".
std::span<const Change> mutations(data::Scheme scheme);

/// A vertex with its neighbours and, in a mesh of quads, the far corners of its faces.
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

  /// Step number `step`, from 0, of `depth`, of a mesh without tags: vertex points in the order of the vertices, then
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
std::unique_ptr<MutantRules> quad_rules(std::string_view mutation);

/// The limit points of a control mesh over 2^depth steps to a side, at least two where a face is no quad nor a triangle
/// of Loop's: by the rules; of a mesh with tags those of the subject `naive`, which has a normal for each side.
class MutantLevel {
 public:
  using V = MutantRules::V;
  MutantLevel(const data::ControlMesh& control, data::Scheme scheme, const MutantRules& rules, int depth);

  const MutantRules::Limit& at(std::size_t face, const FaceDomain::Point& p) const {
    return limits_[number(face, p)];
  }
  /// In a mesh without tags: the whole ring there, if it is closed begun at edge `first`, counted round and round.
  MutantRing ring(std::size_t face, const FaceDomain::Point& p, std::size_t first) const;
  int depth() const { return depth_; }

 private:
  std::size_t number(std::size_t face, const FaceDomain::Point& p) const {
    return first_[face] + static_cast<std::size_t>(domains_[face].number(p, n_));
  }
  template <class Refined, class VertexAt>
  void follow(Refined mesh, const MutantRules& rules, VertexAt vertex_at);
  MutantRing ring_of(std::size_t v) const;

  int depth_;
  std::int64_t n_;
  std::vector<FaceDomain> domains_;
  std::vector<std::size_t> first_;          // of each face, its first lattice point
  std::vector<MutantRules::Limit> limits_;  // of the lattice points
  std::vector<std::int32_t> vertex_;        // likewise, of the refined mesh
  std::vector<V> points_;                   // its vertices
  std::optional<reference::Topology> topology_;
};

}  // namespace limitcheck::verify
