// SPDX-License-Identifier: MIT
#include "verify/evidence/certified_surface.h"

#include <mutex>
#include <optional>
#include <unordered_map>

#include "data/numeral.h"
#include "reference/surface/certified.h"

namespace limitcheck::verify {
namespace {

constexpr int kDigits = 40;

std::vector<std::string> digits(const reference::Enclosure3& point) {
  return {point[0].value, point[1].value, point[2].value};
}

Vector rounded(const reference::Enclosure3& point) {
  return {data::parse<double>(point[0].value), data::parse<double>(point[1].value),
          data::parse<double>(point[2].value)};
}

}  // namespace

struct CertifiedSurface::State {
  std::mutex mutex;
  std::optional<reference::CertifiedEvaluator> evaluator;
  std::unordered_map<Sides::Id, std::optional<ExactPoint>> kept;  // empty: it cannot say
};

CertifiedSurface::CertifiedSurface(const Lattice& lattice, const Sides& sides, reference::Weights weights)
    : lattice_(lattice), sides_(sides), weights_(weights), state_(std::make_unique<State>()) {}
CertifiedSurface::~CertifiedSurface() = default;

const ExactPoint* CertifiedSurface::at(Sides::Id side) const {
  const std::scoped_lock lock(state_->mutex);
  const auto [place, is_new] = state_->kept.try_emplace(side);
  std::optional<ExactPoint>& point = place->second;
  if (is_new) try {
      if (!state_->evaluator) {
        if (lattice_.scheme() == data::Scheme::kLoop)
          state_->evaluator.emplace(lattice_.mesh(), weights_);
        else
          state_->evaluator.emplace(lattice_.mesh(), lattice_.scheme());
      }
      const Place p = sides_.place(side);
      const auto exact =
          state_->evaluator->evaluate(p.face, p.corner, reference::Parameter::fraction(p.i, p.denominator),
                                      reference::Parameter::fraction(p.j, p.denominator), kDigits);
      point = {rounded(exact.position), rounded(exact.normal), digits(exact.position), digits(exact.normal),
               exact.normal_kind == reference::NormalKind::kRegular};
    } catch (const std::exception&) {  // a neighbourhood that it does not take: the word in double stands
    }
  return point ? &*point : nullptr;
}

}  // namespace limitcheck::verify
