// SPDX-License-Identifier: MIT
#include "verify/recognise/recognise.h"

#include <fmt/core.h>

#include "reference/catmull_clark/recursion.h"
#include "reference/loop/refine.h"
#include "verify/subject/face_domain.h"

namespace limitcheck::verify {
namespace {

std::uint32_t number(std::int64_t k) {
  return static_cast<std::uint32_t>(k);
}

template <class Refined>
SchemePoints points_of(const Refined& refined, bool limit) {
  SchemePoints result;
  for (const auto& p : limit ? refined.limits().positions : refined.positions())
    result.position.push_back(vector_of(p));
  result.place.assign(result.position.size(), {0, 0, 0, 0});
  return result;
}

// Loop's rule and Warren's by the reference, linear interpolation by the lattice itself.
SchemePoints triangle_points(const data::ControlMesh& mesh, GuessedRule scheme, int steps, bool limit) {
  const auto weights =
      scheme == GuessedRule::kWarren ? reference::Weights::kWarren : reference::Weights::kLoop;
  const auto refined = reference::refine<double>(mesh, steps, weights);
  SchemePoints result = points_of(refined, limit);
  const std::uint32_t n = 1U << steps;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    FaceDomain::triangle().for_each_point(n, [&](FaceDomain::Point p) {
      const std::int32_t v = refined.vertex(f, static_cast<int>(p.i), static_cast<int>(p.j));
      result.place[v] = {static_cast<std::int32_t>(f), number(p.i), number(p.j), n};
      if (scheme != GuessedRule::kLinear) return;
      const auto [a, b, c] = triangles_of(mesh)[f];
      const double l1 = static_cast<double>(p.i) / n, l2 = static_cast<double>(p.j) / n;
      result.position[v] =
          (1 - l1 - l2) * mesh.positions[a] + l1 * mesh.positions[b] + l2 * mesh.positions[c];
    });
  return result;
}

// After the first step a face is a quad at each corner. Of Loop's lattice only the points on control edges
// are among them, but for a few of no interest.
SchemePoints catmull_clark_points(const data::ControlMesh& mesh, int steps, bool limit,
                                  data::Scheme lattice) {
  reference::catmull_clark::RefinedMesh<double> refined(mesh.faces, reference::positions_of<double>(mesh),
                                                        mesh.sharpness);
  for (int step = 0; step < steps; ++step) refined.refine();
  SchemePoints result = points_of(refined, limit);
  const int n = 1 << steps;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto corners = static_cast<int>(mesh.faces[f].size());
    const FaceDomain quads(data::Scheme::kCatmullClark, corners), its(lattice, corners);
    quads.for_each_point(n, [&](FaceDomain::Point p) {
      const std::int32_t vertex = steps == 0 ? mesh.faces[f][*quads.corner_at(p, n)]
                                             : refined.vertex(f, static_cast<std::size_t>(p.part),
                                                              static_cast<int>(p.i), static_cast<int>(p.j));
      if (lattice == data::Scheme::kLoop) {
        const auto at = quads.side_of(p, n);
        if (!at) return;
        p = its.on_side(at->side, at->along, n);
      }
      result.place[vertex] = {static_cast<std::int32_t>(f), number(p.i), number(p.j),
                              number(std::max<std::int64_t>(its.denominator(n), 1)), p.part};
    });
  }
  return result;
}

}  // namespace

std::vector<Vector> scheme_points(const data::ControlMesh& mesh, GuessedRule scheme, int steps, bool limit) {
  return placed_scheme_points(mesh, scheme, steps, limit).position;
}

SchemePoints placed_scheme_points(const data::ControlMesh& mesh, GuessedRule scheme, int steps, bool limit,
                                  data::Scheme lattice) {
  if (scheme != GuessedRule::kCatmullClark) return triangle_points(mesh, scheme, steps, limit);
  return catmull_clark_points(mesh, steps, limit, lattice);
}

data::ControlMesh without_tags(const data::ControlMesh& mesh) {
  return {mesh.positions, mesh.faces, {}, mesh.holes};
}

Recognised recognised(GuessedRule scheme, int steps, bool limit, bool tags) {
  struct Words {
    const char *word, *rule;
  };
  constexpr Words kWords[] = {{"loop", "Loop's rule"},  // in the order of GuessedRule
                              {"warren", "Loop's rule with Warren's simplified weights"},
                              {"linear", "linear interpolation"},
                              {"catmull-clark", "Catmull and Clark's rule"}};
  const auto& [word, rule] = kWords[static_cast<std::size_t>(scheme)];
  const char* points = scheme == GuessedRule::kLinear ? "flat control mesh itself, by"
                       : limit                        ? "limit points of"
                                                      : "vertices of the control mesh refined by";
  return {fmt::format("the {} {} ({} step{})", points, rule, steps, steps == 1 ? "" : "s"), word, steps,
          limit, tags};
}

void say_recognised(Result& row, const Recognised& recognised, const Statistics& distances, double rounding,
                    const std::optional<Witness>& worst) {
  row.recognised = recognised;
  row.unit = "diagonal";
  row.bound = rounding;
  take(row, distances);
  row.message = recognised.what;
  if (row.bad == 0) return;
  row.witness = worst;
  row.message += fmt::format(", but {} of {} vertices are not", row.bad, row.of);
  if (row.worst) row.message += fmt::format(": up to {:.2g} diagonals off", *row.worst);
  if (worst && worst->face >= 0)
    row.message += fmt::format(", most at vertex {} in face {} at ({}, {})", worst->vertex, worst->where(),
                               worst->l1, worst->l2);
}

}  // namespace limitcheck::verify
