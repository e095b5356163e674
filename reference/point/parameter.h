// SPDX-License-Identifier: MIT
// A point's parameters on a face, kept apart from the number type of the evaluation: which piece of the
// surface a point lies on is decided exactly, and the same for every number type.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace limitcheck::reference {

struct RationalParameter;  // reference/point/parameter_exact.h

/// One of l1, l2: a double, taken as the exact binary fraction it is, or an exact rational.
class Parameter {
 public:
  Parameter(double value) : value_(value) {}  // NOLINT: a double is a parameter
  /// numerator / denominator; throws data::ArgumentError if the denominator is zero.
  static Parameter fraction(std::int64_t numerator, std::int64_t denominator);
  /// "1/3", "0.25", "-2", "1e-300": exactly. At most 10000 characters and exponents of +-10000.
  /// Throws data::ArgumentError on anything else.
  static Parameter parse(std::string_view text);

  /// 1 - l1 - l2, exactly
  static Parameter complement(const Parameter& l1, const Parameter& l2);

  bool is_double() const { return !exact_; }
  double as_double() const { return value_; }  ///< nearest double
  const RationalParameter* exact() const { return exact_.get(); }
  std::string to_string() const;  ///< "1/3"; the exact value of a double likewise

 private:
  double value_;
  std::shared_ptr<const RationalParameter> exact_;
};

}  // namespace limitcheck::reference
