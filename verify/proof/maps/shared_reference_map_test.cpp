// SPDX-License-Identifier: MIT
// The quick reference map is the slow one.
#include "verify/proof/maps/reference_map.h"

#include <gtest/gtest.h>

#include <vector>

#include "verify/proof/numbers/residue.h"
#include "verify/proof/topologies/neighbourhood.h"

namespace limitcheck::verify {
namespace {

TEST(Proof_SharedReferenceMap, EqualsTheEvaluatorsAtEveryPoint) {
  std::vector<Neighbourhood> list{*interior_pair({5, 7, 9, 12}), *interior_pair({3, 6, 4, 6}),
                                  *interior_pair({6, 6, 6, 6}), face_alone()};
  const auto boundary = boundary_pairs({5, 4, 7, 8});
  for (std::size_t k = 0; k < boundary.size(); k += 9) list.push_back(boundary[k]);
  for (const Neighbourhood& n : list) {
    SharedReferenceMap<Residue> shared(n.mesh);
    ReferenceMap<Residue, reference::SubdivisionEvaluator<Residue>> plain(n.mesh);
    const auto expect_equal = [&](const fast::LatticePoint& at) {
      const auto &a = shared.at(at), &b = plain.at(at);
      EXPECT_TRUE(a.position == b.position && a.d1 == b.d1 && a.d2 == b.d2)
          << n.name << " face " << at.face << " at " << at.i << ' ' << at.j << " of " << at.denominator;
    };
    for (std::int32_t face = 0; face < (n.mesh.faces.size() == 1 ? 1 : 2); ++face) {
      constexpr std::uint32_t kSize = 16;
      for (std::uint32_t i = 0; i <= kSize; ++i)
        for (std::uint32_t j = 0; i + j <= kSize; ++j) expect_equal({face, i, j, kSize});
      expect_equal({face, 1, 1, 3});
    }
  }
}

}  // namespace
}  // namespace limitcheck::verify
