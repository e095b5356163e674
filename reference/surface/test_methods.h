// SPDX-License-Identifier: MIT
// For tests: the points of either scheme by every method that has them, and when two of them are the same.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "data/control_mesh.h"
#include "data/scheme.h"
#include "reference/catmull_clark/recursion.h"
#include "reference/catmull_clark/stam.h"
#include "reference/loop/recursion.h"
#include "reference/loop/refine.h"
#include "reference/loop/stam.h"
#include "reference/number/number_exact.h"
#include "reference/point/parameter.h"
#include "reference/surface/certified.h"

namespace limitcheck::reference {

/// The surface of a mesh by Stam's method and by steps of subdivision; corners are counted as in surface.h.
template <class N>
struct Methods {
  using At = std::function<SurfacePoint<N>(int face, int corner, const Parameter&, const Parameter&)>;
  At stam, by_steps;

  explicit Methods(const data::ControlMesh& mesh, data::Scheme scheme, Weights weights = Weights::kLoop)
      : Methods(mesh.faces, positions_of<N>(mesh), mesh.sharpness, scheme, weights) {}
  Methods(const data::Faces& faces, const std::vector<Vec3<N>>& points, const SharpTags& tags,
          data::Scheme scheme, Weights weights = Weights::kLoop) {
    const auto loop = [](auto evaluator) -> At {
      return [e = std::move(evaluator)](int f, int, const Parameter& u, const Parameter& v) {
        return e.evaluate(f, u, v);
      };
    };
    const auto quads = [](auto evaluator) -> At {
      return [e = std::move(evaluator)](int f, int corner, const Parameter& u, const Parameter& v) {
        return e.evaluate(f, corner, u, v);
      };
    };
    if (scheme == data::Scheme::kLoop) {
      const auto triangles = data::Triangles(faces).to_vector();
      stam = loop(StamEvaluator<N>(points, triangles, weights, tags));
      by_steps = loop(SubdivisionEvaluator<N>(points, triangles, weights, tags));
    } else {
      stam = quads(catmull_clark::StamEvaluator<N>(faces, points, tags));
      by_steps = quads(catmull_clark::SubdivisionEvaluator<N>(faces, points, tags));
    }
  }
};

/// The parameters of a point of a face of three or four corners seen from its corner k, x towards the next.
inline std::array<Parameter, 2> seen_from(std::size_t k, std::size_t corners, const Rational& x,
                                          const Rational& y) {
  using Pair = std::array<Rational, 2>;
  const Pair p = k == 0         ? Pair{x, y}
                 : corners == 3 ? (k == 1 ? Pair{1 - x - y, x} : Pair{y, 1 - x - y})
                 : k == 1       ? Pair{1 - y, x}
                 : k == 2       ? Pair{1 - x, 1 - y}
                                : Pair{y, 1 - x};
  return {Parameter::parse(p[0].str()), Parameter::parse(p[1].str())};
}

/// To what subdivision loses: differences of order d between points 2^-steps apart lose d steps bits. A few
/// roundings make three digits more; normals lose twice what tangents do where these close. Where derivatives
/// do not exist, tangents have no length to compare.
template <class N>
void expect_same(const SurfacePoint<N>& a, const SurfacePoint<N>& b, int steps, const std::string& where) {
  const auto expect_near = [&](int order, const Vec3<N>& x, const Vec3<N>& y, const N& size,
                               const char* what) {
    const N bound = ldexp(N(1000 * std::numeric_limits<N>::epsilon()), order * steps) * (1 + size);
    EXPECT_LE(magnitude(x - y), bound) << where << ": " << what;
  };
  expect_near(0, a.position, b.position, magnitude(b.position), "position");
  EXPECT_EQ(a.at_corner, b.at_corner) << where;
  EXPECT_EQ(a.normal_kind, b.normal_kind) << where;
  EXPECT_EQ(a.first_exist, b.first_exist) << where;
  EXPECT_EQ(a.second_exist, b.second_exist) << where;
  if (b.normal_kind == NormalKind::kRegular) expect_near(2, a.normal, b.normal, N(1), "normal");
  const N first = std::max(magnitude(b.d1), magnitude(b.d2));
  if (b.first_exist) expect_near(1, a.d1, b.d1, first, "d1"), expect_near(1, a.d2, b.d2, first, "d2");
  if (!b.second_exist) return;
  const N second = std::max({magnitude(b.d11), magnitude(b.d12), magnitude(b.d22)});
  expect_near(2, a.d11, b.d11, second, "d11");
  expect_near(2, a.d12, b.d12, second, "d12");
  expect_near(2, a.d22, b.d22, second, "d22");
}

/// A box has the truth in it, but for the truth's own error.
inline void expect_inside(const Enclosure3& box, const Vec3<Decimal100>& truth, const Decimal100& error,
                          const std::string& where) {
  const std::array<Decimal100, 3> x{truth.x, truth.y, truth.z};
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_LE(abs(Decimal100(box[i].value) - x[i]), Decimal100(box[i].radius.to_string(17)) + error) << where;
}

/// At every vertex of the lattice of every `step`-th face, at every corner of a face of other than four: what the
/// naive recursion says, the limits of the refined mesh with its vertex there, and the point of Stam's evaluator.
///   see  (const LeafCorner<N>&, const VertexLimits<N>&, std::size_t vertex, const SurfacePoint<N>&)
template <class N, class See>
void each_lattice_point(const data::ControlMesh& mesh, data::Scheme scheme, int depth, const See& see,
                        std::size_t step = 1) {
  const auto points = positions_of<N>(mesh);
  const auto walk = [&](auto refined, const auto& tessellate, const auto& vertex, const auto& point) {
    for (int i = 0; i < depth; ++i) refined.refine();
    const auto limits = refined.limits();
    for (std::size_t f = 0; f < mesh.faces.size(); f += step) {
      const std::size_t corners = mesh.faces[f].size(), whole = scheme == data::Scheme::kLoop ? 3 : 4;
      if (corners != whole && depth == 0) continue;
      const int side = 1 << (corners == whole ? depth : depth - 1);
      for (std::size_t k = 0; k < (corners == whole ? 1 : corners); ++k) {
        int leaves = 0;
        tessellate(f, k, [&](const auto& leaf) {
          ++leaves;
          for (const auto& c : leaf)
            see(c, limits, static_cast<std::size_t>(vertex(refined, f, k, c.i, c.j)),
                point(static_cast<int>(f), static_cast<int>(k), static_cast<double>(c.i) / side,
                      static_cast<double>(c.j) / side));
        });
        EXPECT_EQ(leaves, side * side);
      }
    }
  };
  if (scheme == data::Scheme::kLoop) {
    const NaiveSubdivider<N> naive(mesh);
    const StamEvaluator<N> stam(mesh);
    walk(
        RefinedMesh<N>(mesh),
        [&](std::size_t f, std::size_t, const auto& emit) { naive.tessellate(f, depth, emit); },
        [](const auto& refined, std::size_t f, std::size_t, int i, int j) { return refined.vertex(f, i, j); },
        [&](int f, int, double u, double v) { return stam.evaluate(f, u, v, Derivatives::kFirst); });
  } else {
    const catmull_clark::NaiveSubdivider<N> naive(mesh.faces, points, mesh.sharpness);
    const catmull_clark::StamEvaluator<N> stam(mesh.faces, points, mesh.sharpness);
    walk(
        catmull_clark::RefinedMesh<N>(mesh.faces, points, mesh.sharpness),
        [&](std::size_t f, std::size_t k, const auto& emit) { naive.tessellate(f, k, depth, emit); },
        [](const auto& refined, std::size_t f, std::size_t k, int i, int j) {
          return refined.vertex(f, k, i, j);
        },
        [&](int f, int k, double u, double v) { return stam.evaluate(f, k, u, v, Derivatives::kFirst); });
  }
}

}  // namespace limitcheck::reference
