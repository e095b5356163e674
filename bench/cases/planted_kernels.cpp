// SPDX-License-Identifier: MIT
// Kernels of which one function is slower than it is, to see that the tracker notices. Linked into programs of their
// own, with kernels() and quad_kernels() wrapped (ld's --wrap), so that every engine and case meets them.
// LIMITCHECK_PLANT is
//   FUNCTION=SHARE   each call of the function takes SHARE of its own time longer: 1 is twice the time
//   FUNCTION=+N      each call takes about N instructions more, as many in every call
//   calls            at the end, on standard error, a line for each function: "calls FUNCTION NUMBER"
// where FUNCTION is "loop/avx2/run_edges" or "catmull-clark/avx512/patch_lines".
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "fast/stream/kernel/targets.h"

namespace limitcheck::fast::row_stream {

// As gcc and clang mangle kernels() and quad_kernels().
std::span<const Kernel> real_kernels() asm("__real__ZN10limitcheck4fast10row_stream7kernelsEv");
std::span<const QuadKernel> real_quad_kernels() asm(
    "__real__ZN10limitcheck4fast10row_stream12quad_kernelsEv");
std::span<const Kernel> planted_kernels() asm("__wrap__ZN10limitcheck4fast10row_stream7kernelsEv");
std::span<const QuadKernel> planted_quad_kernels() asm(
    "__wrap__ZN10limitcheck4fast10row_stream12quad_kernelsEv");

namespace {

struct Plant {
  std::string function;
  std::atomic<std::int64_t> calls = 0;
  double share = 0;
  std::uint64_t instructions = 0;
};

std::uint64_t ticks() {
#if defined(__x86_64__)
  return __builtin_ia32_rdtsc();
#else
  return static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
#endif
}

/// As long as it lives, a call of a planted function runs.
class Delay {
 public:
  explicit Delay(Plant& plant) : plant_(plant) {
    ++plant.calls;
    if (plant.share > 0) start_ = ticks();
  }
  ~Delay() {
    if (plant_.share > 0) {
      const std::uint64_t now = ticks();
      const auto longer = static_cast<std::uint64_t>(plant_.share * static_cast<double>(now - start_));
      while (ticks() - now < longer) {
      }
    }
    for (std::uint64_t k = 0; k < plant_.instructions / 2; ++k) asm volatile("");
  }
  Delay(const Delay&) = delete;
  Delay& operator=(const Delay&) = delete;

 private:
  Plant& plant_;
  std::uint64_t start_ = 0;
};

constexpr std::size_t kMostTargets = 8;

template <class Variant>
std::span<const Variant> real_variants() {
  if constexpr (std::is_same_v<Variant, Kernel>)
    return real_kernels();
  else
    return real_quad_kernels();
}

template <class Variant, std::size_t target, auto member, class Function>
struct Wrapped;
template <class Variant, std::size_t target, auto member, class R, class... A>
struct Wrapped<Variant, target, member, R (*)(A...)> {
  static Plant& plant() {
    static Plant it;
    return it;
  }
  static R call(A... arguments) {
    const Delay delay(plant());
    return (real_variants<Variant>()[target].*member)(arguments...);
  }
};

std::vector<Plant*>& all_plants() {
  static std::vector<Plant*> list;
  return list;
}

/// One function of one target, if the target has it.
template <class Variant, std::size_t target, auto member>
void wrap(Variant& variant, const char* scheme, const char* name) {
  if (variant.*member == nullptr) return;
  using It = Wrapped<Variant, target, member, std::remove_reference_t<decltype(variant.*member)>>;
  It::plant().function = std::string(scheme) + "/" + variant.name + "/" + name;
  const char* wanted = std::getenv("LIMITCHECK_PLANT");  // NOLINT(concurrency-mt-unsafe)
  const std::string text = wanted != nullptr ? wanted : "";
  if (const auto sign = text.find('=');
      sign != std::string::npos && text.substr(0, sign) == It::plant().function) {
    const bool instructions = text.substr(sign + 1).starts_with("+");
    (instructions ? void(It::plant().instructions = std::strtoull(text.c_str() + sign + 2, nullptr, 10))
                  : void(It::plant().share = std::strtod(text.c_str() + sign + 1, nullptr)));
  }
  all_plants().push_back(&It::plant());
  variant.*member = &It::call;
}

template <std::size_t target>
void wrap_all(Kernel& kernel) {
  wrap<Kernel, target, &Kernel::run>(kernel, "loop", "run");
  wrap<Kernel, target, &Kernel::run_edges>(kernel, "loop", "run_edges");
  wrap<Kernel, target, &Kernel::run_lines>(kernel, "loop", "run_lines");
  wrap<Kernel, target, &Kernel::run_patches>(kernel, "loop", "run_patches");
  wrap<Kernel, target, &Kernel::patch_lines>(kernel, "loop", "patch_lines");
}
template <std::size_t target>
void wrap_all(QuadKernel& kernel) {
  constexpr const char* kScheme = "catmull-clark";
  wrap<QuadKernel, target, &QuadKernel::quads>(kernel, kScheme, "quads");
  wrap<QuadKernel, target, &QuadKernel::patches>(kernel, kScheme, "patches");
  wrap<QuadKernel, target, &QuadKernel::sides>(kernel, kScheme, "sides");
  wrap<QuadKernel, target, &QuadKernel::quad_lines>(kernel, kScheme, "quad_lines");
  wrap<QuadKernel, target, &QuadKernel::patch_lines>(kernel, kScheme, "patch_lines");
}

template <class Variant>
std::vector<Variant> planted() {
  const auto real = real_variants<Variant>();
  std::vector<Variant> list(real.begin(), real.end());
  if (list.size() > kMostTargets) std::abort();
  [&]<std::size_t... target>(std::index_sequence<target...>) {
    ((target < list.size() ? wrap_all<target>(list[target]) : void()), ...);
  }
  (std::make_index_sequence<kMostTargets>());
  return list;
}

void print_calls() {
  for (const Plant* plant : all_plants())
    std::fprintf(stderr, "calls %s %lld\n", plant->function.c_str(), static_cast<long long>(plant->calls));
}

const bool counts_calls = [] {
  const char* wanted = std::getenv("LIMITCHECK_PLANT");  // NOLINT(concurrency-mt-unsafe)
  if (wanted == nullptr || std::string(wanted) != "calls") return false;
  planted_kernels(), planted_quad_kernels();  // made before print_calls() is registered, so gone after it
  return std::atexit(print_calls) == 0;
}();

}  // namespace

std::span<const Kernel> planted_kernels() {
  static const std::vector<Kernel> list = planted<Kernel>();
  return list;
}

std::span<const QuadKernel> planted_quad_kernels() {
  static const std::vector<QuadKernel> list = planted<QuadKernel>();
  return list;
}

}  // namespace limitcheck::fast::row_stream
