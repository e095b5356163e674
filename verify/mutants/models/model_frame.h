// SPDX-License-Identifier: MIT
// One frame of the model: faces in, vertices and triangles out. Private to it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "reference/loop/stam.h"
#include "verify/mutants/models/model_rules.h"
#include "verify/mutants/models/model_surface.h"
#include "verify/mutants/models/model_tiling.h"
#include "verify/subject/subject.h"

namespace limitcheck::verify {

class ModelFrame {
 public:
  struct Vertex {
    ModelRules::V position, normal;
    lc_provenance place;
  };

  /// One depth for each face, -1 for culled ones, and one of them at least is not.
  ModelFrame(const ModelMesh& mesh, const ModelRules& rules, std::span<const std::int32_t> depth);

  std::vector<Vertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::int32_t> faces;  // of each triangle

 private:
  void display(std::size_t f);
  // The limit point as it is at l1 = i / 2^d, l2 = j / 2^d, and what a mutant makes of it.
  std::uint32_t put(std::size_t f, int i, int j, int d);
  void triangle(std::size_t f, std::uint32_t a, std::uint32_t b, std::uint32_t c);
  void repeat_tile_of(std::size_t t);
  void tiles(std::size_t f, const std::vector<Tile>& list);
  void fan(std::size_t f, const std::array<int, 3>& edge);
  // The limit point at step s of 2^d from corner k to the next.
  ModelRules::V border_point(std::size_t f, int k, int s, int d) const;
  // Where a face meets a shallower one, its border points on that side.
  void at_depth_steps();

  const ModelMesh& mesh_;
  const ModelRules& rules_;
  std::span<const std::int32_t> depth_;
  ModelLevel level_;
  std::unique_ptr<reference::StamEvaluator<double>> surface_;
};

}  // namespace limitcheck::verify
