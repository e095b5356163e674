// SPDX-License-Identifier: MIT
// Float errors as facts about the true surface.
#include "verify/proof/proof_set.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "data/error.h"
#include "data/generators/named_mesh.h"

namespace limitcheck::verify {
namespace {

// Bound: five roundings of a coordinate in the box, an ulp of 2^-24 each, are 3e-7 of its side; the bounds
// proved per topology are below 6e-7 of the unit box. Worst seen: see the properties.
TEST(Certified, PositionsOfBothKernelsLieWithin3e7OfTheTrueSurface) {
  CertifiedErrors worst;
  for (const FloatKernel kernel : {FloatKernel::kSlidingWindow, FloatKernel::kRowStream}) {
    for (const std::string& name : data::stock_shapes()) {
      const auto mesh = data::named_mesh(name);
      for (const int depth : {1, 4}) {
        const CertifiedErrors errors = compare_certified(kernel, mesh, depth, 12);
        EXPECT_GT(errors.points, 2) << name;
        EXPECT_LT(errors.position, 3e-7)
            << name << " face " << errors.face << ' ' << errors.l1 << ' ' << errors.l2;
        EXPECT_LT(errors.radius, 1e-15) << name;
        EXPECT_GT(errors.position, 0) << name;
        worst.position = std::max(worst.position, errors.position);
        worst.normal = std::max(worst.normal, errors.normal);
      }
    }
  }
  RecordProperty("worst_position", fmt::format("{:.3g} of the diagonal", worst.position));
  RecordProperty("worst_normal", fmt::format("{:.3g} degrees", worst.normal));
  EXPECT_LT(worst.normal, .1);
  fmt::print("certified: {:.3g} of the diagonal, {:.3g} degrees\n", worst.position, worst.normal);
}

TEST(Certified, QuadKernelsAreNearTheTrueSurface) {
  CertifiedErrors worst;
  auto lines = stock_shape_lines({FloatKernel::kSlidingWindow, FloatKernel::kRowStream}, 3,
                                 data::Scheme::kCatmullClark);
  certify(lines, 12);
  for (const CertifiedLine& line : lines) {
    EXPECT_GT(line.errors.points, 2) << line.mesh;
    EXPECT_LT(line.errors.position, 3e-7) << line.mesh << ' ' << line.kernel << " face " << line.errors.face
                                          << ' ' << line.errors.l1 << ' ' << line.errors.l2;
    EXPECT_GT(line.errors.position, 0) << line.mesh;
    worst.position = std::max(worst.position, line.errors.position);
    worst.normal = std::max(worst.normal, line.errors.normal);
  }
  RecordProperty("worst_position", fmt::format("{:.3g} of the diagonal", worst.position));
  EXPECT_LT(worst.normal, .1);
  fmt::print("certified quads: {:.3g} of the diagonal, {:.3g} degrees\n", worst.position, worst.normal);
}

TEST(Certified, SeesAMovedControlPoint) {
  // The kernel's own mesh is not the one asked about: one coordinate two float steps off.
  auto mesh = data::named_mesh("icosahedron");
  mesh.positions[0][0] += 1e-9;
  EXPECT_THROW(compare_certified(FloatKernel::kRowStream, mesh, 2, 10), data::ArgumentError);
}

}  // namespace
}  // namespace limitcheck::verify
