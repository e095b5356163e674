// SPDX-License-Identifier: MIT
#include "verify/relations/variants.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
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

Variant face_order(const Evidence& e) {
  return variant(e, "with its faces in another order", true, [&](Variant& v) {
    data::SplitMix64 random(1);
    v.order_faces(shuffled(v.face.size(), random));
    for (std::size_t f = 0; f < v.face.size(); ++f) v.face_depth[f] = e.face_depth[v.face[f]];
  });
}

Variant vertex_order(const Evidence& e) {
  return variant(e, "with its vertices numbered otherwise", true, [&](Variant& v) {
    data::SplitMix64 random(2);
    v.number_vertices(shuffled(e.mesh.positions.size(), random));
  });
}

Variant corner_rotation(const Evidence& e) {
  return variant(e, "with its faces begun at other corners", true, [&](Variant& v) {
    data::SplitMix64 random(3);
    for (std::size_t f = 0; f < v.face.size(); ++f) {
      const auto others = static_cast<std::uint64_t>(v.mesh.faces[f].size()) - 1;
      v.turn_face(f, 1 + static_cast<int>(random.next() % others));
    }
  });
}

void move(Variant& v, const std::function<Vector(const Vector&)>& there) {
  v.magnitude = 0;
  for (Vector& p : v.mesh.positions) {
    p = there(p);
    v.magnitude = std::max(v.magnitude, largest(p));
  }
}

Variant mirror(const Evidence& e) {
  return variant(e, "mirrored", false, [](Variant& v) {
    v.position = v.normal = [](const Vector& p) { return Vector{-p[0], p[1], p[2]}; };
    move(v, v.position);
    v.mirror_faces();
  });
}

Variant rotation(const Evidence& e) {
  return variant(e, "turned", false, [](Variant& v) {
    move(v, [](const Vector& p) { return Vector{p[1], -p[2], -p[0]}; });
    v.position = v.normal = [](const Vector& p) { return Vector{-p[2], p[0], -p[1]}; };
  });
}

Variant scaling(const Evidence& e, int exponent) {
  return variant(e, fmt::format("times 2^{}", exponent), true, [&](Variant& v) {
    const auto times = [](int k) {
      return [k](const Vector& p) {
        return Vector{std::ldexp(p[0], k), std::ldexp(p[1], k), std::ldexp(p[2], k)};
      };
    };
    move(v, times(exponent));
    v.magnitude = e.magnitude;  // compared after scaling back
    v.position = times(-exponent);
  });
}

// By some diagonals, times 2^exponent.
Variant translation(const Evidence& e, int exponent) {
  return variant(e, exponent == 0 ? "moved" : "moved far away", false, [&](Variant& v) {
    const double step = std::ldexp(1.0, std::ilogb(std::max(e.diagonal, 1e-30)) + exponent);
    const Vector by{step, -2 * step, 3 * step};
    move(v, [&](const Vector& p) { return p + by; });
    v.position = [by](const Vector& p) { return p - by; };
    v.normals = false;
  });
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

Variant identity(const Evidence& e) {
  Variant v;
  static_cast<Rewriting&>(v) = Rewriting(e.mesh, e.lattice.scheme());
  v.name = "as it was";
  v.face_depth.assign(e.face_depth.begin(), e.face_depth.end());
  v.position = v.normal = [](const Vector& p) { return p; };
  v.magnitude = e.magnitude;
  return v;
}

Variant variant(const Evidence& e, std::string name, bool same_numbers,
                const std::function<void(Variant&)>& change) {
  Variant v = identity(e);
  v.name = std::move(name);
  v.same_numbers = same_numbers;
  change(v);
  return v;
}

const std::vector<Relation>& variant_relations() {
  using Variants = std::vector<Variant>;
  static const std::vector<Relation> all{
      {"face-order", [](const Evidence& e) { return Variants{face_order(e)}; }},
      {"vertex-order", [](const Evidence& e) { return Variants{vertex_order(e)}; }},
      {"corner-rotation", [](const Evidence& e) { return Variants{corner_rotation(e)}; }},
      {"mirror", [](const Evidence& e) { return Variants{mirror(e)}; }},
      {"rotation", [](const Evidence& e) { return Variants{rotation(e)}; }},
      {"scaling",
       [](const Evidence& e) {
         return Variants{scaling(e, 10), scaling(e, -10), scaling(e, 40), scaling(e, -40)};
       }},
      {"translation",
       [](const Evidence& e) {
         const int far = e.capabilities.precision == LC_FLOAT32 ? 10 : 20;  // some bits are left
         return Variants{translation(e, 0), translation(e, far)};
       }},
  };
  return all;
}

}  // namespace limitcheck::verify
