// SPDX-License-Identifier: MIT
// The linear map of the reference's recursion again, for many points of a face at once. For .cpp files.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <vector>

#include "verify/proof/maps/reference_map.h"

namespace limitcheck::verify {

/// Equal to ReferenceMap of reference::SubdivisionEvaluator<C>, by the same rings, steps, basis and masks,
/// but a sub-face is subdivided once for all points in it, and a basis evaluated once for all control points:
/// a fraction of the work.
template <class C>
class SharedReferenceMap {
 public:
  explicit SharedReferenceMap(const data::ControlMesh& mesh)
      : mesh_(mesh), topology_(mesh.positions.size(), mesh.faces) {}

  const MapRow<C>& at(const fast::LatticePoint& point) {
    const fast::LatticePoint p = lowest_terms(point);
    const auto [found, fresh] = rows_.try_emplace({p.face, p.i, p.j, p.denominator});
    if (fresh) found->second = evaluate(p);
    return found->second;
  }

 private:
  using Point = reference::SurfacePoint<C>;
  using Ringed = reference::RingedFace<C>;
  using Gradient = std::array<int, 2>;

  /// A sub-face under unit control vectors, three at a time.
  struct SubFace {
    explicit SubFace(std::vector<Ringed> r) : rings(std::move(r)), regular(rings.front().is_regular()) {
      if (!regular) return;
      for (const Ringed& face : rings) patches.push_back(reference::detail::regular_patch(face));
    }
    SubFace& part(std::size_t which) {
      if (!parts[which]) {
        std::vector<Ringed> fresh;
        for (const Ringed& face : rings)
          fresh.push_back(reference::SubdividedFace<C>(face).subface(static_cast<int>(which)));
        parts[which] = std::make_unique<SubFace>(std::move(fresh));
      }
      return *parts[which];
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
      rings.push_back(Ringed::gather(topology_, unit_vectors<C>(mesh_, result.points, k), face));
    result.face = std::make_unique<SubFace>(std::move(rings));
    return result;
  }

  MapRow<C> evaluate(const fast::LatticePoint& p) {
    const Root& top = root(p.face);
    MapRow<C> row(mesh_.positions.size());
    const auto put = [&](std::size_t triple, const Point& point) { row.put(top.points, 3 * triple, point); };

    // Barycentric in the current sub-face, times the denominator; and the gradients of that, see
    // SubdivisionEvaluator.
    const auto one = static_cast<std::int64_t>(p.denominator);
    std::array<std::int64_t, 3> w{one - p.i - p.j, p.i, p.j};
    std::array<Gradient, 3> gradient{{{-1, -1}, {1, 0}, {0, 1}}};
    SubFace* face = top.face.get();
    for (long level = 0;; ++level) {
      if (face->regular) {
        reference::Basis<C> basis;
        const auto ratio = [&](std::int64_t n) {
          return Coefficient<C>::ratio(static_cast<int>(n), static_cast<int>(one));
        };
        reference::evaluate_basis<C>(basis, ratio(w[1]), ratio(w[2]), reference::Order::kFirst);
        const reference::ParameterGradients at{gradient[1][0], gradient[1][1], gradient[2][0], gradient[2][1],
                                               level};
        const C scale = reference::NumberTraits<C>::scale(C(1), level);
        for (std::size_t t = 0; t < face->patches.size(); ++t) {
          const auto local = reference::evaluate_patch<C>(face->patches[t], basis, reference::Order::kFirst);
          Point point;
          point.position = local.position;
          reference::set_derivatives(point, local, at, scale, scale, reference::Order::kFirst);
          put(t, point);
        }
        return row;
      }
      for (std::size_t k = 0; k < 3; ++k) {
        if (w[k] != one || face->rings.front().corner[k].is_regular()) continue;
        const Gradient next = gradient[(k + 1) % 3], before = gradient[(k + 2) % 3];
        for (std::size_t t = 0; t < face->rings.size(); ++t) {
          const auto& c = face->rings[t].corner[k];
          put(t, reference::extraordinary_corner<C>(c.point, c.span(), c.on_boundary, c.ring_index,
                                                    {next[0], next[1], before[0], before[1], level},
                                                    face->rings[t].weights, reference::Order::kFirst));
        }
        return row;
      }
      std::size_t k = 0;
      while (k < 3 && 2 * w[k] < one) ++k;
      face = &face->part(k);
      if (k < 3) {
        const std::size_t next = (k + 1) % 3, before = (k + 2) % 3;
        w = {2 * w[k] - one, 2 * w[next], 2 * w[before]};
        gradient = {gradient[k], gradient[next], gradient[before]};
      } else {
        w = {one - 2 * w[2], one - 2 * w[0], one - 2 * w[1]};
        const auto minus = [](Gradient g) { return Gradient{-g[0], -g[1]}; };
        gradient = {minus(gradient[2]), minus(gradient[0]), minus(gradient[1])};
      }
    }
  }

  const data::ControlMesh& mesh_;
  reference::Topology topology_;
  std::map<std::int32_t, Root> roots_;
  std::map<std::tuple<std::int32_t, std::uint32_t, std::uint32_t, std::uint32_t>, MapRow<C>> rows_;
};

}  // namespace limitcheck::verify
