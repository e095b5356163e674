// SPDX-License-Identifier: MIT
#include <flint/ulong_extras.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "data/error.h"
#include "verify/proof/numbers/coefficient.h"

namespace limitcheck::verify {
namespace {

// The largest primes of the form k * kOrder + 1 below 2^60 and 3 * 2^58: FLINT checks them at the start.
nmod_t modulus_below(std::uint64_t limit) {
  constexpr auto order = static_cast<std::uint64_t>(Residue::kOrder);
  std::uint64_t p = (limit - 1) / order * order + 1;
  while (n_is_prime(p) == 0) p -= order;
  nmod_t modulus;
  nmod_init(&modulus, p);
  return modulus;
}

}  // namespace

const nmod_t Residue::moduli_[2] = {modulus_below(std::uint64_t{1} << 60),
                                    modulus_below(std::uint64_t{3} << 58)};

/// Roots of unity, and the inverses of small integers, which are what kernels divide by.
struct ResidueTables {
  static constexpr int kSmall = 1025;
  std::array<std::uint64_t, 2> root;
  std::array<Residue, kSmall> inverse;

  ResidueTables() {
    for (std::size_t k = 0; k < 2; ++k) {
      const nmod_t m = Residue::moduli_[k];
      const auto order = static_cast<std::uint64_t>(Residue::kOrder);
      for (std::uint64_t g = 2;; ++g) {
        root[k] = nmod_pow_ui(g, (m.n - 1) / order, m);
        bool primitive = true;
        for (const std::uint64_t q : {2, 3, 5, 7, 11, 13, 17, 19})
          primitive = primitive && nmod_pow_ui(root[k], order / q, m) != 1;
        if (primitive) break;
      }
    }
    for (int k = 1; k < kSmall; ++k) {
      const auto number = static_cast<std::uint64_t>(k);
      inverse[k] = inverse_of({number, number}, k);
    }
  }
  static Residue inverse_of(const Residue::Pair& residue, double approximation) {
    Residue r;
    for (std::size_t k = 0; k < 2; ++k) r.residue_[k] = n_invmod(residue[k], Residue::moduli_[k].n);
    r.approximation_ = 1 / approximation;
    return r;
  }
  static const ResidueTables& get() {
    static const ResidueTables tables;
    return tables;
  }
  /// The root of unity e^(2 pi i p / q).
  Residue turn(std::int64_t p, std::int64_t q) const {
    if (q <= 0 || Residue::kOrder % q != 0)
      throw data::ArgumentError("the proof's residues hold no root of unity of order " + std::to_string(q));
    const std::int64_t e = ((p % q) + q) % q * (Residue::kOrder / q);
    Residue r;
    for (std::size_t k = 0; k < 2; ++k)
      r.residue_[k] = nmod_pow_ui(root[k], static_cast<std::uint64_t>(e), Residue::moduli_[k]);
    return r;
  }
};

Residue::Residue(int value) : approximation_(value) {
  const auto size = static_cast<std::uint64_t>(std::abs(static_cast<std::int64_t>(value)));
  for (std::size_t k = 0; k < 2; ++k) residue_[k] = value < 0 ? moduli_[k].n - size : size;
}

Residue Residue::cosine(std::int64_t p, std::int64_t q) {
  static thread_local std::map<std::pair<std::int64_t, std::int64_t>, Residue> known;
  const auto [found, fresh] = known.try_emplace({p, q});
  if (fresh) {
    const ResidueTables& t = ResidueTables::get();
    const double angle = 2 * std::numbers::pi * static_cast<double>(p % q) / static_cast<double>(q);
    found->second = (t.turn(p, q) + t.turn(-p, q)) / Residue(2);
    found->second.approximation_ = std::cos(angle);
  }
  return found->second;
}

Residue Residue::inverse() const {
  const auto [first, second] = residue_;
  if (first == 0 || second == 0) throw data::ArgumentError("division by a residue of zero");
  if (first < ResidueTables::kSmall && first == second) return ResidueTables::get().inverse[first];
  return ResidueTables::inverse_of(residue_, approximation_);
}

}  // namespace limitcheck::verify
