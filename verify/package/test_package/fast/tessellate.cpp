// SPDX-License-Identifier: MIT
// Tessellates a cage with a depth of its own for every face, and says what came out.
//   tessellate [cage.obj [largest depth]]
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <vector>

#include <limitcheck/data/io/read.h>
#include <limitcheck/data/shapes.h>
#include <limitcheck/fast/stream/stream_tessellator.h>

int main(int argc, char** argv) try {
  namespace data = limitcheck::data;
  namespace fast = limitcheck::fast;
  const data::ControlMesh cage =
      argc > 1 ? data::read_mesh(argv[1], {.scheme = data::Scheme::kLoop}) : data::octahedron();
  const int depth = argc > 2 ? std::atoi(argv[2]) : 3;

  // Prepared once per cage; then one frame after the other.
  fast::TessellatorOptions options;
  options.provenance = true;
  fast::row_stream::StreamTessellator tessellator(cage, options);
  fast::IndexedMesh<float> mesh;
  std::vector<std::int32_t> depths(cage.faces.size(), depth);
  const auto report = [&](const char* what, const fast::FrameStats& frame) {
    std::printf("%s: %lld faces, %lld triangles, %lld vertices, %lld fans\n", what,
                static_cast<long long>(frame.faces), static_cast<long long>(frame.triangles),
                static_cast<long long>(frame.vertices), static_cast<long long>(frame.fans));
  };
  report("uniform", tessellator.frame(depths, mesh));

  // The limit point of the first face's first corner: lattice point (0, 0).
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const fast::LatticePoint& at = mesh.provenance[v];
    if (at.face != 0 || at.i != 0 || at.j != 0) continue;
    const auto& p = mesh.vertices[v].position;
    std::printf("corner: %.9g %.9g %.9g\n", p.x, p.y, p.z);
  }

  // One face deeper than the others: its neighbours become fans, and no crack opens.
  if (!depths.empty() && depth < fast::kDeepest) depths.front() = depth + 1;
  report("one deeper", tessellator.frame(depths, mesh));
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "tessellate: %s\n", error.what());
  return 2;
}
