// SPDX-License-Identifier: MIT
// Row streaming on any number type: every limit point that it makes for a pair, with its place.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "data/control_mesh.h"
#include "fast/frame/patch.h"
#include "fast/mesh/adjacency.h"
#include "fast/rules/limit.h"
#include "fast/stream/host/number_stream.h"

namespace limitcheck::verify {

/// The prepass, the gathering and the kernel of row streaming over T. Runs twice, for one tangent each:
/// Lane<0> and Lane<1> are LinearNumber<T, 0> and <T, 1> or follow them.
template <class T, template <int> class Lane>
class StreamRuns {
 public:
  using Frame = fast::LimitFrame<T>;

  /// One position per vertex of the mesh.
  StreamRuns(const data::ControlMesh& mesh, const std::vector<fast::Vec3<T>>& positions)
      : adjacency_(mesh), first_(adjacency_, arrays(positions)), second_(adjacency_, arrays(positions)) {}
  StreamRuns(const StreamRuns&) = delete;
  StreamRuns& operator=(const StreamRuns&) = delete;

  /// The pair of half-edge 0, or face 0 if that has no neighbour. Calls visit(LatticePoint, const Frame&),
  /// row by row.
  template <class Visit>
  void pair(int depth, Visit&& visit) const {
    const std::int32_t twin = adjacency_.twin(0);
    const bool alone = twin < 0;
    const fast::Grid pair =
        alone ? fast::Grid{.face0 = 0, .depth = depth} : fast::Grid{0, twin / 3, 0, twin % 3, depth};
    const int size = 1 << depth, side = size + 1;
    std::vector<T> first(6 * side * side), second(first.size());
    first_.whole({&pair, 1}, depth, first.data());
    second_.whole({&pair, 1}, depth, second.data());
    for (int row = 0; row <= size; ++row) {
      for (int column = 0; column <= (alone ? row : size); ++column) {
        const auto at = fast::row_stream::face_point(pair, size, column, row, row >= column);
        const std::size_t k = 6 * (row * side + column);
        visit(at, frame(&first[k], &second[k]));
      }
    }
  }

  /// The strip of half-edge h, from its origin to its end.
  template <class Visit>
  void edge(std::int32_t h, int depth, Visit&& visit) const {
    const int size = 1 << depth;
    std::vector<T> first(6 * (size + 1)), second(first.size());
    first_.edges({&h, 1}, depth, first.data());
    second_.edges({&h, 1}, depth, second.data());
    const fast::Half half{h / 3, h % 3, fast::Display::kFan};
    for (int t = 0; t <= size; ++t)
      visit(half.lattice(size, size - t, t), frame(&first[6 * t], &second[6 * t]));
  }

 private:
  static std::vector<std::array<T, 3>> arrays(const std::vector<fast::Vec3<T>>& positions) {
    std::vector<std::array<T, 3>> result;
    for (const auto& p : positions) result.push_back({p.x, p.y, p.z});
    return result;
  }
  static Frame frame(const T* a, const T* b) {
    return {{a[0], a[1], a[2]}, {a[3], a[4], a[5]}, {b[3], b[4], b[5]}};
  }

  fast::Adjacency adjacency_;
  fast::row_stream::NumberStream<Lane<0>> first_;
  fast::row_stream::NumberStream<Lane<1>> second_;
};

}  // namespace limitcheck::verify
