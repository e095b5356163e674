// SPDX-License-Identifier: MIT
// The linear map that the reference applies, column by column: the limit points of unit control vectors. For
// .cpp files.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <numeric>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "data/control_mesh.h"
#include "fast/plan/pairing.h"
#include "reference/catmull_clark/recursion.h"
#include "reference/catmull_clark/stam.h"
#include "reference/loop/recursion_impl.h"
#include "reference/loop/refine_impl.h"
#include "reference/loop/stam.h"
#include "reference/point/surface_point.h"
#include "verify/proof/numbers/coefficient.h"

namespace limitcheck::verify {

/// One limit point: the weights of all control points in its position and its two tangents.
template <class C>
struct MapRow {
  MapRow() = default;
  explicit MapRow(std::size_t n) : position(n), d1(n), d2(n) {}

  /// The point's x, y and z belong to points[first], points[first + 1] and points[first + 2].
  void put(const std::vector<std::size_t>& points, std::size_t first, const reference::SurfacePoint<C>& p) {
    constexpr std::array<C reference::Vec3<C>::*, 3> kCoordinates{
        &reference::Vec3<C>::x, &reference::Vec3<C>::y, &reference::Vec3<C>::z};
    for (std::size_t c = 0; c < 3 && first + c < points.size(); ++c) {
      const std::size_t v = points[first + c];
      position[v] = p.position.*kCoordinates[c];
      d1[v] = p.t1.*kCoordinates[c];
      d2[v] = p.t2.*kCoordinates[c];
    }
  }

  std::vector<C> position, d1, d2;
  bool has_tangents = true;  ///< false where C has no numbers for them
};

inline fast::LatticePoint lowest_terms(fast::LatticePoint p) {
  for (; (p.i | p.j | p.denominator) % 2 == 0; p.i /= 2, p.j /= 2) p.denominator /= 2;
  return p;
}

/// Control points that are zero, but points[first] is (1, 0, 0), the next (0, 1, 0), the one after (0, 0, 1).
template <class C>
std::vector<reference::Vec3<C>> unit_vectors(const data::ControlMesh& mesh,
                                             const std::vector<std::size_t>& points, std::size_t first) {
  std::vector<reference::Vec3<C>> unit(mesh.positions.size());
  unit[points[first]].x = C(1);
  if (first + 1 < points.size()) unit[points[first + 1]].y = C(1);
  if (first + 2 < points.size()) unit[points[first + 2]].z = C(1);
  return unit;
}

/// Rows, computed once each.
template <class C>
class RowsByPlace {
 public:
  /// evaluate(LatticePoint in lowest terms) makes a row.
  template <class Evaluate>
  const MapRow<C>& at(const fast::LatticePoint& point, Evaluate&& evaluate) {
    const fast::LatticePoint p = lowest_terms(point);
    const auto [found, fresh] = rows_.try_emplace({p.face, p.i, p.j, p.denominator});
    if (fresh) found->second = evaluate(p);
    return found->second;
  }

 private:
  std::map<std::tuple<std::int32_t, std::uint32_t, std::uint32_t, std::uint32_t>, MapRow<C>> rows_;
};

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

/// The map of an evaluator of either scheme. Of quads all control points of the mesh may have weight; where their
/// tangents need roots, at corners, only decimal digits and doubles have them.
///   Evaluator   SubdivisionEvaluator<C> or StamEvaluator<C> of reference or of reference::catmull_clark
template <class C, class Evaluator>
class ReferenceMap {
 public:
  explicit ReferenceMap(const data::ControlMesh& mesh) : mesh_(mesh) {}

  const MapRow<C>& at(const fast::LatticePoint& point) {
    return rows_.at(point, [&](const fast::LatticePoint& p) { return evaluate(p); });
  }

 private:
  using Points = std::vector<reference::Vec3<C>>;
  static constexpr bool kQuads =
      std::is_constructible_v<Evaluator, data::Faces, Points, reference::SharpTags>;
  static constexpr bool kHasRoots = std::is_same_v<C, double> || std::is_same_v<C, reference::Decimal50>;
  struct Columns {
    std::vector<std::size_t> points;
    std::vector<Evaluator> evaluators;  // for three points each
  };

  const Columns& columns(std::int32_t face) {
    const auto [found, fresh] = columns_.try_emplace(face);
    Columns& result = found->second;
    if (!fresh) return result;
    if constexpr (kQuads) {
      result.points.resize(mesh_.positions.size());
      std::iota(result.points.begin(), result.points.end(), std::size_t{0});
    } else {
      result.points = points_near(mesh_, face);
    }
    for (std::size_t k = 0; k < result.points.size(); k += 3) {
      Points unit = unit_vectors<C>(mesh_, result.points, k);
      if constexpr (kQuads)
        result.evaluators.emplace_back(mesh_.faces, std::move(unit), mesh_.sharpness);
      else
        result.evaluators.emplace_back(std::move(unit), triangles_of(mesh_).to_vector());
    }
    return result;
  }

  MapRow<C> evaluate(const fast::LatticePoint& p) {
    const auto first = reference::Parameter::fraction(p.i, p.denominator),
               second = reference::Parameter::fraction(p.j, p.denominator);
    const Columns& c = columns(p.face);
    MapRow<C> row(mesh_.positions.size());
    for (std::size_t k = 0; k < c.evaluators.size(); ++k) {
      if constexpr (kQuads) {
        const auto found = c.evaluators[k].evaluate(p.face, 0, first, second, reference::Order::kFirst);
        row.put(c.points, 3 * k, found);
        if (found.at_corner && !kHasRoots) row.has_tangents = false;
      } else {
        row.put(c.points, 3 * k, c.evaluators[k].evaluate(p.face, first, second, reference::Order::kFirst));
      }
    }
    return row;
  }

  const data::ControlMesh& mesh_;
  std::map<std::int32_t, Columns> columns_;
  RowsByPlace<C> rows_;
};

/// Equal to ReferenceMap of reference::SubdivisionEvaluator<C>, by the same rings, steps, basis and masks,
/// but a sub-face is subdivided once for all points in it, and a basis evaluated once for all control points:
/// a fraction of the work.
template <class C>
class SharedReferenceMap {
 public:
  explicit SharedReferenceMap(const data::ControlMesh& mesh)
      : mesh_(mesh), topology_(mesh.positions.size(), mesh.faces) {}

  const MapRow<C>& at(const fast::LatticePoint& point) {
    return rows_.at(point, [&](const fast::LatticePoint& p) { return evaluate(p); });
  }

 private:
  using Ringed = reference::RingedFace<reference::Vec3<C>>;

  /// A sub-face under unit control vectors, three at a time.
  struct SubFace {
    explicit SubFace(std::vector<Ringed> r) : rings(std::move(r)), regular(rings.front().is_regular()) {
      if (!regular) return;
      for (const Ringed& face : rings) patches.push_back(face.patch(reference::ghost_point<C>));
    }
    SubFace& part(int which) {
      auto& child = parts[static_cast<std::size_t>(which)];
      if (!child) {
        std::vector<Ringed> fresh;
        for (const Ringed& face : rings) fresh.push_back(reference::SubdividedFace<C>(face).subface(which));
        child = std::make_unique<SubFace>(std::move(fresh));
      }
      return *child;
    }

    std::vector<Ringed> rings;
    bool regular;
    std::vector<std::array<reference::Vec3<C>, 12>> patches;
    std::array<std::unique_ptr<SubFace>, 4> parts;
  };
  struct Root {
    std::vector<std::size_t> points;
    std::unique_ptr<SubFace> face;
  };

  Root& root(std::int32_t face) {
    const auto [found, fresh] = roots_.try_emplace(face);
    Root& result = found->second;
    if (!fresh) return result;
    result.points = points_near(mesh_, face);
    std::vector<Ringed> rings;
    for (std::size_t k = 0; k < result.points.size(); k += 3)
      rings.push_back(
          reference::gather_triangle<C>(topology_, unit_vectors<C>(mesh_, result.points, k), face));
    result.face = std::make_unique<SubFace>(std::move(rings));
    return result;
  }

  MapRow<C> evaluate(const fast::LatticePoint& p) {
    const Root& top = root(p.face);
    MapRow<C> row(mesh_.positions.size());
    reference::SubFacePath<reference::Rational> path(reference::Rational(p.i, p.denominator),
                                                     reference::Rational(p.j, p.denominator));
    SubFace* face = top.face.get();
    for (;; face = &face->part(path.descend())) {
      if (face->regular) {
        reference::Basis<C> basis;
        reference::evaluate_basis<C>(basis, reference::number_from<C>(path.w[1]),
                                     reference::number_from<C>(path.w[2]), reference::Order::kFirst);
        const C scale = reference::NumberTraits<C>::scale(C(1), path.level);
        for (std::size_t t = 0; t < face->patches.size(); ++t) {
          const auto local = reference::evaluate_patch<C>(face->patches[t], basis, reference::Order::kFirst);
          reference::SurfacePoint<C> point;
          point.position = local.position;
          reference::set_derivatives(point, local, path.gradients(), scale, scale, reference::Order::kFirst);
          row.put(top.points, 3 * t, point);
        }
        return row;
      }
      for (std::size_t k = 0; k < 3; ++k) {
        if (path.w[k] != 1 || face->rings.front().corner[k].is_regular()) continue;
        const auto next = path.gradient[(k + 1) % 3], before = path.gradient[(k + 2) % 3];
        for (std::size_t t = 0; t < face->rings.size(); ++t) {
          const auto& c = face->rings[t].corner[k];
          row.put(top.points, 3 * t,
                  reference::extraordinary_corner<C>(c.point, c.span(), c.on_boundary, c.ring_index,
                                                     {next[0], next[1], before[0], before[1], path.level},
                                                     reference::Weights::kLoop, reference::Order::kFirst));
        }
        return row;
      }
    }
  }

  const data::ControlMesh& mesh_;
  reference::Topology topology_;
  std::map<std::int32_t, Root> roots_;
  RowsByPlace<C> rows_;
};

/// By the recursion of Loop's scheme or of Catmull-Clark's, and by Stam's method.
template <class C, bool quads>
using RecursionMap =
    ReferenceMap<C, std::conditional_t<quads, reference::catmull_clark::SubdivisionEvaluator<C>,
                                       reference::SubdivisionEvaluator<C>>>;
template <class C, bool quads>
using StamMap = ReferenceMap<
    C, std::conditional_t<quads, reference::catmull_clark::StamEvaluator<C>, reference::StamEvaluator<C>>>;
/// By the recursion, as fast as there is one.
template <class C, bool quads>
using QuickMap = std::conditional_t<quads, RecursionMap<C, true>, SharedReferenceMap<C>>;

}  // namespace limitcheck::verify
