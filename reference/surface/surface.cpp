// SPDX-License-Identifier: MIT
#include "reference/surface/surface.h"

namespace limitcheck::reference {

Surface::Surface(const data::ControlMesh& mesh, data::Scheme scheme, Weights weights)
    : evaluator_([&]() -> decltype(evaluator_) {
        if (scheme == data::Scheme::kLoop) return StamEvaluator<double>(mesh, weights);
        return catmull_clark::StamEvaluator<double>(mesh.faces, positions_of<double>(mesh), mesh.sharpness);
      }()) {}

RefinedSurface::RefinedSurface(const data::ControlMesh& mesh, data::Scheme scheme, int depth, Weights weights)
    : refined_([&]() -> decltype(refined_) {
        if (scheme == data::Scheme::kLoop) return refine<double>(mesh, depth, weights);
        catmull_clark::RefinedMesh<double> refined(mesh.faces, positions_of<double>(mesh), mesh.sharpness);
        for (int step = 0; step < depth; ++step) refined.refine();
        return refined;
      }()) {}

const Vec3<double>& RefinedSurface::position(int face, int corner, int i, int j) const {
  if (const auto* loop = std::get_if<RefinedMesh<double>>(&refined_))
    return loop->positions()[loop->vertex(face, i, j)];
  const auto& quads = std::get<catmull_clark::RefinedMesh<double>>(refined_);
  return quads.positions()[quads.vertex(face, corner, i, j)];
}

}  // namespace limitcheck::reference
