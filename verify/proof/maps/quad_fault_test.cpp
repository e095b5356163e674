// SPDX-License-Identifier: MIT
// A proof that cannot fail proves nothing: wrong operations, control points and places in the kernels of
// quads.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "reference/catmull_clark/subdivision_evaluator_impl.h"
#include "verify/proof/maps/prove_map.h"
#include "verify/proof/maps/prove_quad_map_impl.h"
#include "verify/proof/maps/test_faults.h"
#include "verify/proof/topologies/quad_neighbourhood.h"

namespace limitcheck::verify {
namespace {

using test::same;
using Number = Stencil<Residue>;
using Frame = fast::LimitFrame<Number>;
using Points = std::vector<fast::Vec3<Number>>;
using Window = QuadWindowRuns<Number, LinearSurface<Number>>;
using RowStream = QuadStreamRuns<Number, detail::StencilLane<Residue>::Lane>;
using Maps = std::tuple<QuadReferenceMap<Residue, reference::catmull_clark::SubdivisionEvaluator<Residue>>>;

constexpr int kDepth = 2;
const MapOptions kOptions{Arithmetic::kResidues, kDepth, kDepth};

enum class Kernel { kWindow, kSides, kStream, kStreamSides, kPatch };
constexpr std::array kKernels{Kernel::kWindow, Kernel::kSides, Kernel::kStream, Kernel::kStreamSides,
                              Kernel::kPatch};

template <class Visit>
void run(Kernel kernel, const data::ControlMesh& mesh, const Points& points, Visit&& visit) {
  switch (kernel) {
    case Kernel::kWindow:
      return Window(mesh, points).quad(kDepth, visit);
    case Kernel::kSides:
      return Window(mesh, points).sides(kDepth, visit);
    case Kernel::kStream:
      return RowStream(mesh, points).quad(kDepth, visit);
    case Kernel::kStreamSides:
      return RowStream(mesh, points).sides(kDepth, visit);
    case Kernel::kPatch:
      return RowStream(mesh, points).patch(kDepth, visit);
  }
}
Neighbourhood quad_for(Kernel kernel) {
  return interior_quad(kernel == Kernel::kPatch ? std::array{4, 4, 4, 4} : std::array{5, 4, 3, 6});
}

// Tangents of irregular corners are not compared in residues.
bool same(const Frame& a, const Frame& b, bool at_corner) {
  return same(a.position, b.position) && (at_corner || (same(a.du, b.du) && same(a.dv, b.dv)));
}
bool is_corner(const fast::LatticePoint& p) {
  return p.i % p.denominator == 0 && p.j % p.denominator == 0;
}

TEST(Proof_QuadFaults, OfOneOperationAreCaughtInEveryKernel) {
  for (const Kernel kernel : kKernels) {
    const Neighbourhood quad = quad_for(kernel);
    const Points points = detail::identity<Residue>(quad.mesh.positions.size());
    std::vector<Frame> clean;
    run(kernel, quad.mesh, points, [&](const fast::LatticePoint&, const Frame& f) { clean.push_back(f); });
    int visible = 0;
    for (const StencilFault::Kind kind : test::kFaultKinds) {
      constexpr std::int64_t kFaults = 24;
      const std::int64_t operations = test::operations_of(
          kind, [&] { run(kernel, quad.mesh, points, [](const fast::LatticePoint&, const Frame&) {}); });
      ASSERT_GT(operations, 100);
      for (std::int64_t k = 0; k < kFaults; ++k) {
        const std::int64_t at = (2 * k + 1) * operations / (2 * kFaults);
        Maps maps(quad.mesh);
        std::size_t index = 0;
        bool differs = false, corners_differ = false;
        const StencilFault fault(kind, at);
        const ProofRow row = detail::compare<Residue>(quad, "kernel", kOptions, maps, [&](int, auto&& visit) {
          run(kernel, quad.mesh, points, [&](const fast::LatticePoint& p, const Frame& f) {
            const Frame& right = clean[index++];
            differs = differs || !same(f, right, is_corner(p));
            corners_differ = corners_differ || (is_corner(p) && !same(f, right, false));
            visit(p, f);
          });
        });
        EXPECT_TRUE(fault.has_struck());
        visible += differs ? 1 : 0;
        // Regular corners have tangents that are compared.
        if (differs || !corners_differ) {
          EXPECT_EQ(row.map.equal, !differs) << static_cast<int>(kernel) << " at operation " << at;
        }
        if (!row.map.witness) continue;
        EXPECT_FALSE(row.map.witness->point.empty());
      }
    }
    fmt::print("kernel {}: {} of 120 faults reach a limit point, all caught\n", static_cast<int>(kernel),
               visible);
    EXPECT_GE(visible, 15) << static_cast<int>(kernel);
  }
}

TEST(Proof_QuadFaults, WrongPlacesAndTangentsAreCaught) {
  struct Wrong {
    const char* what;
    void (*change)(fast::LatticePoint&, Frame&);
  };
  const Wrong all[] = {
      {"a quarter turn lost",
       [](fast::LatticePoint& p, Frame&) {
         p = {p.face, p.denominator - p.j, p.i, p.denominator};
       }},
      {"rows in reverse", [](fast::LatticePoint& p, Frame&) { p.j = p.denominator - p.j; }},
      {"rows and columns swapped", [](fast::LatticePoint& p, Frame&) { std::swap(p.i, p.j); }},
      {"the next point",
       [](fast::LatticePoint& p, Frame&) {
         if (p.i < p.denominator) ++p.i;
       }},
      {"tangents swapped", [](fast::LatticePoint&, Frame& f) { std::swap(f.du, f.dv); }},
      {"one tangent twice", [](fast::LatticePoint&, Frame& f) { f.dv = f.du; }},
      {"a constant", [](fast::LatticePoint&, Frame& f) { f.position.x = f.position.x + Number(1); }},
      {"y is x", [](fast::LatticePoint&, Frame& f) { f.position.y = f.position.x; }},
      {"a tangent's z is y", [](fast::LatticePoint&, Frame& f) { f.du.z = f.du.y; }},
      {"an ulp of a weight", [](fast::LatticePoint&, Frame& f) {
         f.position.x = f.position.x + Coefficient<Residue>::ratio(1, 1 << 30) * Number::control_point(2);
       }}};
  for (const Wrong& wrong : all) {
    for (const Kernel kernel : kKernels) {
      const Neighbourhood quad = quad_for(kernel);
      const Points points = detail::identity<Residue>(quad.mesh.positions.size());
      Maps maps(quad.mesh);
      const ProofRow row = detail::compare<Residue>(quad, "wrong", kOptions, maps, [&](int, auto&& visit) {
        run(kernel, quad.mesh, points, [&](fast::LatticePoint p, Frame f) {
          wrong.change(p, f);
          visit(p, f);
        });
      });
      EXPECT_FALSE(row.map.equal) << wrong.what << " in kernel " << static_cast<int>(kernel);
    }
  }
}

// A rule of the mesh itself: another valence, an edge that is not cut, a crease a level less sharp.
TEST(Proof_QuadFaults, AnotherTopologyIsCaught) {
  const auto compared = [](const data::ControlMesh& mesh, const data::ControlMesh& truth) {
    const std::size_t n = std::max(mesh.positions.size(), truth.positions.size());
    using Exact = reference::Rational;
    std::tuple<QuadReferenceMap<Exact, reference::catmull_clark::SubdivisionEvaluator<Exact>>> maps(truth);
    const QuadWindowRuns<Stencil<Exact>, LinearSurface<Stencil<Exact>>> runs(mesh,
                                                                             detail::identity<Exact>(n));
    return detail::compare<Exact>({"", truth}, "window", {Arithmetic::kExact, 0, 1}, maps,
                                  [&](int depth, auto&& visit) { runs.quad(depth, visit); })
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

}  // namespace
}  // namespace limitcheck::verify
