// SPDX-License-Identifier: MIT
// The weights of a dart of many quads, in time linear in its valence.
#pragma once

#include "fast/rules/quad_limit.h"

namespace limitcheck::fast::detail {

/// From so many faces on a dart's weights come from a recurrence and not from powers of its matrix, which take
/// 20 n^3 operations.
inline constexpr int kLargeDart = 64;

/// The error of a weight, for each face, in units of the largest weight of its kind (tangents; measured: a
/// quarter of this at 100 000 faces).
inline constexpr double kLargeDartError = 0x1p-52 * 2;

/// Position and du of star_weights<double>(n, ., kDart), dv left empty. All neighbours but e_0 follow one rule,
/// as if e_0 had no weight: the weights solve a difference equation with zeros at both ends.
StarWeights<double> large_dart_weights(int n);

}  // namespace limitcheck::fast::detail
