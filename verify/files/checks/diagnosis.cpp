// SPDX-License-Identifier: MIT
#include "verify/files/checks/diagnosis.h"

#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

#include "data/triangulate.h"
#include "data/validate.h"
#include "verify/recognise/recognise.h"

namespace limitcheck::verify {
namespace {

constexpr std::size_t kSample = 2000;

// The nearest point of a cloud to each of some points.
struct Nearest {
  std::size_t index = 0;
  double distance = std::numeric_limits<double>::infinity();
};
std::vector<Nearest> nearest(const std::vector<Vector>& points, const std::vector<Vector>& cloud) {
  std::vector<BoxTree::Box> boxes(cloud.size());
  for (std::size_t k = 0; k < cloud.size(); ++k) boxes[k] = {cloud[k], cloud[k]};
  const BoxTree tree(boxes);
  std::vector<Nearest> result(points.size());
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t k) {
    tree.near(points[k], [&](std::size_t other) {
      const double d = norm(points[k] - cloud[other]);
      if (d < result[k].distance) result[k] = {other, d};
      return result[k].distance;
    });
  });
  return result;
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
  bool has(GuessedRule scheme) const {
    return scheme == GuessedRule::kCatmullClark || whole.faces.are_triangles() ||
           data::validate(cut, data::Scheme::kLoop).empty();
  }
  const data::ControlMesh& of(GuessedRule scheme) const {
    return scheme == GuessedRule::kCatmullClark ? whole : cut;
  }
  // Vertices after so many steps, about: half as many as triangles, or as many as quads.
  double vertices_after(GuessedRule scheme, int steps) const {
    const data::ControlMesh& mesh = of(scheme);
    const double growth = std::pow(4, steps);
    return scheme == GuessedRule::kCatmullClark
               ? .25 * (growth * static_cast<double>(mesh.faces.corners().size()))
               : .5 * (growth * static_cast<double>(mesh.faces.size()));
  }
};

// The scheme that the file is judged by, and what it is called.
GuessedRule own_scheme(const FileEvidence& e) {
  return e.scheme() == data::Scheme::kLoop ? GuessedRule::kLoop : GuessedRule::kCatmullClark;
}
const char* owner(GuessedRule scheme) {
  return scheme == GuessedRule::kLoop ? "Loop" : "Catmull and Clark";
}

// The stride with which about kSample elements of a list are taken.
std::size_t stride(std::size_t count) {
  return std::max<std::size_t>(1, count / kSample);
}

// The points that have a place, and a sample of them.
struct Sampled {
  std::vector<std::int32_t> placed;
  std::vector<Vector> points;
  std::vector<double> off;  // the sample's distances from the surface
  double worst = 0;         // the largest of all
};

Sampled sample(const FileEvidence& e) {
  Sampled s;
  for (std::size_t k = 0; k < e.place.size(); ++k) {
    if (e.place[k].face < 0) continue;
    s.placed.push_back(static_cast<std::int32_t>(k));
    s.worst = std::max(s.worst, e.foot[k].distance);
  }
  for (std::size_t k = 0; k < s.placed.size(); k += stride(s.placed.size())) {
    s.points.push_back(e.position(s.placed[k]));
    s.off.push_back(e.foot[s.placed[k]].distance);
  }
  return s;
}

struct Guess {
  GuessedRule scheme;
  int steps;
  bool limit, tags;         // tags: with the sharp edges and vertices of the control mesh
  std::vector<double> off;  // of the sample from its points
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

double magnitude(const data::ControlMesh& mesh) {
  double size = 0;
  for (const Vector& p : mesh.positions) size = std::max(size, largest(p));
  return size;
}

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
  const GuessedRule own = own_scheme(e);
  const auto have = static_cast<double>(sampled.placed.size());
  const auto unlike = [&](int steps) { return std::abs(std::log(cages.vertices_after(own, steps) / have)); };
  for (const GuessedRule scheme :
       {GuessedRule::kLoop, GuessedRule::kWarren, GuessedRule::kLinear, GuessedRule::kCatmullClark}) {
    if (!cages.has(scheme)) continue;
    for (int steps = 0; steps <= 7; ++steps) {
      const double count = cages.vertices_after(scheme, steps);
      if (count > 3 * have + 100 || count < have / 8 || count > 2e6) continue;
      for (const auto& [limit, tags] :
           {std::pair{false, true}, std::pair{true, true}, std::pair{false, false}, std::pair{true, false}}) {
        if (limit && ((scheme == own && tags) || scheme == GuessedRule::kLinear || steps == 0)) continue;
        if (!tags && (e.control.sharpness.empty() || scheme == GuessedRule::kLinear)) continue;
        const auto cloud = scheme_points((tags ? cages : smooth_cages).of(scheme), scheme, steps, limit);
        guesses.all.push_back({scheme, steps, limit, tags, {}});
        for (const Nearest& n : nearest(sampled.points, cloud)) guesses.all.back().off.push_back(n.distance);
        if (scheme == own && tags && (guesses.own.worst < 0 || unlike(steps) < unlike(guesses.own.steps)))
          guesses.own = {worst_of(e.surface, cloud), steps};
      }
    }
  }
  return guesses;
}

const char* remark(GuessedRule scheme, bool tags, GuessedRule own) {
  if (!tags) return "; its sharp edges and vertices were not taken as sharp";
  if (scheme == own) return "; what is missing is the last step, the limit mask";
  switch (scheme) {
    case GuessedRule::kLoop:
      return "; this is not Catmull-Clark subdivision at all: the faces were cut into triangles first";
    case GuessedRule::kWarren:
      return "; Warren's is another surface";
    case GuessedRule::kCatmullClark:
      return "; this is not Loop subdivision at all: more steps bring it no nearer";
    case GuessedRule::kLinear:
      break;
  }
  return "; nothing was subdivided";
}

// All points against what was recognised.
Result recognised_row(const FileEvidence& e, const Sampled& sampled, const Guess& g, const Recognised& what,
                      const Written& how) {
  const data::ControlMesh smooth = without_tags(e.control);
  const Cages cages(g.tags ? e.control : smooth);
  const std::vector<Vector> cloud = scheme_points(cages.of(g.scheme), g.scheme, g.steps, g.limit);
  std::vector<Vector> points;
  for (const std::int32_t k : sampled.placed) points.push_back(e.position(k));
  const std::vector<Nearest> there = nearest(points, cloud);
  std::vector<double> off;
  for (const Nearest& n : there) off.push_back(n.distance / e.surface.diagonal());
  const double bound = rounding(how, g.steps, magnitude(e.control)) / e.surface.diagonal();
  const Statistics statistics = summarise(off, bound);
  std::optional<Witness> worst;
  if (const auto k = statistics.worst_at; k >= 0) {
    worst = e.at_vertex(static_cast<std::int32_t>(e.merged.vertex_of[sampled.placed[k]]));
    worst->show(cloud[there[k].index], points[k]);
  }
  Result row = e.result("file-recognised");
  say_recognised(row, what, statistics, bound, worst);
  return row;
}

}  // namespace

Written written(const std::vector<Vector>& points, double share, bool few_digits) {
  std::vector<int> digits, decimals;
  double size = 0;
  for (const Vector& p : points)
    for (const double x : p) {
      if (x == 0 || !std::isfinite(x)) continue;
      size = std::max(size, std::abs(x));
      std::array<char, 32> text;  // "d.ddde-xx", as many digits as tell it from all other doubles
      const char* end =
          std::to_chars(text.data(), text.data() + text.size(), std::abs(x), std::chars_format::scientific)
              .ptr;
      const char* e = std::find<const char*>(text.data(), end, 'e');
      int exponent = 0;
      std::from_chars(e + (e[1] == '+' ? 2 : 1), end, exponent);
      digits.push_back(std::max(1, static_cast<int>(e - text.data()) - 1));
      decimals.push_back(std::max(0, digits.back() - 1 - exponent));
    }
  if (digits.empty()) return {};
  const auto otherwise = static_cast<std::ptrdiff_t>(share * static_cast<double>(digits.size()));
  const auto most = [&](std::vector<int>& list) {
    std::nth_element(list.begin(), list.end() - 1 - otherwise, list.end());
    return list[list.size() - 1 - static_cast<std::size_t>(otherwise)];
  };
  const double first = std::floor(std::log10(size)) + 1;
  const auto half = [&](int places, int of_all) {
    return std::max(std::pow(10, -places), std::pow(10, first - of_all)) / 2;
  };
  const double told = half(most(decimals), most(digits));
  const double last = few_digits ? told : std::min(told, half(6, 6));
  std::ptrdiff_t no_floats = 0;
  for (const Vector& p : points)
    for (const double x : p)  // a little more, since halves of the last digit are rounded
      no_floats +=
          std::isfinite(x) && !(std::abs(x - static_cast<double>(static_cast<float>(x))) <= 1.001 * last);
  return {no_floats <= otherwise ? LC_FLOAT32 : LC_FLOAT64, last};
}

double rounding(const Written& how, int steps, double magnitude) {
  return position_bound(how.precision, steps, magnitude, 1) + std::sqrt(3.0) * how.last;
}

Diagnosis diagnose(const FileEvidence& e) {
  const Sampled sampled = sample(e);
  if (sampled.points.empty()) return {};
  const double size = e.surface.diagonal();
  const auto [guesses, refined] = guess(e, sampled);
  const GuessedRule own = own_scheme(e);
  // As all coordinates were written; or all but some, which may be those of wrong points; or in few digits.
  const std::vector<Vector>& points = e.tessellation.positions;
  for (const Written& how : {written(points), written(points, .05), written(points, .05, true)}) {
    const Guess* best = nullptr;
    double least = std::numeric_limits<double>::infinity();
    bool convincing = false;
    for (const Guess& g : guesses) {
      const double bound = rounding(how, g.steps, magnitude(e.control));
      Likeness like(bound, std::max(bound, e.tolerance * size));
      for (std::size_t k = 0; k < g.off.size(); ++k) like.add(g.off[k], sampled.off[k]);
      // Of schemes that make the same points, as where all edges are still sharp, the file's own.
      const double misfit = like.misfit() + (g.scheme == own ? 0 : 1e-9);
      if (misfit < least) best = &g, least = misfit, convincing = like.convincing();
    }
    if (!convincing) continue;
    const Recognised what = recognised(best->scheme, best->steps, best->limit, best->tags);
    const Result row = recognised_row(e, sampled, *best, what, how);
    return {
        {fmt::format(
            "looks like {}: {} of {} vertices are those, and up to {:.2g} diagonals off {}'s limit surface{}",
            what.what, row.of - row.bad, row.of, sampled.worst / size, owner(own),
            remark(best->scheme, best->tags, own))},
        what,
        {row}};
  }
  std::vector<std::string> told;
  const auto& t = e.tessellation;
  if (own == GuessedRule::kLoop && 2 * t.quads > t.polygons)
    told.push_back(
        fmt::format("{} of {} faces are quads, which Loop's rule does not make: another scheme, such as "
                    "Catmull and Clark's",
                    t.quads, t.polygons));
  if (refined.worst > 0 && sampled.worst > 3 * refined.worst)
    told.push_back(fmt::format(
        "not {} subdivision of this control mesh: the control mesh refined {} times by {}'s rule, not even "
        "moved to the limit, is within {:.2g} diagonals of the surface, these vertices are off by up to "
        "{:.2g}. If a scale, an offset or a rotation is in between, --fit takes it out",
        own == GuessedRule::kLoop ? "Loop" : "Catmull-Clark", refined.steps, owner(own), refined.worst / size,
        sampled.worst / size));
  return {told, std::nullopt, {}};
}

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
  const auto points = [&](bool limit) {
    return scheme_points(e.control, own_scheme(e), beside_corners ? 1 : 0, limit);
  };
  const std::vector<Vector> refined = points(false), limits = points(true);
  double farthest = 0;
  for (std::size_t v = 0; v < limits.size(); ++v) farthest = std::max(farthest, norm(limits[v] - refined[v]));
  std::string text = beside_corners ? "no vertex lies inside a control face, only at its corners and on its "
                                      "edges: the surface inside of faces was not looked at"
                                    : "all vertices are limits of control vertices: the surface along the "
                                      "edges and inside of faces was not looked at";
  if (farthest > 0)
    text +=
        fmt::format("; limit weights that are off by less than {:.1g} of themselves are within the tolerance",
                    e.tolerance * e.surface.diagonal() / farthest);
  return text;
}

}  // namespace limitcheck::verify
