// SPDX-License-Identifier: MIT
// Tessellation on the fly: depths, pairing, sliding windows and crack repair, one frame after the other.
// [mueller2000, sections 4 and 5]
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "data/control_mesh.h"
#include "fast/frame/frame_options.h"
#include "fast/frame/sink.h"

namespace limitcheck::fast {

/// Prepared once per control mesh (copied); then one frame per call. Real is float or double.
///   throws      std::invalid_argument: a mesh that Adjacency refuses or without faces, coordinates that are
///               not finite, not one depth per face, a depth outside -1 .. kDeepest, a camera that makes no
///               view, a negative number of threads, more vertices than 32-bit indices reach (indexed mesh),
///               a mesh too large or too small for Real
///   precision   the control points are rounded to Real (exact if they are representable)
/// Every point of a control edge or vertex comes out with the same bits from every face that touches it.
/// [D14] One frame at a time per object; inside, pairs run in parallel.
template <class Real>
class Tessellator {
 public:
  explicit Tessellator(const data::ControlMesh& mesh, const TessellatorOptions& options = {});
  ~Tessellator();
  Tessellator(Tessellator&&) noexcept;
  Tessellator& operator=(Tessellator&&) noexcept;

  const Adjacency& adjacency() const;

  /// Given depths: one per face, -1 = culled.
  FrameStats frame(std::span<const std::int32_t> depth, DrawList<Real>& out);
  FrameStats frame(std::span<const std::int32_t> depth, IndexedMesh<Real>& out);
  FrameStats frame(std::span<const std::int32_t> depth, DrawSink<Real>& sink);

  /// Depths by a strategy of section 4.1, at most options.max_depth.
  FrameStats frame(const DepthOptions& strategy, const Camera& camera, DrawList<Real>& out);
  FrameStats frame(const DepthOptions& strategy, const Camera& camera, IndexedMesh<Real>& out);
  FrameStats frame(const DepthOptions& strategy, const Camera& camera, DrawSink<Real>& sink);

  /// The depths of the last frame after pairing, one per face, and its pairs: to colour by, and to check.
  const PairingResult& last_pairing() const;
  const CrackPlan& last_plan() const;

 private:
  struct State;
  template <class Sink>
  FrameStats frame_by_strategy(const DepthOptions& strategy, const Camera& camera, Sink& sink);
  std::unique_ptr<State> state_;
};

extern template class Tessellator<float>;
extern template class Tessellator<double>;

}  // namespace limitcheck::fast
