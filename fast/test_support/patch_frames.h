// SPDX-License-Identifier: MIT
// For the tests of patches: frames as sets of triangles to the bit, meshes of both schemes, and walks through
// depths.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "data/generators/named_mesh.h"
#include "data/scheme.h"
#include "fast/frame/engine.h"
#include "fast/frame/patch_mesh.h"
#include "fast/test_support/shared_points.h"
#include "fast/test_support/test_meshes.h"

namespace limitcheck::fast::row_stream {

using PointBits = std::array<std::uint32_t, 6>;  // bits
using Soup = std::vector<std::tuple<std::int32_t, int, std::array<PointBits, 3>>>;

/// Face, kind and the bits of the corners of every triangle, in an order of their own.
inline void add(Soup& soup, std::int32_t face, Kind kind, const SurfaceVertex<float>& a,
                const SurfaceVertex<float>& b, const SurfaceVertex<float>& c) {
  std::array<PointBits, 3> corners;
  const SurfaceVertex<float>* from[3] = {&a, &b, &c};
  for (std::size_t k = 0; k < 3; ++k) std::memcpy(corners[k].data(), from[k], sizeof(PointBits));
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  soup.emplace_back(face, static_cast<int>(kind), corners);
}

inline Soup soup_of(const DrawList<float>& list) {
  Soup soup;
  for (const Draw& draw : list.draws) {
    for (std::int32_t t = 0; t < draw.triangle_count(); ++t) {
      const auto v = draw.triangle(t);
      const auto* at = list.vertices.data() + draw.first;
      add(soup, draw.face_of(t), draw.kind, at[v[0]], at[v[1]], at[v[2]]);
    }
  }
  std::sort(soup.begin(), soup.end());
  return soup;
}

/// As a graphics library sees it, with the vertices in a buffer of its own.
inline Soup soup_of(const PatchMesh<float>& mesh, std::span<const SurfaceVertex<float>> vertices) {
  Soup soup;
  const bool narrow = mesh.options().narrow;
  const auto index = [&](std::uint32_t i) {
    if (!narrow) return mesh.indices()[i];  // else what a graphics library is given
    return mesh.indices16()[i] == kRestartIndex16 ? kRestartIndex : mesh.indices16()[i];
  };
  for (const PatchDraw& draw : mesh.draws()) {
    std::int32_t done = 0;
    const auto triangle = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      const auto at = [&](std::uint32_t i) {
        EXPECT_LT(i, static_cast<std::uint32_t>(draw.vertex_count));
        return vertices[static_cast<std::size_t>(draw.base_vertex) + i];
      };
      add(soup, done++ < draw.split ? draw.face : draw.face_after, draw.kind, at(a), at(b), at(c));
    };
    const std::uint32_t end = draw.first_index + draw.index_count;
    if (draw.form == IndexForm::kTriangles) {
      for (std::uint32_t i = draw.first_index; i < end; i += 3)
        triangle(index(i), index(i + 1), index(i + 2));
    } else {
      std::uint32_t strip = draw.first_index;
      for (std::uint32_t i = draw.first_index; i < end; ++i) {
        if (index(i) == kRestartIndex) {
          strip = i + 1;
        } else if (i >= strip + 2) {
          (i - strip) % 2 == 0 ? triangle(index(i - 2), index(i - 1), index(i))
                               : triangle(index(i - 1), index(i - 2), index(i));
        }
      }
    }
    EXPECT_EQ(done, draw.triangles);
  }
  std::sort(soup.begin(), soup.end());
  return soup;
}
inline Soup soup_of(const PatchMesh<float>& mesh) {
  return soup_of(mesh, mesh.vertices());
}

struct Model {
  std::string name;
  data::ControlMesh mesh;
  data::Scheme scheme;
};

inline std::vector<Model> models() {
  const auto loop = data::Scheme::kLoop, quads = data::Scheme::kCatmullClark;
  return {{"torus", shaken(grid_torus(4, 5), .2, 2), loop},
          {"sheet", shaken(grid_sheet(3, 4), .1, 4), loop},
          {"fan", shaken(fan(5), .05, 5), loop},
          {"triangle", single_triangle(), loop},
          {"cube", data::named_mesh("cube-quads"), quads},
          {"polygons", data::named_mesh("mixed:1"), quads},
          {"creases", data::named_mesh("creased-cube"), quads},
          {"cut triangles", data::named_mesh("creased:3:40"), loop},
          {"semi-sharp", data::named_mesh("mixed-sharp:3:30"), quads}};
}

/// The next frame of a walk: mostly small changes; sometimes faces appear or go, or everything does.
inline void step(std::vector<std::int32_t>& depth, data::SplitMix64& random) {
  const std::size_t what = below(random, 8);
  if (what == 0) depth = random_depths(depth.size(), -1, 4, random);
  if (what == 1) depth.assign(depth.size(), -1);
  if (what > 2)
    for (int i = 0; i < 2; ++i)
      depth[below(random, depth.size())] = static_cast<std::int32_t>(below(random, 6)) - 1;
}

inline TessellatorOptions options_of(const Model& model, Repair repair) {
  TessellatorOptions options{.scheme = model.scheme};
  options.cracks.repair = repair;
  return options;
}

}  // namespace limitcheck::fast::row_stream
