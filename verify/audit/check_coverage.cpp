// SPDX-License-Identifier: MIT
// Exact: everything happens on lattice coordinates.
#include <fmt/core.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>

#include "verify/audit/checks.h"

namespace limitcheck::verify {
namespace {

using Corners = std::array<Lattice::Coordinates, 3>;

struct Verdict {
  std::int64_t missing = 0, repeated = 0;  // unit triangles, or steps of the outline where the tiling is free
  bool tiled() const { return missing == 0 && repeated == 0; }
  std::int64_t i = 0, j = 0;  // a place where it is wrong, in lattice coordinates
};

void note(Verdict& v, std::int64_t by, std::int64_t i, std::int64_t j) {
  if (v.tiled()) v.i = i, v.j = j;
  (by > 0 ? v.repeated : v.missing) += by > 0 ? by : -by;
}

// Row by row in l2, alternating up and down: the number of the unit triangle among n * n, or -1 if it is
// none. `step` is the lattice coordinate of one side.
std::int64_t unit_triangle(const Corners& c, std::int64_t step, std::int64_t n) {
  const std::int64_t i0 = std::min({c[0].i, c[1].i, c[2].i}), j0 = std::min({c[0].j, c[1].j, c[2].j});
  if (i0 % step != 0 || j0 % step != 0) return -1;
  // Up: (0,0) (1,0) (0,1). Down: (1,0) (1,1) (0,1). A corner is the bit i + 2 j of `seen`.
  unsigned seen = 0;
  for (const auto& p : c) {
    const std::int64_t i = p.i - i0, j = p.j - j0;
    if ((i != 0 && i != step) || (j != 0 && j != step)) return -1;
    seen |= 1U << ((i != 0 ? 1 : 0) + (j != 0 ? 2 : 0));
  }
  const bool up = seen == 0b0111, down = seen == 0b1110;
  if (!up && !down) return -1;
  const std::int64_t i = i0 / step, j = j0 / step;
  const std::int64_t before = j * (2 * n - j);  // rows below: sum of 2 (n - r) - 1
  return before + 2 * i + (down ? 1 : 0);
}

// A face whose neighbours ask for no more than itself: exactly the n * n unit triangles, once each.
Verdict unit_tiling(std::span<const Corners> triangles, std::int64_t scale, int depth,
                    std::vector<std::int32_t>& times) {
  const std::int64_t n = std::int64_t{1} << depth, step = scale / n;
  times.assign(static_cast<std::size_t>(n * n), 0);
  Verdict v;
  for (const Corners& c : triangles) {
    const std::int64_t k = unit_triangle(c, step, n);
    if (k < 0) {
      note(v, 1, c[0].i, c[0].j);
    } else if (++times[k] > 1) {
      note(v, 1, c[0].i, c[0].j);
    }
  }
  for (std::int64_t j = 0, k = 0; j < n; ++j)
    for (std::int64_t i = 0; i < 2 * (n - j) - 1; ++i, ++k)
      if (times[k] == 0) note(v, -1, (i / 2) * step, j * step);
  return v;
}

// Any other tiling. Take every triangle counter-clockwise and add up the boundaries: how often a point is
// covered is the winding number of the sum. So every point is covered exactly once if and only if the sum is
// the outline of the face. Sides are cut into primitive lattice steps, so that a side may meet two shorter
// ones (a T-vertex is not the business of this check).
Verdict free_tiling(std::span<const Corners> triangles, std::int64_t scale) {
  struct Step {
    std::int64_t i, j, di, dj;  // canonical direction
    std::int32_t times;
  };
  std::vector<Step> steps;
  const auto add = [&](Lattice::Coordinates p, Lattice::Coordinates q, std::int32_t times) {
    if (p.i > q.i || (p.i == q.i && p.j > q.j)) std::swap(p, q), times = -times;
    const std::int64_t pieces = std::gcd(q.i - p.i, q.j - p.j);
    const std::int64_t di = (q.i - p.i) / pieces, dj = (q.j - p.j) / pieces;
    for (std::int64_t k = 0; k < pieces; ++k) steps.push_back({p.i + k * di, p.j + k * dj, di, dj, times});
  };
  for (Corners c : triangles) {
    const std::int64_t area = (c[1].i - c[0].i) * (c[2].j - c[0].j) - (c[2].i - c[0].i) * (c[1].j - c[0].j);
    if (area == 0) continue;
    if (area < 0) std::swap(c[1], c[2]);
    for (int k = 0; k < 3; ++k) add(c[k], c[(k + 1) % 3], 1);
  }
  add({0, 0}, {scale, 0}, -1);
  add({scale, 0}, {0, scale}, -1);
  add({0, scale}, {0, 0}, -1);

  const auto key = [](const Step& s) { return std::tie(s.i, s.j, s.di, s.dj); };
  std::sort(steps.begin(), steps.end(), [&](const Step& a, const Step& b) { return key(a) < key(b); });
  Verdict v;
  for (std::size_t k = 0; k < steps.size();) {
    std::size_t end = k;
    std::int64_t sum = 0;
    for (; end < steps.size() && key(steps[end]) == key(steps[k]); ++end) sum += steps[end].times;
    if (sum != 0) note(v, sum, steps[k].i, steps[k].j);
    k = end;
  }
  return v;
}

}  // namespace

std::vector<Result> check_coverage(const Evidence& e) {
  Result r = e.result("coverage");
  r.unit = "faces";
  r.bound = 0;
  const Tessellation& t = e.tessellation;
  const auto faces = static_cast<std::int32_t>(e.mesh.triangles.size());

  // The triangles of each face (counting sort), those of culled faces, and those that lie in no face.
  std::vector<std::int64_t> start(static_cast<std::size_t>(faces) + 1, 0);
  std::vector<std::uint8_t> placed(static_cast<std::size_t>(t.triangle_count()));
  std::vector<Corners> corners(placed.size());
  tbb::parallel_for(std::int64_t{0}, t.triangle_count(),
                    [&](std::int64_t k) { placed[k] = e.place(k, corners[k]); });
  std::int64_t misplaced = 0, misplaced_witness = -1;
  for (std::int64_t k = 0; k < t.triangle_count(); ++k) {
    if (placed[k]) {
      ++start[t.triangle_face()[k] + 1];
    } else if (misplaced++ == 0) {
      misplaced_witness = k;
    }
  }
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<Corners> sorted(static_cast<std::size_t>(start.back()));
  {
    std::vector<std::int64_t> fill(start.begin(), start.end() - 1);
    for (std::int64_t k = 0; k < t.triangle_count(); ++k)
      if (placed[k]) sorted[fill[t.triangle_face()[k]]++] = corners[k];
  }

  std::vector<Verdict> verdicts(static_cast<std::size_t>(faces));
  tbb::enumerable_thread_specific<std::vector<std::int32_t>> scratch;
  tbb::parallel_for(std::int32_t{0}, faces, [&](std::int32_t f) {
    const std::span<const Corners> own(sorted.data() + start[f],
                                       static_cast<std::size_t>(start[f + 1] - start[f]));
    const int depth = e.face_depth[f];
    if (depth < 0) {
      if (!own.empty()) note(verdicts[f], static_cast<std::int64_t>(own.size()), own[0][0].i, own[0][0].j);
      return;
    }
    // Nothing finer in sight, also not beyond a neighbour, which may be displayed as deep as that.
    bool plain = true;
    for (int k = 0; k < 3; ++k)
      for (const std::int32_t g : e.lattice.edges()[e.lattice.edge_of(f, k)].face)
        plain = plain && (g < 0 || deepest_near(e, g) <= depth);
    verdicts[f] = plain ? unit_tiling(own, e.lattice.scale(), depth, scratch.local())
                        : free_tiling(own, e.lattice.scale());
  });

  std::int64_t missing = 0, repeated = 0;
  for (std::int32_t f = 0; f < faces; ++f) {
    const Verdict& v = verdicts[f];
    if (v.tiled()) continue;
    ++r.bad;
    missing += v.missing;
    repeated += v.repeated;
    if (r.witness) continue;
    r.witness = Witness{};
    r.witness->face = f;
    r.witness->l1 = fraction(static_cast<std::uint64_t>(v.i), static_cast<std::uint64_t>(e.lattice.scale()));
    r.witness->l2 = fraction(static_cast<std::uint64_t>(v.j), static_cast<std::uint64_t>(e.lattice.scale()));
  }
  r.of = faces;
  const std::int64_t off_lattice = std::count(e.point.begin(), e.point.end(), Lattice::kNone);
  if (r.bad == 0 && misplaced == 0 && off_lattice == 0) return {r};

  r.status = Status::kFinding;
  if (r.bad == 0) r.bad = std::max(misplaced, off_lattice);
  r.message = fmt::format(
      "{} tiles missing, {} repeated or foreign, {} triangles in no face, {} vertices off the lattice",
      missing, repeated, misplaced, off_lattice);
  if (!r.witness) {
    r.witness = Witness{};
    r.witness->triangle = misplaced_witness;
  }
  return {r};
}

}  // namespace limitcheck::verify
