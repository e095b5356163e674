// SPDX-License-Identifier: MIT
#include "verify/files/blind_spots.h"

#include <fmt/core.h>

#include <algorithm>

#include "reference/loop/refine.h"

namespace limitcheck::verify {

std::string blind_spots(const FileEvidence& e) {
  bool beside_corners = false;
  for (const FacePoint& at : e.place) {
    if (at.face < 0) continue;
    const auto zeros = std::count(at.l.begin(), at.l.end(), 0);
    if (zeros == 0) return "";
    beside_corners = beside_corners || zeros == 1;
  }
  const auto refined = reference::refine<double>(e.control, beside_corners ? 1 : 0);
  const auto limits = refined.limits().positions;
  double farthest = 0;
  for (std::size_t v = 0; v < limits.size(); ++v) {
    const auto way = limits[v] - refined.positions()[v];
    farthest = std::max(farthest, norm(Vector{way.x, way.y, way.z}));
  }
  std::string text =
      beside_corners ? "no vertex lies inside a control face, only at its corners and on its edges: the "
                       "surface inside of faces was not looked at"
                     : "all vertices are limits of control vertices: the surface along the edges and inside "
                       "of faces was not looked at";
  if (farthest > 0)
    text +=
        fmt::format("; limit weights that are off by less than {:.1g} of themselves are within the tolerance",
                    e.tolerance * e.surface.diagonal() / farthest);
  return text;
}

}  // namespace limitcheck::verify
