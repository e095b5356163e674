// SPDX-License-Identifier: MIT
// Subjects that are right when they are asked once and wrong because of what they were asked before: each is
// seen by `state` alone, or at least by it.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "data/generators/named_mesh.h"
#include "verify/audit/audit.h"
#include "verify/host/in_turns.h"
#include "verify/row/test_rows.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

// The recursive subdivider, with a memory that it should not have: one word says which.
struct Forgetful {
  void* inner;
  std::int64_t vertices, faces;
  std::vector<double> positions;
  int calls = 0;
  std::int32_t deepest = -1, last = -1, first = -1;  // depths of the requests so far
  int destroyed = 0;                                 // other instances, before this was made
};
std::string fault;            // of the subject under test
int alive = 0;                // instances
std::int64_t last_faces = 0;  // of the mesh tessellated before, by any instance
int destroyed = 0;            // instances so far
const lc_subject& good() {
  return *lc_subject_naive();
}

// The positions of the first mesh that had as many vertices and faces.
std::map<std::pair<std::int64_t, std::int64_t>, std::vector<double>> cache;
const std::vector<double>& first_of_its_counts(const Forgetful& self) {
  return cache.try_emplace({self.vertices, self.faces}, self.positions).first->second;
}

bool goes_wrong(Forgetful& self, const lc_request& request) {
  std::int32_t depth = 0;
  for (std::int64_t f = 0; f < self.faces; ++f) depth = std::max(depth, request.face_depth[f]);
  const bool wrong = (fault == "after_a_smaller_depth" && self.last >= 0 && self.last < depth) ||
                     (fault == "after_a_greater_depth" && self.deepest > depth) ||
                     (fault == "beside_another" && alive > 1) ||
                     (fault == "after_another_mesh" && last_faces != 0 && last_faces != self.faces) ||
                     (fault == "after_another_was_destroyed" && destroyed > self.destroyed) ||
                     (fault == "first_depth_again" && self.first >= 0 && self.first != depth) ||
                     (fault == "known_by_its_counts" && first_of_its_counts(self) != self.positions) ||
                     (fault == "eighth_call" && self.calls == 7) ||
                     (fault == "eight_threads" && request.threads == 8);
  ++self.calls;
  self.deepest = std::max(self.deepest, depth);
  self.last = depth;
  if (self.first < 0) self.first = depth;
  last_faces = self.faces;
  return wrong;
}

lc_subject forgetful() {
  lc_subject s = good();
  s.name = "forgetful";
  s.create = [](const lc_mesh* mesh, const char*, void** instance, const char** message) {
    auto self = std::make_unique<Forgetful>();
    self->vertices = mesh->vertex_count;
    self->faces = mesh->triangle_count;
    self->positions.assign(mesh->positions, mesh->positions + 3 * mesh->vertex_count);
    const lc_status status = good().create(mesh, nullptr, &self->inner, message);
    if (status != LC_OK) return status;
    ++alive;
    self->destroyed = destroyed;
    *instance = self.release();
    return LC_OK;
  };
  s.tessellate = [](void* instance, const lc_request* request, lc_tessellation* out, const char** message) {
    auto& self = *static_cast<Forgetful*>(instance);
    const bool wrong = goes_wrong(self, *request);
    const lc_status status = good().tessellate(self.inner, request, out, message);
    if (status == LC_OK && wrong) static_cast<double*>(out->positions)[0] *= 1 + 0x1p-40;
    return status;
  };
  s.release = [](void* instance, lc_tessellation* out) {
    good().release(static_cast<Forgetful*>(instance)->inner, out);
  };
  s.destroy = [](void* instance) {
    const std::unique_ptr<Forgetful> self(static_cast<Forgetful*>(instance));
    good().destroy(self->inner);
    --alive;
    ++destroyed;
  };
  return s;
}

Result state_of(const std::string& what) {
  fault = what;
  alive = destroyed = 0;
  last_faces = 0;
  const lc_subject subject = forgetful();
  const auto results = Auditor(2, 1, {}, Level::kStandard)
                           .run({&subject, ""}, {"tetrahedron", data::named_mesh("tetrahedron")});
  EXPECT_EQ(alive, 0) << "every instance is destroyed";
  EXPECT_FALSE(is_bad(row(results, "determinism"))) << what;
  return row(results, "state");
}

TEST(State, OfASubjectWithoutMemoryHolds) {
  const Result r = state_of("none");
  EXPECT_EQ(r.status, Status::kHeld) << r.message;
  EXPECT_GT(r.of, 0);
  for (const char* name : {"naive", "sliding-window", "row-stream", "opensubdiv-far"}) {
    const auto results = Auditor(2, 1, {}, Level::kStandard)
                             .run({find_subject(name), ""}, {"octahedron", data::named_mesh("octahedron")});
    EXPECT_EQ(row(results, "state").status, Status::kHeld) << name << ": " << row(results, "state").message;
  }
  // Nothing in between is of a kind that they do not declare.
  for (const char* name : {"sliding-window", "row-stream"})
    for (const char* mesh : {"corner:3", "creased-cube", "creased-cube:3"}) {
      const auto results =
          Auditor(1, 1, {}, Level::kStandard).run({find_subject(name), ""}, {mesh, data::named_mesh(mesh)});
      EXPECT_FALSE(is_bad(row(results, "state"))) << name << ": " << row(results, "state").message;
    }
}

// As in a process of its own: what it knows by then, it knows from the turns.
TEST(State, OfASubjectThatKnowsMeshesAgainByTheirCountsIsAFinding) {
  fault = "known_by_its_counts";
  alive = destroyed = 0;
  const lc_subject plain = *lc_subject_naive(), subject = forgetful();
  cache.clear();
  InTurns turns(subject);
  const AuditSubject audited{&plain, "", &turns.subject()};
  const auto results =
      Auditor(2, 1, {}, Level::kStandard).run(audited, {"tetrahedron", data::named_mesh("tetrahedron")});
  EXPECT_EQ(row(results, "state").status, Status::kFinding);
}

class Remembers : public testing::TestWithParam<const char*> {};

TEST_P(Remembers, IsAFindingOfStateAndNotOfDeterminism) {
  const Result r = state_of(GetParam());
  EXPECT_EQ(r.status, Status::kFinding) << r.message;
  EXPECT_GT(r.bad, 0);
  EXPECT_FALSE(r.message.empty());
}

INSTANTIATE_TEST_SUITE_P(EachWay, Remembers,
                         testing::Values("after_a_smaller_depth", "after_a_greater_depth", "beside_another",
                                         "after_another_mesh", "after_another_was_destroyed",
                                         "first_depth_again", "eighth_call", "eight_threads"),
                         [](const auto& of) { return std::string(of.param); });

// A point that is no number is `finite`'s business: it is the same one each time.
TEST(State, OfTheSameNaNEachTimeHolds) {
  lc_subject subject = good();
  subject.tessellate = [](void* instance, const lc_request* request, lc_tessellation* out,
                          const char** message) {
    const lc_status status = good().tessellate(instance, request, out, message);
    if (status == LC_OK) static_cast<double*>(out->positions)[0] = std::numeric_limits<double>::quiet_NaN();
    return status;
  };
  const auto results = Auditor(1, 1, {}, Level::kStandard)
                           .run({&subject, ""}, {"tetrahedron", data::named_mesh("tetrahedron")});
  EXPECT_NE(row(results, "state").status, Status::kFinding) << row(results, "state").message;
}

}  // namespace
}  // namespace limitcheck::verify
