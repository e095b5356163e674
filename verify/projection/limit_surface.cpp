// SPDX-License-Identifier: MIT
#include "verify/projection/limit_surface.h"

#include <algorithm>

#include "data/error.h"
#include "reference/catmull_clark/refined_mesh.h"

namespace limitcheck::verify {
namespace {

bool has_other_faces(const data::ControlMesh& mesh) {
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    if (mesh.faces[f].size() != 4) return true;
  return false;
}

const data::ControlMesh& without_tags(const data::ControlMesh& mesh) {
  if (!mesh.sharpness.empty() || !mesh.holes.empty())
    throw data::ArgumentError(
        "the surface of a control mesh with sharp edges or holes is not searched for points");
  return mesh;
}

std::unique_ptr<const data::ControlMesh> refined_once(const data::ControlMesh& mesh, data::Scheme scheme) {
  if (scheme == data::Scheme::kLoop || !has_other_faces(mesh)) return nullptr;
  reference::catmull_clark::RefinedMesh<double> refined(mesh.faces, reference::positions_of<double>(mesh));
  refined.refine();
  auto quads = std::make_unique<data::ControlMesh>();
  for (const auto& p : refined.positions()) quads->positions.push_back(vector_of(p));
  quads->faces = refined.topology().faces();
  return quads;
}

std::vector<std::int32_t> faces_of_corners(const data::ControlMesh& mesh) {
  std::vector<std::int32_t> face;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    face.insert(face.end(), mesh.faces[f].size(), static_cast<std::int32_t>(f));
  return face;
}

}  // namespace

LimitSurface::LimitSurface(const data::ControlMesh& mesh, data::Scheme scheme)
    : control_(without_tags(mesh)),
      scheme_(scheme),
      refined_(refined_once(mesh, scheme)),
      control_face_(refined_ ? faces_of_corners(mesh) : std::vector<std::int32_t>()),
      domain_(this->mesh()),
      surface_(this->mesh(), scheme) {}

reference::SurfacePoint<double> LimitSurface::evaluate(const FacePoint& at, reference::Order order) const {
  double first = at.l[1], second = at.l[2];
  if (scheme_ == data::Scheme::kLoop && first + second > 1)
    (first > second ? second : first) = 1 - (first > second ? first : second);
  return surface_.evaluate(at.face, 0, first, second, order);
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
