// SPDX-License-Identifier: MIT
// What a compiler may do that fuses products with sums: the kernel's rules keep equal bits where faces meet, as long as
// all copies of them are treated alike.                                                              [claim D14]
#include <gtest/gtest.h>

#include <array>
#include <cstdint>

#include "data/generators/named_mesh.h"
#include "verify/mutants/contracted.h"
#include "verify/shared_bits/test_support/shared_bits.h"

namespace limitcheck::verify {
namespace {

// Shared points, on meshes that are closed, have boundaries, or are drawn at random; of all their copies.
struct Shared {
  std::int64_t compared = 0, different = 0;
};
template <Contraction kHow>
Shared shared(int depth) {
  Shared sum;
  for (const char* name : {"octahedron", "icosahedron", "stellated", "cube", "torus", "wheel:7", "fan:4",
                           "sheet", "holes", "random:1", "random:2", "bumpy:200"}) {
    const data::ControlMesh mesh = rounded(data::named_mesh(name));
    SharedBits bits(mesh, depth);
    contracted_points<kHow>(mesh, depth,
                            [&](const fast::LatticePoint& at, const std::array<float, 6>& vertex) {
                              bits.add({at.face, at.i, at.j, at.denominator}, vertex.data());
                            });
    sum.compared += bits.compared(), sum.different += bits.different();
  }
  return sum;
}

TEST(Contraction, AlikeEverywhereLeavesSharedPointsEqual) {
  for (const int depth : {1, 3, 4})  // from depth 4 on edges have origins of their own
    for (const Shared& s : {shared<Contraction::kNone>(depth), shared<Contraction::kLeft>(depth),
                            shared<Contraction::kRight>(depth)}) {
      EXPECT_GT(s.compared, 2'000);
      EXPECT_EQ(s.different, 0);
    }
}

// Which places are treated alike is drawn by where the code lies, so anew in each build.
TEST(Contraction, OfEachCopyInItsOwnWayDoesNot) {
  for (which_compiler = 0; which_compiler < 8; ++which_compiler) {
    const Shared s = shared<Contraction::kByCallSite>(3);
    EXPECT_GT(s.different, 0) << which_compiler;
  }
  which_compiler = 0;
}

// A planted fault: what does not contract at all is no model.
TEST(Contraction, KeepsAProductUnroundedUntilItIsStored) {
  using Left = Contracted<Contraction::kLeft>;
  using Right = Contracted<Contraction::kRight>;
  const float a = 1 + 0x1p-12F, b = 1 + 0x1p-11F;
  EXPECT_EQ((Left(a) * Left(a) - Left(a * a)).value(), 0x1p-24F);
  EXPECT_EQ(((Left(a) * Left(a)).stored() - Left(a * a)).value(), 0);
  EXPECT_EQ((Left(a) * Left(a) - Left(b) * Left(1)).value(), 0x1p-24F);
  EXPECT_EQ((Left(b) * Left(1) - Left(a) * Left(a)).value(), 0) << "the other product is rounded";
  EXPECT_EQ((Right(b) * Right(1) - Right(a) * Right(a)).value(), -0x1p-24F);
  EXPECT_EQ((Contracted<Contraction::kNone>(a) * Contracted<Contraction::kNone>(a) -
             Contracted<Contraction::kNone>(a * a))
                .value(),
            0);
}

}  // namespace
}  // namespace limitcheck::verify
