// SPDX-License-Identifier: MIT
// Boundaries of files that are refined, not limit: no cracks; and cracks and holes in the same files.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "data/generators/named_mesh.h"
#include "verify/files/test_files.h"
#include "verify/host/host.h"
#include "verify/peers/test_opensubdiv.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

using namespace test;

const std::vector<std::string> kOpen{"holes", "sheet", "fan:5", "fan:1", "ragged-disc", "strip:6"};

FileTessellation delivered_by(const lc_subject& subject, const data::ControlMesh& mesh, int depth) {
  Session session(subject, mesh);
  const Tessellation t = session.tessellate(depth);
  FileTessellation file;
  file.name = subject.name;
  for (std::int64_t v = 0; v < t.vertex_count(); ++v) file.positions.push_back(t.position(v));
  for (const auto& corners : t.triangles())
    add_triangle(file, {static_cast<std::int32_t>(corners[0]), static_cast<std::int32_t>(corners[1]),
                        static_cast<std::int32_t>(corners[2])});
  file.used.assign(file.positions.size(), true);
  return file;
}

// OpenSubdiv's Loop, where corners of faces without neighbours stay in place.
FileTessellation with_corners_kept(const data::ControlMesh& mesh, int steps, bool limit) {
  const auto refined =
      refined_by_opensubdiv(mesh, OpenSubdiv::Sdc::SCHEME_LOOP,
                            OpenSubdiv::Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER, steps, limit);
  FileTessellation file;
  file.positions = refined.points;
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
    place_points(e, {}, [](std::size_t, std::size_t) {});
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

TEST(Boundary, OfTheFilesOfLibrariesThatRefineIsNoCrack) {
  for (const lc_subject* subject : {lc_subject_cgal(), lc_subject_openmesh()})
    for (const std::string name : {"holes", "fan:5", "ragged-disc"}) {
      const auto mesh = data::named_mesh(name);
      const Result r = Judge(mesh)(delivered_by(*subject, mesh, 3));
      EXPECT_EQ(r.status, Status::kHeld) << subject->name << " on " << name << ": " << r.message;
    }
}

TEST(Boundary, WhoseCornersAreKeptIsNoCrack) {
  for (const std::string name : {"sheet", "holes", "strip:6", "fan:1"}) {
    const auto mesh = data::named_mesh(name);
    const Judge judge(mesh);
    for (const bool limit : {false, true}) {
      const Result r = judge(with_corners_kept(mesh, 2, limit));
      EXPECT_EQ(r.status, Status::kHeld) << name << (limit ? ", limit: " : ", refined: ") << r.message;
      EXPECT_NE(r.message.find("kept in place"), std::string::npos) << name << ": " << r.message;
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
  EXPECT_NE(r.message.find("no more of it was compared"), std::string::npos) << r.message;
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
    EXPECT_NE(r.message.find("boundary loops instead of"), std::string::npos) << r.message;
  }
}

}  // namespace
}  // namespace limitcheck::verify
