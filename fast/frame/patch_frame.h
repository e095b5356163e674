// SPDX-License-Identifier: MIT
// Brings a PatchMesh from one frame of an engine to the next.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "fast/frame/frame_engine.h"
#include "fast/frame/patch_mesh.h"
#include "fast/frame/patch_store.h"

namespace limitcheck::fast {

template <class Real>
class PatchFrame {
 public:
  PatchFrame(FrameEngine<Real>& engine, PatchMesh<Real>& out) : engine_(engine), out_(out) {}

  /// The pairs of the last frame that stay: those of faces that want the same depth again.
  std::vector<Grid> pairs_to_keep(std::span<const std::int32_t> depth) const;

  /// When the engine has planned its frame at these depths. Returns the number of vertices of the patches.
  ///   throws   data::ArgumentError: a patch of more vertices than narrow indices reach; what memory throws
  std::int64_t write(std::span<const std::int32_t> depth);

 private:
  bool continues() const;
  void make_room(std::size_t keep);
  void add_draws();
  void list_changes();

  FrameEngine<Real>& engine_;
  PatchMesh<Real>& out_;
};

extern template class PatchFrame<float>;
extern template class PatchFrame<double>;

}  // namespace limitcheck::fast
