// SPDX-License-Identifier: MIT
#include "verify/relations/rewriting.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace limitcheck::verify {
namespace {

template <class T>
std::vector<T> in_order(const std::vector<T>& list, const std::vector<std::int32_t>& order) {
  std::vector<T> result;
  result.reserve(list.size());
  for (const std::int32_t k : order) result.push_back(list[k]);
  return result;
}

}  // namespace

std::vector<std::int32_t> shuffled(std::size_t count, data::SplitMix64& random) {
  std::vector<std::int32_t> order(count);
  std::iota(order.begin(), order.end(), 0);
  for (std::size_t k = count; k > 1; --k) std::swap(order[k - 1], order[random.next() % k]);
  return order;
}

Rewriting::Rewriting(data::ControlMesh original, data::Scheme of_scheme)
    : mesh(std::move(original)), scheme(of_scheme) {
  face.resize(mesh.faces.size());
  std::iota(face.begin(), face.end(), 0);
  symmetry.resize(face.size());
}

void Rewriting::number_vertices(const std::vector<std::int32_t>& number) {
  const auto positions = mesh.positions;
  for (std::size_t v = 0; v < number.size(); ++v) mesh.positions[number[v]] = positions[v];
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (std::int32_t& v : mesh.faces[f]) v = number[v];
  for (data::SharpEdge& e : mesh.sharpness.edges) e = {number[e.a], number[e.b], e.sharpness};
  for (data::SharpVertex& v : mesh.sharpness.vertices) v.vertex = number[v.vertex];
}

void Rewriting::order_faces(const std::vector<std::int32_t>& order) {
  data::Faces faces;
  for (const std::int32_t f : order) faces.push_back(std::as_const(mesh.faces)[f]);
  mesh.faces = std::move(faces);
  face = in_order(face, order);
  symmetry = in_order(symmetry, order);
}

void Rewriting::turn_face(std::size_t f, int first) {
  const auto corners = mesh.faces[f];
  std::rotate(corners.begin(), corners.begin() + first, corners.end());
  symmetry[f].first = FaceDomain(scheme, static_cast<int>(corners.size())).corner(first, symmetry[f]);
}

void Rewriting::mirror_faces() {
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    std::reverse(mesh.faces[f].begin() + 1, mesh.faces[f].end());
  for (auto& s : symmetry) s.mirrored = !s.mirrored;
}

Place Rewriting::original(const Place& p) const {
  const FaceDomain domain(scheme, static_cast<int>(mesh.faces[p.face].size()));
  const FaceDomain::Point at = domain.moved(point_of(p), domain.steps(p.denominator), symmetry[p.face]);
  return {face[p.face], static_cast<std::uint32_t>(at.i), static_cast<std::uint32_t>(at.j), p.denominator,
          at.part};
}

}  // namespace limitcheck::verify
