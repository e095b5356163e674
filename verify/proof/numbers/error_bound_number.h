// SPDX-License-Identifier: MIT
// A number that knows how wrong the float in its place can be, for every control mesh in a box at once.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "fast/rules/masks.h"

namespace limitcheck::verify {

/// The floating-point arithmetic that is modelled: each operation returns the float nearest to the exact
/// result of its operands. The flags plant faults: what they name is then taken as exact.
struct RoundingModel {
  double unit = 0x1p-24;       // float: half a unit in the last place of 1
  double wide_unit = 0x1p-53;  // double, in which rings are summed
  bool sums = true, products = true, fused = true, narrowing = true, constants = true;
};

/// Opens a computation: the box that control coordinates lie in, |x| <= reach, and the arithmetic. Numbers
/// live no longer than the scope they were made in; one scope per thread at a time.
class BoundScope {
 public:
  explicit BoundScope(double reach, const RoundingModel& model = {});
  ~BoundScope();
  BoundScope(const BoundScope&) = delete;
  BoundScope& operator=(const BoundScope&) = delete;
};

/// All kernels compute linear functions of the control points, so what a float program returns is, exactly,
///
///     sum_i w_i x_i + sum_k c_k d_k      x_i   control coordinates, |x_i| <= reach; and the constant 1
///                                        d_k   the error that operation k commits, |d_k| <= m_k
///
/// and the true value is the first sum. The form carries both rows of weights. m_k follows from the largest
/// value that operation k can return over the whole box, itself read off its form; the error of a result is
/// at most sum |c_k| m_k. Because the c_k are kept apart, an error that later steps damp, or that leaves
/// again (a local origin), counts for what is left of it: no step's bound is multiplied up.
///
/// m_k: a value of at most B, 2^p <= B < 2^(p+1), is rounded by at most unit * 2^p, and by no more than
/// max(unit * 2^(p-1), B - 2^p), since 2^p itself is a float. 2^-150 more covers underflow.
///
/// The weights are doubles. `slop` bounds what they lose (2^-51 of every sum), what constants are known to,
/// and the operations in double; both the computed and the true value are that near to their sums.
struct BoundForm {
  struct Term {
    std::int32_t column;
    double weight;
  };
  std::vector<Term> terms;  // by column
  double slop = 0;

  bool is_zero() const { return terms.empty() && slop == 0; }
  bool bounded() const;
  bool is_constant() const;  ///< no control point in it
  double constant() const;   ///< the weight of 1
  double magnitude() const;  ///< upper bound of the computed value's size
  double true_magnitude() const;
  double error() const;  ///< upper bound of |computed - true|

  static BoundForm variable();
  static BoundForm exact(double value);
  static BoundForm unbounded();
  /// A constant known to 2^-53 relative plus `doubt`, rounded to the kernel's precision.
  static BoundForm rounded_constant(double value, double doubt, bool single, bool is_exact);

  static BoundForm sum(const BoundForm& a, double sign, const BoundForm& b, bool single);
  static BoundForm product(const BoundForm& a, const BoundForm& b, bool single);
  static BoundForm quotient(const BoundForm& a, const BoundForm& b, bool single);
  /// a * b + sign * c in one rounding.
  static BoundForm fused(const BoundForm& a, const BoundForm& b, double sign, const BoundForm& c);
  static BoundForm negated(BoundForm a);
  static BoundForm narrowed(BoundForm a);
};

/// The form as a number type. A product of two numbers neither of which is constant, or a root, is no linear
/// function: its bound is infinite, and comparisons with it are false.
template <bool kSingle>
class BoundNumber {
 public:
  BoundNumber() = default;
  explicit BoundNumber(int value) : form_(BoundForm::exact(value)) {}
  /// What a constant of a float kernel becomes if it is no float.
  explicit BoundNumber(double value)
      : form_(kSingle && static_cast<double>(static_cast<float>(value)) != value
                  ? BoundForm::rounded_constant(value, 0, true, false)
                  : BoundForm::exact(value)) {}
  explicit BoundNumber(BoundForm form) : form_(std::move(form)) {}
  /// To float: one rounding. To double: exact.
  explicit BoundNumber(const BoundNumber<!kSingle>& other)
      : form_(kSingle ? BoundForm::narrowed(other.form()) : other.form()) {}

  const BoundForm& form() const { return form_; }
  double error() const { return form_.error(); }

  friend BoundNumber operator+(const BoundNumber& a, const BoundNumber& b) {
    return BoundNumber(BoundForm::sum(a.form_, 1, b.form_, kSingle));
  }
  friend BoundNumber operator-(const BoundNumber& a, const BoundNumber& b) {
    return BoundNumber(BoundForm::sum(a.form_, -1, b.form_, kSingle));
  }
  friend BoundNumber operator-(const BoundNumber& a) { return BoundNumber(BoundForm::negated(a.form_)); }
  friend BoundNumber operator*(const BoundNumber& a, const BoundNumber& b) {
    return BoundNumber(BoundForm::product(a.form_, b.form_, kSingle));
  }
  friend BoundNumber operator/(const BoundNumber& a, const BoundNumber& b) {
    return BoundNumber(BoundForm::quotient(a.form_, b.form_, kSingle));
  }
  friend BoundNumber sqrt(const BoundNumber&) { return BoundNumber(BoundForm::unbounded()); }
  friend bool operator<(const BoundNumber& a, const BoundNumber& b) { return certain(a, b, -1); }
  friend bool operator>(const BoundNumber& a, const BoundNumber& b) { return certain(a, b, 1); }
  friend bool operator<=(const BoundNumber& a, const BoundNumber& b) { return certain(a, b, -1); }
  friend bool operator>=(const BoundNumber& a, const BoundNumber& b) { return certain(a, b, 1); }
  friend bool operator==(const BoundNumber& a, const BoundNumber& b) {
    return a.form_.is_zero() && b.form_.is_zero();
  }

 private:
  // Of constants only: the kernels branch on nothing else.
  static bool certain(const BoundNumber& a, const BoundNumber& b, double sign) {
    return a.form_.bounded() && b.form_.bounded() && a.form_.is_constant() && b.form_.is_constant() &&
           sign * (a.form_.constant() - b.form_.constant()) > a.error() + b.error();
  }
  BoundForm form_;
};

using BoundFloat = BoundNumber<true>;
using BoundDouble = BoundNumber<false>;

}  // namespace limitcheck::verify

namespace limitcheck::fast {

/// Ratios are rounded once; cosines and sines of 2 pi p / q come from the C library in double: its argument
/// and its result are right to 2^-47 together (both are below 25 units in the last place of 2 pi).
template <bool kSingle>
struct NumberTraits<verify::BoundNumber<kSingle>> {
  using Number = verify::BoundNumber<kSingle>;
  using Scalar = Number;
  using Wide = verify::BoundNumber<false>;
  static Scalar ratio(int p, int q) {
    const bool power = (q & (q - 1)) == 0;
    return Number(verify::BoundForm::rounded_constant(static_cast<double>(p) / q, 0, kSingle, power));
  }
  static Scalar cosine(int p, int q) { return angle(std::cos(2 * std::numbers::pi * p / q)); }
  static Scalar sine(int p, int q) { return angle(std::sin(2 * std::numbers::pi * p / q)); }
  static Wide widen(const Number& v) { return Wide(v); }
  static Number narrow(const Wide& v) { return Number(v); }

 private:
  static Scalar angle(double value) {
    return Number(verify::BoundForm::rounded_constant(value, 0x1p-47, kSingle, false));
  }
};

}  // namespace limitcheck::fast
