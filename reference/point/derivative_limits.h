// SPDX-License-Identifier: MIT
// Which derivatives the surface has at a vertex, from the eigenvalues of its subdivision.
//
// A step halves the parameters, so that after J of them a mode of eigenvalue mu has a share of (2^d mu)^J in
// the derivatives of order d, unless it is a polynomial in the parameters on every face: then mu is 2^-degree
// and it has no share in derivatives above its degree and a constant one in those of it. The largest mu of
// the others decides. Each scheme lists the modes of each kind of vertex in its leading_modes.h.
#pragma once

#include <array>
#include <cstdint>

namespace limitcheck::reference {

/// A part of the surface around a vertex that a step multiplies by its eigenvalue.
struct Mode {
  double eigenvalue = 0;
  int degree = 0;  ///< of the polynomial that it is on each face, 0 if it is none
};
/// Those below the 1 of the limit point, largest first, as far as they decide on two orders.
using LeadingModes = std::array<Mode, 3>;

/// Where the subdivision is that of a regular mesh.
inline constexpr LeadingModes kRegularModes{{{.5, 1}, {.25, 2}, {.125}}};

/// What becomes of the derivatives of one order towards a vertex, from within a face, for control points in
/// general.
enum class Fate : std::uint8_t {
  kValue,    ///< they tend to those of a polynomial
  kZero,     ///< they fall to zero: growth < 1 and no such polynomial
  kNoLimit,  ///< growth = 1: they depend on the direction, or grow like the logarithm of the distance
  kGrows     ///< growth > 1
};
struct DerivativeLimit {
  Fate fate = Fate::kValue;
  double eigenvalue = 0;  ///< that decides
  double growth = 0;  ///< 2^order eigenvalue: the factor of the derivatives, or of what they lack to their
                      ///< limit, for each halving of the distance
  bool exists() const { return fate <= Fate::kZero; }
};

constexpr DerivativeLimit derivative_limit(const LeadingModes& modes, int order) {
  constexpr double kSame = 1e-9;  // eigenvalues of different valences are farther from a power of two
  bool has_value = false;
  for (const Mode& mode : modes) {
    const double growth = mode.eigenvalue * (1 << order);
    if (mode.degree == order) has_value = true;
    if (mode.degree > 0 && mode.degree <= order) continue;
    const Fate fate = growth > 1 + kSame   ? Fate::kGrows
                      : growth > 1 - kSame ? Fate::kNoLimit
                      : has_value          ? Fate::kValue
                                           : Fate::kZero;
    return {fate, mode.eigenvalue, growth};
  }
  return {};
}

/// Of a vertex.
struct DerivativeLimits {
  DerivativeLimit first, second;
  bool along_boundary =
      false;  ///< on the boundary or a crease, which is a cubic B-spline: along it all exist

  constexpr DerivativeLimits() = default;
  constexpr DerivativeLimits(const LeadingModes& modes, bool has_boundary)
      : first(derivative_limit(modes, 1)), second(derivative_limit(modes, 2)), along_boundary(has_boundary) {}
};

}  // namespace limitcheck::reference
