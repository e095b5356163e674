// SPDX-License-Identifier: MIT
// The shipped kernels are the reference's linear maps.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "verify/proof/prove_map.h"

namespace limitcheck::verify {
namespace {

void expect_equal(const Neighbourhood& n, const MapOptions& options) {
  for (const ProofRow& row : prove_map(n, options)) {
    EXPECT_TRUE(row.map.equal) << row.topology << ' ' << row.kernel;
    fmt::print("{} {} {} {} points {} digits\n", row.topology, row.kernel, row.map.arithmetic, row.points,
               row.map.digits);
    if (row.map.witness) {
      const Witness& w = *row.map.witness;
      ADD_FAILURE() << w.point << ' ' << w.quantity << " of " << w.control_point << ": " << w.found
                    << " is not " << w.expected;
    }
  }
}

TEST(Proof_Map, OfRegularPairsIsExact) {
  expect_equal(*interior_pair({6, 6, 6, 6}), {Arithmetic::kExact, 0, 4});
}
TEST(Proof_Map, OfRationalPairsIsExact) {
  expect_equal(*interior_pair({3, 6, 4, 6}), {Arithmetic::kExact, 0, 4});
}
TEST(Proof_Map, InResidues) {
  expect_equal(*interior_pair({5, 7, 9, 12}), {Arithmetic::kResidues, 0, 6});
}
TEST(Proof_Map, InDigits) {
  expect_equal(*interior_pair({5, 7, 9, 12}), {Arithmetic::kDigits, 0, 4});
}

}  // namespace
}  // namespace limitcheck::verify
