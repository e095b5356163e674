// SPDX-License-Identifier: MIT
// The linear map that the reference applies, column by column: the limit points of unit control vectors. For
// .cpp files.
#pragma once

#include <algorithm>
#include <map>
#include <tuple>
#include <vector>

#include "reference/loop/refine_impl.h"
#include "reference/loop/stam.h"
#include "reference/loop/subdivision_evaluator_impl.h"
#include "verify/proof/maps/map_row.h"

namespace limitcheck::verify {

/// The vertices that a face's limit points depend on: the rings of its corners.
inline std::vector<std::size_t> points_near(const data::ControlMesh& mesh, std::int32_t face) {
  const auto& corners = triangles_of(mesh)[face];
  std::vector<bool> near(mesh.positions.size());
  for (const auto& other : triangles_of(mesh)) {
    if (std::ranges::find_first_of(other, corners) == other.end()) continue;
    for (const std::int32_t v : other) near[v] = true;
  }
  std::vector<std::size_t> points;
  for (std::size_t v = 0; v < near.size(); ++v)
    if (near[v]) points.push_back(v);
  return points;
}

/// Rows of a mesh, computed once each.
///   Evaluator   reference::SubdivisionEvaluator<C> or reference::StamEvaluator<C>
template <class C, class Evaluator>
class ReferenceMap {
 public:
  explicit ReferenceMap(const data::ControlMesh& mesh) : mesh_(mesh) {}

  const MapRow<C>& at(const fast::LatticePoint& point) {
    const fast::LatticePoint p = lowest_terms(point);
    const auto [found, fresh] = rows_.try_emplace({p.face, p.i, p.j, p.denominator});
    if (fresh) found->second = evaluate(p);
    return found->second;
  }

 private:
  struct Columns {
    std::vector<std::size_t> points;
    std::vector<Evaluator> evaluators;  // for three points each
  };

  const Columns& columns(std::int32_t face) {
    const auto [found, fresh] = columns_.try_emplace(face);
    Columns& result = found->second;
    if (!fresh) return result;
    result.points = points_near(mesh_, face);
    for (std::size_t k = 0; k < result.points.size(); k += 3)
      result.evaluators.emplace_back(unit_vectors<C>(mesh_, result.points, k),
                                     triangles_of(mesh_).to_vector());
    return result;
  }

  MapRow<C> evaluate(const fast::LatticePoint& p) {
    const auto l1 = reference::Parameter::fraction(p.i, p.denominator),
               l2 = reference::Parameter::fraction(p.j, p.denominator);
    const Columns& c = columns(p.face);
    MapRow<C> row(mesh_.positions.size());
    for (std::size_t k = 0; k < c.evaluators.size(); ++k)
      row.put(c.points, 3 * k, c.evaluators[k].evaluate(p.face, l1, l2, reference::Order::kFirst));
    return row;
  }

  const data::ControlMesh& mesh_;
  std::map<std::int32_t, Columns> columns_;
  std::map<std::tuple<std::int32_t, std::uint32_t, std::uint32_t, std::uint32_t>, MapRow<C>> rows_;
};

}  // namespace limitcheck::verify
