// SPDX-License-Identifier: MIT
// Arb's balls as a number type: every operation encloses the true result. Heavy: include from .cpp files.
#pragma once

#include <arb.h>
#include <fmpq.h>

#include <utility>

#include "reference/number/number_exact.h"

namespace limitcheck::reference {

/// A midpoint with a radius. Constructors are exact; operations round to the thread's `precision()` and widen
/// the radius.
class Ball {
 public:
  Ball() { arb_init(value_); }
  explicit Ball(int a) : Ball() { arb_set_si(value_, a); }
  Ball(const Ball& other) : Ball() { arb_set(value_, other.value_); }
  Ball(Ball&& other) noexcept : Ball() { arb_swap(value_, other.value_); }
  Ball& operator=(Ball other) noexcept {
    arb_swap(value_, other.value_);
    return *this;
  }
  ~Ball() { arb_clear(value_); }

  /// Bits of the midpoints, per thread; set before anything is computed, evaluators included.
  static long& precision() {
    thread_local long bits = 128;
    return bits;
  }

  arb_ptr raw() { return value_; }
  arb_srcptr raw() const { return value_; }

  friend Ball operator+(const Ball& a, const Ball& b) { return apply(arb_add, a, b); }
  friend Ball operator-(const Ball& a, const Ball& b) { return apply(arb_sub, a, b); }
  friend Ball operator*(const Ball& a, const Ball& b) { return apply(arb_mul, a, b); }
  friend Ball operator/(const Ball& a, const Ball& b) { return apply(arb_div, a, b); }
  Ball& operator+=(const Ball& b) {
    arb_add(value_, value_, b.value_, precision());
    return *this;
  }
  Ball& operator-=(const Ball& b) {
    arb_sub(value_, value_, b.value_, precision());
    return *this;
  }
  Ball& operator*=(const Ball& b) {
    arb_mul(value_, value_, b.value_, precision());
    return *this;
  }
  /// True only where it is certain.
  friend bool operator>(const Ball& a, const Ball& b) { return arb_gt(a.value_, b.value_) != 0; }
  friend bool operator<(const Ball& a, const Ball& b) { return arb_lt(a.value_, b.value_) != 0; }

 private:
  template <class F>
  static Ball apply(F f, const Ball& a, const Ball& b) {
    Ball result;
    f(result.value_, a.value_, b.value_, precision());
    return result;
  }
  arb_t value_;
};

template <>
struct NumberTraits<Ball> {
  static Ball cos_pi(long p, long q) {
    fmpq_t x;
    fmpq_init(x);
    fmpq_set_si(x, p, static_cast<ulong>(q));
    Ball result;
    arb_cos_pi_fmpq(result.raw(), x, Ball::precision());
    fmpq_clear(x);
    return result;
  }
  static Ball sqrt(const Ball& a) {
    Ball result;
    arb_sqrt(result.raw(), a.raw(), Ball::precision());
    return result;
  }
  static Ball cos(const Ball& a) {
    Ball result;
    arb_cos(result.raw(), a.raw(), Ball::precision());
    return result;
  }
  static Ball sin(const Ball& a) {
    Ball result;
    arb_sin(result.raw(), a.raw(), Ball::precision());
    return result;
  }
  /// Of the largest magnitude the ball may have: only used to bring numbers to a common scale, exactly.
  static long exponent(const Ball& a) {
    mag_t bound;
    mag_init(bound);
    arb_get_mag(bound, a.raw());
    const long e = mag_is_zero(bound) != 0 || mag_is_inf(bound) != 0 ? kZeroExponent
                                                                     : fmpz_get_si(MAG_EXPREF(bound)) - 1;
    mag_clear(bound);
    return e;
  }
  static Ball scale(const Ball& a, long e) {
    Ball result;
    arb_mul_2exp_si(result.raw(), a.raw(), e);
    return result;
  }
  static constexpr int kNormalThreshold = 0;  ///< a normal counts when its product is certainly not zero
  static constexpr int kRounding = 0;         ///< the radius has it
  static long precision() { return Ball::precision(); }
  static Ball from_double(double a) {
    Ball result;
    arb_set_d(result.raw(), a);
    return result;
  }
  static double approximate(const Ball& a) { return arf_get_d(arb_midref(a.raw()), ARF_RND_NEAR); }
  static Ball middle(const Ball& a) {
    Ball result;
    arf_set(arb_midref(result.raw()), arb_midref(a.raw()));
    return result;
  }
  /// No less than any |x| of the ball, without a radius.
  static Ball bound(const Ball& a) {
    mag_t bound;
    mag_init(bound);
    arb_get_mag(bound, a.raw());
    Ball result;
    arf_set_mag(arb_midref(result.raw()), bound);
    mag_clear(bound);
    return result;
  }
  static Ball widened(const Ball& a, const Ball& radius) {
    Ball result(a);
    arb_add_error(result.raw(), radius.raw());
    return result;
  }
  static Ball from_rational(const Rational& a) {
    fmpq_t x;
    fmpq_init(x);
    fmpq_set_mpq(x, a.backend().data());
    Ball result;
    arb_set_fmpq(result.raw(), x, Ball::precision());
    fmpq_clear(x);
    return result;
  }
};

}  // namespace limitcheck::reference
