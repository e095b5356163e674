// SPDX-License-Identifier: MIT
// The host trusts nothing. What it makes of bad memory and bad indices: verify/host/isolation/behaviours_test.cpp.
#include "verify/host/host.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>
#include <limits>
#include <tuple>

#include "data/error.h"
#include "data/shapes.h"
#include "verify/host/host_memory.h"
#include "verify/mutants/faulty_subjects.h"
#include "verify/subject/registry.h"

namespace {

using namespace limitcheck;
using namespace limitcheck::verify;
using Kind = Defect::Kind;

// One coordinate is not a float.
data::ControlMesh octahedron() {
  auto mesh = data::octahedron();
  mesh.positions[5][2] = -1.1;
  return mesh;
}

Tessellation planted(const char* fault, int depth = 2) {
  Session session(*lc_subject_faulty(), octahedron(),
                  faulty_options(fault, "opensubdiv-far", "precision=double"));
  return session.tessellate(depth);
}

testing::AssertionResult has_only(const Tessellation& t, Kind kind, const char* array) {
  if (t.defects().size() != 1) return testing::AssertionFailure() << t.defects().size() << " defects";
  const Defect& defect = t.defects().front();
  if (defect.kind != kind || defect.array != array) return testing::AssertionFailure() << defect.message;
  return testing::AssertionSuccess();
}

lc_status status_of(const auto& work) {
  try {
    work();
  } catch (const SubjectError& error) {
    EXPECT_STRNE(error.what(), "");
    return error.status();
  }
  return LC_OK;
}

TEST(Capabilities, WithoutProvenanceDepthsAreUniform) {
  static lc_subject subject = *lc_subject_bare();
  subject.capabilities = [](const char*, lc_capabilities* out, const char**) {
    return out->per_face_depth = out->no_provenance = 1, LC_OK;
  };
  EXPECT_THROW(capabilities(subject), SubjectDied);
  subject.capabilities = [](const char*, lc_capabilities* out, const char**) {
    return out->no_provenance = 1, LC_OK;
  };
  EXPECT_EQ(capabilities(subject).no_provenance, 1);
}

TEST(PlugInInterface, RefusesAnotherInterfaceVersion) {
  lc_subject other = *lc_subject_null();
  ++other.abi;
  EXPECT_EQ(status_of([&] { Session(other, octahedron()); }), LC_NOT_SUPPORTED);
}

TEST(Host, FindsNothingWrongWithASoundSubject) {
  const Tessellation t = planted("none");
  EXPECT_TRUE(t.defects().empty());
  EXPECT_TRUE(t.overruns().empty());
  ASSERT_EQ(t.triangle_count(), 8 * 16);
  ASSERT_EQ(t.vertex_count(), 66);
  for (std::int64_t v = 0; v < t.vertex_count(); ++v) {
    EXPECT_TRUE(t.provenance_ok(v));
    EXPECT_FALSE(t.position_unwritten(v) || t.normal_unwritten(v));
  }
  for (std::int64_t k = 0; k < t.triangle_count(); ++k) EXPECT_TRUE(t.triangle_ok(k));
}

TEST(Host, TakesTheNullSubjectForWhatItIs) {
  Session session(*lc_subject_null(), octahedron());
  const Tessellation t = session.tessellate(3);
  EXPECT_TRUE(t.defects().empty());
  EXPECT_EQ(t.vertex_count(), 0);
  EXPECT_EQ(t.triangle_count(), 0);
}

TEST(Host, RoundsTheControlMeshToThePrecisionOfTheSubject) {
  Session narrow(*lc_subject_opensubdiv_far(), octahedron());
  Session wide(*lc_subject_opensubdiv_far(), octahedron(), "precision=double");
  EXPECT_EQ(narrow.mesh().positions[5][2], double{-1.1F});
  EXPECT_EQ(wide.mesh().positions[5][2], -1.1);
  EXPECT_EQ(narrow.tessellate(1).positions_f32().size(), 3u * 18);
  EXPECT_EQ(narrow.tessellate(1).positions_f64().size(), 0u);
  EXPECT_EQ(wide.tessellate(1).positions_f64().size(), 3u * 18);
  EXPECT_EQ(wide.label(), "opensubdiv-far:precision=double");
}

TEST(Host, RefusesCoordinatesThatAreNotFinite) {
  auto mesh = octahedron();
  mesh.positions[0][0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(status_of([&] { Session(*lc_subject_opensubdiv_far(), mesh); }), LC_INVALID_INPUT);
  EXPECT_EQ(status_of([&] { Session(*lc_subject_opensubdiv_far(), mesh, "precision=double"); }),
            LC_INVALID_INPUT);
}

TEST(Host, JudgesNoMeshWhoseSizeLeavesTheRangeOfThePrecision) {
  for (const auto& [size, single, twice] : {std::tuple{1e-29, LC_OK, LC_OK},
                                            {1e29, LC_OK, LC_OK},
                                            {1e-31, LC_NOT_SUPPORTED, LC_OK},
                                            {1e31, LC_NOT_SUPPORTED, LC_OK},
                                            {1e-72, LC_NOT_SUPPORTED, LC_OK},
                                            {1e72, LC_NOT_SUPPORTED, LC_OK},
                                            {1e-73, LC_NOT_SUPPORTED, LC_NOT_SUPPORTED},
                                            {1e73, LC_NOT_SUPPORTED, LC_NOT_SUPPORTED}}) {
    auto mesh = octahedron();
    for (auto& p : mesh.positions)
      for (double& x : p) x *= size;
    EXPECT_EQ(status_of([&] { Session(*lc_subject_opensubdiv_far(), mesh); }), single) << size;
    EXPECT_EQ(status_of([&] { Session(*lc_subject_opensubdiv_far(), mesh, "precision=double"); }), twice)
        << size;
  }
  auto mesh = octahedron();
  for (auto& p : mesh.positions) p = {0, 0, 0};
  EXPECT_EQ(status_of([&] { Session(*lc_subject_opensubdiv_far(), mesh); }), LC_OK);
}

TEST(Host, RefusesUnknownOptionsAndValues) {
  for (const char* options :
       {"precision=half", "depth=3", "precision", "=double", "precision=double,precision=float"}) {
    EXPECT_EQ(status_of([&] { Session(*lc_subject_opensubdiv_far(), octahedron(), options); }),
              LC_INVALID_INPUT)
        << options;
  }
  EXPECT_EQ(
      status_of([&] { Session(*lc_subject_faulty(), octahedron(), "of=opensubdiv-far,precision=half"); }),
      LC_INVALID_INPUT);
  EXPECT_EQ(status_of([&] { Session(*lc_subject_faulty(), octahedron(), "of=nobody"); }), LC_INVALID_INPUT);
}

TEST(Host, DoesNotAskForDepthsBeyondTheCapabilities) {
  Session session(*lc_subject_opensubdiv_far(), octahedron());
  EXPECT_EQ(status_of([&] { session.tessellate(99); }), LC_NOT_SUPPORTED);
  const std::vector<std::int32_t> mixed{1, 1, 1, 1, 2, 2, 2, 2};
  EXPECT_EQ(status_of([&] { session.tessellate(mixed); }), LC_NOT_SUPPORTED);
  EXPECT_THROW(session.tessellate(std::vector<std::int32_t>(3, 1)), data::ArgumentError);
  EXPECT_THROW(session.tessellate(-2), data::ArgumentError);
  EXPECT_THROW(session.tessellate(1, 0), data::ArgumentError);
}

// Whatever the pattern's secret is.
TEST(Host, SeesTheLastByteOfANumberOutsideAnArray) {
  for (int k = 0; k < 3000; ++k)
    for (const double number : {1., -1., 1e-3, 1e6}) {
      detail::Memory memory;
      auto* const data = static_cast<std::byte*>(detail::Memory::allocate(&memory, 24));
      ASSERT_NE(data, nullptr);
      std::memcpy(data + 24, &number, sizeof number);
      ASSERT_EQ(memory.written_behind(memory.blocks().front()), 8) << number;
    }
}

TEST(Host, SeesWhatIsLeftUnwritten) {
  const auto count = [](const Tessellation& t, auto member) {
    std::int64_t n = 0;
    for (std::int64_t v = 0; v < t.vertex_count(); ++v) n += (t.*member)(v);
    return n;
  };
  EXPECT_EQ(count(planted("unwritten_position"), &Tessellation::position_unwritten), 1);
  EXPECT_EQ(count(planted("unwritten_normal"), &Tessellation::normal_unwritten), 1);
  EXPECT_EQ(count(planted("nan_position"), &Tessellation::position_unwritten), 0);  // written, and wrong
  EXPECT_TRUE(has_only(planted("unwritten_triangle"), Kind::kIndexOutOfRange, "triangles"));
}

// What the interface promises about memory, and what comes of a subject that allocates and then writes
// nothing.
TEST(Host, HandsOutAlignedMemoryFullOfOnes) {
  lc_subject subject = *lc_subject_null();
  subject.tessellate = [](void*, const lc_request* request, lc_tessellation* out, const char** message) {
    const auto get = [request](std::size_t bytes) { return request->allocate(request->host, bytes); };
    out->vertex_count = out->triangle_count = 7;
    out->positions = get(7 * 24);
    out->normals = get(7 * 24);
    out->provenance = static_cast<lc_provenance*>(get(7 * sizeof(lc_provenance)));
    out->triangles = static_cast<std::uint32_t*>(get(7 * 12));
    out->triangle_face = static_cast<std::int32_t*>(get(7 * 4));
    for (const void* p : {out->positions, out->normals, static_cast<void*>(out->triangles)}) {
      if (reinterpret_cast<std::uintptr_t>(p) % 64 == 0) continue;
      *message = "not aligned";
      return LC_FAILED;
    }
    return LC_OK;
  };
  Session session(subject, octahedron());
  const Tessellation t = session.tessellate(0);
  for (int k = 0; k < 7; ++k) {
    EXPECT_TRUE(t.position_unwritten(k) && t.normal_unwritten(k));
    EXPECT_FALSE(t.provenance_ok(k) || t.triangle_ok(k));
  }
  EXPECT_EQ(t.defects().size(), 3u);  // triangles, triangle_face, provenance
  EXPECT_TRUE(t.overruns().empty());
}

// Normals may be missing, and that excuses no other array.
TEST(Host, ReadsNoPositionsThatAreMissingTogetherWithTheNormals) {
  lc_subject subject = *lc_subject_null();
  subject.tessellate = [](void*, const lc_request* request, lc_tessellation* out, const char**) {
    out->vertex_count = 3;
    out->provenance =
        static_cast<lc_provenance*>(request->allocate(request->host, 3 * sizeof(lc_provenance)));
    return LC_OK;
  };
  Session session(subject, octahedron());
  const Tessellation t = session.tessellate(0);
  ASSERT_FALSE(t.defects().empty());
  EXPECT_EQ(t.defects()[0].kind, Kind::kMissingArray);
  EXPECT_EQ(t.defects()[0].array, "positions");
  EXPECT_EQ(t.vertex_count(), 0);
}

// NULL where memory is impossible, not an exception through C.
TEST(Host, RefusesMemoryBeyondAllReason) {
  lc_subject subject = *lc_subject_null();
  subject.tessellate = [](void*, const lc_request* request, lc_tessellation*, const char**) {
    return request->allocate(request->host, std::size_t{1} << 60) == nullptr ? LC_NOT_SUPPORTED : LC_OK;
  };
  Session session(subject, octahedron());
  EXPECT_EQ(status_of([&] { session.tessellate(1); }), LC_NOT_SUPPORTED);
}

TEST(Registry, FindsEverySubjectByItsName) {
  for (const lc_subject* subject : built_in_subjects()) {
    EXPECT_EQ(find_subject(subject->name), subject);
    EXPECT_EQ(subject->abi, LC_SUBJECT_ABI);
  }
  EXPECT_EQ(find_subject("null"), lc_subject_null());
  EXPECT_EQ(find_subject("faulty"), lc_subject_faulty());
  EXPECT_EQ(find_subject("nobody"), nullptr);
}

}  // namespace
