// SPDX-License-Identifier: MIT
// The centre of a cage's first face on the limit surface: in double, and certified to 30 digits.
//   true_point [cage.obj]
#include <cstdio>
#include <exception>

#include <limitcheck/data/io/read.h>
#include <limitcheck/data/shapes.h>
#include <limitcheck/reference/loop/recursion.h>
#include <limitcheck/reference/loop/stam.h>
#include <limitcheck/reference/surface/certified.h>

int main(int argc, char** argv) try {
  namespace data = limitcheck::data;
  namespace reference = limitcheck::reference;
  const data::ControlMesh cage =
      argc > 1 ? data::read_mesh(argv[1], {.scheme = data::Scheme::kLoop}) : data::tetrahedron();

  const auto third = reference::Parameter::fraction(1, 3);
  const auto point = reference::StamEvaluator<double>(cage).evaluate(0, third, third);
  std::printf("double: %.17g %.17g %.17g\n", point.position.x, point.position.y, point.position.z);

  const auto certified = reference::CertifiedEvaluator(cage).evaluate(0, third, third, 30);
  std::printf("certified: %s %s %s (radius %s)\n", certified.position[0].value.c_str(),
              certified.position[1].value.c_str(), certified.position[2].value.c_str(),
              certified.radius.to_string().c_str());

  long leaves = 0;
  reference::NaiveSubdivider<double>(cage).tessellate(0, 3, [&](const auto&) { ++leaves; });
  std::printf("leaves at depth 3: %ld\n", leaves);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "true_point: %s\n", error.what());
  return 2;
}
