// SPDX-License-Identifier: MIT
// Numbers for the tests of this folder: exact rationals, and linear forms over the control points.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>
#include <map>
#include <stdexcept>

#include "fast/rules/masks.h"

namespace limitcheck::fast {

using Rational =
    boost::multiprecision::number<boost::multiprecision::cpp_rational_backend, boost::multiprecision::et_off>;

/// constant + sum weight[i] * (control point i). Products need a constant on one side.
struct Form {
  Rational constant = 0;
  std::map<int, Rational> weights;

  Form() = default;
  template <class X>
  requires std::is_constructible_v<Rational, X>
  explicit Form(const X& x) : constant(x) {}
  static Form point(int i) {
    Form f;
    f.weights[i] = 1;
    return f;
  }

  friend bool operator==(const Form&, const Form&) = default;
  friend Form operator+(Form a, const Form& b) {
    a.constant += b.constant;
    for (const auto& [i, w] : b.weights) a.weights[i] += w;
    return a;
  }
  friend Form operator-(const Form& a) { return Rational(-1) * a; }
  friend Form operator-(const Form& a, const Form& b) { return a + -b; }
  friend Form operator*(const Rational& s, Form a) {
    a.constant *= s;
    for (auto& [i, w] : a.weights) w *= s;
    return a;
  }
  friend Form operator*(const Form& a, const Form& b) {
    if (!a.weights.empty() && !b.weights.empty()) throw std::logic_error("not linear");
    return a.weights.empty() ? a.constant * b : b.constant * a;
  }
  friend Form operator/(const Form& a, const Form& b) {
    if (!b.weights.empty()) throw std::logic_error("not linear");
    return 1 / b.constant * a;
  }
};

template <>
struct NumberTraits<Rational> {
  using Scalar = Rational;
  using Wide = Rational;
  static Rational cosine(int p, int q) {
    if (p != 1) throw std::domain_error("only 2 pi / q");
    switch (q) {
      case 2:
        return -1;
      case 3:
        return Rational(-1, 2);
      case 4:
        return 0;
      case 6:
        return Rational(1, 2);
      default:
        throw std::domain_error("not rational");
    }
  }
  static const Rational& widen(const Rational& x) { return x; }
  static const Rational& narrow(const Rational& x) { return x; }
};

template <>
struct NumberTraits<Form> {
  using Scalar = Rational;
  using Wide = Form;
  static const Form& widen(const Form& x) { return x; }
  static const Form& narrow(const Form& x) { return x; }
};

}  // namespace limitcheck::fast
