// SPDX-License-Identifier: MIT
#include "bench/write_only.h"

#include <cstdlib>
#include <cstring>
#include <new>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bench/write_only.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace limitcheck::bench::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

void write(float* memory, std::size_t count, bool streaming) {
  const hn::ScalableTag<float> d;
  const auto value = hn::Set(d, static_cast<float>(count));
  for (float *p = memory, *end = memory + count; p != end; p += hn::Lanes(d)) {
    if (streaming)
      hn::Stream(value, d, p);
    else
      hn::Store(value, d, p);
  }
}

}  // namespace limitcheck::bench::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limitcheck::bench {

HWY_EXPORT(write);

WriteOnly::WriteOnly(std::size_t bytes)
    : memory_(static_cast<float*>(std::aligned_alloc(64, bytes))), bytes_(bytes) {
  if (!memory_) throw std::bad_alloc();
  std::memset(memory_, 0, bytes);
}

WriteOnly::~WriteOnly() {
  std::free(memory_);
}

void WriteOnly::run(bool streaming) {
  HWY_DYNAMIC_DISPATCH(write)(memory_, bytes_ / sizeof(float), streaming);
}

}  // namespace limitcheck::bench
#endif  // HWY_ONCE
