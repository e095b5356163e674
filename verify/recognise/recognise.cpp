// SPDX-License-Identifier: MIT
#include "verify/recognise/recognise.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include "data/cut_out.h"
#include "reference/mesh/support.h"
#include "verify/evidence/faces_around.h"

namespace limitcheck::verify {
namespace {

// Some of the faces where a tessellation is wrong: to put a guess off that is wrong there, before what it
// makes of the whole mesh is computed.
// They are parts of a mesh with all that their surface depends on.
class WrongFaces {
 public:
  // So many of the faces with vertices farther than `tolerance` from the truth, from the worst to the least.
  WrongFaces(const Evidence& e, double tolerance, std::size_t most) : whole_(e.mesh) {
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
    for (std::size_t k = 0; k < count; ++k)
      wrong.push_back(ranked[(2 * k + 1) * ranked.size() / (2 * count)]);

    wrong_ = wrong.size();
    const FacesAround around(whole_.faces, whole_.positions.size());
    faces_ = reference::support_of(
        std::move(wrong), whole_.faces, [&](std::int32_t v) { return around.of(v); },
        whole_.sharpness.creasing);
    data::CutOut cut = data::cut_out(whole_.faces, faces_);
    part_ = {cut.of(whole_.positions), {}, cut.of(whole_.sharpness)};
    part_.faces = std::move(cut.faces);
  }

  // Whether the mesh has so many more faces that looking at these first is worth it.
  bool worthwhile() const { return wrong_ > 0 && 2 * faces_.size() < whole_.faces.size(); }
  // What a scheme makes of these faces, with places on the whole mesh; nothing but what is right there.
  //   tags, lattice   as placed_scheme_points() wants them
  SchemePoints points(bool tags, GuessedRule scheme, int steps, bool limit, data::Scheme lattice) const {
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

 private:
  const data::ControlMesh& whole_;
  std::vector<std::int32_t> faces_;  // of the part: the wrong ones first, then what their surface depends on
  std::size_t wrong_ = 0;            // how many of those
  data::ControlMesh part_;
};

struct Guess {
  GuessedRule scheme;
  bool limit;
  const char* remark;
  bool tags = true;  // with the sharp edges and vertices of the control mesh
};

std::vector<Guess> guesses_for(const Evidence& e) {
  const bool wants_limit = e.capabilities.points == LC_POINTS_LIMIT;
  const char* no_limit = wants_limit ? "; what is missing is the last step, the limit mask" : "";
  const char* no_step = wants_limit ? "" : "; the capabilities should name them so";
  const char *warren = "; Warren's is another surface", *no_loop = "; this is not Loop subdivision at all";
  const bool loop = e.lattice.scheme() == data::Scheme::kLoop;
  const GuessedRule own = loop ? GuessedRule::kLoop : GuessedRule::kCatmullClark;
  std::vector<Guess> guesses{{own, false, no_limit}, {own, true, no_step}};
  if (loop)
    guesses.insert(guesses.end(), {{GuessedRule::kWarren, false, warren},
                                   {GuessedRule::kWarren, true, warren},
                                   {GuessedRule::kLinear, false, "; nothing was subdivided"}});
  if (loop && e.lattice.depth() > 0)  // at depth 0 Catmull and Clark's is the control mesh again
    guesses.insert(guesses.end(), {{GuessedRule::kCatmullClark, false, no_loop},
                                   {GuessedRule::kCatmullClark, true, no_loop}});
  if (!e.mesh.sharpness.empty())
    for (const bool limit : {false, true})
      guesses.push_back({own, limit, "; its sharp edges and vertices were not taken as sharp", false});
  return guesses;
}

// Of each vertex the distance from a guess, -1 where the guess has none.
std::vector<double> distances(const Evidence& e, const SchemePoints& guess, std::vector<std::int64_t>& at) {
  at.assign(static_cast<std::size_t>(e.lattice.size()), -1);
  for (std::size_t k = 0; k < guess.place.size(); ++k) {
    if (guess.place[k].denominator == 0) continue;
    const Lattice::Id id = e.lattice.id(guess.place[k]);
    if (id != Lattice::kNone) at[id] = static_cast<std::int64_t>(k);
  }
  std::vector<double> distance(static_cast<std::size_t>(e.tessellation.vertex_count()), -1);
  for (std::int64_t v = 0; v < e.tessellation.vertex_count(); ++v) {
    const Lattice::Id id = e.point[v];
    const Vector got = e.tessellation.position(v);
    if (id != Lattice::kNone && at[id] >= 0 && is_finite(got))
      distance[v] = norm(got - guess.position[at[id]]) / e.diagonal;
  }
  return distance;
}

Likeness likeness(const Evidence& e, const std::vector<double>& distance, double bound) {
  Likeness result(bound, bound);
  for (std::size_t v = 0; v < distance.size(); ++v)
    if (distance[v] >= 0)
      result.add(distance[v], norm(e.tessellation.position(static_cast<std::int64_t>(v)) -
                                   e.reference.position(e.point[v])) /
                                  e.diagonal);
  return result;
}

// The best of the guesses that convince, as a sentence and `recognised` of a row of positions; and the row of
// the points that are not those.
std::optional<Result> origin_of_points(const Evidence& e, Result& positions, KeptGuesses& kept) {
  const int steps = e.lattice.depth();
  if (std::any_of(e.face_depth.begin(), e.face_depth.end(), [&](int d) { return d >= 0 && d != steps; }))
    return std::nullopt;
  const double bound = *positions.bound;
  const data::ControlMesh smooth = without_tags(e.mesh);
  const WrongFaces one(e, bound * e.diagonal, 1), few(e, bound * e.diagonal, 8);
  std::vector<std::int64_t> at;
  const auto is_hopeless = [&](const Guess& g) {
    for (const WrongFaces* faces : {&one, &few})
      if (faces->worthwhile() &&
          !likeness(e, distances(e, faces->points(g.tags, g.scheme, steps, g.limit, e.lattice.scheme()), at),
                    bound)
               .plausible())
        return true;
    return false;
  };
  std::optional<Result> row;
  double least = std::numeric_limits<double>::infinity();
  std::string text;
  for (const Guess& g : guesses_for(e)) {
    if (is_hopeless(g)) continue;
    const auto [at_key, is_new] = kept.try_emplace({&e.reference, g.scheme, g.limit, g.tags});
    SchemePoints& points = at_key->second;
    if (is_new)
      points = placed_scheme_points(g.tags ? e.mesh : smooth, g.scheme, steps, g.limit, e.lattice.scheme());
    const std::vector<double> distance = distances(e, points, at);
    const Likeness like = likeness(e, distance, bound);
    if (!like.convincing() || !(like.misfit() < least)) continue;
    least = like.misfit();
    const Recognised& known = positions.recognised.emplace(recognised(g.scheme, steps, g.limit, g.tags));
    text = fmt::format("looks like {}: {} of {} vertices are those, and up to {:.2g} diagonals off {}{}",
                       known.what, like.points() - like.off(), like.points(), positions.worst.value_or(0),
                       e.capabilities.points == LC_POINTS_LIMIT ? "the limit surface" : "the refined mesh",
                       g.remark);
    row = e.result("recognised");
    const Statistics statistics = summarise(distance, bound);
    std::optional<Witness> worst;
    if (const std::int64_t v = statistics.worst_at; v >= 0) {
      const Vector expected = points.position[at[e.point[v]]], got = e.tessellation.position(v);
      worst = e.at_vertex(v);
      worst->show(expected, got);
    }
    say_recognised(*row, known, statistics, bound, worst);
  }
  if (!text.empty()) positions.message += (positions.message.empty() ? "" : "; ") + text;
  return row;
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

constexpr double kNearer = .5;

Vector unit(const Vector& a) {
  const double length = norm(a);
  return length > 0 ? 1 / length * a : Vector{};
}

// Averages of the facets at each vertex or point, by the number that each corner of a triangle is given.
struct FacetMeans {
  std::vector<Vector> by_area, alike, by_angle;

  template <class Triangles>
  FacetMeans(const Triangles& triangles, std::span<const std::int32_t> number,
             std::span<const Vector> positions) {
    std::int32_t most = -1;
    for (const std::int32_t k : number) most = std::max(most, k);
    for (auto* means : {&by_area, &alike, &by_angle}) means->resize(static_cast<std::size_t>(most) + 1);
    for (const auto& t : triangles) {
      if (std::min({number[t[0]], number[t[1]], number[t[2]]}) < 0) continue;
      const Vector n = cross(positions[t[1]] - positions[t[0]], positions[t[2]] - positions[t[0]]);
      for (std::size_t k = 0; k < 3; ++k) {
        const Vector& p = positions[t[k]];
        const double angle = angle_degrees(positions[t[(k + 1) % 3]] - p, positions[t[(k + 2) % 3]] - p);
        const auto at = static_cast<std::size_t>(number[t[k]]);
        by_area[at] = by_area[at] + n;
        alike[at] = alike[at] + unit(n);
        if (std::isfinite(angle)) by_angle[at] = by_angle[at] + angle * unit(n);
      }
    }
  }
};

}  // namespace

void recognise(const Evidence& e, std::vector<Result>& results, KeptGuesses& kept) {
  if (e.lattice.size() > kRecognised) return;
  std::optional<Result> row;
  for (Result& r : results) {
    if (r.status != Status::kFinding) continue;
    if (r.check == "positions" || r.check == "refined-positions") row = origin_of_points(e, r, kept);
    if (r.check != "normals") continue;
    const std::string text = origin_of_normals(e);
    if (!text.empty()) r.message += (r.message.empty() ? "" : "; ") + text;
  }
  if (row) results.push_back(std::move(*row));
}

std::string origin_of_normals(std::span<const DeliveredNormal> normals, const data::ControlMesh& control,
                              std::span<const Vector> positions,
                              std::span<const std::array<std::int32_t, 3>> triangles,
                              std::span<const std::int32_t> point_of) {
  std::vector<std::int32_t> own(positions.size()), of_control(control.positions.size());
  for (std::size_t v = 0; v < own.size(); ++v) own[v] = point_of[v] < 0 ? -1 : static_cast<std::int32_t>(v);
  for (std::size_t v = 0; v < of_control.size(); ++v) of_control[v] = static_cast<std::int32_t>(v);
  const FacetMeans of_vertices(triangles, own, positions);
  const FacetMeans of_points(triangles, point_of, positions);
  std::vector<std::array<std::int32_t, 3>> cage;  // of triangles alone: other faces have no one normal
  if (control.faces.are_triangles()) cage = triangles_of(control).to_vector();
  const FacetMeans of_cage(cage, of_control, control.positions);

  const auto against = std::count_if(normals.begin(), normals.end(), [](const DeliveredNormal& n) {
    return dot(n.direction, n.expected) < 0;
  });
  const bool turned = 2 * against > static_cast<std::ptrdiff_t>(normals.size());
  using Guess = std::function<Vector(const DeliveredNormal&)>;
  // Root mean square angle from what is guessed; infinite where there is no such direction.
  const auto apart = [&](const Guess& guess) {
    double sum = 0;
    for (const DeliveredNormal& n : normals) {
      const double a = angle_degrees(turned ? -1. * n.direction : n.direction, guess(n));
      sum += a * a;
    }
    return std::sqrt(sum / static_cast<double>(normals.size()));
  };
  const auto corner = [&](const DeliveredNormal& n, int k) { return unit(of_cage.by_area[cage[n.face][k]]); };
  std::vector<std::pair<const char*, Guess>> guesses{
      {"averages of the facets around, weighted by area",
       [&](const auto& n) { return of_points.by_area[point_of[n.vertex]]; }},
      {"averages of the facets around, all alike",
       [&](const auto& n) { return of_points.alike[point_of[n.vertex]]; }},
      {"averages of the facets around, weighted by angle",
       [&](const auto& n) { return of_points.by_angle[point_of[n.vertex]]; }},
      {"the normals of single facets", [&](const auto& n) { return of_vertices.by_area[n.vertex]; }}};
  if (!cage.empty()) {
    guesses.emplace_back("the normals of the control mesh's faces", [&](const auto& n) {
      const auto& t = cage[n.face];
      return cross(control.positions[t[1]] - Vector(control.positions[t[0]]),
                   control.positions[t[2]] - Vector(control.positions[t[0]]));
    });
    guesses.emplace_back("the normals of the control mesh's vertices, interpolated", [&](const auto& n) {
      return (1 - n.l1 - n.l2) * corner(n, 0) + n.l1 * corner(n, 1) + n.l2 * corner(n, 2);
    });
  }
  std::string text = turned ? "most of them point the other way" : "";
  const double wrong = apart([](const DeliveredNormal& n) { return n.expected; });
  double least = kNearer * wrong;
  const char* best = nullptr;
  for (const auto& [name, guess] : guesses) {
    const double a = apart(guess);
    if (!(a < least)) continue;
    least = a;
    best = name;
  }
  if (best != nullptr)
    text += fmt::format(
        "{}they look like {}: {:.2g} degrees rms from those, {:.2g} from the normals of the limit surface",
        turned ? "; otherwise " : "", best, least, wrong);
  return text;
}

}  // namespace limitcheck::verify
