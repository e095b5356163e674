// SPDX-License-Identifier: MIT
#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "verify/checks/checks.h"
#include "verify/checks/confirm.h"
#include "verify/row/bounds.h"

namespace limitcheck::verify {
namespace {

enum class Verdict : std::uint8_t { kNotPlaced, kNotFinite, kGood, kClockwise, kFacesBack };

// A facet may only be judged by its points if no allowed error of them can turn it over. A triangle whose
// corners move by s changes its area vector by at most 2 s (sum of sides + s); s is `slack`, once for the
// subject and, generously, once for the reference: so no finding needs certified numbers here.
Verdict judge(const Evidence& e, std::int64_t triangle, double slack) {
  std::array<Lattice::Coordinates, 3> c;
  if (!e.place(triangle, c)) return Verdict::kNotPlaced;

  // On the lattice this is exact; where the facet is nearly degenerate in space, nothing else is judged.
  const double on_lattice =
      e.lattice.domain(e.tessellation.triangle_face()[triangle]).area(c, e.lattice.scale());
  if (on_lattice < 0) return Verdict::kClockwise;
  if (on_lattice == 0) return Verdict::kGood;  // no orientation; `watertight` counts it

  // In space the facet must face as that of the exact surface over the same three lattice points.
  const auto& v = e.tessellation.triangles()[triangle];
  std::array<Vector, 3> got, exact;
  for (int k = 0; k < 3; ++k) {
    got[k] = e.tessellation.position(v[k]);
    exact[k] = e.reference.position(e.point[v[k]]);
    if (!is_finite(got[k])) return Verdict::kNotFinite;
  }
  const Vector got_area = cross(got[1] - got[0], got[2] - got[0]);
  const Vector exact_area = cross(exact[1] - exact[0], exact[2] - exact[0]);
  const double sides = perimeter(exact[0], exact[1], exact[2]);
  if (norm(exact_area) <= 4 * slack * (sides + slack)) return Verdict::kGood;
  return dot(got_area, exact_area) < 0 ? Verdict::kFacesBack : Verdict::kGood;
}

}  // namespace

std::vector<Result> check_orientation(const Evidence& e) {
  Result r = e.result("orientation");
  r.unit = "triangles";
  r.bound = 0;
  const std::int64_t count = e.tessellation.triangle_count();
  const double slack =
      position_bound(e.capabilities.precision, e.reference.steps(), e.magnitude, e.diagonal) * e.diagonal;
  std::vector<Verdict> verdict(count);
  tbb::parallel_for(std::int64_t{0}, count, [&](std::int64_t k) { verdict[k] = judge(e, k, slack); });

  const auto number = [&](Verdict v) { return std::count(verdict.begin(), verdict.end(), v); };
  const std::int64_t clockwise = number(Verdict::kClockwise), back = number(Verdict::kFacesBack);
  const std::int64_t not_finite = number(Verdict::kNotFinite);
  r.of = count - number(Verdict::kNotPlaced) - not_finite;
  r.bad = clockwise + back;
  say_left_out(r, not_finite, "triangles with corners");
  if (r.of == 0) r.status = Status::kNotRun;
  if (r.bad == 0) return {r};

  r.status = Status::kFinding;
  say(r, fmt::format("{} triangles clockwise on their control face, {} face away from the exact facet",
                     clockwise, back));
  const auto bad = std::find_if(verdict.begin(), verdict.end(), [](Verdict v) { return v > Verdict::kGood; });
  const std::int64_t triangle = bad - verdict.begin();
  r.witness = e.at_vertex(e.tessellation.triangles()[triangle][0]);
  r.witness->triangle = triangle;
  return {r};
}

}  // namespace limitcheck::verify
