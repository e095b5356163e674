// SPDX-License-Identifier: MIT
// Costs that are whole numbers and the same on every machine: operations and vectors of a pair, allocations,
// bytes. One JSON object, "what/engine/shape/depth:N": number. `limitcheck bench gate` holds them against a
// baseline.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "bench/contenders/contender.h"
#include "data/generators/polygon_meshes.h"
#include "data/shapes.h"
#include "fast/rules/prepared_quads.h"
#include "fast/stream/row_stream.h"
#include "fast/window/quad_window.h"
#include "fast/window/sliding_window.h"
#include "verify/proof/numbers/operation_count.h"

// What a piece of work asks of the allocator, exactly: every operator new, malloc, calloc, realloc and aligned allocation
// of the process passes here. __libc_* is the C library's allocator under its other names; its operator new calls malloc,
// so this sees both. Bytes are those asked for: what the allocator makes of them differs from version to version.
extern "C" {
void* __libc_malloc(std::size_t);                 // NOLINT(bugprone-reserved-identifier)
void* __libc_calloc(std::size_t, std::size_t);    // NOLINT(bugprone-reserved-identifier)
void* __libc_realloc(void*, std::size_t);         // NOLINT(bugprone-reserved-identifier)
void* __libc_memalign(std::size_t, std::size_t);  // NOLINT(bugprone-reserved-identifier)
void __libc_free(void*);                          // NOLINT(bugprone-reserved-identifier)
}

namespace limitcheck::bench {
namespace {

struct Allocations {
  std::int64_t count = 0;  ///< blocks asked for
  std::int64_t kept = 0;   ///< bytes asked for and not yet freed; of this work's blocks alone
  std::int64_t peak = 0;   ///< largest value that `kept` had
};

std::atomic<bool> counting = false;
thread_local bool inside = false;  // the books allocate, too

struct Books {
  std::mutex mutex;
  std::unordered_map<void*, std::size_t> sizes;
  Allocations sum;
};

Books& books() {
  static Books all;
  return all;
}

template <class Change>
void change_books(void* block, const Change& change) {
  if (!counting || inside || !block) return;
  inside = true;
  {
    const std::lock_guard lock(books().mutex);
    change(books());
  }
  inside = false;
}

void enter(void* block, std::size_t size) {
  change_books(block, [&](Books& b) {
    b.sizes[block] = size;
    ++b.sum.count;
    b.sum.kept += static_cast<std::int64_t>(size);
    b.sum.peak = std::max(b.sum.peak, b.sum.kept);
  });
}

void strike_out(void* block) {
  change_books(block, [&](Books& b) {
    const auto found = b.sizes.find(block);
    if (found == b.sizes.end()) return;
    b.sum.kept -= static_cast<std::int64_t>(found->second);
    b.sizes.erase(found);
  });
}

/// Of all threads, while work runs. One at a time.
Allocations count_allocations(const std::function<void()>& work) {
  books().sizes.clear();
  books().sum = {};
  counting = true;
  work();
  counting = false;
  return books().sum;
}

}  // namespace
}  // namespace limitcheck::bench

extern "C" {

void* malloc(std::size_t size) noexcept {
  void* block = __libc_malloc(size);
  limitcheck::bench::enter(block, size);
  return block;
}

void* calloc(std::size_t count, std::size_t size) noexcept {
  void* block = __libc_calloc(count, size);
  limitcheck::bench::enter(block, count * size);
  return block;
}

void* realloc(void* old, std::size_t size) noexcept {
  limitcheck::bench::strike_out(old);
  void* block = __libc_realloc(old, size);
  limitcheck::bench::enter(block, size);
  return block;
}

void* memalign(std::size_t alignment, std::size_t size) noexcept {
  void* block = __libc_memalign(alignment, size);
  limitcheck::bench::enter(block, size);
  return block;
}

void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept {
  return memalign(alignment, size);
}

int posix_memalign(void** out, std::size_t alignment, std::size_t size) noexcept {
  void* block = memalign(alignment, size);
  if (!block) return ENOMEM;
  *out = block;
  return 0;
}

void free(void* block) noexcept {
  limitcheck::bench::strike_out(block);
  __libc_free(block);
}

}  // extern "C"

namespace {

using namespace limitcheck;
namespace rs = fast::row_stream;

using Costs = nlohmann::ordered_json;
using Shape = std::pair<const char*, data::ControlMesh>;

/// Of the pair of half-edge 0: regular, irregular and boundary corners.
void add_operations(Costs& costs) {
  const std::vector<Shape> shapes = {{"torus:5x6", data::torus(5, 6)},
                                     {"bipyramid:9", data::bipyramid(9)},
                                     {"wheel:7", data::wheel(7)},
                                     {"wheel:5x1", data::wheel(5, 1)}};
  const std::pair<const char*, verify::CountedKernel> engines[] = {
      {"row-stream", verify::CountedKernel::kRowStream},
      {"sliding-window", verify::CountedKernel::kSlidingWindow},
      {"sliding-window-printed", verify::CountedKernel::kSlidingWindowPrinted}};
  for (const auto& [engine, kernel] : engines) {
    for (const auto& [shape, mesh] : shapes) {
      for (const int depth : {0, 1, 3, 5}) {
        const verify::KernelCost cost = verify::count_operations(kernel, mesh, depth);
        const std::string tail = fmt::format("/{}/{}/depth:{}", engine, shape, depth);
        costs["flops" + tail] = cost.operations.flops();
        costs["vectors-stored" + tail] = cost.stored_vectors;
        costs["limits-evaluated" + tail] = cost.limits;
        if (depth == 0) costs[fmt::format("flops/prepass/{}/{}", engine, shape)] = cost.prepass.flops();
      }
    }
  }
}

/// The engines whose names and lanes every machine has that has AVX2.
bool everywhere(const bench::Route& route) {
  return route.name == "row-stream/avx2" || route.name == "row-stream/scalar" ||
         route.name == "sliding-window";
}

void add_allocations(Costs& costs, const Shape& shape, const std::vector<bench::Route>& routes) {
  for (const bench::Route& route : routes) {
    if (!everywhere(route)) continue;
    for (const int depth : {3, 5}) {
      const std::string tail = fmt::format("/{}/{}/depth:{}", route.name, shape.first, depth);
      std::unique_ptr<bench::Contender> contender;
      costs["allocations/set-up" + tail] =
          bench::count_allocations([&] { contender = route.make(shape.second, depth, 1); }).count;
      const bench::Allocations first = bench::count_allocations([&] { contender->run(); });
      costs["allocations/first-run" + tail] = first.count;
      costs["bytes/workspace-of-a-thread" + tail] = first.kept;
      costs["allocations/later-run" + tail] = bench::count_allocations([&] { contender->run(); }).count;
    }
  }
}

/// Makes what is kept of the control mesh before the first point, and counts it and the most that making it takes.
template <class T, class... From>
void add_made(Costs& costs, const std::string& what, const Shape& shape, std::optional<T>& part,
              const From&... from) {
  const bench::Allocations made = bench::count_allocations([&] { part.emplace(from...); });
  const std::string tail = fmt::format("/{}/{}/faces:{}", what, shape.first, shape.second.faces.size());
  costs["bytes" + tail] = made.kept;
  costs["bytes-while-made" + tail] = made.peak;
}

void add_prepass(Costs& costs, const Shape& shape) {
  std::optional<fast::Adjacency> adjacency;
  add_made(costs, "adjacency", shape, adjacency, shape.second);
  std::optional<rs::RowStream> stream;
  add_made(costs, "prepass/row-stream", shape, stream, shape.second, *adjacency);
  std::optional<fast::PreparedMesh<float>> prepared;
  add_made(costs, "prepass/sliding-window", shape, prepared, *adjacency,
           fast::positions_of<float>(shape.second));
}

/// The same of quads.
void add_quad_prepass(Costs& costs, const Shape& shape) {
  std::optional<fast::QuadMesh> quads;
  add_made(costs, "quad-mesh", shape, quads, shape.second);
  std::optional<rs::QuadRowStream> stream;
  add_made(costs, "prepass/row-stream", shape, stream, *quads);
  std::optional<fast::PreparedQuads<float>> prepared;
  add_made(costs, "prepass/sliding-window", shape, prepared, *quads, fast::positions_of<float>(*quads));
}

/// What the window computes and holds for quad 0, as the paper counts it.
void add_quad_window(Costs& costs, const Shape& shape) {
  const fast::QuadMesh quads(shape.second);
  const fast::PreparedQuads<float> prepared(quads, fast::positions_of<float>(quads));
  for (const int depth : {0, 1, 3, 5}) {
    fast::QuadWindow<float, fast::LimitSurface<float>, fast::Counting> window(depth,
                                                                              quads.adjacency.max_valence());
    window.run(prepared, 0, depth, [](int, const auto*) {});
    const std::string tail = fmt::format("/sliding-window/{}/depth:{}", shape.first, depth);
    costs["vectors-stored" + tail] = window.probe().counts.stored();
    costs["limits-evaluated" + tail] = window.probe().counts.limit_points;
    costs["vectors-held" + tail] = window.allocated_vectors();
  }
}

}  // namespace

int main() {
  Costs costs = Costs::object();
  add_operations(costs);
  const Shape torus{"torus:20x24", data::torus(20, 24)}, holes{"holes", data::holes()};
  for (const Shape* shape : {&torus, &holes}) {
    add_allocations(costs, *shape, bench::our_routes());
    add_prepass(costs, *shape);
  }
  for (const Shape& shape :
       {Shape{"quad-torus:20x24", data::quad_torus(20, 24)}, Shape{"pawn", data::pawn(8)}}) {
    add_allocations(costs, shape, bench::our_quad_routes());
    add_quad_prepass(costs, shape);
    add_quad_window(costs, shape);
  }
  std::puts(costs.dump(0).c_str());
  return 0;
}
