// SPDX-License-Identifier: MIT
#include "fast/gpu/shaders.h"

namespace limitcheck::fast::gpu {

// The .glsl files beside this one.
namespace text {
extern const char kCommon[], kTriangleRules[], kTriangleGrids[], kTriangleEdges[], kQuadRules[], kQuads[],
    kQuadSides[], kQuadPatches[], kCopies[];
}

BatchUniforms BatchUniforms::of(int depth, const Placement<float>& placement, int lanes) {
  BatchUniforms all;
  all.centre = {placement.centre[0], placement.centre[1], placement.centre[2], 0};
  all.control_unit = placement.unit;
  all.limit_unit = row_stream::limit_unit(placement.unit, depth);
  all.given_stride = lanes;
  all.depth = depth;
  return all;
}

BatchUniforms BatchUniforms::of(const row_stream::QuadBatch<float>& batch, const Placement<float>& placement,
                                int lanes, int sides) {
  BatchUniforms all = of(batch.depth, placement, lanes);
  all.centre[3] = row_stream::quad_unit(placement.unit, 0);
  all.limit_unit = row_stream::quad_unit(placement.unit, batch.depth);
  all.sides = sides;
  all.period = batch.period;
  all.open = batch.open, all.darts = batch.darts, all.sharp = batch.sharp;
  all.some_polynomial = batch.some_polynomial;
  return all;
}

std::vector<EdgeEnds> edges_of_grids(int depth, int lanes) {
  using row_stream::kAB, row_stream::kBC, row_stream::kCD, row_stream::kDA, row_stream::kAC;
  std::vector<EdgeEnds> all;
  const int block = row_stream::corner_block_size(depth) * lanes, parts = row_stream::parts_offset(depth);
  for (int grid = 0; grid < lanes; ++grid)
    for (const row_stream::Part edge : {kDA, kBC, kAC, kCD, kAB}) {
      const row_stream::EdgeEnds& e = row_stream::kEdgeEnds[edge];
      all.push_back(
          {e.p * block + grid, e.p_first, e.q * block + grid, e.q_first, (parts + edge) * lanes + grid});
    }
  return all;
}

std::vector<EdgeEnds> edges_by_themselves(int depth, int lanes) {
  std::vector<EdgeEnds> all;
  for (int e = 0; e < lanes; ++e)
    all.push_back({e, 0, row_stream::edge_block_size(depth) * lanes + e, 0,
                   row_stream::edge_part_offset(depth) * lanes + e});
  return all;
}

std::string source(Shader shader, int most, bool local, Output output) {
  const SharedMemory memory = SharedMemory::of(shader, most);
  std::string code = "#version 430\n";
  const auto define = [&](const char* name, int value) {
    code += std::string("#define ") + name + ' ' + std::to_string(value) + '\n';
  };
  define("LANES", kLanes);
  define("LOCAL", local ? 1 : 0);
  define("PLACED", output != Output::kInOrder ? 1 : 0);
  define("COMPACT", output == Output::kPlacedCompact ? 1 : 0);
  define("BORDERS", memory.borders);
  define("STAGED", memory.staged);
  define("MEMORY", memory.size);
  const auto with = [&](const char* rules, const char* shader_text) {
    return code + text::kCommon + rules + shader_text;
  };
  switch (shader) {
    case Shader::kTriangleGrids:
      return with(text::kTriangleRules, text::kTriangleGrids);
    case Shader::kTriangleEdges:
      return with(text::kTriangleRules, text::kTriangleEdges);
    case Shader::kQuads:
      return with(text::kQuadRules, text::kQuads);
    case Shader::kQuadSides:
      return with(text::kQuadRules, text::kQuadSides);
    case Shader::kQuadPatches:
      return with(text::kQuadRules, text::kQuadPatches);
    case Shader::kCopies:
      return with("", text::kCopies);
  }
  return code;
}

}  // namespace limitcheck::fast::gpu
