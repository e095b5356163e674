// SPDX-License-Identifier: MIT
#include "verify/evidence/reference_surface.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>
#include <unordered_map>

#include "reference/surface/certified.h"
#include "reference/surface/surface.h"
#include "verify/interrupt/interrupt.h"

namespace limitcheck::verify {
namespace {

constexpr int kDigits = 40;

std::vector<std::string> digits(const reference::Enclosure3& point) {
  return {point[0].value, point[1].value, point[2].value};
}

// See normal_condition(). In units of the larger tangent, so that nothing overflows or vanishes.
double condition(const reference::SurfacePoint<double>& p) {
  const Vector t1 = vector_of(p.t1), t2 = vector_of(p.t2);
  const double unit = std::max(largest(t1), largest(t2));
  if (!(unit > 0)) return std::numeric_limits<double>::infinity();
  const auto scaled = [&](const Vector& t) { return Vector{t[0] / unit, t[1] / unit, t[2] / unit}; };
  const double area = norm(cross(scaled(t1), scaled(t2)));
  return (norm(scaled(t1)) + norm(scaled(t2))) / area / unit;
}

// Of a triangle the middle of the side opposite a corner, in the lattice's triangle there; of other faces the
// middle of the lattice's quad there.
std::array<double, 2> beside_corner(const Lattice& lattice, const Place& corner, int k) {
  const FaceDomain domain = lattice.domain(corner.face);
  const std::int64_t n = lattice.scale(), step = std::min(n / lattice.n(), domain.denominator(n));
  const FaceDomain::Point c = domain.corner_point(k, n), p = domain.on_side(k, step, n);
  // The other neighbour, as the part of corner k names it.
  const FaceDomain::Point q = *domain.in_part(domain.on_side(domain.previous(k), n - step, n), c.part, n);
  const double whole = 2.0 * static_cast<double>(domain.denominator(n));
  return {static_cast<double>(p.i + q.i) / whole, static_cast<double>(p.j + q.j) / whole};
}

// See terms_at(): of each face.
std::vector<std::int64_t> terms(const data::Faces& faces, std::size_t vertices) {
  std::vector<std::int64_t> at(vertices, 1), most(faces.size(), 0);
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (const std::int32_t v : faces[f]) at[v] += static_cast<std::int64_t>(faces[f].size()) - 2;
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (const std::int32_t v : faces[f]) most[f] = std::max(most[f], at[v]);
  if (std::all_of(most.begin(), most.end(), [](std::int64_t n) { return n <= kOrdinaryTerms; })) most.clear();
  return most;
}

}  // namespace

int steps_of(const data::Sharpness& tags) {
  float most = 0;
  const auto look = [&](const auto& list) {
    for (const auto& tag : list)
      if (tag.sharpness < data::kInfiniteSharpness) most = std::max(most, tag.sharpness);
  };
  look(tags.edges);
  look(tags.vertices);
  return static_cast<int>(std::ceil(most));
}

// Each made when first needed: for limit points, for refined ones, and for findings.
struct ReferenceSurface::Evaluators {
  std::optional<reference::Surface> limit;
  std::optional<reference::RefinedSurface> refined;
  std::mutex mutex;  // of what follows
  std::optional<reference::CertifiedEvaluator> certified;
  std::unordered_map<Sides::Id, std::optional<ExactPoint>> kept;  // empty: it cannot say
};

const ExactPoint* ReferenceSurface::certified(Sides::Id side) const {
  const std::scoped_lock lock(evaluators_->mutex);
  const auto [place, is_new] = evaluators_->kept.try_emplace(side);
  std::optional<ExactPoint>& point = place->second;
  if (is_new) try {
      auto& evaluator = evaluators_->certified;
      if (!evaluator && lattice_.scheme() == data::Scheme::kLoop)
        evaluator.emplace(mesh_, weights_);
      else if (!evaluator)
        evaluator.emplace(mesh_, lattice_.scheme());
      const Place p = sides_.place(side);
      const auto exact =
          evaluator->evaluate(p.face, p.corner, reference::Parameter::fraction(p.i, p.denominator),
                              reference::Parameter::fraction(p.j, p.denominator), kDigits);
      point = {vector_of(exact.position), vector_of(exact.normal), digits(exact.position),
               digits(exact.normal), exact.normal_kind == reference::NormalKind::kRegular};
    } catch (const std::exception&) {  // a neighbourhood that it does not take: the word in double stands
    }
  return point ? &*point : nullptr;
}

ReferenceSurface::ReferenceSurface(const data::ControlMesh& mesh, data::Scheme scheme, int depth,
                                   lc_points points, reference::Weights weights,
                                   std::span<const Place> others)
    : mesh_(mesh),
      lattice_(mesh_, scheme, depth, others),
      sides_(lattice_),
      steps_(points == LC_POINTS_LIMIT ? std::max(depth, steps_of(mesh.sharpness)) : depth),
      points_(points),
      weights_(weights),
      terms_(terms(mesh_.faces, mesh_.positions.size())),
      evaluators_(std::make_unique<Evaluators>()) {
  const auto size = static_cast<std::size_t>(lattice_.size());
  const auto sides = static_cast<std::size_t>(sides_.size());
  position_.resize(size);
  if (points_ == LC_POINTS_LIMIT) {
    normal_.resize(sides);
    condition_.resize(sides);
  }
  state_.assign(sides, State::kMissing);
}

ReferenceSurface::~ReferenceSurface() = default;

void ReferenceSurface::evaluate(Sides::Id side) {
  const Lattice::Id point = sides_.point(side);
  const Place p = sides_.place(side);
  // Dyadic fractions are exact doubles; thirds are not.
  const auto& limit = *evaluators_->limit;
  const auto at =
      std::has_single_bit(p.denominator)
          ? limit.evaluate(p.face, p.corner, static_cast<double>(p.i) / p.denominator,
                           static_cast<double>(p.j) / p.denominator, reference::Order::kFirst)
          : limit.evaluate(p.face, p.corner, reference::Parameter::fraction(p.i, p.denominator),
                           reference::Parameter::fraction(p.j, p.denominator), reference::Order::kFirst);
  if (side == point) position_[point] = vector_of(at.position);
  normal_[side] = vector_of(at.normal);
  state_[side] = at.normal_kind == reference::NormalKind::kRegular ? State::kRegular : State::kNoNormal;
  condition_[side] = condition(at);
  if (!lattice_.is_vertex(point)) return;
  const auto beside = beside_corner(lattice_, p, *lattice_.corner_of(p.face, point));
  const double near =
      condition(limit.evaluate(p.face, p.corner, beside[0], beside[1], reference::Order::kFirst));
  condition_[side] = std::isfinite(condition_[side]) ? std::max(condition_[side], near) : near;
}

void ReferenceSurface::prepare(std::span<const Lattice::Id> ids) {
  // What is missing, each side of each point once.
  const bool limit = points_ == LC_POINTS_LIMIT;
  std::vector<Sides::Id> wanted;
  const auto want = [&](Sides::Id side) {
    state_[side] = State::kWanted;
    wanted.push_back(side);
  };
  for (const Lattice::Id id : ids) {
    if (id == Lattice::kNone || state_[id] != State::kMissing) continue;
    if (limit)
      sides_.for_each(id, want);
    else
      want(id);
  }
  if (wanted.empty()) return;

  if (limit) {
    if (!evaluators_->limit) evaluators_->limit.emplace(mesh_, lattice_.scheme(), weights_);
    tbb::parallel_for(std::size_t{0}, wanted.size(), [&](std::size_t k) {
      end_if_interrupted();
      evaluate(wanted[k]);
    });
    return;
  }

  if (!evaluators_->refined)
    evaluators_->refined.emplace(mesh_, lattice_.scheme(), lattice_.depth(), weights_);
  for (const Lattice::Id id : wanted) {
    state_[id] = State::kNoNormal;
    if (lattice_.is_bare_centre(id)) continue;  // which is no vertex of a refined mesh
    if (lattice_.is_vertex(id) && lattice_.depth() == 0) {
      position_[id] = mesh_.positions[id];
      continue;
    }
    const Place p = lattice_.place(id);
    const auto finer = lattice_.domain(p.face).denominator(lattice_.n()) / p.denominator;
    position_[id] = vector_of(evaluators_->refined->position(p.face, p.corner, static_cast<int>(p.i * finer),
                                                             static_cast<int>(p.j * finer)));
  }
}

}  // namespace limitcheck::verify
