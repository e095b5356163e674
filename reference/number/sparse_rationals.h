// SPDX-License-Identifier: MIT
// A list of exact numbers of which nearly all are 0: these take four bytes and no memory of their own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "reference/number/number_exact.h"

namespace limitcheck::reference {

class SparseRationals {
 public:
  explicit SparseRationals(std::size_t count = 0) : place_(count) {}

  std::size_t size() const { return place_.size(); }
  bool is_zero(std::size_t i) const { return place_[i] == 0; }
  const Rational& operator[](std::size_t i) const { return values_[static_cast<std::size_t>(place_[i])]; }
  void set(std::size_t i, const Rational& value) {
    place_[i] = 0;
    if (value == 0) return;
    place_[i] = static_cast<std::int32_t>(values_.size());
    values_.push_back(value);
  }

 private:
  std::vector<std::int32_t> place_;  // in values_
  std::vector<Rational> values_{Rational(0)};
};

}  // namespace limitcheck::reference
