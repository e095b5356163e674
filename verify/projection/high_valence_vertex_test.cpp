// SPDX-License-Identifier: MIT
// Evaluation near vertices of very many faces against Stam's method.
#include "verify/projection/limit_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "data/generators/named_mesh.h"
#include "data/splitmix64.h"

namespace limitcheck::verify {
namespace {

TEST(HighValenceVertex, GivesThePointsAndDerivativesOfStamsMethod) {
  double worst = 0, worst_first = 0, worst_second = 0;
  int near = 0;
  for (const char* name :
       {"bipyramid:50", "wheel:60", "fan:50", "quad-wheel:50", "quad-fan:45", "prism:60"}) {
    const data::ControlMesh mesh = data::named_mesh(name);
    const data::Scheme scheme = data::natural_scheme(mesh);
    const LimitSurface surface(mesh, scheme);
    const reference::Surface stam(mesh, scheme);
    data::SplitMix64 random(1);
    for (int n = 0; n < 3000; ++n) {
      const auto face = static_cast<std::int32_t>(random.next() % surface.domain().face_count());
      const Chart chart = surface.domain().chart();
      double u = random.unit(), v = random.unit();
      if (!chart.is_square() && u + v > 1) u = 1 - u, v = 1 - v;
      Chart::Affine at = Chart::at(u, v);
      const auto k = static_cast<int>(random.next() % static_cast<std::uint64_t>(chart.corners()));
      const double shrink = std::ldexp(1.0, -static_cast<int>(random.next() % 18));
      for (int i = 0; i < 3; ++i) at[i] = chart.corner(k)[i] + shrink * (at[i] - chart.corner(k)[i]);
      at = chart.clamp(at);
      const auto named = surface.control_point({face, at});
      const double half = named.corner < 0 && !surface.has_control_faces() ? .5 : 1;
      const auto is = surface.evaluate({face, at}, reference::Order::kSecond);
      const auto want = stam.evaluate(named.face, std::max(named.corner, 0), named.first, named.second);
      const auto apart = [](const auto& a, const auto& b) {
        return norm(vector_of(a) - vector_of(b)) / std::max(1e-3, norm(vector_of(b)));
      };
      near += shrink < .1;
      worst = std::max(worst, norm(vector_of(is.position) - vector_of(want.position)));
      worst_first = std::max({worst_first, apart(is.d1, want.d1 * half), apart(is.d2, want.d2 * half)});
      if (shrink > .01)  // they grow like 4^steps, and their rounding too
        worst_second =
            std::max({worst_second, apart(is.d11, want.d11 * (half * half)),
                      apart(is.d12, want.d12 * (half * half)), apart(is.d22, want.d22 * (half * half))});
    }
  }
  EXPECT_GT(near, 1000);
  RecordProperty("worst_position", std::to_string(worst * 1e16) + "e-16");
  RecordProperty("worst_first_derivative", std::to_string(worst_first * 1e12) + "e-12");
  RecordProperty("worst_second_derivative", std::to_string(worst_second * 1e12) + "e-12");
  EXPECT_LE(worst, 1e-13);
  EXPECT_LE(worst_first, 1e-8);
  EXPECT_LE(worst_second, 1e-6);
}

}  // namespace
}  // namespace limitcheck::verify
