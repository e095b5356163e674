// SPDX-License-Identifier: MIT
// The engine's shaders as kernels, a batch at a time: what a FrameRecorder is given, evaluated at once.
#pragma once

#include <gtest/gtest.h>

#include <span>
#include <stdexcept>
#include <vector>

#include "verify/gl/context.h"
#include "verify/gl/recorded_points.h"

namespace limitcheck::fast::row_stream {

/// Each test in an OpenGL context, or skipped where there is none.
class GlTest : public testing::Test {
 protected:
  void SetUp() override {
    try {
      const verify::CurrentGl there_is_one;
    } catch (const std::runtime_error& error) {
      GTEST_SKIP() << error.what();
    }
  }
};

inline void evaluated(verify::FrameRecorder& recorder, float* out, std::size_t vertices) {
  verify::put_points(verify::points_by_gl(recorder), {reinterpret_cast<Vertex*>(out), vertices});
}

/// Grids are to lie one after the other, and so are edges.
inline const Kernel& gl_kernel() {
  static constexpr auto lanes = [] {
    return static_cast<std::size_t>(verify::FrameRecorder::triangles().lanes);
  };
  static const Kernel kernel{
      "gl",
      verify::FrameRecorder::triangles().lanes,
      false,
      [](float* input, int depth, const BatchPlacement<float>& placement, float* work,
         const Target<float>& to) {
        verify::FrameRecorder recorder;
        const char* name = verify::FrameRecorder::triangles().run(input, depth, placement, work, to);
        const auto n = (std::size_t{1} << depth) + 1;
        evaluated(recorder, to.base, lanes() * n * n);
        return name;
      },
      [](const float* input, int depth, const BatchPlacement<float>& placement, float* work, float* out,
         std::ptrdiff_t lane_stride) {
        verify::FrameRecorder recorder;
        verify::FrameRecorder::triangles().run_edges(input, depth, placement, work, out, lane_stride);
        evaluated(recorder, out, lanes() * ((std::size_t{1} << depth) + 1));
      },
      nullptr};
  return kernel;
}

template <QuadKernel::Run* QuadKernel::*kRun>
const char* run_by_gl(const QuadBatch<float>& batch, const Placement<float>& placement, float* work,
                      const QuadTarget<float>& to) {
  verify::FrameRecorder recorder;
  const QuadKernel& kernel = verify::FrameRecorder::quads();
  const char* name = (kernel.*kRun)(batch, placement, work, to);
  const auto n = (std::size_t{1} << batch.depth) + 1, rows = kRun == &QuadKernel::sides ? 1 : n;
  const std::vector<float> points = verify::points_by_gl(recorder);
  for (int k = 0; k < kernel.lanes; ++k)
    verify::put_points(points, {reinterpret_cast<Vertex*>(to.lane[k]), n * rows});
  return name;
}

inline const QuadKernel& gl_quad_kernel() {
  static const QuadKernel kernel{"gl",
                                 verify::FrameRecorder::quads().lanes,
                                 false,
                                 &run_by_gl<&QuadKernel::quads>,
                                 &run_by_gl<&QuadKernel::patches>,
                                 &run_by_gl<&QuadKernel::sides>,
                                 nullptr,
                                 nullptr};
  return kernel;
}

}  // namespace limitcheck::fast::row_stream
