// SPDX-License-Identifier: MIT
#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>
#include <tuple>

#include "verify/checks/checks.h"
#include "verify/row/statistics.h"

namespace limitcheck::verify {
namespace {

enum class Verdict : std::uint8_t { kNotPlaced, kNotFinite, kGood, kClockwise, kFacesBack };

// A facet may only be judged by its points if no allowed error of them can turn it over. A triangle whose
// corners move by s changes its area vector by at most 2 s (sum of sides + s); s is `slack`, once for the
// subject and, generously, once for the reference: so no finding needs certified numbers here.
Verdict judge(const Evidence& e, std::int64_t triangle) {
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
  double slack = 0;
  for (const auto corner : v) slack = std::max(slack, e.position_bound_at(e.point[corner]) * e.diagonal);
  if (norm(exact_area) <= 4 * slack * (sides + slack)) return Verdict::kGood;
  return dot(got_area, exact_area) < 0 ? Verdict::kFacesBack : Verdict::kGood;
}

using Corners = std::array<Lattice::Coordinates, 3>;

// What is wrong with one face, and a place where it is.
struct Tiling {
  bool holes = false, overlaps = false;  // points that no triangle covers, or more than one
  bool finer = false;                    // corners between the lattice points of its depth, without a reason
  bool coarser = false;                  // lattice points of its depth that are no corners
  bool shown = false;                    // although culled
  bool astray = false;  // triangles or vertices that name the face and lie elsewhere, or off the lattice
  bool fan = false;     // coarser, as the paper's fans are: all triangles meet in the centre
  Lattice::Coordinates at{-1, -1};
  std::int64_t triangle = -1;  // that is astray

  bool wrong() const { return holes || overlaps || finer || coarser || shown || astray; }
  void note(bool& fault, Lattice::Coordinates where) {
    if (!wrong()) at = where;
    fault = true;
  }
};

// Take every triangle counter-clockwise and add up the boundaries: how often a point is covered is the
// winding number of the sum. So every point is covered exactly once if and only if the sum is the outline of
// the face, whichever diagonals the tiling has. Sides on one line are sums of intervals, which vanish if and only if
// those that end at each point are as many as begin there; so a side may meet two shorter ones (`t-vertices` reports
// T-vertices).
void judge_tiling(std::span<const Corners> triangles, FaceDomain domain, std::int64_t scale, Tiling& v) {
  using Point = Lattice::Coordinates;
  struct End {
    Point line, at;  // a line by its least direction, of part -1 - its own
    std::int32_t times;
    auto key() const { return std::tie(line.part, line.i, line.j, at.part, at.i, at.j); }
  };
  std::vector<End> ends;
  ends.reserve(6 * triangles.size());
  const auto add = [&](const Point& p, const Point& q, std::int32_t times) {
    domain.for_each_straight(p, q, scale, [&](const Point& from, const Point& to) {
      if (from.part != to.part) {  // between two parts: from there to there and back, and nothing else
        const Point a = domain.canonical(from, scale), b = domain.canonical(to, scale);
        const bool up = std::tie(a.part, a.i, a.j) < std::tie(b.part, b.i, b.j);
        ends.push_back({up ? a : b, up ? b : a, up ? times : -times});
        return;
      }
      const std::int64_t di = to.i - from.i, dj = to.j - from.j;
      const std::int64_t step = (di < 0 || (di == 0 && dj < 0) ? -1 : 1) * std::gcd(di, dj);
      const Point line{di / step, dj / step, -1 - from.part};
      ends.push_back({line, to, times});
      ends.push_back({line, from, -times});
    });
  };
  for (Corners c : triangles) {
    const double area = domain.area(c, scale);
    if (area == 0) continue;
    if (area < 0) std::swap(c[1], c[2]);
    for (int k = 0; k < 3; ++k) add(c[k], c[(k + 1) % 3], 1);
  }
  for (int k = 0; k < domain.corners(); ++k)
    add(domain.corner_point(k, scale), domain.corner_point(domain.next(k), scale), -1);

  std::sort(ends.begin(), ends.end(), [](const End& a, const End& b) { return a.key() < b.key(); });
  for (std::size_t k = 0; k < ends.size();) {
    std::size_t end = k;
    std::int64_t sum = 0;
    for (; end < ends.size() && ends[end].key() == ends[k].key(); ++end) sum += ends[end].times;
    if (sum != 0) v.note(v.holes, ends[k].at);
    k = end;
  }
  // The sum of the areas tells whether it is a hole, an overlap or both.
  if (!v.holes) return;
  // Twice the area that the outline has, seen from a corner.
  double covered = 0, whole = 0;
  for (const Corners& c : triangles) covered += std::abs(domain.area(c, scale));
  for (int k = 1; k + 1 < domain.corners(); ++k)
    whole += domain.area(
        {domain.corner_point(0, scale), domain.corner_point(k, scale), domain.corner_point(k + 1, scale)},
        scale);
  v.overlaps = covered >= whole;
  v.holes = covered <= whole;
}

// Every lattice point of the face's depth is a corner.
void judge_points(std::span<const Corners> triangles, FaceDomain domain, std::int64_t scale, int depth,
                  bool plain, Tiling& v) {
  const std::int64_t n = std::int64_t{1} << depth, step = scale / n;
  std::vector<bool> met(domain.point_count(n), false);
  bool fan = true;
  for (const Corners& c : triangles) {
    if (domain.area(c, scale) == 0) continue;
    bool at_centre = false;
    for (const auto& p : c) {
      at_centre = at_centre || domain.is_centre(p, scale);
      if (p.i % step == 0 && p.j % step == 0)
        met[domain.number({p.i / step, p.j / step, p.part}, n)] = true;
      else if (plain)
        v.note(v.finer, p);
    }
    fan = fan && at_centre;
  }
  domain.for_each_point(n, [&](FaceDomain::Point p) {
    if (!met[domain.number(p, n)]) v.note(v.coarser, {p.i * step, p.j * step, p.part});
  });
  v.fan = v.coarser && fan && !triangles.empty();
}

// Neither the face nor a neighbour is deeper, nor the faces beyond a neighbour, which may be displayed as
// deep as they are.
bool is_plain(const Evidence& e, std::span<const std::int32_t> deepest, std::int32_t face) {
  const auto finer = [&](std::int32_t f) { return f >= 0 && deepest[f] > e.face_depth[face]; };
  if (finer(face)) return false;
  for (int k = 0; k < e.lattice.domain(face).corners(); ++k)
    if (finer(e.lattice.across(face, k))) return false;
  return true;
}

}  // namespace

std::vector<Result> check_orientation(const Evidence& e) {
  Result r = e.result("orientation", "triangles", 0);
  const std::int64_t count = e.tessellation.triangle_count();
  std::vector<Verdict> verdict(count);
  tbb::parallel_for(std::int64_t{0}, count, [&](std::int64_t k) { verdict[k] = judge(e, k); });

  const auto number = [&](Verdict v) { return std::count(verdict.begin(), verdict.end(), v); };
  const std::int64_t clockwise = number(Verdict::kClockwise), back = number(Verdict::kFacesBack);
  const std::int64_t not_finite = number(Verdict::kNotFinite);
  r.of = count - number(Verdict::kNotPlaced) - not_finite;
  r.bad = clockwise + back;
  say_left_out(r, not_finite, "triangles with corners");
  settle(r);
  if (r.bad == 0) return {r};
  say(r, fmt::format("{} triangles clockwise on their control face, {} face away from the exact facet",
                     clockwise, back));
  const auto bad = std::find_if(verdict.begin(), verdict.end(), [](Verdict v) { return v > Verdict::kGood; });
  const std::int64_t triangle = bad - verdict.begin();
  r.witness = e.at_vertex(e.tessellation.triangles()[triangle][0]);
  r.witness->triangle = triangle;
  return {r};
}

std::vector<Result> check_coverage(const Evidence& e) {
  Result r = e.result("coverage", "faces", 0);
  const Tessellation& t = e.tessellation;
  const auto faces = static_cast<std::int32_t>(e.mesh.faces.size());
  std::vector<Corners> corners(static_cast<std::size_t>(t.triangle_count()));
  std::vector<std::uint8_t> placed(corners.size());  // of each triangle: whether it lies in the face it names
  tbb::parallel_for(std::int64_t{0}, t.triangle_count(),
                    [&](std::int64_t k) { placed[k] = e.place(k, corners[k]); });
  std::vector<std::vector<Corners>> triangles(e.mesh.faces.size());
  for (std::int64_t k = 0; k < t.triangle_count(); ++k)
    if (placed[k]) triangles[t.triangle_face()[k]].push_back(corners[k]);
  const std::vector<std::int32_t> deepest = deepest_near(e);

  std::vector<Tiling> verdicts(faces);
  tbb::parallel_for(std::int32_t{0}, faces, [&](std::int32_t f) {
    const std::span<const Corners> own = triangles[f];
    Tiling& v = verdicts[f];
    if (e.face_depth[f] >= 0) {
      judge_tiling(own, e.lattice.domain(f), e.lattice.scale(), v);
      if (e.capabilities.points_anywhere == 0)
        judge_points(own, e.lattice.domain(f), e.lattice.scale(), e.face_depth[f], is_plain(e, deepest, f),
                     v);
    } else if (!own.empty()) {
      v.note(v.shown, own[0][0]);
    }
  });

  // What has no place counts as a fault of the face that it names.
  std::int64_t misplaced = 0, off_lattice = 0;
  Tiling nowhere;  // no face of the mesh at all
  const auto blame = [&](std::int32_t face, std::int64_t triangle) {
    Tiling& v = face >= 0 && face < faces ? verdicts[face] : nowhere;
    v.note(v.astray, v.at);
    if (v.triangle < 0) v.triangle = triangle;
  };
  for (std::int64_t k = 0; k < t.triangle_count(); ++k)
    if (!placed[k]) ++misplaced, blame(t.triangle_face()[k], k);
  for (std::int64_t v = 0; v < t.vertex_count(); ++v)
    if (e.point[v] == Lattice::kNone) ++off_lattice, blame(t.provenance()[v].face, -1);

  r.of = faces;
  for (std::int32_t f = 0; f < faces; ++f) {
    const Tiling& v = verdicts[f];
    if (!v.wrong()) continue;
    ++r.bad;
    if (r.witness) continue;
    r.witness = v.at.i < 0 ? Witness{.face = f} : e.at(e.lattice.place(f, v.at));
    r.witness->triangle = v.triangle;
  }
  const auto tell = [&](bool Tiling::*fault, const char* what) {
    const auto count =
        std::count_if(verdicts.begin(), verdicts.end(), [&](const Tiling& v) { return v.*fault; });
    if (count > 0) say(r, fmt::format("{} faces {}", count, what));
  };
  tell(&Tiling::holes, "with holes");
  tell(&Tiling::overlaps, "covered more than once");
  tell(&Tiling::finer, "with corners between the lattice points of their depth");
  tell(&Tiling::coarser, "without all lattice points of their depth");
  tell(&Tiling::fan, "of these fans round their centre, as the paper repairs cracks");
  tell(&Tiling::shown, "displayed although culled");
  if (misplaced > 0) say(r, fmt::format("{} triangles not in the face that they name", misplaced));
  if (off_lattice > 0)
    say(r, fmt::format("{} vertices {}", off_lattice,
                       e.capabilities.points_anywhere == 0
                           ? "off the lattice"
                           : "in no face, or without a common denominator below 2^32"));
  if (r.bad == 0 && nowhere.wrong()) {
    r.bad = 1;
    r.witness = Witness{.triangle = nowhere.triangle};
  }
  if (r.bad > 0) r.status = Status::kFinding;
  return {r};
}

}  // namespace limitcheck::verify
