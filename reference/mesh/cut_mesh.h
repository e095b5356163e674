// SPDX-License-Identifier: MIT
// A mesh with sharp edges and vertices, as evaluators take it: what a step makes of its points, the part that a
// face depends on, and the mesh cut along its sharp edges. The same in both schemes. Heavy: include from .cpp
// files.
#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "data/cut_out.h"
#include "reference/mesh/sharpness.h"
#include "reference/mesh/support.h"
#include "reference/number/vec3.h"
#include "reference/point/boundary_curve.h"
#include "reference/point/parameter_exact.h"

namespace limitcheck::reference {

/// Turns the points of a step by the smooth rules (vertices, edge points, ..) into those of a step with sharp
/// edges and vertices.
///   Rules   Sharpness, or what answers as it does
template <class N, class Rules>
void sharpen(const Topology& topology, const Rules& sharpness, const std::vector<Vec3<N>>& positions,
             std::vector<Vec3<N>>& refined) {
  const auto at = [&](std::int32_t v) -> const Vec3<N>& { return positions[static_cast<std::size_t>(v)]; };
  for (std::size_t e = 0; e < topology.edges().size(); ++e) {
    const Edge& edge = topology.edges()[e];
    if (sharpness.is_smooth(static_cast<std::int32_t>(e))) continue;
    const Rational share = sharpness.edge_share(topology, static_cast<std::int32_t>(e));
    if (edge.on_boundary() || share == 0) continue;
    Vec3<N>& point = refined[positions.size() + e];
    const Vec3<N> middle = boundary_edge_point(at(edge.a), at(edge.b));
    point = share == 1 ? middle : point + (middle - point) * number_from<N>(share);
  }
  for (std::size_t id = 0; id < positions.size(); ++id) {
    const auto v = static_cast<std::int32_t>(id);
    if (topology.sector(v).faces.empty() || sharpness.is_smooth_around(topology, v)) continue;
    const VertexRules rules = sharpness.rules(topology, v);
    const Vec3<N> smooth = refined[id], &c = positions[id];
    const auto point = [&](const VertexRules::One& one) -> Vec3<N> {
      if (one.rule == VertexRule::kCorner) return c;
      if (one.rule != VertexRule::kCrease) return smooth;
      return boundary_vertex_point(c, at(one.ends[0]), at(one.ends[1]));
    };
    refined[id] = point(rules.parent);
    if (rules.parent_share != 1) {
      const Vec3<N> child = point(rules.child);
      refined[id] = child + (refined[id] - child) * number_from<N>(rules.parent_share);
    }
  }
}

/// A mesh with its tags.
template <class N>
struct TaggedMesh {
  Topology topology;
  std::vector<Vec3<N>> positions;
  Sharpness sharpness;

  /// Some faces, which come first, and all that their surface depends on.
  TaggedMesh around(std::vector<std::int32_t> faces) const {
    faces = support_of(std::move(faces), topology, sharpness.creasing());
    const data::CutOut part = data::cut_out(topology.faces(), faces);
    Topology local(part.vertices.size(), part.faces);
    Sharpness sharp = sharpness.of_part(topology, local, faces, part.vertices);
    return {std::move(local), part.of(positions), std::move(sharp)};
  }
  /// Whether a face needs no step before its surface can be said.
  bool is_settled(std::size_t face) const { return !sharpness.needs_a_step(topology)[face]; }
  TaggedMesh around(std::size_t face) const {
    return around(std::vector<std::int32_t>{static_cast<std::int32_t>(face)});
  }
};

/// Where anybody will ask for the surface of a face: nowhere, everywhere, or at that corner.
constexpr int kNowhere = -2, kEverywhere = -1;
inline int asked_of(const std::vector<int>& asked, std::size_t face) {
  return asked.empty() ? kEverywhere : asked[face];
}

/// A mesh that is cut along its sharp edges. It has the surface of all faces but those near semi-sharp tags.
template <class N>
struct CutMesh {
  Topology topology;
  std::vector<Vec3<N>> positions;
  std::vector<VertexState> states;  ///< of the vertices; empty if all are ordinary
  /// Faces whose surface this mesh does not have, since semi-sharp tags are near: theirs are those of
  /// `tagged`, which has the same faces and is not cut.
  std::vector<bool> needs_a_step;
  std::shared_ptr<const TaggedMesh<N>> tagged;

  CutMesh(std::vector<Vec3<N>> points, data::Faces faces, const SharpTags& tags = {})
      : topology(points.size(), std::move(faces)), positions(std::move(points)) {
    if (tags.empty()) return;
    Sharpness sharpness(topology, tags);
    settle({std::move(topology), std::move(positions), std::move(sharpness)});
  }
  explicit CutMesh(TaggedMesh<N> mesh) : topology(mesh.topology) { settle(std::move(mesh)); }

  bool is_settled(std::size_t face) const { return !tagged || !needs_a_step[face]; }
  /// Whether anybody will ask for the surface of a face that has one here.
  bool is_answered(std::size_t face, const std::vector<int>& asked) const {
    return asked_of(asked, face) != kNowhere && is_settled(face);
  }
  bool answers_any(const std::vector<int>& asked) const {
    for (std::size_t f = 0; f < topology.faces().size(); ++f)
      if (is_answered(f, asked)) return true;
    return false;
  }

 protected:
  void settle(TaggedMesh<N> mesh) {
    needs_a_step = mesh.sharpness.needs_a_step(mesh.topology);
    Sharpness::Cut cut = mesh.sharpness.cut(mesh.topology);
    positions.clear();
    for (const std::int32_t v : cut.origin) positions.push_back(mesh.positions[static_cast<std::size_t>(v)]);
    states = std::move(cut.states);
    topology = Topology(positions.size(), std::move(cut.faces));
    if (std::find(needs_a_step.begin(), needs_a_step.end(), true) != needs_a_step.end())
      tagged = std::make_shared<const TaggedMesh<N>>(std::move(mesh));
  }
};

/// The step after an evaluator's mesh, of the faces alone whose surface it cannot say yet.
///
/// Near semi-sharp tags a face has no evaluator before so many steps. Faces that need one are refined
/// together, and what is settled then has an evaluator of its own: the levels of a mesh with a crease of
/// sharpness s grow twofold from step to step, s times. But a point at a corner stays at one corner of one
/// sub-face: for these there are steps apart, that do not grow. Made when a point there is first asked for.
///   Data   the evaluator of a mesh: Data(TaggedMesh<N>, where its faces are asked); corner_of_child(k) is the
///          corner of sub-face k that is corner k of its face
template <class N, class Data>
class NextStep {
 public:
  /// `needs_a_step` of the faces; `asked` of each, everywhere if it is empty.
  NextStep(const std::vector<bool>& needs_a_step, const std::vector<int>& asked) {
    for (std::size_t f = 0; f < needs_a_step.size(); ++f) {
      const int where = asked_of(asked, f);
      if (!needs_a_step[f] || where == kNowhere) continue;
      corners_.add(f, where);
      if (where == kEverywhere) all_.add(f, where);
    }
  }

  /// Goes on to sub-face k of a face that needs the step: its number among the faces of what is returned. Any
  /// number of threads may ask.
  ///   at_corner   whether the point is at corner k of the face
  ///   refine      of a TaggedMesh<N>, one step
  template <class Refine, class... More>
  const Data& descend(std::size_t& face, int k, bool at_corner, const TaggedMesh<N>& mesh, Refine refine,
                      const More&... more) const {
    const Step& step = at_corner ? corners_ : all_;
    std::call_once(step.once, [&] {
      TaggedMesh<N> finer = refine(mesh.around(step.faces));
      std::vector<int> asked(finer.topology.faces().size(), kNowhere);
      for (std::size_t child = 0; child < 4 * step.faces.size(); ++child) {
        const int from = step.asked[child / 4], number = static_cast<int>(child % 4);
        if (!at_corner)
          asked[child] = kEverywhere;
        else if (from == kEverywhere || from == number)
          asked[child] = Data::corner_of_child(number);
      }
      step.data = std::make_unique<const Data>(std::move(finer), asked, more...);
    });
    const auto part = std::lower_bound(step.faces.begin(), step.faces.end(), static_cast<std::int32_t>(face));
    face = 4 * static_cast<std::size_t>(part - step.faces.begin()) + static_cast<std::size_t>(k);
    return *step.data;
  }

 private:
  struct Step {
    std::vector<std::int32_t> faces;  ///< that need it, rising
    std::vector<int> asked;           ///< of each of these
    mutable std::once_flag once;
    mutable std::unique_ptr<const Data> data;

    void add(std::size_t face, int where) {
      faces.push_back(static_cast<std::int32_t>(face));
      asked.push_back(where);
    }
  };
  Step all_, corners_;
};

}  // namespace limitcheck::reference
