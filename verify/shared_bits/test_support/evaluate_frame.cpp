// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <vector>

#include "fast/stream/row_stream.h"
#include "verify/host/host.h"
#include "verify/shared_bits/test_support/shared_bits.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {

void add_frame(const Rewriting& mesh, std::span<const std::int32_t> depth, const std::string& options,
               int threads, SharedBits& bits) {
  std::vector<std::int32_t> face_depth;
  for (const std::int32_t f : mesh.face) face_depth.push_back(depth[f]);
  Session session(*lc_subject_row_stream(), mesh.mesh, options);
  const Tessellation t = session.tessellate(face_depth, threads);
  const auto positions = t.positions_f32(), normals = t.normals_f32();
  for (std::size_t v = 0; v < t.provenance().size(); ++v) {
    const lc_provenance& at = t.provenance()[v];
    if (!std::has_single_bit(at.denominator)) continue;  // the centre of a fan
    fast::row_stream::Vertex vertex;
    std::copy_n(positions.begin() + static_cast<std::ptrdiff_t>(3 * v), 3, &vertex.position.x);
    std::copy_n(normals.begin() + static_cast<std::ptrdiff_t>(3 * v), 3, &vertex.normal.x);
    bits.add(mesh.original(place_of(at)), &vertex.position.x);
  }
}

}  // namespace limitcheck::verify
