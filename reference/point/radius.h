// SPDX-License-Identifier: MIT
// The radius of a ball, of any size.
#pragma once

#include <compare>
#include <string>

namespace limitcheck::reference {

/// An upper bound as a decimal with an exponent of its own, so that those of curvatures of 1e600 and of points
/// of 1e-300 are what they are: digits * 10^exponent with 1 <= digits < 10; 0; or infinite.
class Radius {
 public:
  Radius() = default;
  /// Any digits >= 0, infinity included.
  Radius(double digits, long exponent);

  bool is_zero() const { return digits_ == 0; }
  /// Not less: infinite beyond the largest double, and the least above zero below it.
  double as_double() const;
  /// So many significant digits, 1 .. 17, not less: "4.3e-20", "0", "inf".
  std::string to_string(int digits = 2) const;

  friend auto operator<=>(const Radius&, const Radius&) = default;

 private:
  long exponent_ = -(1L << 40);  // of zero; first, as it decides which is larger
  double digits_ = 0;
};

}  // namespace limitcheck::reference
