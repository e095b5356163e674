// SPDX-License-Identifier: MIT
#include "verify/projection/closest_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "data/bounding_box.h"
#include "verify/interrupt/interrupt.h"
#include "verify/projection/newton.h"
#include "verify/projection/triangle.h"

namespace limitcheck::verify {
namespace {

constexpr int kCuts = 12;  // as dear as one descent, about

// Of the pieces of the surface, not of the flat triangles.
std::vector<BoxTree::Box> boxes(const SurfaceLattice& lattice) {
  std::vector<BoxTree::Box> list(lattice.size());
  for (std::size_t t = 0; t < list.size(); ++t) {
    const auto c = lattice.corners(t);
    list[t] = BoxTree::around({c[0], c[1], c[2]}, lattice.deviation(t));
  }
  return list;
}

// Whether the surface over a piece may be nearer to p than `distance`, as far as so many cuts tell.
bool may_be_nearer(const SurfaceLattice& lattice, const LimitSurface& surface, const Piece& piece,
                   const Vector& p, double distance, int& cuts) {
  if (closest_on_triangle(p, piece.corner).distance - piece.deviation >= distance) return false;
  if (cuts-- <= 0) return true;
  const auto children = lattice.split(piece, surface);
  return std::any_of(children.begin(), children.end(), [&](const Piece& child) {
    return may_be_nearer(lattice, surface, child, p, distance, cuts);
  });
}

}  // namespace

ClosestPoint::ClosestPoint(const data::ControlMesh& mesh, data::Scheme scheme, std::size_t pieces)
    : surface_(mesh, scheme),
      lattice_(surface_.mesh(), SurfaceLattice::depth_for(surface_.mesh(), pieces, surface_.tags()),
               surface_.tags()),
      tree_(boxes(lattice_)),
      diagonal_(data::box_diagonal(mesh)) {}

Foot ClosestPoint::at(const FacePoint& where, const Vector& p) const {
  const auto s = surface_.evaluate(where, reference::Order::kFirst);
  Foot foot;
  foot.at = where;
  foot.position = vector_of(s.position);
  foot.normal = vector_of(s.normal);
  foot.has_normal = s.normal_kind == reference::NormalKind::kRegular;
  foot.distance = norm(p - foot.position);
  return foot;
}

Piece ClosestPoint::nearest_flat(const Vector& p, OnTriangle& flat) const {
  std::size_t nearest = 0;
  flat.distance = std::numeric_limits<double>::infinity();
  tree_.near(p, [&](std::size_t index) {
    const OnTriangle here = closest_on_triangle(p, lattice_.corners(index));
    if (here.distance < flat.distance) {
      flat = here;
      nearest = index;
    }
    return flat.distance;
  });
  return lattice_.piece(nearest);
}

double ClosestPoint::at_most(const Vector& p) const {
  OnTriangle flat;
  const Piece piece = nearest_flat(p, flat);
  double least = descend(surface_, p, piece.parameter(flat.weight), diagonal_, true).distance;
  for (const Vector& corner : piece.corner) least = std::min(least, norm(p - corner));
  return least;
}

std::optional<Foot> ClosestPoint::on_surface(const Vector& p, double within) const {
  OnTriangle flat;
  const Piece piece = nearest_flat(p, flat);
  if (flat.distance > within + piece.deviation) return std::nullopt;
  const Minimum found = descend(surface_, p, piece.parameter(flat.weight), diagonal_, true);
  // Next to an extraordinary vertex Newton's iteration may end nearby; the vertex itself is on the surface.
  for (int k = 0; k < 3; ++k)
    if (const double d = norm(p - piece.corner[k]);
        d <= within && d <= found.distance && domain().chart().corner_at(piece.at[k]) >= 0)
      return at({piece.face, piece.at[k]}, p);
  if (!found.stationary || found.distance > within) return std::nullopt;
  return at(found.at, p);
}

Foot ClosestPoint::closest(const Vector& p, double enough) const {
  // A nearer point that could only be nearer by rounding is not worth looking for.
  const double rounding = 1e-16 * diagonal_;
  Minimum best;
  best.distance = std::numeric_limits<double>::infinity();
  double at_least = best.distance;
  int descents = 0;
  tree_.near(p, [&](std::size_t index) {
    end_if_interrupted();
    const auto corners = lattice_.corners(index);
    const OnTriangle flat = closest_on_triangle(p, corners);
    const double bound = flat.distance - lattice_.deviation(index);
    at_least = std::min(at_least, bound);
    if (bound >= best.distance - rounding) return best.distance - rounding;

    const Piece piece = lattice_.piece(index);
    for (int k = 0; k < 3; ++k) {  // where Newton's iteration may be slow: at extraordinary vertices
      const double d = norm(p - corners[k]);
      if (d >= best.distance) continue;
      FacePoint corner{piece.face, piece.at[k]};
      best = {corner, corners[k], d, false};
    }
    if (best.distance <= std::max(rounding, enough)) return 0.0;
    int cuts = best.stationary ? kCuts : 0;
    if (!may_be_nearer(lattice_, surface_, piece, p, best.distance - rounding, cuts))
      return best.distance - rounding;
    if (descents++ < 256) {
      // Where Newton's iteration fails, the slow search is for the first minimum: others that it alone would
      // find lie at kinks of the surface, which corners of pieces show too.
      const Minimum found = descend(surface_, p, piece.parameter(flat.weight), diagonal_, best.stationary);
      if (found.distance < best.distance || (found.stationary && found.distance <= best.distance + rounding))
        best = found;
    }
    return best.distance <= enough ? 0.0 : best.distance - rounding;
  });
  Foot foot = at(best.at, p);
  const bool ended_early = enough > 0 && best.distance <= enough;
  foot.at_least = ended_early || foot.distance <= rounding ? 0 : std::clamp(at_least, 0.0, foot.distance);
  const bool at_corner = domain().chart().corner_at(best.at.l) >= 0;
  foot.stationary = best.stationary || foot.distance <= rounding ||
                    (at_corner && norm(cross(p - foot.position, foot.normal)) <= 1e-12 * diagonal_);
  return foot;
}

}  // namespace limitcheck::verify
