// SPDX-License-Identifier: MIT
// The process in between changes nothing: for every fault the host can find, a subject run in a process of
// its own gives the same arrays, defects and overruns as one called directly.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "data/error.h"
#include "data/shapes.h"
#include "verify/host/host.h"
#include "verify/host/isolation/remote_subject.h"
#include "verify/mutants/faulty_subjects.h"
#include "verify/subject/registry.h"

namespace {

using namespace limitcheck;
using namespace limitcheck::verify;

bool same(const auto a, const auto b) {
  return a.size() == b.size() && std::ranges::equal(std::as_bytes(a), std::as_bytes(b));
}

void expect_same(const Tessellation& here, const Tessellation& there, std::string_view what) {
  EXPECT_EQ(here.has_normals(), there.has_normals()) << what;
  EXPECT_TRUE(same(here.positions_f32(), there.positions_f32())) << what;
  EXPECT_TRUE(same(here.positions_f64(), there.positions_f64())) << what;
  EXPECT_TRUE(same(here.normals_f32(), there.normals_f32())) << what;
  EXPECT_TRUE(same(here.normals_f64(), there.normals_f64())) << what;
  EXPECT_TRUE(same(here.provenance(), there.provenance())) << what;
  EXPECT_TRUE(same(here.triangles(), there.triangles())) << what;
  EXPECT_TRUE(same(here.triangle_face(), there.triangle_face())) << what;
  ASSERT_EQ(here.channel_count(), there.channel_count()) << what;
  for (std::size_t c = 0; c < here.channel_count(); ++c)
    for (std::int64_t n = 0; n < 3 * here.triangle_count(); ++n) {
      const auto t = n / 3;
      const auto k = static_cast<int>(n % 3);
      EXPECT_TRUE(same(here.channel_bits(c, t, k), there.channel_bits(c, t, k))) << what << " " << n;
      for (int of = 0; of < 2 * here.components(c); ++of)
        EXPECT_EQ(here.channel_derivative(c, t, k, of / 2, of % 2),
                  there.channel_derivative(c, t, k, of / 2, of % 2));
    }
  ASSERT_EQ(here.defects().size(), there.defects().size()) << what;
  for (std::size_t k = 0; k < here.defects().size(); ++k) {
    EXPECT_EQ(here.defects()[k].kind, there.defects()[k].kind) << what;
    EXPECT_EQ(here.defects()[k].message, there.defects()[k].message) << what;
  }
  ASSERT_EQ(here.overruns().size(), there.overruns().size()) << what;
  for (std::size_t k = 0; k < here.overruns().size(); ++k) {
    EXPECT_EQ(here.overruns()[k].array, there.overruns()[k].array) << what;
    EXPECT_EQ(here.overruns()[k].before, there.overruns()[k].before) << what;
    EXPECT_EQ(here.overruns()[k].distance, there.overruns()[k].distance) << what;
  }
}

TEST(Isolation, EveryPlantedFaultIsSeenThroughIt) {
  const data::ControlMesh mesh = data::octahedron();
  const RemoteSubject remote(RemoteSubject::Kind::kBuiltIn, "faulty", {{}, LIMITCHECK_PROGRAM, ""});
  std::size_t defects = 0, overruns = 0;
  for (const Fault& fault : faults()) {
    for (const char* precision : {"precision=double", "precision=float"}) {
      const std::string options = faulty_options(fault.name, "opensubdiv-far", precision);
      Session here(*lc_subject_faulty(), mesh, options), there(remote.subject(), mesh, options);
      const Tessellation a = here.tessellate(2), b = there.tessellate(2);
      expect_same(a, b, fault.name);
      there.close();
      defects += b.defects().size();
      overruns += b.overruns().size();
    }
  }
  EXPECT_GE(defects, 10U);
  EXPECT_GE(overruns, 4U);
}

TEST(Isolation, ASessionTessellatesAgainAndAgainAndRefusalsPass) {
  const data::ControlMesh mesh = data::icosahedron();
  const RemoteSubject remote(RemoteSubject::Kind::kBuiltIn, "row-stream", {{}, LIMITCHECK_PROGRAM, ""});
  Session here(*lc_subject_row_stream(), mesh), there(remote.subject(), mesh);
  for (const int depth : {3, 0, 2})
    expect_same(here.tessellate(depth), there.tessellate(depth), "row-stream");
  EXPECT_THROW(there.tessellate(99), SubjectError);
  expect_same(here.tessellate(1), there.tessellate(1), "after a refusal");
  EXPECT_THROW(Session(remote.subject(), mesh, "no-such=option"), SubjectError);
}

TEST(Isolation, ChannelsGoWithTheMeshAndTheirValuesAndDerivativesComeBack) {
  data::ControlMesh mesh = data::octahedron();
  data::Channel& uv = mesh.channels.emplace_back(data::Channel{"uv"});
  for (const std::int32_t v : mesh.faces.corners()) {
    uv.corners.push_back(static_cast<std::int32_t>(uv.corners.size()));  // each face a chart
    uv.values.insert(uv.values.end(), {mesh.positions[v][0] + v, mesh.positions[v][1] - v});
  }
  const RemoteSubject remote(RemoteSubject::Kind::kBuiltIn, "naive", {{}, LIMITCHECK_PROGRAM, ""});
  Session here(*lc_subject_naive(), mesh), there(remote.subject(), mesh);
  const Tessellation t = here.tessellate(1);
  ASSERT_EQ(t.channel_count(), 1U);
  ASSERT_TRUE(t.has_channel_derivatives());
  expect_same(t, there.tessellate(1), "naive");
}

TEST(Isolation, AsManySubjectsAsThereAreSlotsAndNoMore) {
  std::vector<std::unique_ptr<RemoteSubject>> all;
  const auto one_more = [&] {
    all.push_back(
        std::make_unique<RemoteSubject>(RemoteSubject::Kind::kProgram, "true", IsolationSettings{}));
  };
  for (int k = 0; k < 64; ++k) one_more();
  EXPECT_THROW(one_more(), data::ArgumentError);
  all.clear();
  one_more();
}

}  // namespace
