// SPDX-License-Identifier: MIT
// A program of its own: it replaces operator new.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "fast/frame/crack_centre.h"
#include "fast/test_support/test_meshes.h"
#include "fast/window/crack_edge.h"
#include "fast/window/sliding_window.h"
#include "fast/window/triangle_lattice.h"

namespace {
std::atomic<long> allocations{0};
}

// Those of arrays call these. Not inlined: else g++ 12 warns that free() is given what operator new made.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
  ++allocations;
  const auto a = static_cast<std::size_t>(alignment);
  if (void* memory = std::aligned_alloc(a, (size + a - 1) / a * a)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}

namespace limitcheck::fast {
namespace {

TEST(Sec4_SlidingWindow, AllocatesNothingAfterConstruction) {
  RecordProperty("claim", "C19");
  for (const auto& mesh : {tetrahedron(), bipyramid(130), grid_sheet(3, 4), wheel(5), fan(8)}) {
    const Adjacency adjacency(mesh);
    const PreparedMesh<float> prepared(adjacency, positions_of<float>(mesh));
    SlidingWindow<float> window(5, adjacency.max_valence());
    EdgeStrip<float> strip(5, adjacency.max_valence());
    FanCentreEvaluator<float> centre(adjacency.max_valence());
    SurfaceVertex<float> border[33];
    double sum = 0;
    const long before = allocations;
    for (std::int32_t h = 0; h < 3 * adjacency.face_count(); ++h) {
      for (int depth = 0; depth <= 5; ++depth) {
        strip.evaluate(prepared, h, depth, border);
        if (adjacency.twin(h) < 0) continue;
        window.run(prepared, h, depth, [&](int, const SurfaceVertex<float>* s) { sum += s[0].position.x; });
      }
      sum += centre.evaluate(prepared, h / 3, FanCentre::kLimit).position.x;
    }
    EXPECT_EQ(allocations - before, 0);
    EXPECT_TRUE(std::isfinite(sum));
  }
  const auto mesh = single_triangle();
  const Adjacency adjacency(mesh);
  const PreparedMesh<float> prepared(adjacency, positions_of<float>(mesh));
  TriangleLattice<float> lattice(5);
  double sum = 0;
  const long before = allocations;
  lattice.run(prepared, 0, 5, [&](int, const SurfaceVertex<float>* s) { sum += s[0].position.x; });
  EXPECT_EQ(allocations - before, 0);
  EXPECT_GT(allocations.load(), 0) << "or the replaced operator is not in use";
}

}  // namespace
}  // namespace limitcheck::fast
