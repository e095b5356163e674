// SPDX-License-Identifier: MIT
// Where the tangents of the surface vanish but for rounding no subject has a finding, and row streaming takes
// the same side as the sliding window.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "data/control_mesh.h"
#include "verify/audit/audit.h"
#include "verify/host/host.h"
#include "verify/row/test_rows.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

data::ControlMesh wheel_of_twelve(const std::array<double, 3>& hub,
                                  const std::array<std::array<double, 3>, 12>& ring) {
  data::ControlMesh mesh{{hub}, {}};
  mesh.positions.insert(mesh.positions.end(), ring.begin(), ring.end());
  for (std::int32_t i = 0; i < 12; ++i) mesh.faces.push_back({0, i + 1, (i + 1) % 12 + 1});
  return mesh;
}

/// Rings of dyadic numbers whose first harmonic is zero, though not one rounded sum of it is.
data::ControlMesh tilted() {
  return wheel_of_twelve({.25, .5, -.375}, {{{3.75, .25, 1},
                                             {1.5, .125, -.125},
                                             {-2.5, 1.625, -.5},
                                             {-1.75, 1.75, .625},
                                             {1, -.375, -1.25},
                                             {1, -1.875, -1.625},
                                             {.75, .25, .25},
                                             {1.5, 3.125, -.125},
                                             {.5, 1.625, .25},
                                             {-1.75, -1.25, .625},
                                             {-2, -.375, -2},
                                             {1, 1.125, -1.625}}});
}

/// The same in a plane; the control facets face down, those after a step up.
data::ControlMesh in_a_plane() {
  return wheel_of_twelve({0, 0, 0}, {{{3.5, 0, 0},
                                      {1, -.5, 0},
                                      {-2.5, 1, 0},
                                      {-2, 1.5, 0},
                                      {.5, -1, 0},
                                      {1, -2.5, 0},
                                      {.5, 0, 0},
                                      {1, 2.5, 0},
                                      {.5, 1, 0},
                                      {-2, -1.5, 0},
                                      {-2.5, -1, 0},
                                      {1, .5, 0}}});
}

/// A sphere without the faces at the poles that would have no area; sin(pi) is left at 1e-16, so that one
/// pole is a row of vertices 1e-17 apart.
data::ControlMesh sphere_with_residue() {
  constexpr int around = 16, rows = 8;
  data::ControlMesh mesh{{{0, 0, 1}}, {}};
  for (int i = 1; i <= rows; ++i)
    for (int j = 0; j < around; ++j) {
      const double t = std::numbers::pi * i / rows, p = 2 * std::numbers::pi * j / around;
      mesh.positions.push_back({std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t)});
    }
  const auto at = [](int i, int j) {
    return static_cast<std::int32_t>(i == 0 ? 0 : 1 + (i - 1) * around + j % around);
  };
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < around; ++j) {
      if (i > 0) mesh.faces.push_back({at(i, j + 1), at(i, j), at(i + 1, j + 1)});
      if (i < rows - 1) mesh.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
    }
  return mesh;
}

TEST(VanishingNormals, BlameNoSoundSubject) {
  const std::vector<std::pair<std::string, data::ControlMesh>> meshes{
      {"tilted", tilted()}, {"in a plane", in_a_plane()}, {"sphere", sphere_with_residue()}};
  const std::vector<std::pair<const char*, const char*>> subjects{
      {"naive", ""}, {"sliding-window", "precision=double"}, {"sliding-window", ""}, {"row-stream", ""}};
  for (const auto& [name, mesh] : meshes) {
    for (const int depth : {0, 1, 4}) {
      Auditor auditor(depth, 1);
      for (const auto& [subject, options] : subjects) {
        const auto results = auditor.run({find_subject(subject), options}, {name, mesh});
        for (const char* check : {"positions", "normals", "normal-length", "normals-against-positions"})
          EXPECT_EQ(row(results, check).status, Status::kHeld)
              << subject << " " << options << " " << name << " depth " << depth << " " << check;
      }
    }
  }
}

TEST(VanishingNormals, FaceTheSameWayInBothEngines) {
  for (const char* subject : {"sliding-window", "row-stream"}) {
    Session session(*find_subject(subject), in_a_plane());
    const Tessellation t = session.tessellate(1);
    std::int64_t hubs = 0;
    for (std::int64_t v = 0; v < t.vertex_count(); ++v) {
      const lc_provenance& p = t.provenance()[v];
      if (p.i != 0 || p.j != 0) continue;
      ++hubs;
      EXPECT_EQ(t.normal(v), (Vector{0, 0, 1})) << subject;
      for (const double c : t.normal(v)) EXPECT_FALSE(std::signbit(c)) << subject;
    }
    EXPECT_GT(hubs, 0) << subject;
  }
}

}  // namespace
}  // namespace limitcheck::verify
