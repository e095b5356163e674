// SPDX-License-Identifier: MIT
// The kernel of quads in double, where nothing hides behind the rounding of float.
#include "fast/stream/kernel/kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "data/generators/polygon_meshes.h"
#include "data/generators/sharp_meshes.h"
#include "fast/stream/gather/quad_batch.h"
#include "fast/window/quad_window.h"

namespace limitcheck::fast::row_stream {
namespace {

using Number = ScalarNumber<double>;

// Position and normal of all points of a quad, row by row: streamed, or as a polynomial.
std::vector<double> evaluate(const BasicQuadRings<double>& rings, std::int32_t face, int depth,
                             bool as_patch) {
  const std::ptrdiff_t n = (1 << depth) + 1;
  std::vector<double> out(static_cast<std::size_t>(6 * n * n)), input(quad_input_size(depth)),
      work(quad_work_size(depth));
  double* lane = out.data();
  const QuadTarget<double> target{&lane, 6 * n, nullptr, nullptr};
  if (as_patch) {
    const auto batch = gather_patches<double>(rings, {&face, 1}, depth, 1, input.data());
    generic::QuadPatch<Number>(batch, rings.placement(), work.data(), {target}).run();
  } else {
    const auto batch = gather_quads<double>(rings, {&face, 1}, depth, 1, input.data());
    generic::QuadStream<Number>(batch, rings.placement(), work.data(), {target}).run();
  }
  return out;
}

TEST(QuadNumbers, AreThoseOfTheWindowToFourteenDigits) {
  double worst_position = 0, worst_normal = 0;
  const std::vector<data::ControlMesh> meshes{
      data::quad_cube(),       data::quad_torus(6, 5), data::pawn(7),
      data::quad_wheel(12, 1), data::quad_fan(3, 2),   data::dart(5, false),
      data::corner(3, false),  data::creased_cube(10), data::polygon_prism(5)};
  for (const auto& mesh : meshes) {
    const QuadMesh quads(mesh);
    std::vector<Vec3<double>> positions;
    for (const auto& p : quads.positions) positions.push_back({p[0], p[1], p[2]});
    const PreparedQuads<double> prepared(quads, positions);
    const BasicQuadRings<double> rings(quads);
    for (int depth = 0; depth <= 6; ++depth) {
      const int n = (1 << depth) + 1;
      QuadWindow<double> window(depth, quads.adjacency.max_valence());
      const auto faces = std::min(quads.adjacency.face_count(), 40);
      for (std::int32_t f = 0; f < faces; ++f) {
        for (const bool as_patch : {false, true}) {
          if (as_patch && rings.kind(f) != QuadClass::kRegular) continue;
          const auto got = evaluate(rings, f, depth, as_patch);
          window.run(prepared, f, depth, [&](int row, const SurfaceVertex<double>* strip) {
            for (int q = 0; q < 2 * n; ++q) {
              const double* v = got.data() + 6 * ((n - 1 - row - q % 2) * n + q / 2);
              const auto& [p, w] = strip[q];
              const std::array want{p.x, p.y, p.z, w.x, w.y, w.z};
              for (int c = 0; c < 6; ++c) {
                double& worst = c < 3 ? worst_position : worst_normal;
                worst = std::max(worst, std::abs(v[c] - want[c]));
              }
            }
          });
        }
      }
    }
  }
  EXPECT_LE(worst_position, 1e-14);  // measured: 1.4e-15
  EXPECT_LE(worst_normal, 2e-12);    // measured: 1.7e-13
  RecordProperty("worst_position", std::to_string(worst_position * 1e15) + "e-15");
  RecordProperty("worst_normal", std::to_string(worst_normal * 1e12) + "e-12");
}

}  // namespace
}  // namespace limitcheck::fast::row_stream
