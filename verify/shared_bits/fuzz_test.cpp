// SPDX-License-Identifier: MIT
// Random meshes, depths and pairings: the same bits at shared points, finite and unit vectors everywhere, and
// nothing but normals for the audit to find. LIMITCHECK_FUZZ=FIRST:COUNT runs other seeds.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include "data/generators/random_mesh.h"
#include "data/splitmix64.h"
#include "data/validate.h"
#include "fast/stream/kernel/targets.h"
#include "verify/audit/audit.h"
#include "verify/host/host.h"
#include "verify/shared_bits/test_support/shared_bits.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

using fast::row_stream::kernels;

struct Seeds {
  std::uint64_t first = 1, count = 0;
};

Seeds seeds(std::uint64_t usual) {
  Seeds s{1, usual};
  if (const char* given = std::getenv("LIMITCHECK_FUZZ")) {
    char* end = nullptr;
    s.first = std::strtoull(given, &end, 10);
    s.count = *end == ':' ? std::strtoull(end + 1, nullptr, 10) : 1;
  }
  return s;
}

enum class Geometry { kAsItIs, kOnAGrid, kFlat, kFarAway, kTiny, kHuge, kCount };

Geometry geometry(std::uint64_t seed) {
  return static_cast<Geometry>(seed % static_cast<std::uint64_t>(Geometry::kCount));
}

bool overlaps(std::uint64_t seed) {
  const Geometry g = geometry(seed);
  return g == Geometry::kOnAGrid || g == Geometry::kFlat || g == Geometry::kFarAway;
}

// One mesh of each kind of geometry in turn. Coordinates stay exact in float.
data::ControlMesh fuzz_mesh(std::uint64_t seed) {
  data::SplitMix64 random(seed ^ 0x5eed);
  data::ControlMesh mesh = data::random_mesh(seed, {.faces = 20 + static_cast<int>(random.next() % 200)});
  for (auto& p : mesh.positions) {
    for (double& x : p) {
      switch (geometry(seed)) {
        case Geometry::kOnAGrid:  // vertices that coincide, rings without tangents, equal rings to start from
          x = std::round(x * 4) / 4;
          break;
        case Geometry::kFarAway:
          x = static_cast<double>(static_cast<float>(x + 1000));
          break;
        case Geometry::kTiny:
          x = std::ldexp(x, -60);
          break;
        case Geometry::kHuge:
          x = std::ldexp(x, 60);
          break;
        default:
          break;
      }
    }
    if (geometry(seed) == Geometry::kFlat) p[seed / 6 % 3] = -0.;
  }
  return mesh;
}

TEST(SharedBitsFuzz, RandomMeshesDepthsAndPairingsGiveEqualBits) {
  const Seeds s = seeds(240);
  std::int64_t points = 0, compared = 0, different = 0;
  for (std::uint64_t seed = s.first; seed < s.first + s.count; ++seed) {
    const auto mesh = fuzz_mesh(seed);
    ASSERT_TRUE(data::validate(mesh).empty()) << "seed " << seed;
    data::SplitMix64 random(seed);
    SharedBits bits(mesh, 6);
    for (int round = 0; round < 4; ++round) {
      const auto& kernel = kernels()[random.next() % kernels().size()];
      const int depth = static_cast<int>(random.next() % (kernel.fused ? 7 : 5));
      const Rewriting other = rewrite(mesh, random.next());
      const Form form = random.next() % 2 == 0 ? Form::kRows : Form::kWhole;
      add_pairs(other, depth, kernel, form, random.next(), bits);
      add_edges(other, depth, kernel, random.next(), bits);
      const auto depths = random_depths(mesh.faces.size(), -1, depth, random.next());
      constexpr const char* kForms[] = {"output=strips,repair=fan", "output=strips,repair=stitch",
                                        "output=indexed"};
      add_frame(other, depths, fmt::format("{},target={}", kForms[random.next() % 3], kernel.name),
                1 + static_cast<int>(random.next() % 3), bits);
    }
    EXPECT_EQ(bits.different_bits(), 0) << "seed " << seed << ": " << bits.witness();
    points += bits.points();
    compared += bits.compared();
    different += bits.different_bits();
  }
  fmt::print("{} meshes, {} shared points, {} comparisons, {} bits differ\n", s.count, points, compared,
             different);
  RecordProperty("comparisons", std::to_string(compared));
  RecordProperty("different_bits", std::to_string(different));
}

// Whatever the geometry: vertices that coincide, flat rings, points at 2^60 and 2^-60.
TEST(SharedBitsFuzz, EveryVectorIsFiniteAndEveryNormalHasLengthOne) {
  const Seeds s = seeds(240);
  double worst = 0;
  for (std::uint64_t seed = s.first; seed < s.first + s.count; ++seed) {
    const auto mesh = fuzz_mesh(seed);
    Session session(*lc_subject_row_stream(), mesh);
    const Tessellation t = session.tessellate(random_depths(mesh.faces.size(), 0, 5, seed));
    for (std::int64_t v = 0; v < t.vertex_count(); ++v) {
      const auto p = t.position(v), n = t.normal(v);
      ASSERT_TRUE(std::isfinite(p[0] + p[1] + p[2])) << "seed " << seed << " vertex " << v;
      const double error = std::abs(std::hypot(n[0], n[1], n[2]) - 1);
      const lc_provenance& at = t.provenance()[v];
      ASSERT_LE(error, 1e-6) << fmt::format("seed {}, face {} at ({}, {}) / {}: normal {} {} {}", seed,
                                            at.face, at.i, at.j, at.denominator, n[0], n[1], n[2]);
      worst = std::max(worst, error);
    }
  }
  RecordProperty("worst", fmt::format("{:.3g}", worst));
}

// The audit holds but for normals, since a sliver's are as wrong as its height is small, and for
// watertightness where faces fall upon one another, or into a point.
TEST(SharedBitsFuzz, TheAuditFindsNothingButTheNormalsOfSlivers) {
  const Seeds s = seeds(36);
  Auditor auditor(4, 1);
  std::int64_t held = 0;
  for (std::uint64_t seed = s.first; seed < s.first + s.count; ++seed) {
    const auto mesh = fuzz_mesh(seed);
    const AuditMesh audited{fmt::format("seed {}", seed), mesh,
                            random_depths(mesh.faces.size(), -1, 4, seed)};
    for (const Result& r : auditor.run({lc_subject_row_stream(), ""}, audited)) {
      if (r.check.starts_with("normals") || (r.check == "watertight" && overlaps(seed))) continue;
      EXPECT_NE(r.status, Status::kFinding) << r.mesh << " " << r.check << ": " << r.message;
      held += r.status == Status::kHeld;
    }
  }
  RecordProperty("held", std::to_string(held));
}

}  // namespace
}  // namespace limitcheck::verify
