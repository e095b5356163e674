// SPDX-License-Identifier: MIT
// A proof that cannot fail proves nothing: wrong weights, control points and places in what the kernels of both schemes
// deliver. source_faults.sh plants wrong operations in the kernels themselves.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "reference/catmull_clark/recursion_impl.h"
#include "verify/proof/maps/prove_map_impl.h"

namespace limitcheck::verify {
namespace {

using Number = Stencil<Residue>;
using Frame = fast::LimitFrame<Number>;
using Points = std::vector<fast::Vec3<Number>>;

constexpr int kDepth = 2;
const MapOptions kOptions{Arithmetic::kResidues, kDepth, kDepth};

struct Triangles {
  using Runs = SchemeRuns<TriangleRuns, Number, detail::StencilLane<Residue>::Lane>;
  using Maps = std::tuple<ReferenceMap<Residue, reference::SubdivisionEvaluator<Residue>>>;
  static constexpr std::array kKernels{ProvedKernel::kSlidingWindow, ProvedKernel::kRowStream,
                                       ProvedKernel::kRowStreamPatch};
  static Neighbourhood topology(ProvedKernel kernel) {
    return *interior_pair(kernel == ProvedKernel::kRowStreamPatch ? std::array{6, 6, 6, 6}
                                                                  : std::array{5, 7, 4, 8});
  }
  static bool is_place(const fast::LatticePoint& p) { return p.i + p.j <= p.denominator; }
  static fast::LatticePoint turned(const fast::LatticePoint& p) {
    return {p.face, p.j, p.denominator - p.i - p.j, p.denominator};
  }
};
struct Quads {
  using Runs = SchemeRuns<QuadRuns, Number, detail::StencilLane<Residue>::Lane>;
  using Maps = std::tuple<ReferenceMap<Residue, reference::catmull_clark::SubdivisionEvaluator<Residue>>>;
  static constexpr std::array kKernels{ProvedKernel::kSlidingWindow, ProvedKernel::kCrackEdge,
                                       ProvedKernel::kRowStream, ProvedKernel::kRowStreamEdge,
                                       ProvedKernel::kRowStreamPatch};
  static Neighbourhood topology(ProvedKernel kernel) {
    return interior_quad(kernel == ProvedKernel::kRowStreamPatch ? std::array{4, 4, 4, 4}
                                                                 : std::array{5, 4, 3, 6});
  }
  static bool is_place(const fast::LatticePoint& p) { return p.i <= p.denominator && p.j <= p.denominator; }
  static fast::LatticePoint turned(const fast::LatticePoint& p) {
    return {p.face, p.denominator - p.j, p.i, p.denominator};
  }
};

template <class Scheme, class Visit>
void run(ProvedKernel kernel, const data::ControlMesh& mesh, const Points& points, Visit&& visit) {
  typename Scheme::Runs(mesh, points).run(kernel, kDepth, visit);
}

/// What the proof says of a kernel whose points `change(number, place, frame)` alters.
template <class Scheme, class Change>
MapProof spoiled(ProvedKernel kernel, const Neighbourhood& topology, Change&& change) {
  const Points points = detail::identity<Residue>(topology.mesh.positions.size());
  typename Scheme::Maps maps(topology.mesh);
  std::size_t number = 0;
  return detail::compare<Residue>(topology, "wrong", kOptions, maps,
                                  [&](int, auto&& visit) {
                                    run<Scheme>(kernel, topology.mesh, points,
                                                [&](fast::LatticePoint p, Frame f) {
                                                  change(number++, p, f);
                                                  if (Scheme::is_place(p)) visit(p, f);
                                                });
                                  })
      .map;
}

template <class Scheme>
class Proof_Faults : public ::testing::Test {};
using Schemes = ::testing::Types<Triangles, Quads>;
TYPED_TEST_SUITE(Proof_Faults, Schemes);

TYPED_TEST(Proof_Faults, WrongPlacesAndTangentsAreCaught) {
  struct Wrong {
    const char* what;
    void (*change)(fast::LatticePoint&, Frame&);
  };
  const Wrong all[] = {
      {"corners turned", [](fast::LatticePoint& p, Frame&) { p = TypeParam::turned(p); }},
      {"corners swapped", [](fast::LatticePoint& p, Frame&) { std::swap(p.i, p.j); }},
      {"rows in reverse", [](fast::LatticePoint& p, Frame&) { p.j = p.denominator - p.j; }},
      {"the next point",
       [](fast::LatticePoint& p, Frame&) {
         ++p.i;
         if (!TypeParam::is_place(p)) --p.i;
       }},
      {"the other face", [](fast::LatticePoint& p, Frame&) { p.face = 1 - p.face; }},
      {"one level off", [](fast::LatticePoint& p, Frame&) { p.denominator *= 2; }},
      {"tangents swapped", [](fast::LatticePoint&, Frame& f) { std::swap(f.du, f.dv); }},
      {"a tangent turned",
       [](fast::LatticePoint&, Frame& f) { f.du = -f.du.x * fast::Vec3<Number>{Number(1)}; }},
      {"one tangent twice", [](fast::LatticePoint&, Frame& f) { f.dv = f.du; }},
      {"a tangent off the plane",
       [](fast::LatticePoint&, Frame& f) {
         f.du.x = f.du.x + Number::control_point(0) - Number::control_point(1);
       }},
      {"a constant", [](fast::LatticePoint&, Frame& f) { f.position.x = f.position.x + Number(1); }},
      {"y is x", [](fast::LatticePoint&, Frame& f) { f.position.y = f.position.x; }},
      {"z is y", [](fast::LatticePoint&, Frame& f) { f.position.z = f.position.y; }},
      {"y and z exchanged", [](fast::LatticePoint&, Frame& f) { std::swap(f.position.y, f.position.z); }},
      {"a tangent's y is x", [](fast::LatticePoint&, Frame& f) { f.du.y = f.du.x; }},
      {"a tangent's z is y", [](fast::LatticePoint&, Frame& f) { f.du.z = f.du.y; }},
      {"the other tangent's z is y", [](fast::LatticePoint&, Frame& f) { f.dv.z = f.dv.y; }},
      {"z is not there", [](fast::LatticePoint&, Frame& f) { f.position.z = Number(); }}};
  for (const Wrong& wrong : all)
    for (const ProvedKernel kernel : TypeParam::kKernels)
      EXPECT_FALSE(spoiled<TypeParam>(kernel, TypeParam::topology(kernel),
                                      [&](auto, auto& p, auto& f) { wrong.change(p, f); })
                       .equal)
          << wrong.what << " in " << name_of(kernel);
}

TYPED_TEST(Proof_Faults, OneWeightOfOnePointIsCaughtAndNamed) {
  for (const ProvedKernel kernel : TypeParam::kKernels) {
    const Neighbourhood topology = TypeParam::topology(kernel);
    for (std::size_t at = 0; at < 9; ++at) {
      const auto weight = static_cast<int>(at % topology.mesh.positions.size());
      const MapProof map =
          spoiled<TypeParam>(kernel, topology, [&](std::size_t point, fast::LatticePoint&, Frame& f) {
            if (point == at)
              f.position.x =
                  f.position.x + Coefficient<Residue>::ratio(1, 1 << 30) * Number::control_point(weight);
          });
      ASSERT_TRUE(map.witness) << name_of(kernel) << " point " << at;
      EXPECT_EQ(map.witness->control_point, weight);
      EXPECT_FALSE(map.witness->point.empty());
    }
  }
}

TEST(Proof_PlaceFaults, TwoControlPointsSwappedAreCaughtAndNamed) {
  std::size_t positions = 0, points = 0;
  for (const ProvedKernel kernel : Triangles::kKernels) {
    const Neighbourhood pair = Triangles::topology(kernel);
    const std::size_t n = pair.mesh.positions.size();
    points += n;
    for (std::size_t k = 0; k + 1 < n; ++k) {
      Points given = detail::identity<Residue>(n);
      std::swap(given[k], given[k + 1]);
      Triangles::Maps maps(pair.mesh);
      const ProofRow row = detail::compare<Residue>(pair, "swapped", kOptions, maps, [&](int, auto&& visit) {
        run<Triangles>(kernel, pair.mesh, given, visit);
      });
      ASSERT_TRUE(row.map.witness) << k;
      // Of two tangents that no longer span the plane, several weights may be called the wrong ones.
      if (row.map.witness->quantity != "position") continue;
      ++positions;
      const auto named = static_cast<std::size_t>(row.map.witness->control_point);
      EXPECT_TRUE(named == k || named == k + 1) << named << " for " << k;
    }
  }
  EXPECT_GT(positions, points / 2);
}

// A rule of the mesh itself: another valence, an edge that is not cut, a crease a level less sharp.
TEST(Proof_TopologyFaults, AnotherTopologyIsCaught) {
  const auto compared = [](const data::ControlMesh& mesh, const data::ControlMesh& truth) {
    const std::size_t n = std::max(mesh.positions.size(), truth.positions.size());
    using Exact = reference::Rational;
    std::tuple<ReferenceMap<Exact, reference::catmull_clark::SubdivisionEvaluator<Exact>>> maps(truth);
    const QuadWindowRuns<Stencil<Exact>, LinearSurface<Stencil<Exact>>> runs(mesh,
                                                                             detail::identity<Exact>(n));
    return detail::compare<Exact>({"", truth}, "window", {Arithmetic::kExact, 0, 1}, maps,
                                  [&](int depth, auto&& visit) { runs.whole(depth, visit); })
        .map.equal;
  };
  const auto sharp = semi_sharp_quads({4, 5, 3, 6});
  EXPECT_TRUE(compared(sharp[0].mesh, sharp[0].mesh));
  data::ControlMesh other = sharp[0].mesh;
  other.sharpness.edges.front().sharpness += 1;
  EXPECT_FALSE(compared(other, sharp[0].mesh));
  other.sharpness = {};
  EXPECT_FALSE(compared(other, sharp[0].mesh));
  const auto creased = creased_quads({4, 5, 3, 6});
  for (const Neighbourhood& quad : creased) {
    if (has_dart(quad.mesh)) continue;
    other = quad.mesh;
    other.sharpness.edges.pop_back();
    if (has_dart(other)) continue;
    EXPECT_FALSE(compared(other, quad.mesh)) << quad.name;
  }
}

TEST(Proof_ScaleFaults, OfTheScaleOfFloatAndDoubleAreCaught) {
  constexpr auto rightly = [](int depth, auto&& scaled, auto unit) {
    return detail::scales_rightly<TriangleRuns, decltype(unit)>(depth, scaled);
  };
  const auto right = [](auto unit, int depth) {
    return static_cast<decltype(unit)>(std::ldexp(static_cast<double>(unit) / 12, -3 * depth));
  };
  for (int depth = 0; depth <= fast::row_stream::kMaxDepth; ++depth) {
    EXPECT_TRUE((detail::scales_rightly<TriangleRuns, float>(depth))) << depth;
    EXPECT_TRUE((detail::scales_rightly<TriangleRuns, double>(depth))) << depth;
    EXPECT_TRUE((detail::scales_rightly<QuadRuns, float>(depth))) << depth;
    EXPECT_TRUE((detail::scales_rightly<QuadRuns, double>(depth))) << depth;
    EXPECT_TRUE(rightly(depth, right, 0.F) && rightly(depth, right, 0.)) << depth;
    const auto level = [&](auto unit, int d) { return right(unit, d + 1); };
    EXPECT_FALSE(rightly(depth, level, 0.F)) << depth;
    const auto ulp = [&](auto unit, int d) { return std::nextafter(right(unit, d), decltype(unit)(0)); };
    EXPECT_FALSE(rightly(depth, ulp, 0.F) || rightly(depth, ulp, 0.)) << depth;
    const auto eleven = [&](auto unit, int d) { return right(unit, d) * 12 / 11; };
    EXPECT_FALSE(rightly(depth, eleven, 0.F)) << depth;
  }
}

TEST(Proof_Stencil, WhatIsNotLinearIsRefused) {
  const Number a = Number::control_point(0), b = Number::control_point(1);
  EXPECT_THROW(a * b, NotLinear);
  EXPECT_THROW(a / b, NotLinear);
  EXPECT_THROW(static_cast<void>(a < b), NotLinear);
  EXPECT_THROW(sqrt(a), NotLinear);
}

}  // namespace
}  // namespace limitcheck::verify
