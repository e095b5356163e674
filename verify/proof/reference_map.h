// SPDX-License-Identifier: MIT
// The linear map that the reference applies, column by column: the limit points of unit control vectors. For
// .cpp files.
#pragma once

#include <map>
#include <tuple>
#include <vector>

#include "fast/sink.h"
#include "reference/stam.h"
#include "reference/subdivision_evaluator_impl.h"
#include "verify/proof/coefficient.h"

namespace limitcheck::verify {

/// One limit point: the weights of all control points in its position and its two tangents.
template <class C>
struct MapRow {
  std::vector<C> position, d1, d2;
};

/// Rows of a mesh, computed once each.
///   Evaluator   reference::SubdivisionEvaluator<C> or reference::StamEvaluator<C>
template <class C, class Evaluator>
class ReferenceMap {
 public:
  explicit ReferenceMap(const data::ControlMesh& mesh) : mesh_(mesh) {}

  const MapRow<C>& at(const fast::LatticePoint& p) {
    auto i = p.i, j = p.j, denominator = p.denominator;
    for (; (i | j | denominator) % 2 == 0; i /= 2, j /= 2) denominator /= 2;
    const auto [found, fresh] = rows_.try_emplace({p.face, i, j, denominator});
    if (fresh) found->second = evaluate(p.face, i, j, denominator);
    return found->second;
  }

 private:
  // Three unit vectors make a mesh: the first in x, the second in y, the third in z. A face's surface depends
  // on the rings of its corners alone.
  struct Columns {
    std::vector<std::size_t> points;
    std::vector<Evaluator> evaluators;
  };

  const Columns& columns(std::int32_t face) {
    const auto [found, fresh] = columns_.try_emplace(face);
    Columns& result = found->second;
    if (!fresh) return result;
    const auto& corners = mesh_.triangles[static_cast<std::size_t>(face)];
    std::vector<bool> near(mesh_.positions.size());
    for (const auto& other : mesh_.triangles) {
      bool touches = false;
      for (const std::int32_t v : other)
        touches = touches || v == corners[0] || v == corners[1] || v == corners[2];
      for (const std::int32_t v : other)
        if (touches) near[static_cast<std::size_t>(v)] = true;
    }
    for (std::size_t v = 0; v < near.size(); ++v)
      if (near[v]) result.points.push_back(v);
    for (std::size_t k = 0; k < result.points.size(); k += 3) {
      std::vector<reference::Vec3<C>> unit(mesh_.positions.size());
      unit[result.points[k]].x = C(1);
      if (k + 1 < result.points.size()) unit[result.points[k + 1]].y = C(1);
      if (k + 2 < result.points.size()) unit[result.points[k + 2]].z = C(1);
      result.evaluators.emplace_back(std::move(unit), mesh_.triangles);
    }
    return result;
  }

  MapRow<C> evaluate(std::int32_t face, std::uint32_t i, std::uint32_t j, std::uint32_t denominator) {
    const auto l1 = reference::Parameter::fraction(i, denominator),
               l2 = reference::Parameter::fraction(j, denominator);
    const Columns& c = columns(face);
    const std::size_t n = mesh_.positions.size();
    MapRow<C> row{std::vector<C>(n), std::vector<C>(n), std::vector<C>(n)};
    for (std::size_t k = 0; k < c.points.size(); ++k) {
      if (k % 3 == 0) point_ = c.evaluators[k / 3].evaluate(face, l1, l2, reference::Order::kFirst);
      const auto coordinate = [&](const reference::Vec3<C>& v) {
        return k % 3 == 0 ? v.x : k % 3 == 1 ? v.y : v.z;
      };
      const std::size_t v = c.points[k];
      row.position[v] = coordinate(point_.position);
      row.d1[v] = coordinate(point_.d1);
      row.d2[v] = coordinate(point_.d2);
    }
    return row;
  }

  const data::ControlMesh& mesh_;
  std::map<std::int32_t, Columns> columns_;
  std::map<std::tuple<std::int32_t, std::uint32_t, std::uint32_t, std::uint32_t>, MapRow<C>> rows_;
  reference::SurfacePoint<C> point_;
};

}  // namespace limitcheck::verify
