// SPDX-License-Identifier: MIT
// The number that a kernel runs on to show what it does: a row of weights over the control points.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "fast/rules/masks.h"
#include "verify/proof/numbers/coefficient.h"

namespace limitcheck::verify {

/// A kernel that multiplies two control points, takes a root or asks which is larger is no linear map.
struct NotLinear : std::logic_error {
  using std::logic_error::logic_error;
};

/// constant + sum of weight * control point, the points in rising order, no weight zero. Numbers that do not
/// depend on the control points are stencils too: with a constant alone.
///   C   the number type of the weights (coefficient.h)
template <class C>
class Stencil {
 public:
  struct Entry {
    int point;
    C weight;
  };
  using Entries = std::vector<Entry>;
  using K = Coefficient<C>;

  Stencil() = default;
  explicit Stencil(C constant) : constant_(std::move(constant)) {}
  explicit Stencil(int constant) : constant_(constant) {}
  /// For constants of rules that have none in a linear kernel: only small dyadic numbers. Throws NotLinear.
  explicit Stencil(double constant) : constant_(dyadic(constant)) {}
  /// Control point number `point` itself.
  static Stencil control_point(int point) {
    Stencil s;
    s.entries_.push_back({point, C(1)});
    return s;
  }

  const C& constant() const { return constant_; }
  const Entries& entries() const { return entries_; }

  friend Stencil operator+(const Stencil& a, const Stencil& b) { return merged<false>(a, b); }
  friend Stencil operator-(const Stencil& a, const Stencil& b) { return merged<true>(a, b); }
  friend Stencil operator-(const Stencil& a) { return merged<true>(Stencil(), a); }
  friend Stencil operator*(const C& s, const Stencil& a) { return a.scaled(s); }
  friend Stencil operator*(const Stencil& a, const Stencil& b) {
    if (a.entries_.empty()) return b.scaled(a.constant_);
    if (b.entries_.empty()) return a.scaled(b.constant_);
    throw NotLinear("a product of control points");
  }
  friend Stencil operator/(const Stencil& a, const Stencil& b) {
    if (!b.entries_.empty()) throw NotLinear("a quotient of control points");
    return a.scaled(C(1) / b.constant_);
  }
  friend Stencil sqrt(const Stencil&) { throw NotLinear("a square root"); }
  friend bool operator==(const Stencil&, const Stencil&) { throw NotLinear("a comparison"); }
  friend bool operator<(const Stencil&, const Stencil&) { throw NotLinear("a comparison"); }
  friend bool operator>(const Stencil&, const Stencil&) { throw NotLinear("a comparison"); }
  friend bool operator<=(const Stencil&, const Stencil&) { throw NotLinear("a comparison"); }
  friend bool operator>=(const Stencil&, const Stencil&) { throw NotLinear("a comparison"); }

 private:
  static C dyadic(double value) {
    int twos = 0;
    for (; value != static_cast<int>(value); value *= 2)
      if (++twos > 30) throw NotLinear("the constant " + std::to_string(value));
    C result(static_cast<int>(value));
    for (; twos > 0; --twos) result *= K::ratio(1, 2);
    return result;
  }

  void push(int point, const C& weight) {
    if (!K::is_zero(weight)) entries_.push_back({point, weight});
  }

  template <bool kMinus>
  static Stencil merged(const Stencil& a, const Stencil& b) {
    Stencil s;
    s.constant_ = a.constant_;
    kMinus ? s.constant_ -= b.constant_ : s.constant_ += b.constant_;
    if (b.entries_.empty()) {
      s.entries_ = a.entries_;
      return s;
    }
    s.entries_.reserve(a.entries_.size() + b.entries_.size());
    auto p = a.entries_.begin();
    auto q = b.entries_.begin();
    while (p != a.entries_.end() || q != b.entries_.end()) {
      if (q == b.entries_.end() || (p != a.entries_.end() && p->point < q->point)) {
        s.entries_.push_back(*p++);
      } else if (p == a.entries_.end() || q->point < p->point) {
        s.entries_.push_back({q->point, kMinus ? -q->weight : q->weight});
        ++q;
      } else {
        C weight = p->weight;
        kMinus ? weight -= q->weight : weight += q->weight;
        s.push(p->point, weight);
        ++p, ++q;
      }
    }
    return s;
  }

  Stencil scaled(const C& factor) const {
    Stencil s;
    if (K::is_zero(factor)) return s;
    if (!K::is_zero(constant_)) s.constant_ = factor * constant_;
    s.entries_.reserve(entries_.size());
    for (const Entry& entry : entries_) s.entries_.push_back({entry.point, factor * entry.weight});
    return s;
  }

  C constant_{};
  Entries entries_;
};

}  // namespace limitcheck::verify

namespace limitcheck::fast {

/// Of the weights themselves.
template <verify::Weight C>
struct NumberTraits<C> {
  static C cosine(int p, int q) { return verify::Coefficient<C>::cosine(p, q); }
  static C sine(int p, int q) { return verify::Coefficient<C>::sine(p, q); }
};

template <class C>
struct NumberTraits<verify::Stencil<C>> : NumberTraits<C> {
  using Scalar = C;
  using Wide = verify::Stencil<C>;
  static C ratio(int p, int q) { return verify::Coefficient<C>::ratio(p, q); }
  static const Wide& widen(const Wide& v) { return v; }
  static const Wide& narrow(const Wide& v) { return v; }
};

}  // namespace limitcheck::fast
