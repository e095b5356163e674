// SPDX-License-Identifier: MIT
// The situations that proofs range over are the ones they say they are.
#include "verify/proof/neighbourhood.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <set>

#include "data/shapes.h"
#include "data/validate.h"
#include "fast/adjacency.h"

namespace limitcheck::verify {
namespace {

TEST(Proof_Neighbourhoods, HaveTheInteriorValencesAskedForOrDoNotExist) {
  int missing = 0;
  for (int a = 3; a <= 12; ++a) {
    for (int b = 3; b <= 12; ++b) {
      for (int c = 3; c <= 12; ++c) {
        for (int d = 3; d <= 12; ++d) {
          const auto pair = interior_pair({a, b, c, d});
          if (!pair) {
            // Two neighbours of valence 3 share all three neighbours: the rest of the mesh is decided.
            EXPECT_TRUE(a == 3 || b == 3 || c == 3 || d == 3 || (a == 4 && c == 4))
                << fmt::format("{} {} {} {}", a, b, c, d);
            ++missing;
            continue;
          }
          EXPECT_EQ(pair->name, fmt::format("{} {} {} {}", a, b, c, d));
        }
      }
    }
  }
  RecordProperty("missing", missing);
  fmt::print("{} of 10000 have no mesh\n", missing);
}

}  // namespace
}  // namespace limitcheck::verify
