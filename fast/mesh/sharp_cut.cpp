// SPDX-License-Identifier: MIT
#include "fast/mesh/sharp_cut.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace limitcheck::fast {

template <int K>
SharpCut cut_sharp(BasicAdjacency<K>& adjacency, const SharpPolygons& sharp) {
  SharpCut out;
  // How many infinitely sharp edges end at each vertex, and which of them have two faces.
  std::vector<std::int32_t> sharp_edges(sharp.vertex.size());
  std::vector<std::uint8_t> cuts(sharp.side.size());
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    const auto h = static_cast<std::int32_t>(i);
    if (sharp.side[i] != kAlwaysSharp) continue;
    ++sharp_edges[adjacency.origin(h)];
    if (adjacency.twin(h) < 0) ++sharp_edges[adjacency.target(h)];
    cuts[i] = adjacency.twin(h) >= 0 ? 1 : 0;
  }
  out.uncut.resize(sharp.vertex.size());
  std::iota(out.uncut.begin(), out.uncut.end(), 0);
  if (std::find(cuts.begin(), cuts.end(), 1) != cuts.end()) {
    out.twin.assign(cuts.size(), -1);
    for (std::size_t h = 0; h < cuts.size(); ++h)
      if (cuts[h] != 0) out.twin[h] = adjacency.twin(static_cast<std::int32_t>(h));
    out.uncut = adjacency.cut(cuts);
  }
  out.kinds.resize(out.uncut.size());
  for (std::size_t v = 0; v < out.kinds.size(); ++v) {
    const std::int32_t b = out.uncut[v];
    if (sharp.vertex[b] == kAlwaysSharp || sharp_edges[b] > 2)
      out.kinds[v] = VertexKind::kHeld;
    else if (sharp_edges[b] == 1)
      out.kinds[v] = VertexKind::kDart;
  }
  return out;
}

template SharpCut cut_sharp(BasicAdjacency<3>&, const SharpPolygons&);
template SharpCut cut_sharp(BasicAdjacency<4>&, const SharpPolygons&);

}  // namespace limitcheck::fast
