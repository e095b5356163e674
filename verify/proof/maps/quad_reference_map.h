// SPDX-License-Identifier: MIT
// The linear map that the reference of Catmull-Clark's scheme applies, column by column. For .cpp files.
#pragma once

#include <map>
#include <numeric>
#include <tuple>
#include <type_traits>
#include <vector>

#include "reference/catmull_clark/stam.h"
#include "reference/catmull_clark/subdivision_evaluator.h"
#include "verify/proof/maps/map_row.h"

namespace limitcheck::verify {

/// As ReferenceMap, of face 0, on which all control points of the mesh may have weight. At corners where
/// tangents need roots, only decimal digits and doubles have them.
///   Evaluator   catmull_clark::SubdivisionEvaluator<C> or catmull_clark::StamEvaluator<C>
template <class C, class Evaluator>
class QuadReferenceMap {
 public:
  explicit QuadReferenceMap(const data::ControlMesh& mesh) : points_(mesh.positions.size()) {
    std::iota(points_.begin(), points_.end(), std::size_t{0});
    for (std::size_t k = 0; k < points_.size(); k += 3)
      evaluators_.emplace_back(mesh.faces, unit_vectors<C>(mesh, points_, k), mesh.sharpness);
  }

  const MapRow<C>& at(const fast::LatticePoint& point) {
    const fast::LatticePoint p = lowest_terms(point);
    const auto [found, fresh] = rows_.try_emplace({p.i, p.j, p.denominator});
    if (fresh) found->second = evaluate(p);
    return found->second;
  }

 private:
  static constexpr bool kHasRoots = std::is_same_v<C, double> || std::is_same_v<C, reference::Decimal50>;

  MapRow<C> evaluate(const fast::LatticePoint& p) const {
    const auto u = reference::Parameter::fraction(p.i, p.denominator),
               v = reference::Parameter::fraction(p.j, p.denominator);
    MapRow<C> row(points_.size());
    for (std::size_t k = 0; k < evaluators_.size(); ++k) {
      const auto found = evaluators_[k].evaluate(0, 0, u, v, reference::Order::kFirst);
      row.put(points_, 3 * k, found);
      if (found.at_corner && !kHasRoots) row.has_tangents = false;
    }
    return row;
  }

  std::vector<std::size_t> points_;
  std::vector<Evaluator> evaluators_;  // for three points each
  std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, MapRow<C>> rows_;
};

}  // namespace limitcheck::verify
