// SPDX-License-Identifier: MIT
#include "verify/files/checks/blind_spots.h"

#include <fmt/core.h>

#include <algorithm>

#include "verify/recognise/schemes.h"

namespace limitcheck::verify {

std::string blind_spots(const FileEvidence& e) {
  const Chart chart = e.surface.domain().chart();
  bool beside_corners = false;
  for (const FacePoint& at : e.place) {
    if (at.face < 0) continue;
    int sides = 0;
    for (int k = 0; k < chart.corners(); ++k)
      sides += chart.height(k, at.l) == 0 && e.surface.surface().on_control_edge(at.face, k);
    if (sides == 0) return "";
    beside_corners = beside_corners || sides == 1;
  }
  const Scheme scheme = e.scheme() == data::Scheme::kLoop ? Scheme::kLoop : Scheme::kCatmullClark;
  const auto refined = scheme_points(e.control, scheme, beside_corners ? 1 : 0, false);
  const auto limits = scheme_points(e.control, scheme, beside_corners ? 1 : 0, true);
  double farthest = 0;
  for (std::size_t v = 0; v < limits.size(); ++v) farthest = std::max(farthest, norm(limits[v] - refined[v]));
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
