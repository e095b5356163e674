// SPDX-License-Identifier: MIT
#include "reference/loop/vertex_limit.h"
#include "reference/mesh/test_masks.h"

namespace limitcheck::reference {
namespace {

using N = Decimal100;

TEST(Loop_Masks, AreTheKnownOnes) {
  const auto all = known_masks("loop");
  EXPECT_EQ(all.size(), 20U);
  for (const KnownMask& known : all)
    expect_masks(known, [&](const std::vector<Vec3<N>>& points) -> std::array<Vec3<N>, 3> {
      std::vector<Vec3<N>> ring(points.begin() + 1, points.end());
      const bool dart = known.kind == KnownMask::Kind::kDart;
      if (dart) ring.push_back(points[1]);
      const auto limit = vertex_limit<N>(points[0], ring, known.kind != KnownMask::Kind::kSmooth,
                                         Weights::kLoop, dart ? VertexState::kDart : VertexState::kOrdinary);
      return {limit.position, limit.tangents.first, limit.tangents.second};
    });
}

}  // namespace
}  // namespace limitcheck::reference
