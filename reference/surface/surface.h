// SPDX-License-Identifier: MIT
// The surface of a control mesh in double, by either scheme.
#pragma once

#include <cstdint>
#include <variant>

#include "data/control_mesh.h"
#include "data/scheme.h"
#include "reference/catmull_clark/recursion.h"
#include "reference/catmull_clark/stam.h"
#include "reference/loop/refine.h"
#include "reference/loop/stam.h"

namespace limitcheck::reference {

/// The limit surface, evaluated by Stam's method. Errors and exceptions are those of loop/stam.h and
/// catmull_clark/stam.h; any number of threads may evaluate at once.
class Surface {
 public:
  ///   weights  of Loop's scheme
  Surface(const data::ControlMesh& mesh, data::Scheme scheme, Weights weights = Weights::kLoop)
      : Surface(mesh.faces, positions_of<double>(mesh), mesh.sharpness, scheme, weights) {}
  Surface(const data::Faces& faces, std::vector<Vec3<double>> positions, const SharpTags& tags,
          data::Scheme scheme, Weights weights = Weights::kLoop);

  /// At (l1, l2) of a triangle of Loop's scheme, whose corner is 0; at (u, v) of a quad, whose corner is 0,
  /// or of the sub-quad at a corner of another face.
  ///   Coordinate  double or Parameter
  template <class Coordinate>
  SurfacePoint<double> evaluate(int face, int corner, const Coordinate& first, const Coordinate& second,
                                Derivatives order = Derivatives::kSecond) const {
    if (const auto* loop = std::get_if<StamEvaluator<double>>(&evaluator_))
      return loop->evaluate(face, first, second, order);
    return std::get<catmull_clark::StamEvaluator<double>>(evaluator_)
        .evaluate(face, corner, first, second, order);
  }

 private:
  std::variant<StamEvaluator<double>, catmull_clark::StamEvaluator<double>> evaluator_;
};

/// The control mesh refined a number of times.
class RefinedSurface {
 public:
  RefinedSurface(const data::ControlMesh& mesh, data::Scheme scheme, int depth,
                 Weights weights = Weights::kLoop);

  /// The vertex at a lattice point of a face, counted from its corner as the refined meshes of the schemes
  /// do.
  const Vec3<double>& position(int face, int corner, int i, int j) const;

 private:
  std::variant<RefinedMesh<double>, catmull_clark::RefinedMesh<double>> refined_;
};

}  // namespace limitcheck::reference
