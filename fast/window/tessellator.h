// SPDX-License-Identifier: MIT
// The paper's tessellator: a sliding window for each pair of faces. [mueller2000, sections 4 and 5]
#pragma once

#include <memory>

#include "data/control_mesh.h"
#include "fast/frame/engine.h"

namespace limitcheck::fast {

/// Tessellation on the fly by sliding windows; see Engine for what it can do and what it throws. Real is
/// float or double. Control points that are representable in Real are taken exactly. The options name the
/// scheme: Loop's for triangles without semi-sharp tags, or Catmull-Clark's for any polygons and tags.
/// A depth belongs to a control face, whatever quads that consists of. [C21]
template <class Real>
class Tessellator : public Engine<Real> {
 public:
  explicit Tessellator(const data::ControlMesh& mesh, const TessellatorOptions& options = {});
  /// For the tests of the paper's claims: by its printed rules.
  Tessellator(const data::ControlMesh& mesh, const TessellatorOptions& options, const PrintedRules& rules);

 private:
  static std::unique_ptr<FrameEngine<Real>> make_state(const data::ControlMesh& mesh,
                                                       const TessellatorOptions& options,
                                                       const PrintedRules& rules);
};

extern template class Tessellator<float>;
extern template class Tessellator<double>;

}  // namespace limitcheck::fast
