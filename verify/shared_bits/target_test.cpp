// SPDX-License-Identifier: MIT
// Which compiled variant runs when one is asked for, found out without asking it: by the function's name in
// the program's symbol table, and by where the processor is while it works. A variant that bears another's
// name gives the right bits, so nothing else can tell.
#include <gtest/gtest.h>

#include <dlfcn.h>
#include <fmt/core.h>
#include <sys/time.h>
#include <ucontext.h>
#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <iterator>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "data/generators/named_mesh.h"
#include "data/test_support/assertions.h"
#include "fast/stream/kernel/targets.h"
#include "fast/stream/row_stream.h"
#include "verify/shared_bits/test_support/shared_bits.h"
#include "verify/subject/lent_mesh.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

// By address in the file, from the program's own symbol table.
const std::map<std::uintptr_t, std::string>& functions() {
  static const std::map<std::uintptr_t, std::string> all = [] {
    std::map<std::uintptr_t, std::string> list;
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(
        popen("nm -C --defined-only \"/proc/$PPID/exe\" 2>/dev/null", "r"), pclose);
    if (!pipe) return list;
    char* line = nullptr;
    std::size_t room = 0;
    while (getline(&line, &room, pipe.get()) > 0) {
      std::string text(line);
      const std::size_t kind = text.find(' ');
      if (kind == std::string::npos || kind + 3 > text.size()) continue;
      if (std::string("tTwW").find(text[kind + 1]) == std::string::npos) continue;
      text.pop_back();  // the line's end
      list[std::strtoull(line, nullptr, 16)] = text.substr(kind + 3);
    }
    std::free(line);
    return list;
  }();
  return all;
}

std::uintptr_t load_address() {
  Dl_info info{};
  return dladdr(reinterpret_cast<const void*>(&load_address), &info) != 0
             ? reinterpret_cast<std::uintptr_t>(info.dli_fbase)
             : 0;
}

constexpr std::size_t kMostSamples = 1 << 16;
std::array<std::uintptr_t, kMostSamples> sampled;
std::atomic<std::size_t> sample_count{0};

void take_sample(int, siginfo_t*, void* context) {
  const auto* where = static_cast<const ucontext_t*>(context);
  const std::size_t at = sample_count.fetch_add(1, std::memory_order_relaxed);
#if defined(__x86_64__)
  if (at < kMostSamples) sampled[at] = static_cast<std::uintptr_t>(where->uc_mcontext.gregs[REG_RIP]);
#endif
}

// The demangled name of the function at this address of the program itself, "" if there is none.
std::string function_at(std::uintptr_t address) {
  Dl_info info{};
  // Not in this program: a shared library.
  if (dladdr(reinterpret_cast<const void*>(address), &info) == 0) return "";
  const std::uintptr_t base = load_address();
  if (reinterpret_cast<std::uintptr_t>(info.dli_fbase) != base) return "";
  const auto after = functions().upper_bound(address - base);
  return after == functions().begin() ? "" : std::prev(after)->second;
}

// Which functions of this program run while something is done: found by sampling, so that no function needs to report
// itself. Samples by function, demangled name -> count, of this process' processor time every half millisecond while
// `work` is repeated, until `least` samples fell into functions whose name contains `part` or `most` seconds of
// processor time have passed. Samples outside this program's own code count as "". Linux on x86-64; names are read
// with nm.
std::map<std::string, int> profile(const std::function<void()>& work, const std::string& part, int least,
                                   double most) {
  functions();  // read beforehand
  struct sigaction action {};
  struct sigaction before {};
  action.sa_sigaction = &take_sample;
  action.sa_flags = SA_SIGINFO | SA_RESTART;
  sigaction(SIGPROF, &action, &before);
  const itimerval interval{{0, 500}, {0, 500}}, never{};

  std::map<std::string, int> found;
  int hits = 0;
  const std::clock_t start = std::clock();
  do {
    sample_count = 0;
    // A timer that is set anew ticks first after one or two of the system's ticks of 1 to 10 ms: pieces of work
    // that are shorter would never be seen.
    const std::clock_t turn = std::clock();
    setitimer(ITIMER_PROF, &interval, nullptr);
    do {
      work();
    } while (static_cast<double>(std::clock() - turn) < .2 * CLOCKS_PER_SEC);
    setitimer(ITIMER_PROF, &never, nullptr);
    const std::size_t count = std::min<std::size_t>(sample_count, kMostSamples);
    for (std::size_t k = 0; k < count; ++k) {
      const std::string name = function_at(sampled[k]);
      ++found[name];
      hits += name.find(part) != std::string::npos;
    }
  } while (hits < least && static_cast<double>(std::clock() - start) < most * CLOCKS_PER_SEC);
  sigaction(SIGPROF, &before, nullptr);
  return found;
}

namespace rs = fast::row_stream;

// What a name stands for: the namespace that Highway compiles for these instructions, and the vector in it.
struct Meaning {
  std::string instructions;
  int lanes;
};

const std::map<std::string, Meaning>& meanings() {
  static const std::map<std::string, Meaning> all{
      {"avx512", {"N_AVX3", 16}}, {"avx512/4", {"N_AVX3", 4}}, {"avx2", {"N_AVX2", 8}},
      {"avx2/4", {"N_AVX2", 4}},  {"sse4", {"N_SSE4", 4}},     {"scalar", {"", 1}},
  };
  return all;
}

// Of a function of the kernel, or a helper of its own; "" for the scalar one.
bool belongs_to(const std::string& function, const Meaning& meaning) {
  if (meaning.instructions.empty())
    return function.find("row_stream::generic::") != std::string::npos ||
           function.find("run_scalar") != std::string::npos ||
           function.find("run_edge_scalar") != std::string::npos;
  return function.find("::fill_lanes<") == std::string::npos &&  // fills lanes for whichever kernel asks
         function.find("row_stream::" + meaning.instructions + "::") != std::string::npos &&
         (function.find(fmt::format("Simd<float, {}ul", meaning.lanes)) != std::string::npos ||
          function.find(fmt::format("_lanes<{}>", meaning.lanes)) != std::string::npos);
}

TEST(Targets, EveryKernelIsTheFunctionItsNameStandsFor) {
  for (const rs::Kernel& kernel : rs::kernels()) {
    ASSERT_TRUE(meanings().contains(kernel.name)) << kernel.name;
    const Meaning& meaning = meanings().at(kernel.name);
    EXPECT_EQ(kernel.lanes, meaning.lanes) << kernel.name;
    const std::string run = function_at(reinterpret_cast<std::uintptr_t>(kernel.run));
    const std::string edges = function_at(reinterpret_cast<std::uintptr_t>(kernel.run_edges));
    EXPECT_TRUE(belongs_to(run, meaning)) << kernel.name << ": " << run;
    EXPECT_TRUE(belongs_to(edges, meaning)) << kernel.name << ": " << edges;
  }
}

// Every x86-64 machine that can run this project's CI has these; the rest is what the processor says it has.
TEST(Targets, AreAllThereThatTheProcessorHas) {
  std::vector<std::string> expected;
  __builtin_cpu_init();
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw"))
    expected.insert(expected.end(), {"avx512", "avx512/4"});
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    expected.insert(expected.end(), {"avx2", "avx2/4"});
  if (__builtin_cpu_supports("sse4.2")) expected.push_back("sse4");
  expected.push_back("scalar");
  std::vector<std::string> found;
  for (const rs::Kernel& kernel : rs::kernels()) found.push_back(kernel.name);
  EXPECT_EQ(found, expected);
}

// Samples in the kernel asked for, and in any other but `beside` it.
void expect_only(const std::string& target, const std::map<std::string, int>& samples,
                 const std::string& beside = "") {
  int own = 0, other = 0;
  std::string where;
  for (const auto& [function, count] : samples) {
    for (const auto& [name, meaning] : meanings()) {
      if (name == beside || !belongs_to(function, meaning)) continue;
      (name == target ? own : other) += count;
      if (name != target) where += "\n  " + function;
    }
  }
  EXPECT_GE(own, 20) << target;
  EXPECT_EQ(other, 0) << target << " was asked for; seen running:" << where;
  testing::Test::RecordProperty(target, own);
}

std::string part_of(const Meaning& meaning) {
  return meaning.instructions.empty() ? "generic::" : meaning.instructions + "::";
}

TEST(Targets, OnlyTheKernelAskedForIsSeenRunning) {
  const auto mesh = data::named_mesh("bumpy:200");
  const fast::Adjacency adjacency(mesh);
  const auto pairs = random_pairs(adjacency, 5, 1);
  for (const rs::Kernel& kernel : rs::kernels()) {
    const rs::RowStream stream(mesh, adjacency, kernel);
    rs::Workspace workspace;
    std::vector<rs::Vertex> out(pairs.size() * static_cast<std::size_t>(rs::side(5) * rs::side(5)));
    const auto work = [&] {
      for (int repeat = 0; repeat < 20; ++repeat) stream.whole(pairs, 5, workspace, out.data());
    };
    expect_only(kernel.name, profile(work, part_of(meanings().at(kernel.name)), 40, 5));
  }
}

TEST(Targets, OnlyTheTargetTheSubjectWasGivenIsSeenRunning) {
  const auto mesh = data::named_mesh("bumpy:200");
  const std::vector<std::int32_t> depth(mesh.faces.size(), 5);
  const lc_subject& subject = *lc_subject_row_stream();
  LentMesh lent(mesh, data::Scheme::kLoop);
  // Without memory to hand it over in, next to nothing is done but the frames. Their depths are unequal, and what
  // repairs the edges between these is the four lanes of every target.
  const lc_request request{depth.data(), 1, nullptr, [](void*, std::size_t) -> void* { return nullptr; },
                           sizeof(lc_request)};
  for (const rs::Kernel& kernel : rs::kernels()) {
    void* instance = nullptr;
    const char* message = "";
    const std::string options = fmt::format("target={},frames=100", kernel.name);
    ASSERT_EQ(subject.create(&lent.lend(), options.c_str(), &instance, &message), LC_OK) << message;
    const auto work = [&] {
      lc_tessellation out{};
      out.size = sizeof out;
      EXPECT_EQ(subject.tessellate(instance, &request, &out, &message), LC_FAILED);
    };
    expect_only(kernel.name, profile(work, part_of(meanings().at(kernel.name)), 40, 10),
                std::string(kernel.name) + "/4");
    subject.destroy(instance);
  }
}

TEST(Targets, ATargetThatTheMachineLacksIsRefusedByName) {
  const auto refused = thrown<SubjectError>([] { capabilities(*lc_subject_row_stream(), "target=neon"); });
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->status(), LC_INVALID_INPUT);
  for (const rs::Kernel& kernel : rs::kernels()) EXPECT_TRUE(says(refused->what(), kernel.name));
}

}  // namespace
}  // namespace limitcheck::verify
