// SPDX-License-Identifier: MIT
// A signal ends an audit whatever it is at: no check, and no subject in this process, has to look for it.
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <semaphore>

#include "data/generators/named_mesh.h"
#include "verify/audit/audit.h"
#include "verify/interrupt/interrupt.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

// Signals, and never answers.
lc_status hang(void*, const lc_request*, lc_tessellation*, const char**) {
  raise(SIGTERM);
  std::binary_semaphore never(0);
  never.acquire();
  return LC_FAILED;
}

// In a process of its own, since what is left uses what stands here.
[[noreturn]] void audit_and_leave() {
  lc_subject subject = *find_subject("naive");
  subject.tessellate = hang;
  const InterruptGuard guard;
  Auditor auditor(1, 1);
  auditor.leave_what_is_interrupted();
  const std::vector<AuditSubject> subjects{{&subject, ""}};
  const std::vector<AuditMesh> meshes{{"icosahedron", data::named_mesh("icosahedron")},
                                      {"octahedron", data::named_mesh("octahedron")}};
  const std::vector<Result> results = auditor.run(subjects, meshes);
  const bool told = std::all_of(results.begin(), results.end(), [](const Result& r) {
    return r.status == Status::kNotRun && r.message == "interrupted";
  });
  leave(told && results.size() > 10 && auditor.gave_up() && auditor.abandoned() ? 42 : 1, 2);
}

TEST(AbandonedAudit, HasARowForEachCheckOfWhatWasBegun) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(audit_and_leave(), testing::ExitedWithCode(42), "");
}

}  // namespace
}  // namespace limitcheck::verify
