// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>

#include "verify/files/checks/hausdorff.h"

namespace limitcheck::verify {

std::vector<Result> check_file_hausdorff(const FileEvidence& e, double bound,
                                         const std::function<void()>& tick) {
  Result r = e.result("file-hausdorff");
  r.unit = "diagonal";
  if (e.tessellation.triangles.empty()) {
    r.status = Status::kNotSupported;
    r.message = "the file has no faces";
    return {r};
  }
  const Hausdorff h = hausdorff(e, tick);
  const double size = e.surface.diagonal();
  const bool forwards = h.from_triangles.at_least >= h.from_surface.at_least;
  const Bracket& larger = forwards ? h.from_triangles : h.from_surface;
  r.of = 1;
  r.worst = r.rms = larger.at_least / size;
  r.worst_absolute = larger.at_least;
  r.bound = bound >= 0 ? bound : h.one_polygon_each / size + e.tolerance;
  const double most = std::max(h.from_triangles.at_most, h.from_surface.at_most) / size;
  r.message = fmt::format(
      "Hausdorff distance between {:.3e} and {:.3e} diagonals (triangles to surface {:.3e} to {:.3e}, "
      "surface to triangles {:.3e} to {:.3e})",
      *r.worst, most, h.from_triangles.at_least / size, h.from_triangles.at_most / size,
      h.from_surface.at_least / size, h.from_surface.at_most / size);
  const bool loop = e.scheme() == data::Scheme::kLoop;
  if (bound < 0)
    r.message += fmt::format("; the bound is that of one {} per control face", loop ? "triangle" : "polygon");
  const std::size_t triangles_each = e.control.faces.corners().size() - 2 * e.control.faces.size();
  if (bound < 0 && e.tessellation.triangles.size() <= triangles_each)
    r.message += ", which this file is: only --max-deviation can judge it";
  if (h.loose > 0)
    r.message += fmt::format(
        "; {} triangles reach over several control faces or cover none, which makes the upper ends large",
        h.loose);
  if (*r.worst > *r.bound) {
    r.status = Status::kFinding;
    r.bad = 1;
  } else if (most > *r.bound) {
    r.message += "; the bound lies in between: not decided, taken as held";
  }
  r.witness = e.at_point(larger.where);
  return {r};
}

}  // namespace limitcheck::verify
