// SPDX-License-Identifier: MIT
#include "verify/recognise/recognise.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "verify/recognise/normal_origin.h"
#include "verify/recognise/schemes.h"
#include "verify/recognise/worst_faces.h"

namespace limitcheck::verify {
namespace {

constexpr double kTimesNearer = 10;
constexpr std::int64_t kFewest = 10;  // points that both have

// Root mean square and largest distances, from a guess and from the truth, at the points that the guess has.
struct Apart {
  std::int64_t points = 0;
  double from_guess = 0, from_truth = 0, worst_guess = 0, worst_truth = 0;
  double squares_from_guess = 0;
};

Apart apart(const Evidence& e, const SchemePoints& guess) {
  std::vector<std::int64_t> at(e.lattice.size(), -1);
  for (std::size_t k = 0; k < guess.place.size(); ++k) {
    if (guess.place[k].denominator == 0) continue;
    const Lattice::Id id = e.lattice.id(guess.place[k]);
    if (id != Lattice::kNone) at[id] = static_cast<std::int64_t>(k);
  }
  Apart a;
  for (std::int64_t v = 0; v < e.tessellation.vertex_count(); ++v) {
    const Lattice::Id id = e.point[v];
    const Vector got = e.tessellation.position(v);
    if (id == Lattice::kNone || at[id] < 0 || !is_finite(got)) continue;
    const double x = norm(got - guess.position[at[id]]), y = norm(got - e.reference.position(id));
    ++a.points;
    a.from_guess += x * x;
    a.from_truth += y * y;
    a.worst_guess = std::max(a.worst_guess, x);
    a.worst_truth = std::max(a.worst_truth, y);
  }
  a.squares_from_guess = a.from_guess;
  const double count = static_cast<double>(std::max<std::int64_t>(a.points, 1));
  a.from_guess = std::sqrt(a.from_guess / count);
  a.from_truth = std::sqrt(a.from_truth / count);
  return a;
}

std::string origin_of_points(const Evidence& e) {
  const int steps = e.lattice.depth();
  if (std::any_of(e.face_depth.begin(), e.face_depth.end(), [&](int d) { return d >= 0 && d != steps; }))
    return "";
  const bool wants_limit = e.capabilities.points == LC_POINTS_LIMIT;
  struct Guess {
    Scheme scheme;
    bool limit;
    const char* remark;
    bool tags = true;  // with the sharp edges and vertices of the control mesh
  };
  const bool loop = e.lattice.scheme() == data::Scheme::kLoop;
  const char* no_loop = "; this is not Loop subdivision at all";
  std::vector<Guess> guesses{
      {Scheme::kLoop, false, wants_limit ? "; what is missing is the last step, the limit mask" : ""},
      {Scheme::kLoop, true, wants_limit ? "" : "; the capabilities should name them so"},
      {Scheme::kWarren, false, "; Warren's is another surface"},
      {Scheme::kWarren, true, "; Warren's is another surface"},
      {Scheme::kLinear, false, "; nothing was subdivided"},
      {Scheme::kCatmullClark, false, no_loop},
      {Scheme::kCatmullClark, true, no_loop},
  };
  if (!loop)
    guesses = {{Scheme::kCatmullClark, false,
                wants_limit ? "; what is missing is the last step, the limit mask" : ""},
               {Scheme::kCatmullClark, true, wants_limit ? "" : "; the capabilities should name them so"}};
  if (!e.mesh.sharpness.empty())
    for (const bool limit : {false, true})
      guesses.push_back({loop ? Scheme::kLoop : Scheme::kCatmullClark, limit,
                         "; its sharp edges and vertices were not taken as sharp", false});
  const data::ControlMesh smooth = without_tags(e.mesh);
  // On few faces alone a guess is farther off than it may be on all of them.
  const WorstFaces worst_one(e, 1), worst_few(e, 8);
  const auto is_wrong = [&](const Guess& guess) {
    const auto is_wrong_on = [&](const WorstFaces& worst) {
      constexpr double kRounding = 1.01;
      if (!worst.worthwhile()) return false;
      const Apart a =
          apart(e, worst.points(guess.tags, guess.scheme, steps, guess.limit, e.lattice.scheme()));
      return kTimesNearer * kTimesNearer * a.squares_from_guess > kRounding * worst.squares();
    };
    return is_wrong_on(worst_one) || is_wrong_on(worst_few);
  };
  std::string text;
  double least = std::numeric_limits<double>::infinity();
  for (const Guess& guess : guesses) {
    if (loop && guess.scheme == Scheme::kCatmullClark && steps == 0) continue;  // the control mesh again
    if (is_wrong(guess)) continue;
    const Apart a = apart(e, placed_scheme_points(guess.tags ? e.mesh : smooth, guess.scheme, steps,
                                                  guess.limit, e.lattice.scheme()));
    if (a.points < kFewest || !(kTimesNearer * a.from_guess < a.from_truth) || !(a.from_guess < least))
      continue;
    least = a.from_guess;
    text = fmt::format(
        "looks like {}: the vertices are within {:.2g} diagonals of those, and up to {:.2g} off {}{}",
        describe(guess.scheme, steps, guess.limit), a.worst_guess / e.diagonal, a.worst_truth / e.diagonal,
        wants_limit ? "the limit surface" : "the refined mesh", guess.remark);
  }
  return text;
}

std::string origin_of_normals(const Evidence& e) {
  const Tessellation& t = e.tessellation;
  std::vector<Vector> positions;
  std::vector<std::int32_t> point_of;  // by the lattice: positions may differ in their last bits
  std::vector<DeliveredNormal> normals;
  for (std::int64_t v = 0; v < t.vertex_count(); ++v) {
    positions.push_back(t.position(v));
    const Lattice::Id id = is_finite(positions.back()) ? e.point[v] : Lattice::kNone;
    point_of.push_back(static_cast<std::int32_t>(id));
    const Vector direction = t.normal(v);
    if (id == Lattice::kNone || e.reference.sides().several(id) || !e.reference.has_normal(id) ||
        !std::isfinite(angle_degrees(direction, e.reference.normal(id))))
      continue;
    const lc_provenance& p = t.provenance()[v];
    normals.push_back({static_cast<std::int32_t>(v), direction, e.reference.normal(id), p.face,
                       static_cast<double>(p.i) / p.denominator, static_cast<double>(p.j) / p.denominator});
  }
  if (normals.empty()) return "";
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (std::int64_t k = 0; k < t.triangle_count(); ++k)
    if (const auto& c = t.triangles()[k]; t.triangle_ok(k))
      triangles.push_back({static_cast<std::int32_t>(c[0]), static_cast<std::int32_t>(c[1]),
                           static_cast<std::int32_t>(c[2])});
  return origin_of_normals(normals, e.mesh, positions, triangles, point_of);
}

}  // namespace

void recognise(const Evidence& e, std::vector<Result>& results) {
  if (e.lattice.size() > kRecognised) return;
  for (Result& r : results) {
    if (r.status != Status::kFinding) continue;
    std::string text;
    if (r.check == "positions" || r.check == "refined-positions") text = origin_of_points(e);
    if (r.check == "normals") text = origin_of_normals(e);
    if (!text.empty()) r.message += (r.message.empty() ? "" : "; ") + text;
  }
}

}  // namespace limitcheck::verify
