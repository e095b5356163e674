// SPDX-License-Identifier: MIT
#include "verify/recognise/wrong_faces.h"

#include <algorithm>
#include <utility>

#include "data/cut_out.h"
#include "reference/mesh/support.h"
#include "verify/evidence/faces_around.h"

namespace limitcheck::verify {

WrongFaces::WrongFaces(const Evidence& e, double tolerance, std::size_t most) : whole_(e.mesh) {
  std::vector<double> error(whole_.faces.size());
  for (std::int64_t v = 0; v < e.tessellation.vertex_count(); ++v) {
    const Lattice::Id id = e.point[v];
    const Vector got = e.tessellation.position(v);
    if (id == Lattice::kNone || !is_finite(got)) continue;
    double& worst = error[e.tessellation.provenance()[v].face];
    worst = std::max(worst, norm(got - e.reference.position(id)));
  }
  std::vector<std::int32_t> ranked;
  for (std::size_t f = 0; f < error.size(); ++f)
    if (error[f] > tolerance) ranked.push_back(static_cast<std::int32_t>(f));
  std::stable_sort(ranked.begin(), ranked.end(),
                   [&](std::int32_t f, std::int32_t g) { return error[f] > error[g]; });
  // The middle ones of as many parts, since the very worst may be wrong for another reason.
  std::vector<std::int32_t> wrong;
  const std::size_t count = std::min(most, ranked.size());
  for (std::size_t k = 0; k < count; ++k) wrong.push_back(ranked[(2 * k + 1) * ranked.size() / (2 * count)]);

  wrong_ = wrong.size();
  const FacesAround around(whole_.faces, whole_.positions.size());
  faces_ = reference::support_of(
      std::move(wrong), whole_.faces, [&](std::int32_t v) { return around.of(v); },
      whole_.sharpness.creasing);
  data::CutOut cut = data::cut_out(whole_.faces, faces_);
  part_ = {cut.of(whole_.positions), {}, cut.of(whole_.sharpness)};
  part_.faces = std::move(cut.faces);
}

bool WrongFaces::worthwhile() const {
  return wrong_ > 0 && 2 * faces_.size() < whole_.faces.size();
}

SchemePoints WrongFaces::points(bool tags, Scheme scheme, int steps, bool limit, data::Scheme lattice) const {
  SchemePoints points =
      placed_scheme_points(tags ? part_ : without_tags(part_), scheme, steps, limit, lattice);
  for (Place& p : points.place) {
    if (p.denominator == 0) continue;
    const auto face = static_cast<std::size_t>(p.face);
    if (face < wrong_)
      p.face = faces_[face];
    else
      p.denominator = 0;
  }
  return points;
}

}  // namespace limitcheck::verify
