// SPDX-License-Identifier: MIT
#include "verify/recognise/worst_faces.h"

#include <algorithm>
#include <numeric>

#include "data/cut_out.h"
#include "reference/mesh/support.h"
#include "verify/evidence/faces_around.h"

namespace limitcheck::verify {

namespace {

constexpr double kEnough = .1;  // of all squares: a guess is right if it leaves a hundredth

}  // namespace

WorstFaces::WorstFaces(const Evidence& e, std::size_t most) : whole_(e.mesh) {
  std::vector<double> of_face(whole_.faces.size());
  for (std::int64_t v = 0; v < e.tessellation.vertex_count(); ++v) {
    const Lattice::Id id = e.point[v];
    const Vector got = e.tessellation.position(v);
    if (id == Lattice::kNone || !is_finite(got)) continue;
    const double y = norm(got - e.reference.position(id));
    of_face[e.tessellation.provenance()[v].face] += y * y;
    squares_ += y * y;
  }
  std::vector<std::int32_t> worst(whole_.faces.size());
  std::iota(worst.begin(), worst.end(), 0);
  const std::size_t count = std::min(most, worst.size());
  std::partial_sort(worst.begin(), worst.begin() + static_cast<std::ptrdiff_t>(count), worst.end(),
                    [&](std::int32_t f, std::int32_t g) { return of_face[f] > of_face[g]; });
  std::size_t enough = 0;
  for (double of_these = 0; enough < count && of_these < kEnough * squares_; ++enough)
    of_these += of_face[worst[enough]];
  worst.resize(enough);

  worst_ = worst.size();
  const FacesAround around(whole_.faces, whole_.positions.size());
  faces_ = reference::support_of(
      std::move(worst), whole_.faces, [&](std::int32_t v) { return around.of(v); },
      whole_.sharpness.creasing);
  data::CutOut cut = data::cut_out(whole_.faces, faces_);
  part_ = {cut.of(whole_.positions), {}, cut.of(whole_.sharpness)};
  part_.faces = std::move(cut.faces);
}

bool WorstFaces::worthwhile() const {
  return 2 * faces_.size() < whole_.faces.size();
}

SchemePoints WorstFaces::points(bool tags, Scheme scheme, int steps, bool limit, data::Scheme lattice) const {
  SchemePoints points =
      placed_scheme_points(tags ? part_ : without_tags(part_), scheme, steps, limit, lattice);
  for (Place& p : points.place) {
    if (p.denominator == 0) continue;
    const auto face = static_cast<std::size_t>(p.face);
    if (face < worst_)
      p.face = faces_[face];
    else
      p.denominator = 0;
  }
  return points;
}

}  // namespace limitcheck::verify
