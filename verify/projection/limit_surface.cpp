// SPDX-License-Identifier: MIT
#include "verify/projection/limit_surface.h"

#include <algorithm>
#include <cmath>

#include "reference/catmull_clark/recursion.h"
#include "reference/loop/refine.h"
#include "reference/mesh/sharpness.h"

namespace limitcheck::verify {
namespace {

bool has_other_faces(const data::ControlMesh& mesh) {
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    if (mesh.faces[f].size() != 4) return true;
  return false;
}

std::vector<std::int32_t> faces_of_corners(const data::ControlMesh& mesh) {
  std::vector<std::int32_t> face;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    face.insert(face.end(), mesh.faces[f].size(), static_cast<std::int32_t>(f));
  return face;
}

}  // namespace

std::unique_ptr<const LimitSurface::Refined> LimitSurface::refined_once(const data::ControlMesh& mesh,
                                                                        data::Scheme scheme) {
  if (scheme == data::Scheme::kLoop || !has_other_faces(mesh)) return nullptr;
  reference::catmull_clark::RefinedMesh<double> refined(mesh.faces, reference::positions_of<double>(mesh),
                                                        mesh.sharpness);
  const reference::Topology before = refined.topology();
  refined.refine();
  auto result = std::make_unique<Refined>();
  for (const auto& p : refined.positions()) result->mesh.positions.push_back(vector_of(p));
  result->mesh.faces = refined.topology().faces();
  if (!mesh.sharpness.empty())
    result->tags = reference::Sharpness(before, mesh.sharpness)
                       .refined(before, refined.topology())
                       .tags(refined.topology());
  return result;
}

LimitSurface::LimitSurface(const data::ControlMesh& mesh, data::Scheme scheme)
    : control_(mesh),
      scheme_(scheme),
      control_tags_(mesh.sharpness),
      refined_(refined_once(mesh, scheme)),
      control_face_(refined_ ? faces_of_corners(mesh) : std::vector<std::int32_t>()),
      domain_(this->mesh(), tags()),
      surface_(mesh, scheme) {
  if (mesh.holes.empty()) return;
  hole_.assign(mesh.faces.size(), false);
  for (const std::int32_t face : mesh.holes) hole_[face] = true;
}

reference::SurfacePoint<double> LimitSurface::evaluate(const FacePoint& at, reference::Order order) const {
  double first = at.l[1], second = at.l[2];
  if (!refined_) {
    // The way to a piece without semi-sharp tags doubles and subtracts: of multiples of 2^-52 exactly.
    if (scheme_ == data::Scheme::kLoop && !control_tags_.empty())
      for (double* l : {&first, &second}) *l = std::nearbyint(*l * 0x1p52) * 0x1p-52;
    // So that 1 - l1 - l2 is not negative by rounding; the difference from the larger is exact.
    if (scheme_ == data::Scheme::kLoop && second > 1 - first)
      (first > second ? second : first) = 1 - (first > second ? first : second);
    return surface_.evaluate(at.face, 0, first, second, order);
  }
  const std::int32_t face = control_face_[at.face];
  const int k = control_corner_of(at.face);
  if (!is_quarter(at.face)) return surface_.evaluate(face, k, first, second, order);
  const Chart::Affine corner = Chart::square().corner(k);
  auto point = surface_.evaluate(face, 0, (corner[1] + first) / 2, (corner[2] + second) / 2, order);
  reference::scale_derivatives(point, .5);
  return point;
}

// A quarter of a quad keeps the directions of u and v; the quad at a corner of another face begins there.
LimitSurface::ControlPoint LimitSurface::control_point(const FacePoint& at) const {
  if (at.face < 0) return {};
  if (!refined_) {
    const double most = scheme_ == data::Scheme::kLoop ? 1 - at.l[1] : 1;
    return {at.face, -1, at.l[1], std::min(at.l[2], most)};
  }
  const std::int32_t face = control_face_[at.face];
  const int k = control_corner_of(at.face);
  if (!is_quarter(at.face)) return {face, k, at.l[1], at.l[2]};
  const Chart::Affine corner = Chart::square().corner(k);
  return {face, -1, (corner[1] + at.l[1]) / 2, (corner[2] + at.l[2]) / 2};
}

FacePoint LimitSurface::at(const ControlPoint& point) const {
  const double u = point.first, v = point.second;
  if (!refined_) return {point.face, Chart::at(u, v)};
  const auto first = static_cast<std::int32_t>(control_.faces.first_corner(point.face));
  if (!is_quarter(first)) return {first + std::max(point.corner, 0), Chart::at(u, v)};
  const bool right = u > .5, up = v > .5;
  return {first + (up ? (right ? 2 : 3) : (right ? 1 : 0)),
          Chart::at(right ? 2 * u - 1 : 2 * u, up ? 2 * v - 1 : 2 * v)};
}

FacePoint LimitSurface::control_corner(std::int32_t face, int k) const {
  if (!refined_) return {face, domain_.chart().corner(k)};
  const auto quad = static_cast<std::int32_t>(control_.faces.first_corner(face)) + k;
  return {quad, Chart::square().corner(is_quarter(quad) ? k : 0)};
}

bool LimitSurface::on_control_edge(std::int32_t face, int side) const {
  if (!refined_) return true;
  const int corner = is_quarter(face) ? control_corner_of(face) : 0;
  return side == corner || side == (corner + 3) % 4;
}

}  // namespace limitcheck::verify
