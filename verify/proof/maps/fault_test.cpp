// SPDX-License-Identifier: MIT
// A proof that cannot fail proves nothing: wrong operations, wrong control points, wrong places.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "verify/proof/maps/prove_map_impl.h"
#include "verify/proof/maps/test_faults.h"

namespace limitcheck::verify {
namespace {

using test::same;
using Number = Stencil<Residue>;
using Frame = fast::LimitFrame<Number>;
using Points = std::vector<fast::Vec3<Number>>;
using Window = WindowRuns<Number, LinearSurface<Number>>;
using RowStream = StreamRuns<Number, detail::StencilLane<Residue>::Lane>;
using Maps = std::tuple<ReferenceMap<Residue, reference::SubdivisionEvaluator<Residue>>>;

constexpr int kDepth = 2;
const MapOptions kOptions{Arithmetic::kResidues, kDepth, kDepth};

/// What the two engines deliver for a pair.
template <class Visit>
void run_window(const data::ControlMesh& mesh, const Points& points, Visit&& visit) {
  Window(mesh, points).pair(kDepth, visit);
}
template <class Visit>
void run_stream(const data::ControlMesh& mesh, const Points& points, Visit&& visit) {
  RowStream(mesh, points).pair(kDepth, visit);
}

bool same(const Frame& a, const Frame& b) {
  return same(a.position, b.position) && same(a.du, b.du) && same(a.dv, b.dv);
}

std::string name(StencilFault::Kind kind) {
  constexpr std::array<const char*, 5> kNames{"factor", "dropped", "doubled", "neighbour", "coordinate"};
  return kNames[static_cast<std::size_t>(kind)];
}

/// Spoils operations spread over the whole run, one at a time. Whatever changes a single delivered weight
/// must be caught and traced to a point and a control point.
template <class Run>
void expect_caught(const char* kernel, const Neighbourhood& pair, Run&& run) {
  const Points points = detail::identity<Residue>(pair.mesh.positions.size());
  std::vector<Frame> clean;
  run(pair.mesh, points, [&](const fast::LatticePoint&, const Frame& f) { clean.push_back(f); });
  int planted = 0, visible = 0;
  using Kind = StencilFault::Kind;
  for (const Kind kind : test::kFaultKinds) {
    const std::int64_t operations = test::operations_of(
        kind, [&] { run(pair.mesh, points, [](const fast::LatticePoint&, const Frame&) {}); });
    ASSERT_GT(operations, 100);
    constexpr std::int64_t kFaults =
        48;  // the rings of the vertices around the pair take most operations: in vain
    for (std::int64_t k = 0; k < kFaults; ++k) {
      const std::int64_t at = (2 * k + 1) * operations / (2 * kFaults);
      ++planted;
      Maps maps(pair.mesh);
      std::size_t index = 0;
      bool differs = false;
      const StencilFault fault(kind, at);
      const ProofRow row = detail::compare<Residue>(pair, kernel, kOptions, maps, [&](int, auto&& visit) {
        run(pair.mesh, points, [&](const fast::LatticePoint& p, const Frame& f) {
          differs = differs || !same(f, clean[index++]);
          visit(p, f);
        });
      });
      EXPECT_TRUE(fault.has_struck());
      visible += differs ? 1 : 0;
      EXPECT_EQ(row.map.equal, !differs) << kernel << ' ' << name(kind) << " at operation " << at;
      if (!row.map.witness) continue;
      const MapWitness& w = *row.map.witness;
      EXPECT_EQ(w.control_point < 0, kind == Kind::kCoordinate) << w.quantity;
      EXPECT_FALSE(w.point.empty());
    }
  }
  ::testing::Test::RecordProperty("visible", visible);
  fmt::print("{}: {} of {} faults reach a limit point, all caught\n", kernel, visible, planted);
  EXPECT_GE(visible, 30);
}

TEST(Proof_Faults, OfOneOperationOfTheSlidingWindowAreCaught) {
  expect_caught("sliding-window", *interior_pair({5, 7, 4, 8}),
                [](auto&&... a) { run_window(std::forward<decltype(a)>(a)...); });
}
TEST(Proof_Faults, OfOneOperationOfRowStreamingAreCaught) {
  expect_caught("row-stream", *interior_pair({5, 7, 4, 8}),
                [](auto&&... a) { run_stream(std::forward<decltype(a)>(a)...); });
}

TEST(Proof_Faults, TwoControlPointsSwappedAreCaughtAndNamed) {
  const Neighbourhood pair = *interior_pair({5, 7, 4, 8});
  const std::size_t n = pair.mesh.positions.size();
  std::size_t positions = 0;
  for (const bool window : {true, false}) {
    for (std::size_t k = 0; k + 1 < n; ++k) {
      Points points = detail::identity<Residue>(n);
      std::swap(points[k], points[k + 1]);
      Maps maps(pair.mesh);
      const ProofRow row = detail::compare<Residue>(pair, "swapped", kOptions, maps, [&](int, auto&& visit) {
        window ? run_window(pair.mesh, points, visit) : run_stream(pair.mesh, points, visit);
      });
      ASSERT_TRUE(row.map.witness) << k;
      // Of two tangents that no longer span the plane, several weights may be called the wrong ones.
      if (row.map.witness->quantity != "position") continue;
      ++positions;
      const auto named = static_cast<std::size_t>(row.map.witness->control_point);
      EXPECT_TRUE(named == k || named == k + 1) << named << " for " << k;
    }
  }
  EXPECT_GT(positions, n);
}

TEST(Proof_Faults, WrongPlacesAndTangentsAreCaught) {
  const Neighbourhood pair = *interior_pair({5, 7, 4, 8});
  const Points points = detail::identity<Residue>(pair.mesh.positions.size());
  struct Wrong {
    const char* what;
    void (*change)(fast::LatticePoint&, Frame&);
  };
  const Wrong all[] = {
      {"corners turned",
       [](fast::LatticePoint& p, Frame&) {
         p = {p.face, p.j, p.denominator - p.i - p.j, p.denominator};
       }},
      {"corners swapped", [](fast::LatticePoint& p, Frame&) { std::swap(p.i, p.j); }},
      {"the other face", [](fast::LatticePoint& p, Frame&) { p.face = 1 - p.face; }},
      {"the next point",
       [](fast::LatticePoint& p, Frame&) {
         if (p.i + p.j < p.denominator) ++p.i;
       }},
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
      {"the other tangent's z is y", [](fast::LatticePoint&, Frame& f) { f.dv.z = f.dv.y; }},
      {"z is not there", [](fast::LatticePoint&, Frame& f) { f.position.z = Number(); }},
      {"an ulp of a weight", [](fast::LatticePoint&, Frame& f) {
         f.position.x = f.position.x + Coefficient<Residue>::ratio(1, 1 << 30) * Number::control_point(2);
       }}};
  for (const Wrong& wrong : all) {
    for (const bool window : {true, false}) {
      Maps maps(pair.mesh);
      const ProofRow row = detail::compare<Residue>(pair, "wrong", kOptions, maps, [&](int, auto&& visit) {
        const auto changed = [&](fast::LatticePoint p, Frame f) {
          wrong.change(p, f);
          if (p.i + p.j <= p.denominator) visit(p, f);
        };
        window ? run_window(pair.mesh, points, changed) : run_stream(pair.mesh, points, changed);
      });
      EXPECT_FALSE(row.map.equal) << wrong.what;
    }
  }
}

TEST(Proof_Faults, OfTheScaleOfFloatAndDoubleAreCaught) {
  using detail::scales_rightly;
  const auto right = [](auto unit, int depth) {
    return static_cast<decltype(unit)>(std::ldexp(static_cast<double>(unit) / 12, -3 * depth));
  };
  for (int depth = 0; depth <= fast::row_stream::kMaxDepth; ++depth) {
    EXPECT_TRUE(scales_rightly<float>(depth) && scales_rightly<double>(depth)) << depth;
    EXPECT_TRUE(scales_rightly<float>(depth, right) && scales_rightly<double>(depth, right)) << depth;
    const auto level = [&](auto unit, int d) { return right(unit, d + 1); };
    EXPECT_FALSE(scales_rightly<float>(depth, level)) << depth;
    const auto ulp = [&](auto unit, int d) { return std::nextafter(right(unit, d), decltype(unit)(0)); };
    EXPECT_FALSE(scales_rightly<float>(depth, ulp) || scales_rightly<double>(depth, ulp)) << depth;
    const auto eleven = [&](auto unit, int d) { return right(unit, d) * 12 / 11; };
    EXPECT_FALSE(scales_rightly<float>(depth, eleven)) << depth;
  }
}

TEST(Proof_Faults, WhatIsNotLinearIsRefused) {
  const Number a = Number::control_point(0), b = Number::control_point(1);
  EXPECT_THROW(a * b, NotLinear);
  EXPECT_THROW(a / b, NotLinear);
  EXPECT_THROW(static_cast<void>(a < b), NotLinear);
  EXPECT_THROW(sqrt(a), NotLinear);
}

}  // namespace
}  // namespace limitcheck::verify
