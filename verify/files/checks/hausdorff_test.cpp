// SPDX-License-Identifier: MIT
// The brackets against known distances and against dense samples.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <stdexcept>

#include "data/generators/named_mesh.h"
#include "reference/loop/refine.h"
#include "verify/files/test_files.h"

namespace limitcheck::verify {
namespace {

data::ControlMesh named(const std::string& name) {
  if (name != "flat sheet") return data::named_mesh(name);
  data::ControlMesh mesh = data::named_mesh("sheet");
  for (auto& p : mesh.positions) p[2] = 0;
  return mesh;
}

struct Case {
  data::ControlMesh mesh;
  ClosestPoint surface;
  FileTessellation t;
  FileEvidence e;

  Case(const std::string& name, int depth, std::size_t pieces)
      : mesh(named(name)), surface(mesh, pieces), e{name, mesh, surface, t, 1e-6} {
    const auto refined = reference::refine<double>(mesh, depth);
    for (const auto& p : refined.limits().positions) t.positions.push_back({p.x, p.y, p.z});
    t.triangles = refined.triangles();
    t.used.assign(t.positions.size(), true);
  }
  Hausdorff run() {
    place_points(e, {}, [](std::size_t, std::size_t) {});
    return hausdorff(e);
  }
};

// A flat sheet lifted by 1/64 lies 1/64 from its limit surface, both ways, everywhere.
TEST(Hausdorff, OfALiftedFlatSheetIsTheLift) {
  Case c("flat sheet", 2, 4096);
  for (Vector& p : c.t.positions) p[2] += 1. / 64;
  const Hausdorff h = c.run();
  EXPECT_NEAR(h.from_triangles.at_least, 1. / 64, 1e-12);
  EXPECT_GE(h.from_surface.at_least,
            1. / 64 - 1e-12);  // a little more at the round corners, which chords cut
  for (const Bracket& b : {h.from_triangles, h.from_surface}) {
    EXPECT_GE(b.at_most, b.at_least);
    EXPECT_LE(b.at_most, 2. / 64) << "at the sheet's corners the parametrisation is no affine map";
  }
}

// A triangle less in the plane: the farthest point of the hole is the centre of its inscribed circle. Legs of
// 1/4 of a square's side s: the radius is s/4 (1 - 1/sqrt 2).
TEST(Hausdorff, SeesAHoleFromTheSurfaceOnly) {
  Case c("flat sheet", 2, 4096);
  const auto hole = c.t.triangles[600];
  c.t.triangles.erase(c.t.triangles.begin() + 600);
  const Vector &p = c.t.positions[hole[0]], &q = c.t.positions[hole[1]], &r = c.t.positions[hole[2]];
  const double a = norm(q - p), b = norm(r - q), d = norm(p - r);
  const double radius = norm(cross(q - p, r - p)) / (a + b + d);
  const Hausdorff h = c.run();
  EXPECT_LE(h.from_triangles.at_least, 1e-12);
  EXPECT_LE(h.from_surface.at_least, radius * (1 + 1e-12));
  EXPECT_GE(h.from_surface.at_most, radius);
  RecordProperty("at_least_by_radius", fmt::format("{:.4f}", h.from_surface.at_least / radius));
  RecordProperty("at_most_by_radius", fmt::format("{:.4f}", h.from_surface.at_most / radius));
  EXPECT_GE(h.from_surface.at_least, .95 * radius) << radius;
  EXPECT_LE(h.from_surface.at_most, 1.10 * radius) << radius;
}

// The same of a tetrahedron: one of 4^3 triangles of the first face taken out. The hole's rim stays, so no
// point of the surface over it is farther from what is left than from the rim; and the point of the surface
// over the middle of the hole is nowhere nearer to a triangle than a dense search finds.
TEST(Hausdorff, OfATetrahedronWithATriangleLessIsWhatADenseSearchFinds) {
  Case c("tetrahedron", 3, 1 << 12);
  const auto hole = c.t.triangles[20];
  c.t.triangles.erase(c.t.triangles.begin() + 20);
  const Hausdorff h = c.run();
  const std::array<Vector, 3> corner{c.t.positions[hole[0]], c.t.positions[hole[1]], c.t.positions[hole[2]]};
  double farthest = 0;
  constexpr int kSteps = 60;
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; i + j <= kSteps; ++j) {
      const double u = double(i) / kSteps, v = double(j) / kSteps;
      const Vector flat = (1 - u - v) * corner[0] + u * corner[1] + v * corner[2];
      const Vector there = c.surface.at(c.surface.closest(flat).at, {}).position;
      double least = 1e300;
      for (const auto& t : c.t.triangles)
        least = std::min(
            least, closest_on_triangle(there, {c.t.positions[t[0]], c.t.positions[t[1]], c.t.positions[t[2]]})
                       .distance);
      farthest = std::max(farthest, least);
    }
  RecordProperty("dense", fmt::format("{:.6g}", farthest));
  RecordProperty("bracket", fmt::format("{:.6g} .. {:.6g}", h.from_surface.at_least, h.from_surface.at_most));
  EXPECT_GE(h.from_surface.at_most, farthest);
  EXPECT_GE(h.from_surface.at_least, .95 * farthest);
  EXPECT_LE(h.from_surface.at_most, 1.10 * farthest);
}

TEST(Hausdorff, DenseSamplesOfBothSidesAreWithinTheBrackets) {
  for (const std::string name : {"icosahedron", "bumpy:20", "holes", "wheel:7"}) {
    Case c(name, 1, 1 << 12);
    place_points(c.e, {}, [](std::size_t, std::size_t) {});
    std::vector<Vector> samples;
    for (const auto& s : reference::refine<double>(c.mesh, 3).limits().positions)
      samples.push_back({s.x, s.y, s.z});
    test::expect_brackets(c.e, samples);
  }
}

// A file in another unit, amid the surface: every point of it is as far as the middle is, 0.23 diagonals.
TEST(Hausdorff, OfATinyFileIsTheDistanceFromTheMiddle) {
  for (const double scale : {1e-6, 1e-54}) {
    Case c("icosahedron", 2, 4096);
    for (Vector& p : c.t.positions) p = scale * p;
    const Hausdorff h = c.run();
    const double middle = c.surface.closest({0, 0, 0}).distance;
    constexpr double kTightness = .02;  // what hausdorff() is asked for
    const double size = 2 * scale;      // no vertex is farther from the middle
    EXPECT_LE(h.from_triangles.at_least, middle + size) << scale;
    EXPECT_GE(h.from_triangles.at_least, (middle - size) / (1 + kTightness)) << scale;
    EXPECT_LE(h.from_triangles.at_most, (middle + size) * (1 + kTightness)) << scale;
  }
}

TEST(Hausdorff, IsEndedByTheOneWhoWaits) {
  Case c("icosahedron", 2, 4096);
  place_points(c.e, {}, [](std::size_t, std::size_t) {});
  EXPECT_THROW(hausdorff(c.e,
                         [calls = 0]() mutable {
                           if (++calls > 3) throw std::runtime_error("enough");
                         }),
               std::runtime_error);
}

}  // namespace
}  // namespace limitcheck::verify
