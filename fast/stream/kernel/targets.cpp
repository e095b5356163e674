// SPDX-License-Identifier: MIT
#include "fast/stream/kernel/targets.h"

#include <vector>

#include "fast/stream/kernel/kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fast/stream/kernel/targets.cpp"
// The baseline of x86-64 comes last in the list and is the plain scalar kernel below. Vectors of SVE have no
// size at compile time and cannot be members.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "fast/stream/kernel/lanes-inl.h"
#include "fast/stream/kernel/stream-inl.h"
#include "fast/stream/kernel/triangle_patch-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limitcheck::fast::row_stream::HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128

template <int lanes>
HWY_ATTR const char* run_lanes(float* input, int depth, const BatchPlacement<float>& placement, float* work,
                               const Target<float>& target) {
  using Number = LaneNumber<hn::CappedTag<float, lanes>>;
  Stream<Number>(input, depth, placement, work, {target}).run();
  return target_name(Number::lanes);
}

template <int lanes>
HWY_ATTR const char* run_patch_lanes(float* input, int depth, const BatchPlacement<float>& placement,
                                     float* /*work*/, const Target<float>& target) {
  TrianglePatch<LaneNumber<hn::CappedTag<float, lanes>>>(input, depth, placement, {target}).run();
  return target_name(lanes);
}

template <int lanes>
HWY_ATTR void run_edge_lanes(const float* input, int depth, const BatchPlacement<float>& placement,
                             float* work, float* out, std::ptrdiff_t lane_stride) {
  using Number = LaneNumber<hn::CappedTag<float, lanes>>;
  EdgeStream<Number>(depth, placement, work)
      .scatter(edge_input(input, depth, lanes, placement), LaneRow<Number>{out, lane_stride});
}

#if HWY_TARGET == HWY_AVX3
HWY_ATTR void run_lines(float* input, int depth, const BatchPlacement<float>& placement, float* work,
                        float* const* lane, Stores stores) {
  using Number = LaneNumber<hn::CappedTag<float, 16>>;
  LineRuns<Number> runs(lane, stores);
  Stream<Number, LineTarget<Number>>(input, depth, placement, work, {&runs}).run();
  runs.finish();
}
HWY_ATTR void run_patch_lines(float* input, int depth, const BatchPlacement<float>& placement,
                              float* /*work*/, float* const* lane, Stores stores) {
  using Number = LaneNumber<hn::CappedTag<float, 16>>;
  LineRuns<Number> runs(lane, stores);
  TrianglePatch<Number, LineTarget<Number>>(input, depth, placement, {&runs}).run();
  runs.finish();
}
#endif

#endif  // not the baseline

void list_kernels([[maybe_unused]] std::vector<Kernel>& list) {
#if HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128
  for_each_lane_count([&]<int lanes>() {
    list.push_back({target_name(lanes), lanes, HWY_NATIVE_FMA != 0, &run_lanes<lanes>, &run_edge_lanes<lanes>,
                    nullptr, &run_patch_lanes<lanes>, nullptr});
#if HWY_TARGET == HWY_AVX3
    if (lanes == 16) list.back().run_lines = &run_lines, list.back().patch_lines = &run_patch_lines;
#endif
  });
#endif
}

}  // namespace limitcheck::fast::row_stream::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limitcheck::fast::row_stream {

namespace {

HWY_EXPORT(list_kernels);

const char* run_scalar(float* input, int depth, const BatchPlacement<float>& placement, float* work,
                       const Target<float>& target) {
  generic::Stream<ScalarNumber<float>>(input, depth, placement, work, {target}).run();
  return "scalar";
}

const char* run_patch_scalar(float* input, int depth, const BatchPlacement<float>& placement, float* /*work*/,
                             const Target<float>& target) {
  generic::TrianglePatch<ScalarNumber<float>>(input, depth, placement, {target}).run();
  return "scalar";
}

void run_edge_scalar(const float* input, int depth, const BatchPlacement<float>& placement, float* work,
                     float* out, std::ptrdiff_t lane_stride) {
  generic::EdgeStream<ScalarNumber<float>>(depth, placement, work)
      .scatter(edge_input(input, depth, 1, placement),
               generic::LaneRow<ScalarNumber<float>>{out, lane_stride});
}

}  // namespace

std::span<const Kernel> kernels() {
  static const std::vector<Kernel> list = [] {
    std::vector<Kernel> all;
    ask_every_target([&] { HWY_DYNAMIC_DISPATCH(list_kernels)(all); });
    all.push_back({"scalar", 1, false, &run_scalar, &run_edge_scalar, nullptr, &run_patch_scalar, nullptr});
    return all;
  }();
  return list;
}

}  // namespace limitcheck::fast::row_stream
#endif  // HWY_ONCE
