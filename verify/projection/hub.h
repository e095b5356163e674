// SPDX-License-Identifier: MIT
// The limit surface near a vertex of very many faces, in a time that does not grow with their number.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "data/control_mesh.h"
#include "data/scheme.h"
#include "reference/mesh/topology.h"
#include "reference/surface/surface.h"
#include "verify/projection/chart.h"

namespace limitcheck::verify {

/// Stam's method sums over as many modes as the vertex has faces, for each point near it. But the mesh around
/// the vertex after j steps has the same surface, and on its faces at the vertex Stam's method takes the
/// points of the outer three quarters from polynomials. So a point is evaluated on the mesh after the steps
/// that bring it there; positions differ from Stam's by the rounding of these steps.
class Hub {
 public:
  /// Of a mesh without sharp edges. O(faces at the vertex) steps, and what the evaluator costs, for each level.
  Hub(const data::ControlMesh& mesh, const reference::Topology& topology, data::Scheme scheme,
      std::int32_t vertex);

  /// At a point of a face at the vertex, with the derivatives by the second and third coordinate of `at`.
  ///   corner   of the face that is the vertex
  /// Nothing where the mesh itself has polynomials, and very near the vertex.
  std::optional<reference::SurfacePoint<double>> evaluate(std::int32_t face, int corner,
                                                          const Chart::Affine& at,
                                                          reference::Order order) const;

 private:
  struct Level {
    data::ControlMesh mesh;
    std::unique_ptr<reference::Surface> surface;
  };

  data::Scheme scheme_;
  std::vector<std::int32_t> faces_;  // at the vertex, ascending; they are the first of each level's, in order
  std::vector<Level> levels_;        // after 1, 2 .. steps
};

}  // namespace limitcheck::verify
