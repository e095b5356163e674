// SPDX-License-Identifier: MIT
#include "verify/cli/audit_depths.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "data/error.h"
#include "verify/subject/face_domain.h"

namespace limitcheck::cli {
namespace {

// Measured with bumpy:4000 at depth 5: 358 to 579 bytes a point.
constexpr double kBytesPerPoint = 350;

}  // namespace

void refuse_too_many_points(const verify::AuditMesh& mesh) {
  std::vector<std::int32_t> depths = mesh.face_depth;
  if (depths.empty()) depths.assign(mesh.mesh.faces.size(), mesh.depth);
  if (mesh.sample) depths = mesh.sample->depths_of_part(mesh.sample->cull(std::move(depths)));
  double points = 0;
  const data::ControlMesh& judged = mesh.sample ? mesh.sample->part() : mesh.mesh;
  for (std::size_t f = 0; f < depths.size(); ++f) {
    const verify::FaceDomain domain(mesh.scheme(), static_cast<int>(judged.faces[f].size()));
    // A polygon has points inside from depth 1 on.
    if (depths[f] >= 0)
      points += static_cast<double>(domain.point_count(std::int64_t{1} << std::max(depths[f], 1)));
  }
  const double needed = points * kBytesPerPoint;
  const double there =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  if (needed > there)
    throw data::ArgumentError(
        fmt::format("{}: the audit of {:.3g} points needs some {:.0f} GB, and this machine has {:.0f}: take "
                    "a smaller --depth, or look at a part with --sample FACES",
                    mesh.name, points, needed / 1e9, there / 1e9));
}

}  // namespace limitcheck::cli
