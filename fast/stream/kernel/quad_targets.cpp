// SPDX-License-Identifier: MIT
#include "fast/stream/kernel/targets.h"

#include <vector>

#include "fast/stream/kernel/kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fast/stream/kernel/quad_targets.cpp"
// As in targets.cpp.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128)
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "fast/stream/kernel/lanes-inl.h"
#include "fast/stream/kernel/quad_patch-inl.h"
#include "fast/stream/kernel/quad_stream-inl.h"

HWY_BEFORE_NAMESPACE();
namespace limitcheck::fast::row_stream::HWY_NAMESPACE {

#if HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128

template <int lanes>
using QuadLanes = LaneNumber<hn::CappedTag<float, lanes>>;

template <int lanes>
HWY_ATTR const char* run_quads(const QuadBatch<float>& batch, const KernelPlacement<float>& placement,
                               float* work, const QuadTarget<float>& target) {
  QuadStream<QuadLanes<lanes>>(batch, placement, work, {target}).run();
  return target_name(lanes);
}
template <int lanes>
HWY_ATTR const char* run_patches(const QuadBatch<float>& batch, const KernelPlacement<float>& placement,
                                 float* work, const QuadTarget<float>& target) {
  QuadPatch<QuadLanes<lanes>>(batch, placement, work, {target}).run();
  return target_name(lanes);
}
template <int lanes>
HWY_ATTR const char* run_sides(const QuadBatch<float>& batch, const KernelPlacement<float>& placement,
                               float* work, const QuadTarget<float>& target) {
  QuadStream<QuadLanes<lanes>>(batch, placement, work, {target}).run_side();
  return target_name(lanes);
}

#if HWY_TARGET == HWY_AVX3
template <template <class, class> class Engine>
HWY_ATTR void run_in_lines(const QuadBatch<float>& batch, const KernelPlacement<float>& placement,
                           float* work, float* const* lane, Stores stores) {
  LineRuns<QuadLanes<16>> runs(lane, stores);
  Engine<QuadLanes<16>, LineTarget<QuadLanes<16>>>(batch, placement, work, {&runs}).run();
  runs.finish();
}
#endif

#endif  // not the baseline

void list_quad_kernels([[maybe_unused]] std::vector<QuadKernel>& list) {
#if HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128
  for_each_lane_count([&]<int lanes>() {
    list.push_back({target_name(lanes), lanes, HWY_NATIVE_FMA != 0, &run_quads<lanes>, &run_patches<lanes>,
                    &run_sides<lanes>, nullptr, nullptr});
#if HWY_TARGET == HWY_AVX3
    if (lanes == 16) {
      list.back().quad_lines = &run_in_lines<QuadStream>;
      list.back().patch_lines = &run_in_lines<QuadPatch>;
    }
#endif
  });
#endif
}

}  // namespace limitcheck::fast::row_stream::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limitcheck::fast::row_stream {

namespace {

HWY_EXPORT(list_quad_kernels);

using ScalarStream = generic::QuadStream<ScalarNumber<float>>;
using ScalarPatch = generic::QuadPatch<ScalarNumber<float>>;

const char* run_scalar_quads(const QuadBatch<float>& batch, const KernelPlacement<float>& placement,
                             float* work, const QuadTarget<float>& target) {
  ScalarStream(batch, placement, work, {target}).run();
  return "scalar";
}
const char* run_scalar_patches(const QuadBatch<float>& batch, const KernelPlacement<float>& placement,
                               float* work, const QuadTarget<float>& target) {
  ScalarPatch(batch, placement, work, {target}).run();
  return "scalar";
}
const char* run_scalar_sides(const QuadBatch<float>& batch, const KernelPlacement<float>& placement,
                             float* work, const QuadTarget<float>& target) {
  ScalarStream(batch, placement, work, {target}).run_side();
  return "scalar";
}

}  // namespace

std::span<const QuadKernel> quad_kernels() {
  static const std::vector<QuadKernel> list = [] {
    std::vector<QuadKernel> all;
    ask_every_target([&] { HWY_DYNAMIC_DISPATCH(list_quad_kernels)(all); });
    all.push_back(
        {"scalar", 1, false, &run_scalar_quads, &run_scalar_patches, &run_scalar_sides, nullptr, nullptr});
    return all;
  }();
  return list;
}

}  // namespace limitcheck::fast::row_stream
#endif  // HWY_ONCE
