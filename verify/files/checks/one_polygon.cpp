// SPDX-License-Identifier: MIT
#include "verify/files/checks/one_polygon.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "verify/projection/box_tree.h"
#include "verify/projection/surface_lattice.h"

namespace limitcheck::verify {
namespace {

// Triangles that lie together. Few are gone through, many are found by their boxes.
class Polygon {
 public:
  explicit Polygon(std::vector<std::array<Vector, 3>> triangles) : triangles_(std::move(triangles)) {
    if (triangles_.size() <= kFew) return;
    std::vector<BoxTree::Box> boxes;
    boxes.reserve(triangles_.size());
    for (const auto& t : triangles_) boxes.push_back(BoxTree::around({t[0], t[1], t[2]}));
    tree_.emplace(boxes);
  }

  double distance(const Vector& p) const {
    double least = std::numeric_limits<double>::infinity();
    const auto look = [&](std::size_t k) {
      return least = std::min(least, closest_on_triangle(p, triangles_[k]).distance);
    };
    if (tree_) tree_->near(p, look);
    for (std::size_t k = 0; k < triangles_.size() && !tree_; ++k) look(k);
    return least;
  }

 private:
  static constexpr std::size_t kFew = 16;
  std::vector<std::array<Vector, 3>> triangles_;
  std::optional<BoxTree> tree_;
};

// A control face as one flat polygon of the limits of its corners, cut as files are: a fan from the first.
std::vector<std::array<Vector, 3>> one_polygon(const FileEvidence& e, std::int32_t face) {
  const LimitSurface& surface = e.surface.surface();
  std::vector<Vector> corner;
  for (std::size_t k = 0; k < e.control.faces[face].size(); ++k)
    corner.push_back(e.surface.at(surface.control_corner(face, static_cast<int>(k)), {}).position);
  std::vector<std::array<Vector, 3>> fan;
  for (std::size_t k = 1; k + 1 < corner.size(); ++k) fan.push_back({corner[0], corner[k], corner[k + 1]});
  return fan;
}

}  // namespace

double from_one_polygon_each(const FileEvidence& e) {
  std::vector<std::optional<Polygon>> polygons(e.control.faces.size());
  tbb::parallel_for(std::size_t{0}, polygons.size(), [&](std::size_t f) {
    polygons[f].emplace(one_polygon(e, static_cast<std::int32_t>(f)));
  });
  const LimitSurface& surface = e.surface.surface();
  const SurfaceLattice& lattice = e.surface.lattice();
  std::vector<double> apart(static_cast<std::size_t>(e.surface.domain().face_count()), 0);
  const std::size_t per_face = lattice.size() / apart.size();
  tbb::parallel_for(std::size_t{0}, apart.size(), [&](std::size_t f) {
    const auto face = static_cast<std::int32_t>(f);
    if (surface.is_hole(face)) return;
    const Polygon& polygon = *polygons[surface.control_face(face)];
    for (std::size_t k = f * per_face; k < (f + 1) * per_face; ++k)
      for (const Vector& corner : lattice.corners(k))
        apart[f] = std::max(apart[f], polygon.distance(corner) + lattice.deviation(k));
  });
  return *std::max_element(apart.begin(), apart.end());
}

}  // namespace limitcheck::verify
