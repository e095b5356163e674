// SPDX-License-Identifier: MIT
#include "bench/machine.h"

#include <malloc.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstddef>
#include <cstdio>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bench/machine.cpp"
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

void write_all(std::span<float> memory, bool streaming) {
  HWY_DYNAMIC_DISPATCH(write)(memory.data(), memory.size(), streaming);
}

namespace {

double resident_bytes() {
  long pages = 0, resident = 0;
  std::FILE* file = std::fopen("/proc/self/statm", "r");
  if (!file) return 0;
  const bool read = std::fscanf(file, "%ld %ld", &pages, &resident) == 2;
  std::fclose(file);
  return read ? static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) : 0;
}

}  // namespace

double peak_memory(const std::function<void()>& work) {
  int ends[2];
  if (pipe(ends) != 0) return 0;
  const pid_t child = fork();
  if (child == 0) {
    malloc_trim(0);  // or memory that the parent has freed would serve unseen
    const double before = resident_bytes();
    work();
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const double grown = static_cast<double>(usage.ru_maxrss) * 1024 - before;
    const bool written = write(ends[1], &grown, sizeof grown) == sizeof grown;
    _exit(written ? 0 : 1);
  }
  close(ends[1]);
  double grown = 0;
  if (child < 0 || read(ends[0], &grown, sizeof grown) != sizeof grown) grown = 0;
  close(ends[0]);
  if (child > 0) waitpid(child, nullptr, 0);
  return grown;
}

}  // namespace limitcheck::bench
#endif  // HWY_ONCE
