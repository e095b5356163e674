// SPDX-License-Identifier: MIT
#include "verify/proof/bounds/bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "verify/proof/maps/scheme_runs.h"
#include "verify/proof/numbers/quad_weights.h"

namespace limitcheck::verify {

namespace {

// The kernel's number over BoundFloat: fma rounds once.
template <int tangent>
struct BoundLane : fast::row_stream::LinearNumber<BoundFloat, tangent> {
  static BoundFloat fma(const BoundFloat& a, const BoundFloat& b, const BoundFloat& c) {
    return BoundFloat(BoundForm::fused(a.form(), b.form(), 1, c.form()));
  }
  // Of small integers, which are exact.
  static BoundFloat equal(const BoundFloat& a, const BoundFloat& b) {
    return BoundFloat(a.form().constant() == b.form().constant() ? 1 : 0);
  }
  static BoundFloat select(const BoundFloat& chosen, const BoundFloat& a, const BoundFloat& b) {
    return chosen.form().is_zero() ? b : a;
  }
};

bool is_control_vertex(const fast::LatticePoint& p) {
  return p.i % p.denominator == 0 && p.j % p.denominator == 0;
}

// Columns 1 .. n are the control points, in order.
std::vector<double> control_weights(const BoundForm& form, std::size_t n) {
  std::vector<double> weights(n);
  for (const BoundForm::Term& t : form.terms)
    if (t.column >= 1 && static_cast<std::size_t>(t.column) <= n) weights[t.column - 1] = t.weight;
  return weights;
}

}  // namespace

double KernelBounds::position() const {
  double worst = 0;
  for (const PointBound& p : points) worst = std::max(worst, p.position);
  return worst;
}

KernelBounds bound_kernel(ProvedKernel kernel, const Neighbourhood& neighbourhood, int depth, double reach,
                          const RoundingModel& model) {
  const BoundScope scope(reach, model);
  const std::size_t n = neighbourhood.mesh.positions.size();
  // One coordinate stands for three: the kernels treat them alike until the normal, see BoundProof::alike.
  std::vector<fast::Vec3<BoundFloat>> points(n);
  for (auto& p : points) p.x = BoundFloat(BoundForm::variable());
  KernelBounds bounds{kernel, depth, {}};
  const auto tangent = [&](const BoundFloat& t) -> TangentBound {
    return {t.error(), t.form().true_magnitude(), control_weights(t.form(), n)};
  };
  const auto add = [&](const fast::LatticePoint& at, const fast::LimitFrame<BoundFloat>& frame) {
    PointBound point{at, frame.position.x.error(), !is_stream(kernel) || !is_control_vertex(at), {}, {}};
    if (point.has_tangents) point.du = tangent(frame.du.x), point.dv = tangent(frame.dv.x);
    bounds.points.push_back(std::move(point));
  };
  run_linear<BoundFloat, BoundLane>(neighbourhood.mesh, points, kernel, depth, add);
  return bounds;
}

double product_error(const PointBound& b) {
  const TangentBound &u = b.du, &v = b.dv;
  return (3 * (u.error * v.size + v.error * u.size + u.error * v.error) +
          4 * std::sqrt(3.) * 0x1p-24 * (u.size + u.error) * (v.size + v.error) + 0x1p-60) *
         (1 + 1e-12);
}
double normal_angle_bound(const PointBound& bound, double cross) {
  const double sine = product_error(bound) / cross;
  return sine <= 1 ? std::asin(sine) + 0x1p-23 : std::numeric_limits<double>::infinity();
}
double normal_error_share(const PointBound& bound) {
  return product_error(bound) / (3 * bound.du.size * bound.dv.size);
}

BoundProof prove_bound(ProvedKernel kernel, const Neighbourhood& neighbourhood, int first_depth,
                       int last_depth, int meshes) {
  BoundProof proof{first_depth, last_depth};
  for (int depth = first_depth; depth <= last_depth; ++depth)
    proof.add(search_worst(neighbourhood, bound_kernel(kernel, neighbourhood, depth),
                           depth <= 4 ? meshes : meshes / 5, static_cast<std::uint64_t>(depth) + 1));
  return proof;
}

}  // namespace limitcheck::verify
