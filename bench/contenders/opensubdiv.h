// SPDX-License-Identifier: MIT
// What the OpenSubdiv contenders share. Private to them.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "bench/contenders/contender.h"
#include "data/scheme.h"
#include "verify/peers/opensubdiv_mesh.h"

namespace limitcheck::bench {

/// The control mesh as OpenSubdiv takes it.
class OpenSubdivMesh {
 public:
  explicit OpenSubdivMesh(const data::ControlMesh& mesh) {
    for (const auto& p : mesh.positions)
      for (const double x : p) control_.push_back(static_cast<float>(x));
    const verify::LentMesh lent(mesh, data::natural_scheme(mesh));
    refiner_ = verify::make_refiner(lent.view());
  }
  OpenSubdiv::Far::TopologyRefiner& refiner() const { return *refiner_; }
  /// Corners of every face.
  int corners() const { return refiner_->GetLevel(0).GetFaceVertices(0).size(); }
  std::size_t faces() const { return static_cast<std::size_t>(refiner_->GetLevel(0).GetNumFaces()); }
  const float* control() const { return control_.data(); }
  std::size_t vertices() const { return control_.size() / 3; }

 private:
  std::vector<float> control_;  // x y z of each vertex
  std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> refiner_;
};

}  // namespace limitcheck::bench
