// SPDX-License-Identifier: MIT
// The kernel of quads on a GPU against the processor's own text on a number without fused multiply-add, bit by bit:
// quads of any valences, regular ones, boundaries, cuts and darts, and sides alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "data/generators/named_mesh.h"
#include "fast/mesh/cut_mesh.h"
#include "fast/stream/gather/batch.h"
#include "verify/gl/engine_kernels.h"
#include "verify/shared_bits/test_support/unfused.h"

namespace limitcheck::fast::row_stream {
namespace {

struct Differences {
  std::int64_t differ = 0, compared = 0;
  void add(const std::vector<float>& a, const std::vector<float>& b) {
    for (std::size_t i = 0; i < a.size(); ++i, ++compared)
      differ += std::memcmp(&a[i], &b[i], sizeof(float)) != 0 ? 1 : 0;
  }
};

const QuadKernel& gl() {
  return verify::engine_kernels_by_gl().quads;
}

class Quads {
 public:
  Quads(const std::string& name, int depth, bool local)
      : mesh_(data::named_mesh(name)), rings_(mesh_), depth_(depth), placement_(rings_.placement()) {
    placement_.local_from = local ? 1 : kMaxDepth + 1;
  }

  Differences compare() {
    Differences result;
    const std::int32_t quads = mesh_.adjacency.face_count();  // of many some
    for (std::int32_t f = 0; f < quads; f += 1 + quads / 12) {
      const QuadClass kind = rings_.kind(f);
      if (kind == QuadClass::kSemiSharp) continue;
      if (kind == QuadClass::kRegular) add(result, f, true);
      if (depth_ < kFusedFrom) add(result, f, false);
    }
    for (std::int32_t h = 0; h < 4 * quads; h += 1 + quads / 6)
      if (!rings_.touches_semi_sharp(h)) add_side(result, h);
    return result;
  }

 private:
  std::size_t side() const { return (std::size_t{1} << depth_) + 1; }
  std::vector<float> input(int lanes) const {
    return std::vector<float>(static_cast<std::size_t>(quad_input_size(depth_) * lanes) + 16);
  }

  // here(batch, work, target) and gathered(lanes, input) of one item.
  template <class Gather, class Here>
  void add(Differences& result, std::size_t rows, QuadKernel::Run* there, const Gather& gathered,
           const Here& here) {
    std::vector<float> work(static_cast<std::size_t>(quad_work_size(depth_)) + 16),
        one = input(1), many = input(gl().lanes), expected(6 * rows * side()), out(expected.size());
    const auto stride = static_cast<std::ptrdiff_t>(6 * side());
    float* to = expected.data();
    here(gathered(1, one.data()), work.data(), QuadTarget<float>{&to, stride, nullptr, nullptr});
    std::array<float*, kMaxLanes> lane;
    lane.fill(out.data());
    there(gathered(gl().lanes, many.data()), placement_, work.data(),
          {lane.data(), stride, nullptr, nullptr});
    result.add(expected, out);
  }
  void add(Differences& result, std::int32_t f, bool patch) {
    const auto gathered = [&](int lanes, float* to) {
      return patch ? gather_patches<float>(rings_, {&f, 1}, depth_, lanes, to)
                   : gather_quads<float>(rings_, {&f, 1}, depth_, lanes, to);
    };
    add(result, side(), patch ? gl().patches : gl().quads, gathered,
        [&](const QuadBatch<float>& batch, float* work, const QuadTarget<float>& target) {
          if (patch)
            generic::QuadPatch<Unfused>(batch, placement_, work, {target}).run();
          else
            generic::QuadStream<Unfused>(batch, placement_, work, {target}).run();
        });
  }
  void add_side(Differences& result, std::int32_t h) {
    const auto gathered = [&](int lanes, float* to) {
      return gather_sides<float>(rings_, {&h, 1}, depth_, lanes, to);
    };
    add(result, 1, gl().sides, gathered, [&](const QuadBatch<float>& batch, float* work, const auto& target) {
      generic::QuadStream<Unfused>(batch, placement_, work, {target}).run_side();
    });
  }

  QuadMesh mesh_;
  QuadRings rings_;
  int depth_;
  KernelPlacement<float> placement_;
};

TEST(GlQuadKernel, HasTheBitsOfTheProcessorsKernelWithoutFusedMultiplyAdd) {
  try {
    gl();
  } catch (const std::runtime_error& error) {
    GTEST_SKIP() << error.what();
  }
  for (const bool local : {false, true})
    for (const int depth : {0, 1, 4, 7})
      for (const char* name : {"quad-cube", "quad-torus:4:3", "pawn", "quad-wheel:5", "quad-fan:3",
                               "creased-cube", "open-crease", "prism:5", "mixed:1"}) {
        const std::string mesh(name);
        if ((local && depth == 0) || (depth == 7 && mesh != "quad-torus:4:3" && mesh != "open-crease"))
          continue;
        const Differences d = Quads(mesh, depth, local).compare();
        EXPECT_EQ(d.differ, 0) << name << " depth " << depth << (local ? " local" : "") << " of "
                               << d.compared;
        EXPECT_GT(d.compared, 0) << name;
      }
}

}  // namespace
}  // namespace limitcheck::fast::row_stream
