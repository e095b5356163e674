// SPDX-License-Identifier: MIT
#include "verify/audit/reference_surface.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "reference/loop/refine.h"
#include "reference/loop/stam.h"
#include "verify/interrupt/interrupt.h"

namespace limitcheck::verify {
namespace {

// See normal_condition(). In units of the larger tangent, so that nothing overflows or vanishes.
double condition(const reference::SurfacePoint<double>& p) {
  const Vector t1 = vector_of(p.d1), t2 = vector_of(p.d2);
  const double unit = std::max(largest(t1), largest(t2));
  if (!(unit > 0)) return std::numeric_limits<double>::infinity();
  const auto scaled = [&](const Vector& t) { return Vector{t[0] / unit, t[1] / unit, t[2] / unit}; };
  const double area = norm(cross(scaled(t1), scaled(t2)));
  return (norm(scaled(t1)) + norm(scaled(t2))) / area / unit;
}

// The middle of the side opposite a corner of the face, in the lattice's triangle there.
std::array<double, 2> beside_corner(FaceDomain domain, int k, std::int64_t n) {
  const FaceDomain::Point p = domain.on_side(k, 1, n), q = domain.on_side(domain.previous(k), n - 1, n);
  const double half = 0.5 / static_cast<double>(n);
  return {static_cast<double>(p.i + q.i) * half, static_cast<double>(p.j + q.j) * half};
}

}  // namespace

// The exact evaluator for limit points; for refined points the refined mesh, made when first needed.
struct ReferenceSurface::Evaluator {
  std::unique_ptr<reference::StamEvaluator<double>> limit;
  std::unique_ptr<reference::RefinedMesh<double>> refined;
};

ReferenceSurface::ReferenceSurface(const data::ControlMesh& mesh, int depth, lc_points points,
                                   reference::Weights weights)
    : mesh_(mesh),
      lattice_(mesh_, depth),
      points_(points),
      weights_(weights),
      evaluator_(std::make_unique<Evaluator>()),
      certified_(lattice_, weights) {
  const auto size = static_cast<std::size_t>(lattice_.size());
  position_.resize(size);
  if (points_ == LC_POINTS_LIMIT) {
    normal_.resize(size);
    condition_.resize(size);
  }
  state_.assign(size, State::kMissing);
}

ReferenceSurface::~ReferenceSurface() = default;

void ReferenceSurface::prepare(std::span<const Lattice::Id> ids) {
  // What is missing, each point once.
  std::vector<Lattice::Id> wanted;
  for (const Lattice::Id id : ids)
    if (id != Lattice::kNone && state_[id] == State::kMissing) {
      state_[id] = State::kWanted;
      wanted.push_back(id);
    }
  if (wanted.empty()) return;

  if (points_ == LC_POINTS_LIMIT) {
    if (!evaluator_->limit)
      evaluator_->limit = std::make_unique<reference::StamEvaluator<double>>(mesh_, weights_);
    tbb::parallel_for(std::size_t{0}, wanted.size(), [&](std::size_t k) {
      end_if_interrupted();
      const Lattice::Id id = wanted[k];
      const lc_provenance p = lattice_.provenance(id);
      // Dyadic fractions are exact doubles; thirds are not.
      const auto& limit = *evaluator_->limit;
      const auto point =
          !lattice_.is_centre(id)
              ? limit.evaluate(p.face, static_cast<double>(p.i) / p.denominator,
                               static_cast<double>(p.j) / p.denominator, reference::Order::kFirst)
              : limit.evaluate(p.face, reference::Parameter::fraction(p.i, p.denominator),
                               reference::Parameter::fraction(p.j, p.denominator), reference::Order::kFirst);
      position_[id] = vector_of(point.position);
      normal_[id] = vector_of(point.normal);
      state_[id] = point.normal_kind == reference::NormalKind::kRegular ? State::kRegular : State::kNoNormal;
      condition_[id] = condition(point);
      if (lattice_.is_vertex(id)) {
        const auto [l1, l2] =
            beside_corner(lattice_.domain(p.face), *lattice_.corner_of(p.face, id), lattice_.n());
        const double near = condition(limit.evaluate(p.face, l1, l2, reference::Order::kFirst));
        condition_[id] = std::isfinite(condition_[id]) ? std::max(condition_[id], near) : near;
      }
    });
    return;
  }

  if (!evaluator_->refined)
    evaluator_->refined = std::make_unique<reference::RefinedMesh<double>>(
        reference::refine<double>(mesh_, lattice_.depth(), weights_));
  for (const Lattice::Id id : wanted) {
    const lc_provenance p = lattice_.provenance(id);
    const auto scale = lattice_.n() / p.denominator;
    state_[id] = State::kNoNormal;
    position_[id] = lattice_.is_centre(id)  // which is no vertex of a refined mesh
                        ? Vector{}
                        : vector_of(evaluator_->refined->positions()[evaluator_->refined->vertex(
                              p.face, static_cast<int>(p.i * scale), static_cast<int>(p.j * scale))]);
  }
}

}  // namespace limitcheck::verify
