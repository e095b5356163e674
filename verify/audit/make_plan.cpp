// SPDX-License-Identifier: MIT
// Finds the stars of the plan: limitcheck_make_plan [SEED] > data/generators/planned_stars.inc
#include <fmt/core.h>

#include <cstdlib>

#include "verify/audit/default_plan.h"

int main(int count, char** arguments) {
  using namespace limitcheck;
  using namespace limitcheck::verify;
  const std::uint64_t seed = count > 1 ? std::strtoull(arguments[1], nullptr, 10) : 1;
  fmt::print(
      "// SPDX-License-Identifier: MIT\n// Written by `limitcheck_make_plan {}`, and not to be edited.\n",
      seed);
  for (const data::Scheme scheme : {data::Scheme::kLoop, data::Scheme::kCatmullClark}) {
    std::vector<Looked> known;
    for (const AuditMesh& m : default_plan(Level::kQuick))
      if (m.scheme() == scheme && m.name.find("stars:") == std::string::npos) known.push_back(look_at(m));
    fmt::print("  static const std::vector<PlannedStars> {}{{\n",
               scheme == data::Scheme::kLoop ? "loop" : "quads");
    for (const PlannedCase& c : cover(scheme, known, seed))
      fmt::print("      {{\"{}\", {}, \"{}\", {}}},\n", c.mesh, c.depth, c.depths, c.relations);
    fmt::print("  }};\n");
    for (const std::int32_t ability : steps_of_ability()) {
      const Covered now = covered_by(known, scheme, ability);
      for (std::size_t k = 0; k < now.wanted.size(); ++k)
        if (now.wanted[k] && !now.looked[k])
          fmt::print(stderr, "not found: {}, ability {}: {}\n", name_of(scheme), ability,
                     cells(scheme)[k].name());
    }
  }
}
