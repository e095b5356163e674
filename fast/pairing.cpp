// SPDX-License-Identifier: MIT
#include "fast/pairing.h"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>

#include "fast/depth.h"

namespace limitcheck::fast {

namespace {

constexpr std::int8_t kTaken = 4;  // paired, singleton or culled: in none of S0 .. S3

// The state of the greedy algorithm. A face only ever moves towards S0 and enters each set at most once, so
// the queues need no deletion: what has moved on since it was appended is skipped when it comes up.
//
// Which neighbours are free and what becomes of them follows no pattern that a processor could foresee, so
// the corrected rule's steps do not branch on it. The neighbour -1 is a face that is always taken.
class Greedy {
 public:
  Greedy(const Adjacency& adjacency, const PairingOptions& options, PairingResult& result)
      : adjacency_(adjacency), options_(options), result_(result) {
    const auto faces = static_cast<std::int32_t>(result_.depth.size());
    neighbours_.reset(new Neighbours[result_.depth.size() + 1]);
    nodes_.reset(new Node[result_.depth.size() + 1]);
    neighbour_ = neighbours_.get() + 1;
    node_ = nodes_.get() + 1;
    for (Queue& queue : queues_) queue.faces.reset(new std::int32_t[result_.depth.size() + 1]);
    for (std::int32_t f = 0; f < faces; ++f) {
      for (int k = 0; k < 3; ++k) neighbour_[f].face[k] = adjacency.neighbour(f, k);
      const bool culled = result_.depth[f] < 0;
      node_[f].set = culled ? kTaken : std::int8_t{3};
      result_.culled += culled;
    }
    for (std::int32_t f = 0; f < faces; ++f) {
      for (const std::int32_t g : neighbour_[f].face) node_[f].free += is_free(g);
    }
    for (std::int32_t f = 0; f < faces; ++f) {
      if (is_free(f)) move(f, set_by_definition(f));
    }
  }

  void run() {
    for (std::int32_t f = highest(); f >= 0; f = highest()) {
      const int k = choose_partner(f);
      take(f);
      if (k >= 0) take(neighbour_[f].face[k]);
      emit(f, k);
      raise_neighbours(f, k);
    }
  }

 private:
  struct Neighbours {
    std::int32_t face[3] = {-1, -1, -1};
  };
  struct Node {
    std::int8_t set = kTaken;
    std::int8_t free = 0;  // free neighbours
  };

  struct Queue {
    std::unique_ptr<std::int32_t[]> faces;
    std::size_t head = 0, tail = 0;

    void push_if(bool condition, std::int32_t f) {
      faces[tail] = f;
      tail += condition;
    }
  };

  bool is_free(std::int32_t f) const { return node_[f].set != kTaken; }

  bool has_neighbour_below_three(std::int32_t f) const {
    bool any = false;
    for (const std::int32_t g : neighbour_[f].face) any |= is_free(g) & (node_[g].free < 3);
    return any;
  }

  // S1 is "two free neighbours, at least one of which has fewer than three".                   [C36]
  int set_by_definition(std::int32_t f) const {
    if (node_[f].free <= 1) return 0;
    if (node_[f].free == 3) return 3;
    return has_neighbour_below_three(f) ? 1 : 2;
  }

  void move(std::int32_t f, int set) {
    node_[f].set = static_cast<std::int8_t>(set);
    queues_[static_cast<std::size_t>(set)].push_if(true, f);
  }

  void take(std::int32_t f) { node_[f].set = kTaken; }

  /// The first face of the highest set that is not empty; -1 when all are.
  std::int32_t highest() {
    for (int set = 0; set < 4; ++set) {
      Queue& queue = queues_[static_cast<std::size_t>(set)];
      for (; queue.head < queue.tail; ++queue.head) {
        if (node_[queue.faces[queue.head]].set == set) return queue.faces[queue.head];
      }
    }
    return -1;
  }

  /// The edge of f towards its partner; -1 without a free neighbour. "A neighbour in S0 first" decides
  /// nothing as long as the sets are right: a face with a choice is taken only when S0 is empty. With the
  /// printed step 3 they are not.
  int choose_partner(std::int32_t f) const {
    constexpr std::uint64_t kNone = ~std::uint64_t{0};
    std::uint64_t best = kNone;  // not in S0, other depth, set, face, edge: the smallest wins
    for (unsigned k = 0; k < 3; ++k) {
      const std::int32_t g = neighbour_[f].face[k];
      const auto set = static_cast<std::uint64_t>(node_[g].set);
      const bool other_depth = g >= 0 && options_.prefer_equal_depth && result_.depth[g] != result_.depth[f];
      const std::uint64_t rank = std::uint64_t{set != 0} << 40 | std::uint64_t{other_depth} << 39 |
                                 set << 36 | std::uint64_t{static_cast<std::uint32_t>(g)} << 2 | k;
      best = std::min(best, set == kTaken ? kNone : rank);
    }
    return best == kNone ? -1 : static_cast<int>(best & 3);
  }

  void emit(std::int32_t f, int k) {
    Pair pair;
    pair.face0 = f;
    pair.depth = result_.depth[f];
    if (k >= 0) {
      pair.face1 = neighbour_[f].face[k];
      pair.edge0 = k;
      pair.edge1 = adjacency_.twin(3 * f + k) - 3 * pair.face1;
      pair.depth = std::max(pair.depth, result_.depth[pair.face1]);
      result_.depth[f] = result_.depth[pair.face1] = pair.depth;
      ++result_.pair_count;
    } else {
      for (int dummy = 2; dummy >= 0; --dummy) {
        const std::int32_t h = adjacency_.twin(3 * f + dummy);
        if (h < 0) continue;
        pair.edge0 = dummy;
        pair.edge1 = h % 3;
      }
      ++result_.singletons;
    }
    result_.pairs.push_back(pair);
  }

  // Step 3. The free neighbours of f and g, at most four, in the order of their edges; a face that touches
  // both is there once and loses two. [C40]
  void raise_neighbours(std::int32_t f, int k) {
    std::array<std::int32_t, 7> touched;
    touched[0] = touched[1] = -1;
    std::size_t count = 0;
    const auto visit = [&](std::int32_t face) {
      for (const std::int32_t h : neighbour_[face].face) {
        const bool free = is_free(h);
        node_[h].free = static_cast<std::int8_t>(node_[h].free - free);
        const bool known = (touched[0] == h) | (touched[1] == h);  // f has two neighbours besides g
        touched[count] = h;
        count += free & !known;
      }
    };
    if (node_[f].free > (k >= 0)) visit(f);
    if (k >= 0 && node_[neighbour_[f].face[k]].free > 1) visit(neighbour_[f].face[k]);
    const std::span<const std::int32_t> faces(touched.data(), count);
    if (options_.rule == PairingRule::kCorrected) {
      raise_corrected(faces);
    } else {
      raise_printed(faces);
    }
  }

  void raise_corrected(std::span<const std::int32_t> touched) {
    for (const std::int32_t h : touched) {
      Node& node = node_[h];
      const bool raised = (node.free <= 1) & (node.set != 0);
      queues_[0].push_if(raised, h);
      node.set = raised ? std::int8_t{0} : node.set;
    }
    for (const std::int32_t h : touched) {  // one of three free neighbours gone: two are left
      Node& node = node_[h];
      if (node.set != 3) continue;
      const int set = has_neighbour_below_three(h) ? 1 : 2;
      node.set = static_cast<std::int8_t>(set);
      queues_[static_cast<std::size_t>(set)].push_if(true, h);
    }
    // A face of S2 reaches S1 when one of its neighbours has left S3; only those of the touched ones have.
    for (const std::int32_t h : touched) {
      for (const std::int32_t g : neighbour_[h].face) {
        if (node_[g].set == 2) move(g, 1);
      }
    }
  }

  // The three lines of step 3 in the order they are printed.
  void raise_printed(std::span<const std::int32_t> touched) {
    std::array<std::int32_t, 6> moved{};
    std::size_t count = 0;
    for (const std::int32_t h : touched) {
      if (node_[h].set != 3) continue;
      move(h, 2);
      moved[count++] = h;
    }
    for (const std::int32_t h : touched) {
      if (node_[h].set == 2 || node_[h].set == 1) move(h, 0);
    }
    // "All triangles from S2 with neighbours in S0, S1 or S2": such a neighbour is new only beside one that
    // moved.
    for (std::size_t i = 0; i < count; ++i) {
      for (int e = 0; e < 3; ++e) {
        const std::int32_t neighbour = neighbour_[moved[i]].face[e];
        if (is_free(neighbour) && node_[neighbour].set == 2) move(neighbour, 1);
      }
    }
  }

  const Adjacency& adjacency_;
  const PairingOptions& options_;
  PairingResult& result_;
  std::unique_ptr<Neighbours[]> neighbours_;
  std::unique_ptr<Node[]> nodes_;
  Neighbours* neighbour_;  // [-1] is the neighbour that is not there
  Node* node_;
  std::array<Queue, 4> queues_;
};

}  // namespace

PairingResult pair_faces(const Adjacency& adjacency, std::span<const std::int32_t> depth,
                         const PairingOptions& options) {
  check_depths(depth, adjacency.face_count(), std::numeric_limits<std::int32_t>::max());
  PairingResult result;
  result.depth.assign(depth.begin(), depth.end());
  result.pairs.reserve(depth.size() / 2 + 1);
  Greedy(adjacency, options, result).run();
  return result;
}

}  // namespace limitcheck::fast
