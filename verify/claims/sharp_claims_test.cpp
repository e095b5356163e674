// SPDX-License-Identifier: MIT
// Section 2: "it is even possible to let a sharp edge start and end in an otherwise smooth surface". [C85]
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>

#include "data/generators/named_mesh.h"
#include "data/scheme.h"
#include "reference/surface/surface.h"
#include "verify/evidence/lattice.h"
#include "verify/evidence/vector.h"

namespace limitcheck::verify {
namespace {

// The surface along a control edge, as the faces on both sides of it see it.
class EdgeOfSurface {
 public:
  EdgeOfSurface(const Lattice& lattice, const reference::Surface& surface, const Lattice::Edge& edge)
      : lattice_(lattice), surface_(surface), edge_(edge) {}

  struct Both {
    double gap, degrees;  // between the positions, and between the normals
    bool regular;         // either side has a normal
  };
  /// The part `along` of the way from the edge's smaller vertex.
  Both at(double along) const {
    const auto a = side(0, along), b = side(1, along);
    const auto regular = [](const auto& p) { return p.normal_kind == reference::NormalKind::kRegular; };
    return {norm(vector_of(a.position) - vector_of(b.position)),
            angle_degrees(vector_of(a.normal), vector_of(b.normal)), regular(a) && regular(b)};
  }

 private:
  reference::SurfacePoint<double> side(std::size_t k, double along) const {
    // Integers far finer than any point that is asked for.
    constexpr std::int64_t kWhole = std::int64_t{1} << 40;
    const std::int32_t face = edge_.face[k];
    const bool forwards = lattice_.vertex(face, edge_.corner[k]) == edge_.a;
    const auto steps = static_cast<std::int64_t>(along * static_cast<double>(kWhole));
    const FaceDomain domain = lattice_.domain(face);
    const auto p = domain.on_side(edge_.corner[k], forwards ? steps : kWhole - steps, kWhole);
    const auto whole = static_cast<double>(domain.denominator(kWhole));
    return surface_.evaluate(face, p.part, static_cast<double>(p.i) / whole, static_cast<double>(p.j) / whole,
                             reference::Order::kFirst);
  }

  const Lattice& lattice_;
  const reference::Surface& surface_;
  const Lattice::Edge& edge_;
};

// Returns the largest angle between the sides, in degrees.
double look_at_all_edges(const data::ControlMesh& mesh) {
  const Lattice lattice(mesh, 0);
  const reference::Surface surface(mesh, lattice.scheme());
  std::map<std::int32_t, int> sharp_edges_at;
  const auto is_sharp = [&](const Lattice::Edge& e) {
    return std::any_of(
        mesh.sharpness.edges.begin(), mesh.sharpness.edges.end(),
        [&](const data::SharpEdge& s) { return e.a == std::min(s.a, s.b) && e.b == std::max(s.a, s.b); });
  };
  for (const Lattice::Edge& e : lattice.edges())
    if (is_sharp(e)) ++sharp_edges_at[e.a], ++sharp_edges_at[e.b];
  const auto ends = std::count_if(sharp_edges_at.begin(), sharp_edges_at.end(),
                                  [](const auto& entry) { return entry.second == 1; });
  EXPECT_EQ(ends, 2);

  double sharpest = 0, bluntest = 180, smooth = 0, gap = 0;
  for (const Lattice::Edge& edge : lattice.edges()) {
    const EdgeOfSurface here(lattice, surface, edge);
    const bool sharp = is_sharp(edge);
    for (int i = 0; i <= 16; ++i) {
      const auto both = here.at(i / 16.);
      gap = std::max(gap, both.gap);
      const bool inside = i > 0 && i < 16;
      EXPECT_TRUE(both.regular);
      if (sharp && inside) {
        sharpest = std::max(sharpest, both.degrees);
        bluntest = std::min(bluntest, both.degrees);
      } else if (!sharp && inside) {
        smooth = std::max(smooth, both.degrees);
      }
    }
    // Where the crease ends, its sides turn into one tangent plane.
    for (const bool last : {false, true}) {
      if (!sharp || sharp_edges_at[last ? edge.b : edge.a] != 1) continue;
      const auto angle = [&](double distance) { return here.at(last ? 1 - distance : distance).degrees; };
      EXPECT_LE(angle(0), 1e-7);
      EXPECT_LT(angle(0x1p-20), angle(0x1p-10));
      EXPECT_LT(angle(0x1p-10), angle(0x1p-2));
    }
  }
  EXPECT_GT(sharpest, 10);
  EXPECT_GT(bluntest, 1e-3) << "sharp all along";
  EXPECT_LE(smooth, 1e-7) << "smooth everywhere else";
  EXPECT_LE(gap, 1e-14) << "and in one piece";
  return sharpest;
}

TEST(Sec2_SharpEdges, StartAndEndInAnOtherwiseSmoothSurface) {
  RecordProperty("claim", "C85");
  const double triangles = look_at_all_edges(data::named_mesh("bumpy-crease:200"));
  const double quads = look_at_all_edges(data::named_mesh("open-crease"));
  RecordProperty("degrees_between_the_sides_loop", fmt::format("{:.0f}", triangles));
  RecordProperty("degrees_between_the_sides_catmull_clark", fmt::format("{:.0f}", quads));
}

}  // namespace
}  // namespace limitcheck::verify
