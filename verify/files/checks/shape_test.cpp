// SPDX-License-Identifier: MIT
// Boundaries of files that are refined, not limit: no cracks; and cracks and holes in the same files.
// The brackets against known distances and against dense samples.
#include <gtest/gtest.h>

#include <fmt/core.h>
#include <algorithm>
#include <csignal>
#include <stdexcept>

#include "data/generators/named_mesh.h"
#include "data/test_support/assertions.h"
#include "reference/loop/refine.h"
#include "verify/files/test_files.h"
#include "verify/interrupt/interrupt.h"
#include "verify/peers/test_opensubdiv.h"

namespace limitcheck::verify {
namespace {

using namespace test;

const std::vector<std::string> kOpen{"holes", "sheet", "fan:5", "fan:1", "ragged-disc", "strip:6"};

// OpenSubdiv's Loop, where corners of faces without neighbours stay in place.
FileTessellation with_corners_kept(const data::ControlMesh& mesh, int steps, bool limit) {
  const auto refined =
      refined_by_opensubdiv(mesh, OpenSubdiv::Sdc::SCHEME_LOOP,
                            OpenSubdiv::Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER, steps, limit);
  FileTessellation file{.positions = refined.points};
  file.used.assign(file.positions.size(), true);
  const OpenSubdiv::Far::TopologyLevel& last = refined.refiner->GetLevel(steps);
  for (int f = 0; f < last.GetNumFaces(); ++f) {
    const auto corners = last.GetFaceVertices(f);
    add_triangle(file, {corners[0], corners[1], corners[2]});
  }
  return file;
}

// Without the triangle in which `vertex` is; its other corners stay where they are.
void remove_one_at(FileTessellation& t, std::int32_t vertex) {
  for (std::size_t k = 0; k < t.triangles.size(); ++k)
    if (const auto& c = t.triangles[k]; c[0] == vertex || c[1] == vertex || c[2] == vertex) {
      t.triangles.erase(t.triangles.begin() + static_cast<std::ptrdiff_t>(k));
      t.polygon.pop_back();
      --t.polygons;
      return;
    }
}

// A place at the boundary where three triangles or more meet, and one of them that has an open side there.
struct AtTheBoundary {
  std::size_t triangle;
  int corner;
};
AtTheBoundary at_the_boundary(const FileTessellation& t) {
  std::vector<int> uses(t.positions.size(), 0);
  for (const auto& corners : t.triangles)
    for (const std::int32_t v : corners) ++uses[v];
  const auto points = static_cast<std::int64_t>(t.positions.size());
  for (const auto& edge : inspect_surface(points, t.triangles).open_edges) {
    const auto& corners = t.triangles[edge.triangle];
    const auto corner = std::find(corners.begin(), corners.end(), edge.from) - corners.begin();
    if (uses[edge.from] >= 3) return {static_cast<std::size_t>(edge.triangle), static_cast<int>(corner)};
  }
  throw std::logic_error("no such place");
}

// The row file-watertight alone.
class Judge {
 public:
  explicit Judge(const data::ControlMesh& mesh) : mesh_(mesh), surface_(mesh, 1 << 12) {}
  const ClosestPoint& surface() const { return surface_; }
  Result operator()(const FileTessellation& t) const {
    FileEvidence e{"mesh", mesh_, surface_, t, 1e-6};
    place_points(e, {}, false, [](std::size_t, std::size_t) {});
    return check_file_watertight(e).front();
  }

 private:
  const data::ControlMesh& mesh_;
  ClosestPoint surface_;
};

TEST(Boundary, OfRefinedFilesIsNoCrack) {
  for (const std::string& name : kOpen) {
    const auto mesh = data::named_mesh(name);
    const Judge judge(mesh);
    for (const int depth : {0, 1, 3}) {
      const Result r = judge(exact(mesh, depth, false));
      EXPECT_EQ(r.status, Status::kHeld) << name << " depth " << depth << ": " << r.message;
    }
  }
}

TEST(Boundary, WhoseCornersAreKeptIsNoCrack) {
  for (const std::string name : {"sheet", "holes", "strip:6", "fan:1"}) {
    const auto mesh = data::named_mesh(name);
    const Judge judge(mesh);
    for (const bool limit : {false, true}) {
      const Result r = judge(with_corners_kept(mesh, 2, limit));
      EXPECT_EQ(r.status, Status::kHeld) << name << (limit ? ", limit: " : ", refined: ") << r.message;
      EXPECT_TRUE(says(r.message, "kept in place")) << name;
    }
  }
}

// Boundary points drawn inwards and lifted off the surface, as no rule of ours has them.
TEST(Boundary, OfAnUnknownRuleIsNoCrackAsLongAsItHasTheControlMeshsLoops) {
  const auto mesh = data::named_mesh("holes");
  const Judge judge(mesh);
  FileTessellation t = exact(mesh, 2, true);
  const auto report = inspect_surface(static_cast<std::int64_t>(t.positions.size()), t.triangles);
  const FileTessellation flat = t;
  for (const auto& edge : report.open_edges) {
    Vector centre{};
    for (const std::int32_t v : t.triangles[edge.triangle]) centre = centre + 1. / 3 * flat.positions[v];
    t.positions[edge.from] =
        .8 * flat.positions[edge.from] + .2 * centre + .01 * t.normals[edge.from].direction;
  }
  const Result r = judge(t);
  EXPECT_EQ(r.status, Status::kHeld) << r.message;
  EXPECT_TRUE(says(r.message, "no more of it was compared"));
  t.triangles.erase(t.triangles.begin() + 700);
  EXPECT_EQ(judge(t).status, Status::kFinding);
}

TEST(Boundary, CracksAndHolesAreFoundInLimitAndInRefinedFiles) {
  for (const std::string& name : kOpen) {
    const auto mesh = data::named_mesh(name);
    const Judge judge(mesh);
    for (const bool limit : {true, false}) {
      const FileTessellation good = exact(mesh, 2, limit);
      const auto with = [&](auto&& fault) {
        FileTessellation t = good;
        fault(t);
        return judge(t).status;
      };
      const AtTheBoundary at = at_the_boundary(good);
      const auto triangle = static_cast<std::ptrdiff_t>(at.triangle);
      const std::string where = name + (limit ? ", limit" : ", refined");
      EXPECT_EQ(with([](auto&) {}), Status::kHeld) << where;
      EXPECT_EQ(with([&](auto& t) { t.triangles.erase(t.triangles.begin() + triangle); }), Status::kFinding)
          << where << ": a triangle less at the boundary";
      EXPECT_EQ(with([&](auto& t) { crack<float>(t, at.triangle, static_cast<std::size_t>(at.corner)); }),
                Status::kFinding)
          << where << ": a crack at the boundary";
      // The last vertex that refinement makes lies inside.
      const auto inside = static_cast<std::int32_t>(good.positions.size()) - 1;
      EXPECT_EQ(with([&](auto& t) { remove_one_at(t, inside); }), Status::kFinding)
          << where << ": a triangle less";
    }
  }
}

TEST(Boundary, AHoleOfTheControlMeshThatTheFileFilledIsAFinding) {
  const auto mesh = data::named_mesh("holes");
  for (const bool limit : {true, false}) {
    FileTessellation t = exact(mesh, 2, limit);
    const auto report = inspect_surface(static_cast<std::int64_t>(t.positions.size()), t.triangles);
    ASSERT_GE(report.open_loops, 1);
    // A fan from one of its vertices over the first loop.
    std::vector<std::int32_t> next(t.positions.size(), -1);
    for (const auto& edge : report.open_edges) next[edge.from] = edge.to;
    const std::int32_t first = report.open_edges.front().from;
    for (std::int32_t v = next[first]; next[v] != first; v = next[v]) add_triangle(t, {first, next[v], v});
    const Result r = Judge(mesh)(t);
    EXPECT_EQ(r.status, Status::kFinding) << r.message;
    EXPECT_TRUE(says(r.message, "boundary loops instead of"));
  }
}

data::ControlMesh mesh_of_shape(const std::string& name) {
  if (name != "flat sheet") return data::named_mesh(name);
  data::ControlMesh mesh = data::named_mesh("sheet");
  for (auto& p : mesh.positions) p[2] = 0;
  return mesh;
}

struct ShapeCase {
  data::ControlMesh mesh;
  ClosestPoint surface;
  FileTessellation t;
  FileEvidence e;

  ShapeCase(const std::string& name, int depth, std::size_t pieces)
      : mesh(mesh_of_shape(name)), surface(mesh, pieces), e{name, mesh, surface, t, 1e-6} {
    const auto refined = reference::refine<double>(mesh, depth);
    for (const auto& p : refined.limits().positions) t.positions.push_back({p.x, p.y, p.z});
    t.triangles = refined.triangles().to_vector();
    t.used.assign(t.positions.size(), true);
  }
  Hausdorff run() {
    place_points(e, {}, false, [](std::size_t, std::size_t) {});
    return hausdorff(e);
  }
};

// A flat sheet lifted by 1/64 lies 1/64 from its limit surface, both ways, everywhere.
TEST(Hausdorff, OfALiftedFlatSheetIsTheLift) {
  ShapeCase c("flat sheet", 2, 4096);
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
  ShapeCase c("flat sheet", 2, 4096);
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

TEST(Hausdorff, DenseSamplesOfBothSidesAreWithinTheBrackets) {
  for (const std::string name : {"icosahedron", "bumpy:20", "holes", "wheel:7"}) {
    ShapeCase c(name, 1, 1 << 12);
    place_points(c.e, {}, false, [](std::size_t, std::size_t) {});
    std::vector<Vector> samples;
    for (const auto& s : reference::refine<double>(c.mesh, 3).limits().positions)
      samples.push_back({s.x, s.y, s.z});
    test::expect_brackets(c.e, samples);
  }
}

// A file in another unit, amid the surface: every point of it is as far as the middle is, 0.23 diagonals.
TEST(Hausdorff, OfATinyFileIsTheDistanceFromTheMiddle) {
  for (const double scale : {1e-6, 1e-54}) {
    ShapeCase c("icosahedron", 2, 4096);
    for (Vector& p : c.t.positions) p = scale * p;
    const Hausdorff h = c.run();
    const double middle = c.surface.closest({0, 0, 0}).distance;
    const double size = 2 * scale;  // no vertex is farther from the middle
    EXPECT_LE(h.from_triangles.at_least, middle + size) << scale;
    EXPECT_GE(h.from_triangles.at_least, (middle - size) / (1 + kTightness)) << scale;
    EXPECT_LE(h.from_triangles.at_most, (middle + size) * (1 + kTightness)) << scale;
  }
}

TEST(Hausdorff, IsEndedByASignal) {
  ShapeCase c("icosahedron", 2, 4096);
  place_points(c.e, {}, false, [](std::size_t, std::size_t) {});
  const InterruptGuard guard;
  raise(SIGTERM);
  EXPECT_THROW(hausdorff(c.e), Interrupted);
}

}  // namespace
}  // namespace limitcheck::verify
