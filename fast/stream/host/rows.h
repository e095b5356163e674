// SPDX-License-Identifier: MIT
// What the row streams of both schemes do alike: rows handed to visitors, and grids written to places of their own.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "data/error.h"
#include "fast/stream/kernel/output_targets.h"
#include "fast/stream/row_stream.h"

namespace limitcheck::fast::row_stream {

inline int checked(int depth) {
  if (depth < 0 || depth > kMaxDepth) throw data::ArgumentError("row streaming: depth is 0 to 10");
  return depth;
}

/// What a kernel calls after each row.
template <class View>
struct RowVisitor {
  View view;
  void (*visit)(void*, const View&);
  void* context;

  using Call = void (*)(void* self, int j);
  Call call() const { return visit == nullptr ? nullptr : &row; }

 private:
  static void row(void* self, int j) {
    auto& rows = *static_cast<RowVisitor*>(self);
    rows.view.j = j;
    rows.visit(rows.context, rows.view);
  }
};

/// Where grid i begins.
inline auto one_after_the_other(Vertex* out, int depth) {
  const auto n = static_cast<std::size_t>(side(depth));
  return [out, size = n * n](std::size_t i) { return out + i * size; };
}

/// Rows of whole grids to their places: that of number i of the list from at(i) on.
template <class View, class At>
struct Runs {
  const At& at;
  Stores stores;
  std::array<LineStream, kMaxLanes> lines = {};

  static void visit(void* context, const View& view) {
    Runs& runs = *static_cast<Runs*>(context);
    const auto n = static_cast<std::size_t>(side(view.depth)), j = static_cast<std::size_t>(view.j);
    for (std::size_t lane = 0; lane < view.size(); ++lane) {
      if (runs.stores == Stores::kOrdinary) {
        std::copy_n(view.vertices(lane), n, runs.at(view.number(lane)) + j * n);
        continue;
      }
      LineStream& lines = runs.lines[lane];
      if (j == 0) lines.start(reinterpret_cast<std::byte*>(runs.at(view.number(lane))));
      lines.append(reinterpret_cast<const std::byte*>(view.vertices(lane)), n * sizeof(Vertex));
      if (j + 1 == n) lines.finish();
    }
  }
};

}  // namespace limitcheck::fast::row_stream
