// SPDX-License-Identifier: MIT
// The rules of either scheme with one of them changed: what the subjects `model` and `quad-model` compute with.
// Where a rule is right its masks are those of reference/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "data/control_mesh.h"
#include "data/scheme.h"
#include "data/sharpness.h"
#include "reference/loop/masks.h"
#include "reference/mesh/topology.h"
#include "reference/number/vec3.h"
#include "verify/subject/face_domain.h"

namespace limitcheck::verify {

// How sharp the edges and vertices of a mesh are at one level, for the model: what DeRose, Kass and Truong
// 1998 say of a step, as OpenSubdiv has it, with Chaikin's way of falling. The same in both schemes.
class MutantTags {
 public:
  using V = reference::Vec3<double>;
  static constexpr double kForEver = std::numeric_limits<double>::infinity();
  enum class Rule : std::uint8_t { kSmooth, kDart, kCrease, kCorner };

  /// None. Nothing may be asked of it but that.
  MutantTags() = default;
  /// Tags of edges that do not exist are left out.
  MutantTags(const data::Sharpness& sharpness, const reference::Topology& topology,
             std::string_view mutation);

  bool is(std::string_view name) const { return mutation_ == name; }
  bool none() const { return vertex_.empty(); }
  bool smooth_triangles() const { return smooth_triangles_; }

  /// 0 and more; kForEver on the boundary.
  double edge(const reference::Topology& topology, std::int32_t e) const;
  double vertex(std::int32_t v) const { return vertex_[v]; }
  bool lasts(const reference::Topology& topology, std::int32_t e) const {
    return edge(topology, e) == kForEver;
  }

  /// Whether a vertex and the edges at it are untouched by tags: its rule is that of a mesh without.
  bool plain(const reference::Topology& topology, std::int32_t v) const;
  /// Whether the rule of a vertex is for ever the one that it has.
  bool settled(const reference::Topology& topology, std::int32_t v) const;

  /// Turns the points of a step by the rules of smooth meshes (vertices, edge points, ..) into those of a
  /// step with tags.
  void sharpen(const reference::Topology& topology, const std::vector<V>& points,
               std::vector<V>& refined) const;
  /// After that step.
  MutantTags refined(const reference::Topology& topology, const reference::Topology& finer) const;
  MutantTags of_part(const reference::Topology& topology, const reference::Topology& part,
                     const std::vector<std::int32_t>& vertices) const;

 private:
  // The rule of a vertex in a step and, of a crease, the two neighbours along it.
  struct Step {
    Rule rule;
    std::int32_t ends[2];
  };
  Step step(const reference::Topology& topology, std::int32_t v, bool next) const;
  V point(const Step& step, const std::vector<V>& points, std::int32_t v, const V& smooth) const;
  // What is left after a step of an edge at its end v, and of a vertex.
  double fallen(const reference::Topology& topology, std::int32_t e, std::int32_t v) const;
  double fallen(double sharpness) const;
  double edge_share(const reference::Topology& topology, std::int32_t e) const;
  double old_share(const reference::Topology& topology, std::int32_t v) const;

  std::vector<double> edge_, vertex_;
  bool chaikin_ = false, smooth_triangles_ = false;
  bool control_ = true;  // of the control mesh
  std::string_view mutation_ = "none";
};

struct Mutation {
  std::string_view name, description;
  std::string_view check;       // the row of the audit meant for it
  std::string_view claim = {};  // of the paper, where this is the paper taken literally
  bool in_float = false;        // delivered in float: small faults hide in wider bounds
  bool sharp = false;           // only sharp edges and vertices bring it out
};

/// All mutations of the rules of a scheme; the first is "none".
std::span<const Mutation> mutations(data::Scheme scheme);

/// A vertex c with its neighbours e_i and, in a mesh of quads, f_i, opposite c between e_i and e_{i+1}: n of
/// each inside, K + 1 and K in a sector, which begins and ends at sharp edges or at the boundary.
struct MutantRing {
  using V = reference::Vec3<double>;
  V c;
  std::vector<V> e, f;
  bool closed;

  /// In a mesh whose faces are all triangles or all quads.
  static MutantRing of(const reference::Topology& topology, const std::vector<V>& points, std::int32_t v);
  /// The sector of so many faces from face `first` on.
  MutantRing part(std::size_t first, std::size_t faces) const;
  /// A closed ring begun at e_first; an open one as it is.
  MutantRing turned(std::size_t first) const;
  std::size_t faces() const { return closed ? e.size() : e.size() - 1; }
  /// The sum of e_i x e_{i+1}, from c: of the triangles around, by their areas.
  V facets() const;
};

/// Of unit length; (0, 0, 1) for the zero vector.
MutantRing::V unit_or_up(const MutantRing::V& n);

/// The rules under one mutation, in double. Points are those of a mesh at some level.
class MutantRules {
 public:
  using V = reference::Vec3<double>;
  using Points = std::vector<V>;
  explicit MutantRules(std::string_view mutation) : mutation_(mutation) {}
  virtual ~MutantRules() = default;

  bool is(std::string_view name) const { return mutation_ == name; }
  std::string_view mutation() const { return mutation_; }

  /// Step number `step`, from 0, of `depth`: vertex points in the order of the vertices, then edge points,
  /// then, of quads, face points.
  virtual Points refine(const reference::Topology& topology, const Points& points, const MutantTags& tags,
                        int step, int depth) const = 0;
  /// At level `depth`, of a vertex without tags.
  virtual V limit(const MutantRing& ring, int depth) const = 0;
  /// Of unit length; of a vertex without tags, or on one side of a crease.
  virtual V normal(const MutantRing& ring) const = 0;
  /// The same of a vertex that is held.
  virtual V corner_normal(const MutantRing& ring) const = 0;
  /// Of a vertex at which one sharp edge ends, that to e_0; a direction.
  virtual V dart_limit(const MutantRing& ring) const = 0;
  virtual V dart_normal(const MutantRing& ring) const = 0;

 private:
  std::string_view mutation_;
};

///   weights   the family that the subject declares
///   refined   limit() leaves points as they are
std::unique_ptr<MutantRules> loop_rules(std::string_view mutation, reference::Weights weights, bool refined);
std::unique_ptr<MutantRules> quad_rules(std::string_view mutation);

// The meshes of the model from level to level, and the limits of the vertices of the deepest.

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
