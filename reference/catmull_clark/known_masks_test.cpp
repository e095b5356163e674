// SPDX-License-Identifier: MIT
#include "reference/catmull_clark/vertex_limit.h"
#include "reference/mesh/test_masks.h"

namespace limitcheck::reference::catmull_clark {
namespace {

using N = Decimal100;

TEST(CatmullClark_Masks, AreTheKnownOnes) {
  const auto all = known_masks("cc");
  EXPECT_EQ(all.size(), 26U);
  for (const KnownMask& known : all)
    expect_masks(known, [&](const std::vector<Vec3<N>>& points) -> std::array<Vec3<N>, 3> {
      RingedCorner<Vec3<N>> c;
      c.on_boundary = known.kind != KnownMask::Kind::kSmooth;
      if (known.kind == KnownMask::Kind::kDart) c.state = VertexState::kDart;
      const auto faces = static_cast<std::size_t>(known.faces);
      const std::size_t edges = faces + (known.kind == KnownMask::Kind::kBoundary ? 1 : 0);
      c.point = points[0];
      c.edges.assign(points.begin() + 1, points.begin() + 1 + static_cast<std::ptrdiff_t>(edges));
      c.faces.assign(points.begin() + 1 + static_cast<std::ptrdiff_t>(edges), points.end());
      if (known.kind == KnownMask::Kind::kDart) c.edges.push_back(points[1]);
      const Tangents<N> t = limit_tangents(c);
      return {limit_position(c), t.first, t.second};
    });
}

}  // namespace
}  // namespace limitcheck::reference::catmull_clark
