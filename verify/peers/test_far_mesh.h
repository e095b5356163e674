// SPDX-License-Identifier: MIT
// A mesh refined by OpenSubdiv's Far in double, in the order of our own refinement. For tests of this folder.
#pragma once

#include <opensubdiv/far/primvarRefiner.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <type_traits>
#include <utility>
#include <vector>

#include "data/control_mesh.h"
#include "reference/catmull_clark/refined_mesh.h"
#include "reference/loop/refine.h"
#include "verify/peers/opensubdiv_mesh.h"

namespace limitcheck::verify::test {

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
    constexpr bool kQuads = std::is_same_v<Refined, Quads>;
    const LentMesh lent(mesh, kQuads ? data::Scheme::kCatmullClark : data::Scheme::kLoop);
    const auto refiner = make_refiner(lent.view());
    OpenSubdiv::Far::TopologyRefiner::UniformOptions uniform(depth);
    uniform.fullTopologyInLastLevel = true;
    refiner->RefineUniform(uniform);
    const OpenSubdiv::Far::PrimvarRefinerReal<double> primvars(*refiner);
    std::vector<OpenSubdivVector<double>> points;
    for (const auto& p : mesh.positions) points.push_back({p});
    std::vector<int> vertex(mesh.positions.size()), face(mesh.faces.size());  // Far's number of ours
    std::iota(vertex.begin(), vertex.end(), 0);
    std::iota(face.begin(), face.end(), 0);
    const auto in_our_order = [&](const std::vector<OpenSubdivVector<double>>& theirs) {
      std::vector<Vec3<double>> result;
      for (const int v : vertex) {
        const auto& x = theirs[static_cast<std::size_t>(v)].x;
        result.push_back({x[0], x[1], x[2]});
      }
      return result;
    };
    for (int level = 1; level <= depth; ++level) {
      std::vector<OpenSubdivVector<double>> next(
          static_cast<std::size_t>(refiner->GetLevel(level).GetNumVertices()));
      primvars.Interpolate(level, points, next);
      points.swap(next);
      const OpenSubdiv::Far::TopologyLevel& here = refiner->GetLevel(level - 1);
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
      refined = in_our_order(points);
      for (std::size_t v = 0; v < refined.size(); ++v)
        worst = std::max(worst, magnitude(ours.positions()[v] - refined[v]));
    }
    if (!with_limits) return;
    std::vector<OpenSubdivVector<double>> limit(points.size()), t1(points.size()), t2(points.size());
    primvars.Limit(points, limit, t1, t2);
    limits = in_our_order(limit);
    const auto first = in_our_order(t1), second = in_our_order(t2);
    for (std::size_t v = 0; v < first.size(); ++v) {
      normals.push_back(cross(first[v], second[v]));
      rule.push_back(refiner->GetLevel(depth).GetVertexRule(vertex[v]));
    }
  }
};

}  // namespace limitcheck::verify::test
