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

template <int lanes, class Engine, void (Engine::*run)() = &Engine::run>
HWY_ATTR const char* run_batch(const QuadBatch<float>& batch, const Placement<float>& placement, float* work,
                               const QuadTarget<float>& target) {
  Engine engine(batch, placement, work, {target});
  (engine.*run)();
  return target_name(lanes);
}

#if HWY_TARGET == HWY_AVX3
template <template <class, class> class Engine>
HWY_ATTR void run_in_lines(const QuadBatch<float>& batch, const Placement<float>& placement, float* work,
                           float* const* lane, Stores stores) {
  LineRuns<QuadLanes<16>> runs(lane, stores);
  Engine<QuadLanes<16>, LineTarget<QuadLanes<16>>>(batch, placement, work, {&runs}).run();
  runs.finish();
}
#endif

#endif  // not the baseline

void list_quad_kernels([[maybe_unused]] std::vector<QuadKernel>& list) {
#if HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128
  for_each_lane_count([&]<int lanes>() {
    using Quads = QuadStream<QuadLanes<lanes>>;
    list.push_back({target_name(lanes), lanes, HWY_NATIVE_FMA != 0, &run_batch<lanes, Quads>,
                    &run_batch<lanes, QuadPatch<QuadLanes<lanes>>>,
                    &run_batch<lanes, Quads, &Quads::run_side>, nullptr, nullptr});
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

using ScalarQuads = generic::QuadStream<ScalarNumber<float>>;

template <class Engine, void (Engine::*run)() = &Engine::run>
const char* run_scalar(const QuadBatch<float>& batch, const Placement<float>& placement, float* work,
                       const QuadTarget<float>& target) {
  Engine engine(batch, placement, work, {target});
  (engine.*run)();
  return "scalar";
}

}  // namespace

std::span<const QuadKernel> quad_kernels() {
  static const std::vector<QuadKernel> list = [] {
    std::vector<QuadKernel> all;
    ask_every_target([&] { HWY_DYNAMIC_DISPATCH(list_quad_kernels)(all); });
    all.push_back({"scalar", 1, false, &run_scalar<ScalarQuads>,
                   &run_scalar<generic::QuadPatch<ScalarNumber<float>>>,
                   &run_scalar<ScalarQuads, &ScalarQuads::run_side>, nullptr, nullptr});
    return all;
  }();
  return list;
}

}  // namespace limitcheck::fast::row_stream
#endif  // HWY_ONCE
