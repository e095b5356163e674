// SPDX-License-Identifier: MIT
#include "verify/projection/limit_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_set>

#include "reference/catmull_clark/refined_mesh.h"
#include "reference/loop/refine.h"
#include "verify/interrupt/interrupt.h"
#include "verify/projection/cut_mesh.h"

namespace limitcheck::verify {
namespace {

constexpr int kLevels = 14;

using reference::Topology;
using Points = std::vector<reference::Vec3<double>>;

// Some faces of a mesh, turned so that they begin at vertex 0 if they have it, and all faces that touch one of
// their corners. Vertex `centre` becomes vertex 0.
Part around(const Topology& topology, const Points& positions, std::int32_t centre,
            std::span<const std::int32_t> first) {
  std::vector<std::int32_t> faces(first.begin(), first.end());
  std::unordered_set<std::int32_t> known(first.begin(), first.end());
  for (const std::int32_t f : first)
    for (const std::int32_t v : topology.faces()[f])
      if (v != centre)
        for (const std::int32_t near : topology.sector(v).faces)
          if (known.insert(near).second) faces.push_back(near);
  Part part(topology, positions, centre, faces);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const std::span<std::int32_t> corners = part.faces[f];
    if (const auto at = std::find(corners.begin(), corners.end(), 0); at != corners.end())
      std::rotate(corners.begin(), at, corners.end());
  }
  return part;
}

// One step of a part, of which the first `count` faces are those at vertex 0. Their first children follow at
// every fourth place: at the corner where the face begins.
template <class Refined>
Part step(Refined refined, std::size_t count) {
  refined.refine();
  std::vector<std::int32_t> first;
  for (std::size_t f = 0; f < count; ++f) first.push_back(static_cast<std::int32_t>(4 * f));
  return around(refined.topology(), refined.positions(), 0, first);
}

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

/// The limit surface near a vertex of very many faces, in a time that does not grow with their number.
///
/// Stam's method sums over as many modes as the vertex has faces, for each point near it. But the mesh around
/// the vertex after j steps has the same surface, and on its faces at the vertex Stam's method takes the
/// points of the outer three quarters from polynomials. So a point is evaluated on the mesh after the steps
/// that bring it there; positions differ from Stam's by the rounding of these steps.
class HighValenceVertex {
 public:
  /// Of a mesh without sharp edges. O(faces at the vertex) steps, and what the evaluator costs, for each level.
  HighValenceVertex(const data::ControlMesh& mesh, const Topology& topology, data::Scheme scheme,
                    std::int32_t vertex)
      : loop_(scheme == data::Scheme::kLoop) {
    const auto sector = topology.sector(vertex).faces;
    faces_.assign(sector.begin(), sector.end());
    std::sort(faces_.begin(), faces_.end());
    Points positions;
    for (const auto& p : mesh.positions) positions.push_back({p[0], p[1], p[2]});
    Part part = around(topology, positions, vertex, faces_);
    levels_.reserve(kLevels);
    for (int level = 0; level < kLevels; ++level) {
      end_if_interrupted();
      if (loop_)
        part = step(reference::RefinedMesh<double>(part.positions, data::Triangles(part.faces).to_vector()),
                    faces_.size());
      else
        part = step(reference::catmull_clark::RefinedMesh<double>(part.faces, part.positions), faces_.size());
      Level& its = levels_.emplace_back();
      for (const auto& p : part.positions) its.mesh.positions.push_back(vector_of(p));
      its.mesh.faces = part.faces;
      its.surface = std::make_unique<reference::Surface>(its.mesh, scheme);
    }
  }

  /// At a point of a face at the vertex, with the derivatives by the second and third coordinate of `at`.
  ///   corner   of the face that is the vertex
  /// Nothing where the mesh itself has polynomials, and very near the vertex.
  std::optional<reference::SurfacePoint<double>> evaluate(std::int32_t face, int corner,
                                                          const Chart::Affine& at,
                                                          reference::Order order) const {
    const Chart chart = loop_ ? Chart::triangle() : Chart::square();
    const auto [px, py] = chart.from_corner(corner, {std::max(0., at[0]), at[1], at[2]}, 1);
    // How often the distance from the corner, measured as the schemes do, is to be doubled to exceed 1/2.
    const double far = loop_ ? px + py : std::max(px, py);
    if (!(far > 0) || far > .5) return std::nullopt;
    int exponent = 0;
    const double mantissa = std::frexp(far, &exponent);
    const int steps = mantissa == .5 ? 1 - exponent : -exponent;
    if (steps < 1 || steps > kLevels) return std::nullopt;
    double x = std::ldexp(px, steps), y = std::ldexp(py, steps);
    if (loop_ && y > 1 - x) (x > y ? y : x) = 1 - (x > y ? x : y);
    const auto which = std::lower_bound(faces_.begin(), faces_.end(), face) - faces_.begin();
    const auto& surface = *levels_[static_cast<std::size_t>(steps - 1)].surface;
    auto s = surface.evaluate(static_cast<int>(which), 0, x, y, order);
    reference::scale_derivatives(s, std::ldexp(1.0, steps));
    const auto turned = s;
    const auto [a1, b1] = chart.from_corner(corner, {-1, 1, 0}, 0);  // of x and y by either coordinate
    const auto [a2, b2] = chart.from_corner(corner, {-1, 0, 1}, 0);
    s.d1 = turned.d1 * a1 + turned.d2 * b1;
    s.d2 = turned.d1 * a2 + turned.d2 * b2;
    s.t1 = s.d1, s.t2 = s.d2;
    s.d11 = turned.d11 * (a1 * a1) + turned.d12 * (2 * a1 * b1) + turned.d22 * (b1 * b1);
    s.d12 = turned.d11 * (a1 * a2) + turned.d12 * (a1 * b2 + a2 * b1) + turned.d22 * (b1 * b2);
    s.d22 = turned.d11 * (a2 * a2) + turned.d12 * (2 * a2 * b2) + turned.d22 * (b2 * b2);
    return s;
  }

 private:
  struct Level {
    data::ControlMesh mesh;
    std::unique_ptr<reference::Surface> surface;
  };

  bool loop_;
  std::vector<std::int32_t> faces_;  // at the vertex, ascending; they are the first of each level's, in order
  std::vector<Level> levels_;        // after 1, 2 .. steps
};

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
  look_for_high_valences();
  if (mesh.holes.empty()) return;
  hole_.assign(mesh.faces.size(), false);
  for (const std::int32_t face : mesh.holes) hole_[face] = true;
}

// Vertices of so many faces that the sums over all of them are what evaluation costs.
void LimitSurface::look_for_high_valences() {
  constexpr std::size_t kMany = 40;
  if (!tags().empty()) return;
  std::optional<Topology> topology;
  for (std::size_t v = 0; v < mesh().positions.size(); ++v) {
    const auto vertex = static_cast<std::int32_t>(v);
    if (domain_.faces_at(vertex).size() <= kMany) continue;
    if (!topology) {
      topology.emplace(mesh().positions.size(), mesh().faces);
      high_valence_.resize(mesh().positions.size());
    }
    high_valence_[v] = std::make_shared<const HighValenceVertex>(mesh(), *topology, scheme_, vertex);
  }
}

std::optional<reference::SurfacePoint<double>> LimitSurface::near_high_valence(const FacePoint& at,
                                                                               reference::Order order) const {
  if (high_valence_.empty()) return std::nullopt;
  for (int k = 0; k < domain_.chart().corners(); ++k)
    if (const auto& its = high_valence_[domain_.vertex(at.face, k)])
      if (auto point = its->evaluate(at.face, k, at.l, order)) return point;
  return std::nullopt;
}

reference::SurfacePoint<double> LimitSurface::evaluate(const FacePoint& at, reference::Order order) const {
  if (auto point = near_high_valence(at, order)) return *point;
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
