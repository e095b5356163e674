// SPDX-License-Identifier: MIT
#include "verify/mesh_output/mesh_output.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>

#include "data/error.h"
#include "fast/plan/depth.h"
#include "verify/mesh_output/formats.h"

namespace limitcheck::verify {

namespace {

// Viridis at equal steps, depths 0 .. kDeepest.
constexpr std::array<std::array<std::uint8_t, 3>, 11> kDepthColours{{{68, 1, 84},
                                                                     {72, 36, 117},
                                                                     {65, 68, 135},
                                                                     {53, 95, 141},
                                                                     {42, 120, 142},
                                                                     {33, 145, 140},
                                                                     {34, 168, 132},
                                                                     {68, 191, 112},
                                                                     {122, 209, 81},
                                                                     {189, 223, 38},
                                                                     {253, 231, 37}}};
static_assert(kDepthColours.size() == fast::kDeepest + 1);

}  // namespace

Colouring colour_by_depth(const fast::IndexedMesh<float>& mesh, std::span<const std::int32_t> depth) {
  Colouring colouring;
  for (std::size_t d = 0; d < kDepthColours.size(); ++d) {
    colouring.classes.push_back({fmt::format("depth_{}", d), kDepthColours[d]});
  }
  colouring.of_triangle.reserve(mesh.triangles.size());
  for (const std::int32_t face : mesh.triangle_face) {
    colouring.of_triangle.push_back(static_cast<std::uint8_t>(depth[face]));
  }
  return colouring;
}

Colouring colour_by_kind(const fast::IndexedMesh<float>& mesh) {
  Colouring colouring;
  colouring.classes = {{"pair", {176, 190, 197}},
                       {"singleton", {255, 160, 0}},
                       {"fan", {198, 40, 40}},
                       {"stitched", {46, 125, 50}}};
  colouring.of_triangle.reserve(mesh.triangles.size());
  for (const fast::Kind kind : mesh.triangle_kind)
    colouring.of_triangle.push_back(static_cast<std::uint8_t>(kind));
  return colouring;
}

OutputFormat output_format(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".ply") return OutputFormat::kPly;
  if (extension == ".obj") return OutputFormat::kObj;
  if (extension == ".glb") return OutputFormat::kGlb;
  throw data::InputError("FILE_UNKNOWN_FORMAT", file.string(), 0,
                         "a tessellation is written as .ply, .obj or .glb");
}

void write_tessellation(const std::filesystem::path& file, const fast::IndexedMesh<float>& mesh,
                        const Colouring& colouring) {
  switch (output_format(file)) {
    case OutputFormat::kPly:
      return write_ply(file, mesh, colouring);
    case OutputFormat::kObj:
      return write_obj(file, mesh, colouring);
    case OutputFormat::kGlb:
      return write_glb(file, mesh, colouring);
  }
}

std::vector<std::vector<std::uint32_t>> triangles_by_class(const fast::IndexedMesh<float>& mesh,
                                                           const Colouring& colouring) {
  std::vector<std::vector<std::uint32_t>> lists(std::max<std::size_t>(1, colouring.classes.size()));
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    lists[colouring.classes.empty() ? 0 : colouring.of_triangle[t]].push_back(t);
  }
  return lists;
}

}  // namespace limitcheck::verify
