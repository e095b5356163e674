// SPDX-License-Identifier: MIT
// Semi-sharp edges and vertices of a mesh of quads: what each step makes of them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fast/mesh/quad_mesh.h"
#include "fast/rules/quad_star.h"

namespace limitcheck::fast {

/// The share of the midpoint in the point of an edge of this sharpness, whose halves get the others. Chaikin:
/// an edge below 1 with halves that stay sharp is a midpoint.
double edge_crease_share(double sharpness, double half, double other_half);

/// The share of the curve's rule in the point between two edges of these sharpnesses that go straight on.
double curve_share(double before, double after, data::Creasing creasing);

/// Part i of an edge that was cut into parts, and what the next step makes of it: the halves at either end.
struct SidePart {
  double sharpness = 0, first_half = 0, second_half = 0;
};

/// All steps of a point inside a semi-sharp edge, between two parts of it, for a star of four faces with the
/// parts along edges 0 (`after`) and 2 (`before`).
std::vector<StarTags> straight_steps(const SidePart& before, const SidePart& after, data::Creasing creasing);

/// The tags of every vertex for each of the steps in which it has some. Read-only once made.
class SemiSharp {
 public:
  explicit SemiSharp(const QuadMesh& mesh);

  /// One entry per step, at most 10; none at a vertex where nothing is semi-sharp.
  std::span<const StarTags> steps(std::int32_t v) const {
    return steps_.empty() ? std::span<const StarTags>{} : std::span<const StarTags>(steps_[v]);
  }
  const StarTags* step(std::int32_t v, std::size_t level) const {
    const auto all = steps(v);
    return level < all.size() ? &all[level] : nullptr;
  }

  /// The sharpness of the 2^level parts of half-edge h, from its origin on, for level = 0 .. levels, one
  /// level after the other; empty if the edge is not semi-sharp.
  void along(std::int32_t h, int levels, std::vector<double>& out) const;
  bool has(std::int32_t h) const { return !steps_.empty() && mesh_->side_sharpness[h] > 0; }
  data::Creasing creasing() const { return mesh_->creasing; }

 private:
  const QuadMesh* mesh_;
  std::vector<std::vector<StarTags>> steps_;
};

}  // namespace limitcheck::fast
