// SPDX-License-Identifier: MIT
// Meshes refined by OpenSubdiv's Far in double: as it has them, and in the order of our own refinement. For tests.
#pragma once

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <type_traits>
#include <utility>
#include <vector>

#include "data/control_mesh.h"
#include "reference/catmull_clark/recursion.h"
#include "reference/loop/refine.h"
#include "verify/peers/opensubdiv_mesh.h"

namespace limitcheck::verify::test {

struct RefinedByOpenSubdiv {
  using Points = std::vector<std::array<double, 3>>;

  std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> refiner;  // with the faces of the last level
  std::vector<Points> levels;                                 // the points of each, before any limit
  Points points;                                              // of the last level, at the limit if asked
  Points first, second;                                       // tangents there, if asked
};

/// `steps` times, the last level moved to the limit if asked.
inline RefinedByOpenSubdiv refined_by_opensubdiv(const data::ControlMesh& mesh,
                                                 OpenSubdiv::Sdc::SchemeType type,
                                                 OpenSubdiv::Sdc::Options::VtxBoundaryInterpolation boundary,
                                                 int steps, bool limit) {
  using namespace OpenSubdiv;
  using Level = std::vector<OpenSubdivVector<double>>;
  RefinedByOpenSubdiv result;
  const LentMesh lent(mesh, type == Sdc::SCHEME_LOOP ? data::Scheme::kLoop : data::Scheme::kCatmullClark);
  result.refiner = make_refiner(lent.view(), type, boundary);
  Far::TopologyRefiner::UniformOptions uniform(steps);
  uniform.fullTopologyInLastLevel = true;
  result.refiner->RefineUniform(uniform);
  const Far::PrimvarRefinerReal<double> primvars(*result.refiner);
  const auto plain = [](const Level& level) {
    RefinedByOpenSubdiv::Points points;
    for (const auto& p : level) points.push_back(p.x);
    return points;
  };
  Level level;
  for (const auto& p : mesh.positions) level.push_back({p});
  result.levels.push_back(mesh.positions);
  for (int step = 1; step <= steps; ++step) {
    Level next(static_cast<std::size_t>(result.refiner->GetLevel(step).GetNumVertices()));
    primvars.Interpolate(step, level, next);
    level = std::move(next);
    result.levels.push_back(plain(level));
  }
  result.points = result.levels.back();
  if (!limit) return result;
  Level moved(level.size()), first(level.size()), second(level.size());
  primvars.Limit(level, moved, first, second);
  result.points = plain(moved), result.first = plain(first), result.second = plain(second);
  return result;
}

using reference::Vec3;
using Quads = reference::catmull_clark::RefinedMesh<double>;
using Triangles = reference::RefinedMesh<double>;

template <class Refined>
Refined reference_of(const data::ControlMesh& mesh) {
  if constexpr (std::is_same_v<Refined, Triangles>) {
    return Triangles(mesh);
  } else {
    return Quads(mesh.faces, reference::positions_of<double>(mesh), mesh.sharpness);
  }
}

inline double largest_of(const data::ControlMesh& mesh) {
  double largest = 0;
  for (const auto& p : mesh.positions)
    largest = std::max({largest, std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
  return largest;
}

inline double degrees(const Vec3<double>& a, const Vec3<double>& b) {
  return std::atan2(magnitude(cross(a, b)), dot(a, b)) * 180 / 3.14159265358979323846;
}

/// A mesh refined by OpenSubdiv in the order of our refinement.
///   Refined   Quads or Triangles
template <class Refined>
struct FarMesh {
  Refined ours;                                     ///< after all steps
  std::vector<Vec3<double>> refined;                ///< their points then
  std::vector<Vec3<double>> limits, normals;        ///< empty if nobody asks; normals of any length
  std::vector<OpenSubdiv::Sdc::Crease::Rule> rule;  ///< of each vertex
  double worst = 0;                                 ///< difference between refined points after any step

  FarMesh(const data::ControlMesh& mesh, int depth, bool with_limits = true)
      : ours(reference_of<Refined>(mesh)) {
    using namespace OpenSubdiv;
    constexpr bool kQuads = std::is_same_v<Refined, Quads>;
    const bool held = mesh.sharpness.boundary == data::Boundary::kEdgeAndCorner;
    const RefinedByOpenSubdiv theirs = refined_by_opensubdiv(
        mesh, kQuads ? Sdc::SCHEME_CATMARK : Sdc::SCHEME_LOOP,
        held ? Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER : Sdc::Options::VTX_BOUNDARY_EDGE_ONLY, depth,
        with_limits);
    std::vector<int> vertex(mesh.positions.size()), face(mesh.faces.size());  // Far's number of ours
    std::iota(vertex.begin(), vertex.end(), 0);
    std::iota(face.begin(), face.end(), 0);
    const auto in_our_order = [&](const RefinedByOpenSubdiv::Points& points) {
      std::vector<Vec3<double>> result;
      for (const int v : vertex) {
        const auto& p = points[static_cast<std::size_t>(v)];
        result.push_back({p[0], p[1], p[2]});
      }
      return result;
    };
    for (int level = 1; level <= depth; ++level) {
      const Far::TopologyLevel& here = theirs.refiner->GetLevel(level - 1);
      std::vector<int> next_vertex, next_face;
      for (const int v : vertex) next_vertex.push_back(here.GetVertexChildVertex(v));
      for (const auto& e : ours.topology().edges())
        next_vertex.push_back(here.GetEdgeChildVertex(
            here.FindEdge(vertex[static_cast<std::size_t>(e.a)], vertex[static_cast<std::size_t>(e.b)])));
      if (kQuads)
        for (const int f : face) {
          next_vertex.push_back(here.GetFaceChildVertex(f));
          const auto children = here.GetFaceChildFaces(f);
          for (int k = 0; k < children.size(); ++k) next_face.push_back(children[k]);
        }
      vertex = std::move(next_vertex), face = std::move(next_face);
      ours.refine();
      refined = in_our_order(theirs.levels[static_cast<std::size_t>(level)]);
      for (std::size_t v = 0; v < refined.size(); ++v)
        worst = std::max(worst, magnitude(ours.positions()[v] - refined[v]));
    }
    if (!with_limits) return;
    limits = in_our_order(theirs.points);
    const auto first = in_our_order(theirs.first), second = in_our_order(theirs.second);
    for (std::size_t v = 0; v < first.size(); ++v) {
      normals.push_back(cross(first[v], second[v]));
      rule.push_back(theirs.refiner->GetLevel(depth).GetVertexRule(vertex[v]));
    }
  }
};

}  // namespace limitcheck::verify::test
