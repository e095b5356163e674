// SPDX-License-Identifier: MIT
// Limit masks of a vertex from the matrix of one step of its ring, by numbers alone: for vertices whose masks
// have no closed form.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace limitcheck::verify {

/// Weights of the points of a ring. Those of the tangents have the sum 0; first x second points outward.
struct RingMasks {
  std::vector<double> limit, first, second;
};

/// The left eigenvectors of a step that has a mirror: of the eigenvalue 1, of the largest other one among the
/// even ones and of the largest among the odd ones, each simple. Powers of the matrix become rows of them.
///   size     how many points
///   step     the points after a step, from those before
///   mirror   the point in which each point sees itself
///   even     an arrangement that the first tangent looks along, for its sign
///   odd      likewise for the second
/// O(size^3)
RingMasks ring_masks(std::size_t size,
                     const std::function<std::vector<double>(const std::vector<double>&)>& step,
                     const std::function<std::size_t(std::size_t)>& mirror, const std::vector<double>& even,
                     const std::vector<double>& odd);

}  // namespace limitcheck::verify
