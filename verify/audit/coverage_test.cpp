// SPDX-License-Identifier: MIT
// Tilings that are not the regular one: what a repaired crack looks like, and what an unrepaired mistake
// looks like.
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <vector>

#include "data/shapes.h"
#include "verify/audit/checks.h"
#include "verify/subject/host.h"

namespace limitcheck::verify {
namespace {

// A subject that delivers whatever the test has put here: lattice points of a pair of triangles, in quarters
// or thirds.
struct Script {
  std::vector<lc_provenance> points;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::int32_t> faces;
};
Script* script = nullptr;

template <class T>
T* copy(const lc_request* request, const std::vector<T>& from) {
  auto* to = static_cast<T*>(request->allocate(request->host, from.size() * sizeof(T)));
  if (to != nullptr) std::memcpy(to, from.data(), from.size() * sizeof(T));
  return to;
}

const lc_subject* scripted() {
  static const lc_subject subject = [] {
    lc_subject s{};
    s.abi = LC_SUBJECT_ABI;
    s.name = "scripted";
    s.description = "what the test says";
    s.capabilities = [](const char*, lc_capabilities* out, const char**) {
      *out = {};
      out->precision = LC_FLOAT64;
      out->max_depth = 5;
      out->per_face_depth = 1;
      return LC_OK;
    };
    s.create = [](const lc_mesh*, const char*, void** instance, const char**) {
      *instance = script;
      return LC_OK;
    };
    s.tessellate = [](void*, const lc_request* request, lc_tessellation* out, const char**) {
      out->vertex_count = static_cast<std::int64_t>(script->points.size());
      out->triangle_count = static_cast<std::int64_t>(script->triangles.size());
      std::vector<double> positions;
      for (std::size_t v = 0; v < script->points.size(); ++v)
        for (int axis = 0; axis < 3; ++axis) positions.push_back(static_cast<double>(v));
      out->positions = copy(request, positions);
      out->provenance = copy(request, script->points);
      out->triangles = reinterpret_cast<std::uint32_t*>(copy(request, script->triangles));
      out->triangle_face = copy(request, script->faces);
      return LC_OK;
    };
    s.release = [](void*, lc_tessellation*) {};
    s.destroy = [](void*) {};
    return s;
  }();
  return &subject;
}

// The pair: face 0 with the scripted triangles at depth 1, its neighbour at depth 2 with none.
Result coverage_of_face_0(Script s) {
  s.faces.assign(s.triangles.size(), 0);
  script = &s;
  const data::ControlMesh mesh = data::triangle_pair();
  Session session(*scripted(), mesh);
  const std::vector<std::int32_t> depth{1, 2};
  const Tessellation t = session.tessellate(depth);
  ReferenceSurface reference(mesh, 2, LC_POINTS_LIMIT);
  const Evidence e{"scripted",
                   "pair",
                   session.capabilities(),
                   session.mesh(),
                   depth,
                   t,
                   reference.lattice(),
                   reference,
                   locate(t, reference.lattice()),
                   1,
                   1};
  return check_coverage(e).at(0);
}

// The edge of face 0 that it shares with the finer face 1, as the corner it begins at.
int shared_edge() {
  const data::ControlMesh mesh = data::triangle_pair();
  const Lattice lattice(mesh, 2);
  for (int k = 0; k < 3; ++k)
    if (lattice.edges()[lattice.edge_of(0, k)].face[1] >= 0) return k;
  return -1;
}

// Corners, two points per coarse side and four on the shared one, fanned out from the centre (1/3, 1/3).
Script fan() {
  Script s;
  const int shared = shared_edge();
  const std::array<std::array<std::uint32_t, 2>, 3> corner{{{0, 0}, {4, 0}, {0, 4}}};
  for (int k = 0; k < 3; ++k) {
    const auto& a = corner[k];
    const auto& b = corner[(k + 1) % 3];
    for (std::uint32_t step = 0; step < 4; step += k == shared ? 1 : 2)
      s.points.push_back(
          {0, (a[0] * (4 - step) + b[0] * step) / 4, (a[1] * (4 - step) + b[1] * step) / 4, 4});
  }
  const auto rim = static_cast<std::uint32_t>(s.points.size());
  s.points.push_back({0, 1, 1, 3});
  for (std::uint32_t k = 0; k < rim; ++k) s.triangles.push_back({rim, k, (k + 1) % rim});
  return s;
}

TEST(Coverage, AFanRoundTheCentreTilesAFaceNextToAFinerOne) {
  const Result r = coverage_of_face_0(fan());
  EXPECT_EQ(r.bad, 1) << "face 1 only, which has no triangles: " << r.message;
  EXPECT_EQ(r.witness->face, 1);
}

TEST(Coverage, AMissingARepeatedOrAnOverlappingTriangleOfAFanIsSeen) {
  Script missing = fan();
  missing.triangles.pop_back();
  EXPECT_EQ(coverage_of_face_0(missing).bad, 2);

  Script repeated = fan();
  repeated.triangles.push_back(repeated.triangles[1]);
  EXPECT_EQ(coverage_of_face_0(repeated).bad, 2);

  Script folded = fan();  // the same area is covered, but one triangle reaches over its neighbour
  folded.triangles[0][2] =
      (folded.triangles[0][2] + 1) % static_cast<std::uint32_t>(folded.points.size() - 1);
  EXPECT_EQ(coverage_of_face_0(folded).bad, 2);
}

}  // namespace
}  // namespace limitcheck::verify
