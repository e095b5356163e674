// SPDX-License-Identifier: MIT
// Shared by the two subjects that evaluate OpenSubdiv's surface face by face. Faces share no vertices. The
// normal is d/du x d/dv as evaluated, NaN where the library's derivatives are parallel or zero.
#pragma once

#include <opensubdiv/bfr/tessellation.h>

#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

#include "verify/subject/faces_in_parallel.h"
#include "verify/subject/opensubdiv_mesh.h"

namespace limitcheck::verify {

/// The library's tessellation of a triangle at one depth.
template <class Real>
struct Pattern {
  explicit Pattern(int depth) : denominator(std::uint32_t{1} << depth) {
    using namespace OpenSubdiv;
    const Bfr::Parameterization triangle(Sdc::SCHEME_LOOP, 3);
    const Bfr::Tessellation tessellation(triangle, 1 << depth);
    coords.resize(2 * static_cast<std::size_t>(tessellation.GetNumCoords()));
    facets.resize(3 * static_cast<std::size_t>(tessellation.GetNumFacets()));
    tessellation.GetCoords(coords.data());
    tessellation.GetFacets(facets.data());
    // (u, v) is (l1, l2): the corners of the face are (0, 0), (1, 0), (0, 1).
    for (const Real coordinate : coords) {
      const Real scaled = coordinate * static_cast<Real>(denominator);
      lattice.push_back(static_cast<std::uint32_t>(std::lround(scaled)));
      if (static_cast<Real>(lattice.back()) != scaled)
        throw SubjectError(LC_FAILED, "Bfr leaves the dyadic lattice");
    }
  }
  std::uint32_t denominator;
  std::vector<Real> coords;            // u, v
  std::vector<std::uint32_t> lattice;  // i, j
  std::vector<int> facets;
};

/// Tessellates each face at its depth. `surface()` makes, once for each range of faces, what has
///   void begin(std::int32_t face)
///   void evaluate(const Real uv[2], Real position[3], Real du[3], Real dv[3])
template <class Real, class Make>
void tessellate_faces(const lc_mesh& mesh, const lc_request& request, lc_tessellation& out, Make&& surface) {
  const auto faces = mesh.triangle_count;
  std::map<int, Pattern<Real>> patterns;
  std::vector<std::int64_t> first_vertex(static_cast<std::size_t>(faces) + 1);
  std::vector<std::int64_t> first_triangle(static_cast<std::size_t>(faces) + 1);
  for (std::int64_t f = 0; f < faces; ++f) {
    const int depth = request.face_depth[f];
    const auto k = static_cast<std::size_t>(f);
    first_vertex[k + 1] = first_vertex[k];
    first_triangle[k + 1] = first_triangle[k];
    if (depth < 0) continue;
    const Pattern<Real>& pattern = patterns.try_emplace(depth, depth).first->second;
    first_vertex[k + 1] += static_cast<std::int64_t>(pattern.coords.size() / 2);
    first_triangle[k + 1] += static_cast<std::int64_t>(pattern.facets.size() / 3);
  }
  const auto output = allocate_output<Real>(request, out, first_vertex.back(), first_triangle.back(), true);

  faces_in_parallel(faces, request.threads, [&](std::int64_t begin, std::int64_t end) {
    auto here = surface();
    for (std::int64_t f = begin; f < end; ++f) {
      if (request.face_depth[f] < 0) continue;
      const auto face = static_cast<std::int32_t>(f);
      here.begin(face);
      const Pattern<Real>& pattern = patterns.at(request.face_depth[f]);
      std::int64_t vertex = first_vertex[f];
      std::int64_t triangle = first_triangle[f];
      const auto first = static_cast<std::uint32_t>(vertex);
      for (std::size_t p = 0; p < pattern.coords.size(); p += 2, ++vertex) {
        Real du[3], dv[3];
        here.evaluate(&pattern.coords[p], output.positions + 3 * vertex, du, dv);
        const Real n[3] = {du[1] * dv[2] - du[2] * dv[1], du[2] * dv[0] - du[0] * dv[2],
                           du[0] * dv[1] - du[1] * dv[0]};
        const Real length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        for (int c = 0; c < 3; ++c) output.normals[3 * vertex + c] = n[c] / length;
        output.provenance[vertex] = {face, pattern.lattice[p], pattern.lattice[p + 1], pattern.denominator};
      }
      for (std::size_t t = 0; t < pattern.facets.size(); t += 3, ++triangle) {
        for (std::size_t c = 0; c < 3; ++c) {
          output.triangles[3 * triangle + static_cast<std::int64_t>(c)] =
              first + static_cast<std::uint32_t>(pattern.facets[t + c]);
        }
        output.triangle_face[triangle] = face;
      }
    }
  });
}

}  // namespace limitcheck::verify
