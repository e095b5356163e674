// SPDX-License-Identifier: MIT
#include "verify/recognise/normal_origin.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace limitcheck::verify {
namespace {

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
