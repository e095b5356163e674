// SPDX-License-Identifier: MIT
// What every tessellator can do: one frame after the other, at given depths or by a strategy; its options, and the
// statistics of a frame.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "data/scheme.h"
#include "fast/frame/patch_mesh.h"
#include "fast/frame/sink.h"
#include "fast/plan/crack.h"
#include "fast/plan/depth.h"
#include "fast/plan/pairing.h"

namespace limitcheck::fast {

/// The options of a tessellator, the same for all frames of a mesh.
struct TessellatorOptions {
  CrackOptions cracks;
  int max_depth = 5;        // the largest depth a strategy assigns; depths given by hand may be deeper
  int threads = 0;          // at most so many, 0: all. The output does not depend on it.
  bool provenance = false;  // fill the provenance of every vertex
  data::Scheme scheme = data::Scheme::kLoop;
};

/// What one frame did, and how long it took.
struct FrameStats {
  std::int64_t faces = 0, culled = 0;
  std::int64_t pairs = 0, singletons = 0;  // pairs of two; faces without partner
  std::int64_t fans = 0, stitched = 0;     // faces repaired (their pairs count above as well)
  std::int64_t strips = 0, draws = 0;
  std::int64_t triangles = 0, vertices = 0;  // as delivered
  std::int64_t limit_points = 0;             // evaluated in windows, along edges and at centres
  std::int64_t zero_normals = 0;  // vertices whose normal came from the rule for vanishing tangents
  double seconds_heuristics = 0, seconds_pairing = 0, seconds_planning = 0, seconds_evaluation = 0;
  double seconds_total = 0;
};

struct PrintedRules;  // plan/printed_rules.h, for the tests of the paper's claims
template <class Real>
struct FrameEngine;

/// The part that fast::Tessellator and row_stream::StreamTessellator share: a control mesh is copied and
/// prepared once, then each call of frame() is one frame. Real is float or double.
///   throws      data::ArgumentError. The constructors: a mesh that Adjacency refuses or without faces, a
///               coordinate that is not finite, a negative number of threads, a mesh too large or too small
///               for Real. frame(): not one depth per face, a depth outside -1 .. kDeepest, a strategy or
///               camera that DepthHeuristics refuses, more vertices than 32-bit indices reach (indexed mesh)
///   precision   the control points are rounded to Real
/// Every point of a control edge or vertex comes out with the same bits from every face that touches it, with
/// any number of threads. [D14] One frame at a time per object; inside, grids are evaluated in parallel.
template <class Real>
class Engine {
 public:
  int face_count() const;
  /// Of Loop's scheme: of the mesh with its sharp edges cut.
  ///   throws   data::ArgumentError: the scheme is Catmull-Clark's
  const Adjacency& adjacency() const;

  /// A frame at given depths, one per face, -1 = culled: as strips and fans in memory, as one indexed mesh,
  /// or handed to a sink draw by draw, so that only part of the frame is kept at a time.
  FrameStats frame(std::span<const std::int32_t> depth, DrawList<Real>& out);
  FrameStats frame(std::span<const std::int32_t> depth, IndexedMesh<Real>& out);
  FrameStats frame(std::span<const std::int32_t> depth, DrawSink<Real>& sink);
  /// As patches: their points once, what has not changed since the last frame left as it is, if it is so
  /// wanted (see PatchMesh). The patches have the bits of a fresh frame with the same pairs.
  ///   throws   data::ArgumentError, too: a patch too large for indices of 16 bits, compact vertices of
  ///            doubles
  FrameStats frame(std::span<const std::int32_t> depth, PatchMesh<Real>& out);

  /// A frame at the depths that a strategy of section 4.1 assigns, at most options.max_depth. Output: as
  /// above.
  template <class Output>
  FrameStats frame(const DepthOptions& strategy, const Camera& camera, Output& out) {
    double seconds = 0;
    const std::vector<std::int32_t> depth = depths(strategy, camera, seconds);
    FrameStats stats = frame(depth, out);
    stats.seconds_heuristics = seconds;
    stats.seconds_total += seconds;
    return stats;
  }

  /// Moves the control points, one for each vertex of the mesh that the engine was made for; what depends on
  /// the topology alone stays. The next frame is that of a new engine with these points, to the bit.
  ///   throws   data::ArgumentError: another number of points, or what the constructor refuses; the points
  ///            are then as before
  void move_points(std::span<const std::array<double, 3>> positions);

  /// The depths of the last frame after pairing, one per face, and its grids: to colour by, and to check.
  const PairingResult& last_pairing() const;
  const CrackPlan& last_plan() const;

 protected:
  explicit Engine(std::unique_ptr<FrameEngine<Real>> state);
  ~Engine() = default;
  Engine(Engine&&) noexcept = default;
  Engine& operator=(Engine&&) noexcept = default;

  FrameEngine<Real>& state() const { return *state_; }

 private:
  std::vector<std::int32_t> depths(const DepthOptions& strategy, const Camera& camera, double& seconds);

  std::shared_ptr<FrameEngine<Real>> state_;  // of this alone; shared pointers need no complete type
};

extern template class Engine<float>;
extern template class Engine<double>;

}  // namespace limitcheck::fast
