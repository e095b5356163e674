// SPDX-License-Identifier: MIT
// Meshes refined by OpenSubdiv, for tests of what other schemes make of a mesh.
#pragma once

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <memory>
#include <utility>
#include <vector>

#include "data/control_mesh.h"
#include "verify/peers/opensubdiv_mesh.h"

namespace limitcheck::verify::test {

struct RefinedByOpenSubdiv {
  std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> refiner;  // with the faces of the last level
  std::vector<std::array<double, 3>> points;                  // of the last level
};

/// `steps` times, the last level moved to the limit if asked. In double.
inline RefinedByOpenSubdiv refined_by_opensubdiv(const data::ControlMesh& mesh,
                                                 OpenSubdiv::Sdc::SchemeType type,
                                                 OpenSubdiv::Sdc::Options::VtxBoundaryInterpolation boundary,
                                                 int steps, bool limit) {
  using namespace OpenSubdiv;
  using Point = OpenSubdivVector<double>;
  RefinedByOpenSubdiv result;
  const LentMesh lent(mesh, data::natural_scheme(mesh));
  result.refiner = make_refiner(lent.view(), type, boundary);
  Far::TopologyRefiner::UniformOptions uniform(steps);
  uniform.fullTopologyInLastLevel = true;
  result.refiner->RefineUniform(uniform);
  std::vector<Point> level;
  for (const auto& p : mesh.positions) level.push_back({p});
  const Far::PrimvarRefinerReal<double> primvars(*result.refiner);
  for (int step = 1; step <= steps; ++step) {
    std::vector<Point> next(result.refiner->GetLevel(step).GetNumVertices());
    primvars.Interpolate(step, level, next);
    level = std::move(next);
  }
  if (limit) {
    std::vector<Point> moved(level.size());
    primvars.Limit(level, moved);
    level = std::move(moved);
  }
  for (const Point& p : level) result.points.push_back(p.x);
  return result;
}

}  // namespace limitcheck::verify::test
