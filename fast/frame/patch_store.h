// SPDX-License-Identifier: MIT
// Where the patches of a mesh lie in a buffer of vertices, and what they showed when they were written there.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "fast/frame/patch_indices.h"
#include "fast/frame/patch_mesh.h"
#include "fast/plan/crack.h"
#include "fast/plan/grid.h"

namespace limitcheck::fast {

/// All that the points of a patch depend on, but for the control mesh: two patches of equal keys have equal
/// bits.
struct PatchKey {
  static constexpr std::size_t kEdges = 8;

  Grid grid;
  std::array<Display, 2> display{};
  std::array<std::int8_t, kEdges> edge_depth{};  // of the faces in repair; else 0
  friend bool operator==(const PatchKey&, const PatchKey&) = default;
};

/// A patch that a frame shows.
struct PatchWanted {
  PatchKey key;
  std::int32_t size = 0;   // vertices
  bool comparable = true;  // false: the key does not tell everything; it is always made anew
};

struct PatchPlace {
  std::int64_t first = 0;
  bool fresh = true;  // to be evaluated; else it is there
};

/// Places, one patch for each first face of a grid.
struct PatchStore {
  /// The places of the patches of the list, in their order. If `reuse`, patches whose keys are as before
  /// stay.
  void place(std::size_t faces, bool reuse);
  void clear();

  std::vector<PatchWanted> list;  // the patches of a frame
  std::vector<PatchPlace> places;
  std::int64_t end = 0;      // vertices in use and between
  std::uint64_t writer = 0;  // FrameState::version of the frame that is here, 0: none
  std::uint64_t mesh = 0;    // FrameState::id of the last
  PatchIndices indices;
  std::vector<Grid> pairs;           // of the last frame, for sticky pairing
  std::vector<std::int32_t> depths;  // those that were asked for in the last frame

 private:
  struct Kept {
    PatchKey key;
    std::int64_t first = -1;  // -1: nothing
    std::int32_t size = 0;
    std::uint32_t shown = 0;  // the last frame that did
  };

  void place_all_anew();
  std::int64_t take(std::int32_t size);
  void give_back(Kept& kept);
  void evict(std::int64_t most);

  std::vector<Kept> kept_;                                     // per face
  std::map<std::int32_t, std::vector<std::int64_t>> free_;     // places by size
  std::vector<std::pair<std::uint32_t, std::size_t>> hidden_;  // age and face, while evict() is at it
  std::uint32_t frame_ = 0;
};

}  // namespace limitcheck::fast
