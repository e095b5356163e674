// SPDX-License-Identifier: MIT
// Shared by the two subjects that evaluate OpenSubdiv's surface face by face.
#pragma once

#include <opensubdiv/bfr/tessellation.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "verify/peers/evaluated_faces.h"
#include "verify/peers/opensubdiv_mesh.h"

namespace limitcheck::verify {

/// The library's own tessellation of a triangle at one depth: (u, v) is (l1, l2), the corners of the face are
/// (0, 0), (1, 0), (0, 1).
inline FacePattern opensubdiv_triangle(int depth) {
  using namespace OpenSubdiv;
  const Bfr::Parameterization triangle(Sdc::SCHEME_LOOP, 3);
  const Bfr::Tessellation tessellation(triangle, 1 << depth);
  std::vector<double> coords(2 * static_cast<std::size_t>(tessellation.GetNumCoords()));
  std::vector<int> facets(3 * static_cast<std::size_t>(tessellation.GetNumFacets()));
  tessellation.GetCoords(coords.data());
  tessellation.GetFacets(facets.data());
  FacePattern pattern;
  pattern.denominator = std::uint32_t{1} << depth;
  const auto on_lattice = [&](double coordinate) {
    const double scaled = coordinate * pattern.denominator;
    if (std::round(scaled) != scaled) throw SubjectError(LC_FAILED, "Bfr leaves the dyadic lattice");
    return static_cast<std::int64_t>(scaled);
  };
  for (std::size_t k = 0; k < coords.size(); k += 2)
    pattern.points.push_back({on_lattice(coords[k]), on_lattice(coords[k + 1])});
  for (std::size_t t = 0; t < facets.size(); t += 3)
    pattern.triangles.push_back({static_cast<std::uint32_t>(facets[t]),
                                 static_cast<std::uint32_t>(facets[t + 1]),
                                 static_cast<std::uint32_t>(facets[t + 2])});
  return pattern;
}

/// The option boundary=edge|none: the interpolation rule of boundary vertices. By the library's own
/// default, none, the faces that touch a boundary have no limit surface.
inline bool without_boundary(Options& options) {
  return options.choice("boundary", {"edge", "none"}) == 1;
}
inline OpenSubdiv::Sdc::Options::VtxBoundaryInterpolation boundary_rule(const lc_mesh& mesh,
                                                                        Options& options) {
  return without_boundary(options) ? OpenSubdiv::Sdc::Options::VTX_BOUNDARY_NONE : boundary_rule(mesh);
}
inline lc_boundary boundary_of(Options& options) {
  return without_boundary(options) ? LC_BOUNDARY_NONE : LC_BOUNDARY_SPLINE;
}

}  // namespace limitcheck::verify
