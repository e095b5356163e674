// SPDX-License-Identifier: MIT
// Claim D14 across compilers and machines. A file to itself, since a cross-build has little else
// (verify/portability).
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "data/generators/named_mesh.h"
#include "fast/stream/kernel/targets.h"
#include "verify/shared_bits/test_support/shared_bits.h"

namespace limitcheck::verify {
namespace {

using fast::row_stream::kernels;

// The same bits from every compiler: g++ 12 (-O3) and clang 14 (-O1) gave these. Positions, normals,
// boundaries, all depths. After a change of the rules on purpose the new number goes here, once both agree.
TEST(SharedBits, AreTheSameWithEveryCompiler) {
  std::uint64_t all = 0;
  std::int64_t points = 0;
  const auto add = [&](const std::string& name, int deepest) {
    const auto mesh = rounded(data::named_mesh(name));
    SharedBits bits(mesh, deepest);
    for (int depth = 0; depth <= deepest; ++depth)
      add_pairs(rewrite(mesh, 0), depth, kernels().front(), Form::kRows, 1, bits);
    EXPECT_EQ(bits.different(), 0) << name << ": " << bits.witness();
    all = all * 31 + bits.hash();
    points += bits.points();
  };
  for (const std::string& name : data::stock_shapes()) add(name, 5);
  for (const char* name : {"bumpy:800", "random:1", "random:2", "random:3"}) add(name, 6);
  for (const char* name : {"tetrahedron", "fan:5:1"}) add(name, 10);
  EXPECT_EQ(all, 16175440324700258915u) << points << " points";
}

}  // namespace
}  // namespace limitcheck::verify
