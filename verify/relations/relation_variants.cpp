// SPDX-License-Identifier: MIT
#include "verify/relations/relation_variants.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "data/splitmix64.h"

namespace limitcheck::verify {

Variant identity(const Evidence& e) {
  Variant v;
  static_cast<Rewriting&>(v) = Rewriting(e.mesh, e.lattice.scheme());
  v.name = "as it was";
  v.face_depth.assign(e.face_depth.begin(), e.face_depth.end());
  v.position = v.normal = [](const Vector& p) { return p; };
  v.magnitude = e.magnitude;
  return v;
}

namespace {

Variant face_order(const Evidence& e) {
  Variant v = identity(e);
  v.name = "with its faces in another order";
  data::SplitMix64 random(1);
  v.order_faces(shuffled(v.face.size(), random));
  for (std::size_t f = 0; f < v.face.size(); ++f) v.face_depth[f] = e.face_depth[v.face[f]];
  v.same_numbers = true;
  return v;
}

Variant vertex_order(const Evidence& e) {
  Variant v = identity(e);
  v.name = "with its vertices numbered otherwise";
  data::SplitMix64 random(2);
  v.number_vertices(shuffled(e.mesh.positions.size(), random));
  v.same_numbers = true;
  return v;
}

Variant corner_rotation(const Evidence& e) {
  Variant v = identity(e);
  v.name = "with its faces begun at other corners";
  data::SplitMix64 random(3);
  for (std::size_t f = 0; f < v.face.size(); ++f) {
    const auto others = static_cast<std::uint64_t>(v.mesh.faces[f].size()) - 1;
    v.turn_face(f, 1 + static_cast<int>(random.next() % others));
  }
  v.same_numbers = true;
  return v;
}

void move(Variant& v, const std::function<Vector(const Vector&)>& there) {
  v.magnitude = 0;
  for (Vector& p : v.mesh.positions) {
    p = there(p);
    v.magnitude = std::max(v.magnitude, largest(p));
  }
}

Variant mirror(const Evidence& e) {
  Variant v = identity(e);
  v.name = "mirrored";
  const auto flip = [](const Vector& p) { return Vector{-p[0], p[1], p[2]}; };
  move(v, flip);
  v.mirror_faces();
  v.position = v.normal = flip;
  return v;
}

Variant rotation(const Evidence& e) {
  Variant v = identity(e);
  v.name = "turned";
  move(v, [](const Vector& p) { return Vector{p[1], -p[2], -p[0]}; });
  v.position = v.normal = [](const Vector& p) { return Vector{-p[2], p[0], -p[1]}; };
  return v;
}

Variant scaling(const Evidence& e, int exponent) {
  Variant v = identity(e);
  v.name = fmt::format("times 2^{}", exponent);
  const auto times = [](int k) {
    return [k](const Vector& p) {
      return Vector{std::ldexp(p[0], k), std::ldexp(p[1], k), std::ldexp(p[2], k)};
    };
  };
  move(v, times(exponent));
  v.magnitude = e.magnitude;  // compared after scaling back
  v.position = times(-exponent);
  v.same_numbers = true;
  return v;
}

Variant translation(const Evidence& e) {
  Variant v = identity(e);
  v.name = "moved";
  const double step = std::ldexp(1.0, std::ilogb(std::max(e.diagonal, 1e-30)));
  const Vector by{step, -2 * step, 3 * step};
  move(v, [&](const Vector& p) { return p + by; });
  v.position = [by](const Vector& p) { return p - by; };
  v.normals = false;
  return v;
}

}  // namespace

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
      {"translation", [](const Evidence& e) { return Variants{translation(e)}; }},
  };
  return all;
}

}  // namespace limitcheck::verify
