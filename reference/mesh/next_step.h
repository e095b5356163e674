// SPDX-License-Identifier: MIT
// The step after an evaluator's mesh, of the faces alone whose surface it cannot say yet.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "reference/mesh/sharpness.h"

namespace limitcheck::reference {

/// Near semi-sharp tags a face has no evaluator before so many steps. Faces that need one are refined
/// together, and what is settled then has an evaluator of its own: the levels of a mesh with a crease of
/// sharpness s grow twofold from step to step, s times. Made when a point there is first asked for.
///   Data   the evaluator of a mesh: Data(TaggedMesh<N>, wanted faces)
template <class N, class Data>
class NextStep {
 public:
  /// `needs_a_step` of the faces; `wanted` are those of which anybody will ask, all if it is empty.
  NextStep(const std::vector<bool>& needs_a_step, const std::vector<bool>& wanted)
      : part_of_(needs_a_step.size(), -1) {
    for (std::size_t f = 0; f < needs_a_step.size(); ++f) {
      if (!needs_a_step[f] || (!wanted.empty() && !wanted[f])) continue;
      part_of_[f] = static_cast<std::int32_t>(faces_.size());
      faces_.push_back(static_cast<std::int32_t>(f));
    }
  }

  /// Child k of a face that needs the step, as face of data().
  std::size_t child(std::size_t face, int k) const {
    return 4 * static_cast<std::size_t>(part_of_[face]) + static_cast<std::size_t>(k);
  }
  /// Any number of threads may ask.
  ///   refine   of a TaggedMesh<N>, one step
  template <class Refine, class... More>
  const Data& data(const TaggedMesh<N>& mesh, Refine refine, const More&... more) const {
    std::call_once(once_, [&] {
      std::vector<bool> wanted(4 * faces_.size(), true);
      TaggedMesh<N> finer = refine(mesh.around(faces_));
      wanted.resize(finer.topology.faces().size(), false);
      data_ = std::make_unique<const Data>(std::move(finer), std::move(wanted), more...);
    });
    return *data_;
  }

 private:
  std::vector<std::int32_t> faces_, part_of_;
  mutable std::once_flag once_;
  mutable std::unique_ptr<const Data> data_;
};

}  // namespace limitcheck::reference
