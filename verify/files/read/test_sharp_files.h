// SPDX-License-Identifier: MIT
// Files of surfaces with sharp edges, with a normal for each corner of a triangle. For tests of this folder.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "reference/catmull_clark/refined_mesh.h"
#include "reference/loop/refine.h"
#include "reference/surface/surface.h"
#include "verify/files/read/tessellation_file.h"

namespace limitcheck::verify::test {

/// A file that is made triangle by triangle.
struct SharpFile {
  FileTessellation t;

  /// The corners' vertices, and their normals on the side of this triangle.
  void add(const std::array<std::int32_t, 3>& corners, const std::array<Vector, 3>& normals) {
    auto& which = t.corner_normals.emplace_back();
    for (std::size_t c = 0; c < 3; ++c) {
      which[c] = static_cast<std::int32_t>(t.normals.size());
      t.normals.push_back({corners[c], normals[c]});
      t.used[corners[c]] = true;
    }
    t.triangles.push_back(corners);
    t.polygon.push_back(t.polygons++);
  }
};

inline SharpFile begin_file(const std::vector<reference::Vec3<double>>& positions) {
  SharpFile file;
  file.t.name = "sharp.obj";
  for (const auto& p : positions) file.t.positions.push_back(vector_of(p));
  file.t.used.assign(positions.size(), false);
  return file;
}

/// The limit surface at a depth >= 1, holes left out, exact but for rounding.
inline FileTessellation sharp_file(const data::ControlMesh& mesh, data::Scheme scheme, int depth) {
  const reference::Surface surface(mesh, scheme);
  std::vector<bool> hole(mesh.faces.size(), false);
  for (const std::int32_t f : mesh.holes) hole[f] = true;
  const auto normal = [&](std::size_t f, std::size_t corner, double u, double v) {
    return vector_of(
        surface.evaluate(static_cast<int>(f), static_cast<int>(corner), u, v, reference::Order::kFirst)
            .normal);
  };
  // A triangle of the lattice at a corner of a face, which has so many steps along a side.
  const auto put = [&](SharpFile& file, const auto& vertex, std::size_t f, std::size_t corner, int steps,
                       std::array<std::array<int, 2>, 3> at) {
    std::array<std::int32_t, 3> corners{};
    std::array<Vector, 3> normals{};
    for (std::size_t c = 0; c < 3; ++c) {
      corners[c] = vertex(at[c][0], at[c][1]);
      normals[c] =
          normal(f, corner, at[c][0] / static_cast<double>(steps), at[c][1] / static_cast<double>(steps));
    }
    file.add(corners, normals);
  };
  const int n = 1 << depth;
  if (scheme == data::Scheme::kLoop) {
    reference::RefinedMesh<double> refined(mesh);
    for (int step = 0; step < depth; ++step) refined.refine();
    SharpFile file = begin_file(refined.limits().positions);
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      const auto vertex = [&](int i, int j) { return refined.vertex(f, i, j); };
      for (int j = 0; j < n && !hole[f]; ++j)
        for (int i = 0; i + j < n; ++i) {
          put(file, vertex, f, 0, n, {{{i, j}, {i + 1, j}, {i, j + 1}}});
          if (i + j + 1 < n) put(file, vertex, f, 0, n, {{{i + 1, j}, {i + 1, j + 1}, {i, j + 1}}});
        }
    }
    return file.t;
  }
  reference::catmull_clark::RefinedMesh<double> refined(mesh.faces, reference::positions_of<double>(mesh),
                                                        mesh.sharpness);
  for (int step = 0; step < depth; ++step) refined.refine();
  SharpFile file = begin_file(refined.limits().positions);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const bool quad = mesh.faces[f].size() == 4;
    const int steps = quad ? n : n / 2;
    for (std::size_t k = 0; k < (quad ? 1 : mesh.faces[f].size()) && !hole[f]; ++k) {
      const auto vertex = [&](int i, int j) { return refined.vertex(f, k, i, j); };
      for (int j = 0; j < steps; ++j)
        for (int i = 0; i < steps; ++i) {
          put(file, vertex, f, k, steps, {{{i, j}, {i + 1, j}, {i + 1, j + 1}}});
          put(file, vertex, f, k, steps, {{{i, j}, {i + 1, j + 1}, {i, j + 1}}});
        }
    }
  }
  return file.t;
}

/// With one normal for each vertex, that of the first triangle that has it.
inline FileTessellation with_one_normal_each(FileTessellation t) {
  std::vector<FileTessellation::NormalAt> one(t.positions.size(), {-1, {}});
  for (const auto& n : t.normals)
    if (one[n.vertex].vertex < 0) one[n.vertex] = n;
  for (std::size_t v = 0; v < one.size(); ++v)
    if (one[v].vertex < 0) one[v] = {static_cast<std::int32_t>(v), {0, 0, 1}};
  t.normals = one;
  t.corner_normals.clear();
  return t;
}

}  // namespace limitcheck::verify::test
