// SPDX-License-Identifier: MIT
#include "verify/files/diagnosis.h"

#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "verify/audit/schemes.h"

namespace limitcheck::verify {
namespace {

constexpr std::size_t kSample = 2000;

// Root mean square and largest distance of points from a cloud.
struct Apart {
  double rms = 0, worst = 0;
};
Apart apart(const std::vector<Vector>& points, const std::vector<Vector>& cloud) {
  std::vector<BoxTree::Box> boxes(cloud.size());
  for (std::size_t k = 0; k < cloud.size(); ++k) boxes[k] = {cloud[k], cloud[k]};
  const BoxTree tree(boxes);
  std::vector<double> distance(points.size(), std::numeric_limits<double>::infinity());
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t k) {
    tree.near(points[k], [&](std::size_t other) {
      return distance[k] = std::min(distance[k], norm(points[k] - cloud[other]));
    });
  });
  Apart a;
  for (const double d : distance) {
    a.rms += d * d;
    a.worst = std::max(a.worst, d);
  }
  a.rms = std::sqrt(a.rms / static_cast<double>(points.size()));
  return a;
}

// Vertices after so many steps: triangles, or quads from triangles.
double vertices_after(const data::ControlMesh& mesh, Scheme scheme, int steps) {
  const double growth = std::pow(4, steps) * static_cast<double>(mesh.triangles.size());
  return scheme == Scheme::kCatmullClark ? .75 * growth : .5 * growth;
}

}  // namespace

std::vector<std::string> diagnose(const FileEvidence& e) {
  std::vector<Vector> points;
  double from_surface = 0, worst_from_surface = 0;
  std::vector<std::size_t> used;
  for (std::size_t k = 0; k < e.place.size(); ++k) {
    if (e.place[k].face < 0) continue;
    used.push_back(k);
    worst_from_surface = std::max(worst_from_surface, e.foot[k].distance);
  }
  for (std::size_t k = 0; k < used.size(); k += std::max<std::size_t>(1, used.size() / kSample)) {
    points.push_back(e.position(static_cast<std::int32_t>(used[k])));
    const double d = norm(points.back() - e.foot[used[k]].position);
    from_surface += d * d;
  }
  if (points.empty()) return {};
  const double size = e.surface.diagonal();
  from_surface = std::sqrt(from_surface / static_cast<double>(points.size()));
  std::vector<std::string> told;

  struct Guess {
    Scheme scheme;
    int steps;
    bool limit;
    Apart apart;
  };
  std::vector<Guess> guesses;
  double loop_worst = -1;  // of Loop's refined control points from the surface, at about as many vertices
  int loop_steps = 0;
  for (const Scheme scheme : {Scheme::kLoop, Scheme::kWarren, Scheme::kLinear, Scheme::kCatmullClark})
    for (int steps = 0; steps <= 7; ++steps) {
      const double count = vertices_after(e.control, scheme, steps);
      const auto have = static_cast<double>(used.size());
      if (count > 3 * have + 100 || count < have / 8 || count > 2e6) continue;
      for (const bool limit : {false, true}) {
        if (limit && (scheme == Scheme::kLoop || scheme == Scheme::kLinear || steps == 0)) continue;
        const auto cloud = scheme_points(e.control, scheme, steps, limit);
        guesses.push_back({scheme, steps, limit, apart(points, cloud)});
        if (scheme != Scheme::kLoop) continue;
        double worst = 0;
        for (std::size_t k = 0; k < cloud.size(); k += std::max<std::size_t>(1, cloud.size() / kSample))
          worst = std::max(worst, e.surface.closest(cloud[k]).distance);
        if (loop_worst < 0 || std::abs(std::log(count / have)) <
                                  std::abs(std::log(vertices_after(e.control, scheme, loop_steps) / have))) {
          loop_worst = worst;
          loop_steps = steps;
        }
      }
    }
  const auto best = std::min_element(guesses.begin(), guesses.end(), [](const Guess& a, const Guess& b) {
    return a.apart.rms < b.apart.rms;
  });
  if (best != guesses.end() && best->apart.rms < from_surface / 10) {
    told.push_back(fmt::format(
        "looks like {}: the vertices are within {:.2g} diagonals of those, and {:.2g} off Loop's "
        "limit surface{}",
        describe(best->scheme, best->steps, best->limit), best->apart.worst / size, worst_from_surface / size,
        best->scheme == Scheme::kLoop     ? "; what is missing is the last step, the limit mask"
        : best->scheme == Scheme::kWarren ? "; Warren's is another surface"
        : best->scheme == Scheme::kCatmullClark
            ? "; this is not Loop subdivision at all: more steps bring it no nearer"
            : "; nothing was subdivided"));
    return told;
  }
  const auto& t = e.tessellation;
  if (2 * t.quads > t.polygons)
    told.push_back(
        fmt::format("{} of {} faces are quads, which Loop's rule does not make: another scheme, such as "
                    "Catmull and Clark's",
                    t.quads, t.polygons));
  if (loop_worst > 0 && worst_from_surface > 3 * loop_worst)
    told.push_back(
        fmt::format("not Loop subdivision of this control mesh: the control mesh refined {} times by Loop's "
                    "rule, not even moved to the "
                    "limit, is within {:.2g} diagonals of the surface, these vertices are off by up to "
                    "{:.2g}. If a scale, an offset or "
                    "a rotation is in between, --fit takes it out",
                    loop_steps, loop_worst / size, worst_from_surface / size));
  return told;
}

}  // namespace limitcheck::verify
