// SPDX-License-Identifier: MIT
#include "reference/surface/surface.h"

namespace limitcheck::reference {

Surface::Surface(const data::Faces& faces, std::vector<Vec3<double>> positions, const SharpTags& tags,
                 data::Scheme scheme, Weights weights)
    : evaluator_([&]() -> decltype(evaluator_) {
        if (scheme == data::Scheme::kCatmullClark)
          return catmull_clark::StamEvaluator<double>(faces, std::move(positions), tags);
        return StamEvaluator<double>(std::move(positions), data::Triangles(faces).to_vector(), weights, tags);
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
