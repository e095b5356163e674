// SPDX-License-Identifier: MIT
// Which compiled variant runs when one is asked for, found out without asking it: by the function's name in
// the program's symbol table, and by where the processor is while it works. A variant that bears another's
// name gives the right bits, so nothing else can tell.
#include <fmt/core.h>
#include <gtest/gtest.h>
#include <malloc.h>

#include <map>
#include <string>
#include <vector>

#include "data/generators/named_mesh.h"
#include "data/test_support/assertions.h"
#include "fast/stream/kernel/targets.h"
#include "fast/stream/row_stream.h"
#include "verify/host/host.h"
#include "verify/shared_bits/test_support/evaluate.h"
#include "verify/shared_bits/test_support/profile.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

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
  return function.find("row_stream::" + meaning.instructions + "::") != std::string::npos &&
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

// Samples in the kernel asked for, and in any other.
void expect_only(const std::string& target, const std::map<std::string, int>& samples) {
  int own = 0, other = 0;
  std::string where;
  for (const auto& [function, count] : samples) {
    for (const auto& [name, meaning] : meanings()) {
      if (!belongs_to(function, meaning)) continue;
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
  // The pages of an answer serve the next: else the system makes pages for most of the time.
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
  const auto mesh = data::named_mesh("bumpy:200");
  // One depth: what repairs the edges between unequal ones is the four lanes of every target.
  const std::vector<std::int32_t> depth(mesh.faces.size(), 5);
  for (const rs::Kernel& kernel : rs::kernels()) {
    Session session(*lc_subject_row_stream(), mesh, fmt::format("target={}", kernel.name));
    const auto work = [&] {
      for (int repeat = 0; repeat < 5; ++repeat) session.tessellate(depth);
    };
    expect_only(kernel.name, profile(work, part_of(meanings().at(kernel.name)), 40, 40));
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
