// SPDX-License-Identifier: MIT
#include "verify/files/checks/diagnosis.h"

#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "data/triangulate.h"
#include "data/validate.h"
#include "verify/recognise/schemes.h"

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

// The control mesh as the schemes take it: of triangles, and as it is. Triangles of polygons may be no
// manifold, and then have no surface.
struct Cages {
  data::ControlMesh cut;
  const data::ControlMesh& whole;

  explicit Cages(const data::ControlMesh& control)
      : cut{control.positions, data::triangulate(control, data::Triangulation::kFan).faces,
            control.sharpness},
        whole(control) {}
  bool has(Scheme scheme) const {
    return scheme == Scheme::kCatmullClark || whole.faces.are_triangles() ||
           data::validate(cut, data::Scheme::kLoop).empty();
  }
  const data::ControlMesh& of(Scheme scheme) const { return scheme == Scheme::kCatmullClark ? whole : cut; }
  // Vertices after so many steps, about: half as many as triangles, or as many as quads.
  double vertices_after(Scheme scheme, int steps) const {
    const data::ControlMesh& mesh = of(scheme);
    const double growth = std::pow(4, steps);
    return scheme == Scheme::kCatmullClark ? .25 * (growth * static_cast<double>(mesh.faces.corners().size()))
                                           : .5 * (growth * static_cast<double>(mesh.faces.size()));
  }
};

// The scheme that the file is judged by, and what it is called.
Scheme own_scheme(const FileEvidence& e) {
  return e.scheme() == data::Scheme::kLoop ? Scheme::kLoop : Scheme::kCatmullClark;
}
const char* owner(Scheme scheme) {
  return scheme == Scheme::kLoop ? "Loop" : "Catmull and Clark";
}

// The stride with which about kSample elements of a list are taken.
std::size_t stride(std::size_t count) {
  return std::max<std::size_t>(1, count / kSample);
}

// A sample of the points that have a place, and how far these are from the surface.
struct Sampled {
  std::size_t placed = 0;
  std::vector<Vector> points;
  double rms = 0;    // of the sample
  double worst = 0;  // of all
};

Sampled sample(const FileEvidence& e) {
  Sampled s;
  std::vector<std::size_t> placed;
  for (std::size_t k = 0; k < e.place.size(); ++k) {
    if (e.place[k].face < 0) continue;
    placed.push_back(k);
    s.worst = std::max(s.worst, e.foot[k].distance);
  }
  s.placed = placed.size();
  for (std::size_t k = 0; k < placed.size(); k += stride(placed.size())) {
    s.points.push_back(e.position(static_cast<std::int32_t>(placed[k])));
    const double d = norm(s.points.back() - e.foot[placed[k]].position);
    s.rms += d * d;
  }
  s.rms = std::sqrt(s.rms / static_cast<double>(s.points.size()));
  return s;
}

struct Guess {
  Scheme scheme;
  int steps;
  bool limit, tags;  // tags: with the sharp edges and vertices of the control mesh
  Apart apart;
};

// The refined control points of the scheme that the file is judged by: their largest distance from the
// surface.
struct Refined {
  double worst = -1;
  int steps = 0;
};

// What the schemes make of the control mesh with about as many vertices, and how far that is from the sample.
struct Guesses {
  std::vector<Guess> all;
  Refined own;  // after the number of steps that comes nearest
};

double worst_of(const ClosestPoint& surface, const std::vector<Vector>& cloud) {
  double worst = 0;
  for (std::size_t k = 0; k < cloud.size(); k += stride(cloud.size()))
    worst = std::max(worst, surface.closest(cloud[k]).distance);
  return worst;
}

Guesses guess(const FileEvidence& e, const Sampled& sampled) {
  Guesses guesses;
  const Cages cages(e.control);
  const data::ControlMesh smooth = without_tags(e.control);
  const Cages smooth_cages(smooth);
  const Scheme own = own_scheme(e);
  const auto have = static_cast<double>(sampled.placed);
  const auto unlike = [&](int steps) { return std::abs(std::log(cages.vertices_after(own, steps) / have)); };
  for (const Scheme scheme : {Scheme::kLoop, Scheme::kWarren, Scheme::kLinear, Scheme::kCatmullClark}) {
    if (!cages.has(scheme)) continue;
    for (int steps = 0; steps <= 7; ++steps) {
      const double count = cages.vertices_after(scheme, steps);
      if (count > 3 * have + 100 || count < have / 8 || count > 2e6) continue;
      for (const auto& [limit, tags] :
           {std::pair{false, true}, std::pair{true, true}, std::pair{false, false}, std::pair{true, false}}) {
        if (limit && ((scheme == own && tags) || scheme == Scheme::kLinear || steps == 0)) continue;
        if (!tags && (e.control.sharpness.empty() || scheme == Scheme::kLinear)) continue;
        const auto cloud = scheme_points((tags ? cages : smooth_cages).of(scheme), scheme, steps, limit);
        guesses.all.push_back({scheme, steps, limit, tags, apart(sampled.points, cloud)});
        if (scheme == own && tags && (guesses.own.worst < 0 || unlike(steps) < unlike(guesses.own.steps)))
          guesses.own = {worst_of(e.surface, cloud), steps};
      }
    }
  }
  return guesses;
}

const char* remark(Scheme scheme, bool tags, Scheme own) {
  if (!tags) return "; its sharp edges and vertices were not taken as sharp";
  if (scheme == own) return "; what is missing is the last step, the limit mask";
  switch (scheme) {
    case Scheme::kLoop:
      return "; this is not Catmull-Clark subdivision at all: the faces were cut into triangles first";
    case Scheme::kWarren:
      return "; Warren's is another surface";
    case Scheme::kCatmullClark:
      return "; this is not Loop subdivision at all: more steps bring it no nearer";
    case Scheme::kLinear:
      break;
  }
  return "; nothing was subdivided";
}

}  // namespace

std::vector<std::string> diagnose(const FileEvidence& e) {
  const Sampled sampled = sample(e);
  if (sampled.points.empty()) return {};
  const double size = e.surface.diagonal();
  const auto [guesses, refined] = guess(e, sampled);
  const Scheme own = own_scheme(e);
  // Of schemes that make the same points, as where all edges are still sharp, the file's own.
  const auto off = [&](const Guess& g) { return g.apart.rms + (g.scheme == own ? 0 : 1e-12 * size); };
  const auto best = std::min_element(guesses.begin(), guesses.end(),
                                     [&](const Guess& a, const Guess& b) { return off(a) < off(b); });
  if (best != guesses.end() && best->apart.rms < sampled.rms / 10)
    return {fmt::format(
        "looks like {}: the vertices are within {:.2g} diagonals of those, and {:.2g} off {}'s limit "
        "surface{}",
        describe(best->scheme, best->steps, best->limit), best->apart.worst / size, sampled.worst / size,
        owner(own), remark(best->scheme, best->tags, own))};
  std::vector<std::string> told;
  const auto& t = e.tessellation;
  if (own == Scheme::kLoop && 2 * t.quads > t.polygons)
    told.push_back(
        fmt::format("{} of {} faces are quads, which Loop's rule does not make: another scheme, such as "
                    "Catmull and Clark's",
                    t.quads, t.polygons));
  if (refined.worst > 0 && sampled.worst > 3 * refined.worst)
    told.push_back(fmt::format(
        "not {} subdivision of this control mesh: the control mesh refined {} times by {}'s rule, not "
        "even moved to the limit, is within {:.2g} diagonals of the surface, these vertices are off by up to "
        "{:.2g}. If a scale, an offset or a rotation is in between, --fit takes it out",
        own == Scheme::kLoop ? "Loop" : "Catmull-Clark", refined.steps, owner(own), refined.worst / size,
        sampled.worst / size));
  return told;
}

}  // namespace limitcheck::verify
