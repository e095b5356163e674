// SPDX-License-Identifier: MIT
// Subjects that are right and unlike others: the default audit blames none of them.
#include "verify/mutants/faulty_subjects.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <vector>

#include "data/generators/named_mesh.h"
#include "verify/audit/audit.h"
#include "verify/audit/default_plan.h"
#include "verify/host/isolation/remote_subject.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

std::string options_of(const Habit& habit) {
  // Rounded to float where it computes in double; else the fast engine.
  if (habit.name == "rounded_double")
    return unusual_options(habit.name, "sliding-window", "precision=double,repair=stitch");
  return unusual_options(habit.name, "row-stream", "repair=stitch");
}

// The cases of the default plan with no more triangles than that at the deepest level.
// LIMITCHECK_WHOLE_PLAN=1: all of them.
std::vector<AuditMesh> cases(double triangles) {
  std::vector<AuditMesh> plan = default_plan(Level::kStandard);
  if (std::getenv("LIMITCHECK_WHOLE_PLAN") == nullptr)
    std::erase_if(plan, [&](const AuditMesh& m) {
      return std::ldexp(static_cast<double>(m.mesh.faces.size()), 2 * m.depth) > triangles;
    });
  return plan;
}

void expect_no_finding(const std::vector<AuditSubject>& subjects, const std::vector<AuditMesh>& plan) {
  Auditor auditor(0, 2, {}, Level::kStandard);
  for (const AuditMesh& m : plan)
    for (const AuditSubject& s : subjects)
      for (const Result& r : auditor.run(s, m))
        EXPECT_FALSE(is_bad(r)) << fmt::format("{} on {} (depth {}, {}) / {}: {}", r.subject, m.name, m.depth,
                                               m.depths, r.check, r.message);
}

TEST(UnusualSubjects, AreTwentyAtLeast) {
  EXPECT_GE(habits().size(), 1 + 20U);
}

TEST(UnusualSubjects, AreNotBlamed) {
  std::vector<AuditSubject> subjects;
  for (const Habit& habit : habits())
    if (!habit.of_the_process) subjects.push_back({lc_subject_unusual(), options_of(habit)});
  expect_no_finding(subjects, cases(2500));
}

TEST(UnusualSubjects, AreNotBlamedForWhatTheyDoToTheirProcess) {
  IsolationSettings settings;
  settings.worker = LIMITCHECK_PROGRAM;
  const RemoteSubject remote(RemoteSubject::Kind::kBuiltIn, "unusual", settings);
  std::vector<AuditSubject> subjects;
  for (const Habit& habit : habits())
    if (habit.of_the_process) subjects.push_back({&remote.subject(), options_of(habit)});
  expect_no_finding(subjects, cases(600));
}

// Between other meshes, in a worker of its own, too.
TEST(UnusualSubjects, KeepTheMeshThatTheyWereLentIfTheyLike) {
  IsolationSettings settings;
  settings.worker = LIMITCHECK_PROGRAM;
  const RemoteSubject plain(RemoteSubject::Kind::kBuiltIn, "unusual", settings);
  settings.in_turns = true;
  const RemoteSubject turns(RemoteSubject::Kind::kBuiltIn, "unusual", settings);
  const std::string options = unusual_options("keeps_the_mesh", "row-stream");
  expect_no_finding({{lc_subject_unusual(), options}, {&plain.subject(), options, &turns.subject()}},
                    {{"octahedron", data::named_mesh("octahedron")}});
}

}  // namespace
}  // namespace limitcheck::verify
