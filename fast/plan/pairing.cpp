// SPDX-License-Identifier: MIT
#include "fast/plan/pairing.h"

#include <algorithm>
#include <array>
#include <limits>
#include <tuple>

#include "fast/plan/depth.h"
#include "fast/plan/printed_rules.h"

namespace limitcheck::fast {

namespace {

constexpr int kTaken = 4;  // paired, singleton or culled: in none of S0 .. S3

// The state of the greedy algorithm. A face only ever moves towards S0 and enters each set at most once, so
// the queues need no deletion: what has moved on since it was appended is skipped when it comes up.
class Greedy {
 public:
  Greedy(const Adjacency& adjacency, const PrintedRules& rules, PairingResult& result,
         std::span<const Grid> keep)
      : adjacency_(adjacency), rules_(rules), result_(result), nodes_(result.depth.size()) {
    const auto faces = static_cast<std::int32_t>(nodes_.size());
    for (std::int32_t f = 0; f < faces; ++f) {
      if (result_.depth[f] < 0) {
        nodes_[f].set = kTaken;
        ++result_.culled;
      }
    }
    for (const Grid& grid : keep) {
      nodes_[grid.face0].set = nodes_[grid.face1].set = kTaken;
      result_.grids.push_back(grid);
      ++result_.pair_count;
    }
    for (std::int32_t f = 0; f < faces; ++f) {
      if (nodes_[f].set != kTaken) nodes_[f].free = count_free(f);
    }
    for (std::int32_t f = 0; f < faces; ++f) {
      if (nodes_[f].set != kTaken) move(f, set_by_definition(f));
    }
  }

  void run() {
    for (std::int32_t f = highest(); f >= 0; f = highest()) {
      const int k = choose_partner(f);
      take(f);
      if (k >= 0) take(adjacency_.neighbour(f, k));
      emit(f, k);
      raise_neighbours(f, k);
    }
  }

 private:
  struct Node {
    std::int8_t set = -1;
    std::int8_t free = 0;  // free neighbours
  };

  struct Queue {
    std::vector<std::int32_t> faces;
    std::size_t head = 0;
  };

  bool is_free(std::int32_t f) const { return f >= 0 && nodes_[f].set != kTaken; }

  std::int8_t count_free(std::int32_t f) const {
    std::int8_t count = 0;
    for (int k = 0; k < 3; ++k)
      count = static_cast<std::int8_t>(count + (is_free(adjacency_.neighbour(f, k)) ? 1 : 0));
    return count;
  }

  // S1 is "two free neighbours, at least one of which has fewer than three". [C36]
  int set_by_definition(std::int32_t f) const {
    if (nodes_[f].free <= 1) return 0;
    if (nodes_[f].free == 3) return 3;
    for (int k = 0; k < 3; ++k) {
      const std::int32_t g = adjacency_.neighbour(f, k);
      if (is_free(g) && nodes_[g].free < 3) return 1;
    }
    return 2;
  }

  void move(std::int32_t f, int set) {
    nodes_[f].set = static_cast<std::int8_t>(set);
    queues_[set].faces.push_back(f);
  }

  void take(std::int32_t f) { nodes_[f].set = kTaken; }

  /// The first face of the highest set that is not empty; -1 when all are.
  std::int32_t highest() {
    for (int set = 0; set < 4; ++set) {
      Queue& queue = queues_[set];
      for (; queue.head < queue.faces.size(); ++queue.head) {
        if (nodes_[queue.faces[queue.head]].set == set) return queue.faces[queue.head];
      }
    }
    return -1;
  }

  /// The edge of f towards its partner; -1 without a free neighbour. "A neighbour in S0 first" decides
  /// nothing as long as the sets are right: a face with a choice is taken only when S0 is empty. With the
  /// printed step 3 they are not.
  int choose_partner(std::int32_t f) const {
    int chosen = -1;
    std::tuple<bool, bool, int, std::int32_t> best{true, true, kTaken,
                                                   std::numeric_limits<std::int32_t>::max()};
    for (int k = 0; k < 3; ++k) {
      const std::int32_t g = adjacency_.neighbour(f, k);
      if (!is_free(g)) continue;
      const std::int8_t set = nodes_[g].set;
      const bool other_depth = rules_.prefer_equal_depth && result_.depth[g] != result_.depth[f];
      const std::tuple<bool, bool, int, std::int32_t> rank{set != 0, other_depth, set, g};
      if (rank < best) {
        best = rank;
        chosen = k;
      }
    }
    return chosen;
  }

  void emit(std::int32_t f, int k) {
    Grid grid;
    grid.face0 = f;
    grid.depth = result_.depth[f];
    if (k >= 0) {
      const std::int32_t h = adjacency_.twin(3 * f + k);
      grid.face1 = h / 3;
      grid.edge0 = k;
      grid.edge1 = h % 3;
      grid.depth = std::max(grid.depth, result_.depth[grid.face1]);
      result_.depth[f] = result_.depth[grid.face1] = grid.depth;
      ++result_.pair_count;
    } else {
      for (int dummy = 2; dummy >= 0; --dummy) {
        const std::int32_t h = adjacency_.twin(3 * f + dummy);
        if (h < 0) continue;
        grid.edge0 = dummy;
        grid.edge1 = h % 3;
      }
      ++result_.singletons;
    }
    result_.grids.push_back(grid);
  }

  // Step 3. The free neighbours of f and g, at most four, in the order of their edges; a face that touches
  // both is there once and loses two. [C40]
  void raise_neighbours(std::int32_t f, int k) {
    std::array<std::int32_t, 6> touched{};
    std::size_t count = 0;
    const auto visit = [&](std::int32_t face) {
      for (int e = 0; e < 3; ++e) {
        const std::int32_t h = adjacency_.neighbour(face, e);
        if (!is_free(h)) continue;
        --nodes_[h].free;
        if (std::find(touched.begin(), touched.begin() + count, h) == touched.begin() + count)
          touched[count++] = h;
      }
    };
    visit(f);
    if (k >= 0) visit(adjacency_.neighbour(f, k));

    const std::span<const std::int32_t> faces(touched.data(), count);
    if (rules_.pairing == PairingRule::kCorrected) {
      raise_corrected(faces);
    } else {
      raise_printed(faces);
    }
  }

  void raise_corrected(std::span<const std::int32_t> touched) {
    for (const std::int32_t h : touched) {
      if (nodes_[h].free <= 1 && nodes_[h].set != 0) move(h, 0);
    }
    for (const std::int32_t h : touched) {
      if (nodes_[h].set == 3) move(h, set_by_definition(h));
    }
    // A face of S2 reaches S1 when one of its neighbours has left S3; only those of the touched ones have.
    for (const std::int32_t h : touched) {
      for (int e = 0; e < 3; ++e) {
        const std::int32_t neighbour = adjacency_.neighbour(h, e);
        if (is_free(neighbour) && nodes_[neighbour].set == 2) move(neighbour, 1);
      }
    }
  }

  // The three lines of step 3 in the order they are printed.
  void raise_printed(std::span<const std::int32_t> touched) {
    std::array<std::int32_t, 6> moved{};
    std::size_t count = 0;
    for (const std::int32_t h : touched) {
      if (nodes_[h].set != 3) continue;
      move(h, 2);
      moved[count++] = h;
    }
    for (const std::int32_t h : touched) {
      if (nodes_[h].set == 2 || nodes_[h].set == 1) move(h, 0);
    }
    // "All triangles from S2 with neighbours in S0, S1 or S2": such a neighbour is new only beside one that
    // moved.
    for (std::size_t i = 0; i < count; ++i) {
      for (int e = 0; e < 3; ++e) {
        const std::int32_t neighbour = adjacency_.neighbour(moved[i], e);
        if (is_free(neighbour) && nodes_[neighbour].set == 2) move(neighbour, 1);
      }
    }
  }

  const Adjacency& adjacency_;
  const PrintedRules& rules_;
  PairingResult& result_;
  std::vector<Node> nodes_;
  std::array<Queue, 4> queues_;
};

}  // namespace

PairingResult pair_faces(const Adjacency& adjacency, std::span<const std::int32_t> depth,
                         const PrintedRules& rules, std::span<const Grid> keep) {
  check_depths(depth, adjacency.face_count(), std::numeric_limits<std::int32_t>::max());
  PairingResult result;
  result.depth.assign(depth.begin(), depth.end());
  result.grids.reserve(depth.size() / 2 + 1);
  Greedy(adjacency, rules, result, keep).run();
  return result;
}

PairingResult pair_faces(const Adjacency& adjacency, std::span<const std::int32_t> depth) {
  return pair_faces(adjacency, depth, PrintedRules{});
}

}  // namespace limitcheck::fast
