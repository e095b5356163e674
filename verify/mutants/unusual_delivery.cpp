// SPDX-License-Identifier: MIT
#include "verify/mutants/unusual_delivery.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

#include "data/splitmix64.h"

namespace limitcheck::verify {
namespace {

template <class Real>
void push_vertex(DeliveredCopy<Real>& out, const DeliveredCopy<Real>& from, std::size_t v) {
  out.positions.push_back(from.positions[v]);
  if (!from.normals.empty()) out.normals.push_back(from.normals[v]);
  out.provenance.push_back(from.provenance[v]);
}

template <class Real>
void soup(DeliveredCopy<Real>& out) {
  DeliveredCopy<Real> apart;
  apart.triangle_face = out.triangle_face;
  for (const auto& t : out.triangles) {
    auto& triangle = apart.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      triangle[k] = static_cast<std::uint32_t>(apart.positions.size());
      push_vertex(apart, out, t[k]);
    }
  }
  out = std::move(apart);
}

std::vector<std::size_t> shuffled(std::size_t count) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), 0);
  data::SplitMix64 random(count);
  for (std::size_t k = count; k > 1; --k) std::swap(order[k - 1], order[random.next() % k]);
  return order;
}

template <class Real>
void shuffle(DeliveredCopy<Real>& out) {
  DeliveredCopy<Real> mixed;
  std::vector<std::uint32_t> to(out.positions.size());
  for (const std::size_t v : shuffled(out.positions.size())) {
    to[v] = static_cast<std::uint32_t>(mixed.positions.size());
    push_vertex(mixed, out, v);
  }
  for (const std::size_t t : shuffled(out.triangles.size())) {
    auto triangle = out.triangles[t];
    for (std::uint32_t& v : triangle) v = to[v];
    std::rotate(triangle.begin(), triangle.begin() + static_cast<std::ptrdiff_t>(t % 3), triangle.end());
    mixed.triangles.push_back(triangle);
    mixed.triangle_face.push_back(out.triangle_face[t]);
  }
  out = std::move(mixed);
}

// Two triangles (a, b, c) and (c, b, d) of one face that make a parallelogram of the lattice become (a, b, d)
// and (a, d, c).
template <class Real>
void cut_otherwise(DeliveredCopy<Real>& out) {
  std::map<std::array<std::int64_t, 3>, std::size_t> waiting;  // face and edge -> triangle
  const auto place = [&](std::uint32_t v) { return out.provenance[v]; };
  const auto sum_is_same = [&](std::uint32_t a, std::uint32_t d, std::uint32_t b, std::uint32_t c) {
    const auto twice = [&](std::uint32_t u, std::uint32_t v, std::uint32_t lc_provenance::*l) {
      return std::uint64_t{place(u).*l} * place(v).denominator +
             std::uint64_t{place(v).*l} * place(u).denominator;
    };
    const auto same = [&](std::uint32_t lc_provenance::*l) {
      return twice(a, d, l) * place(b).denominator * place(c).denominator ==
             twice(b, c, l) * place(a).denominator * place(d).denominator;
    };
    return same(&lc_provenance::i) && same(&lc_provenance::j);
  };
  const auto in_face = [&](std::uint32_t v, std::size_t t) { return place(v).face == out.triangle_face[t]; };
  for (std::size_t t = 0; t < out.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [c, b, d] =
          std::array{out.triangles[t][k], out.triangles[t][(k + 1) % 3], out.triangles[t][(k + 2) % 3]};
      const auto other = waiting.find({out.triangle_face[t], b, c});
      if (other == waiting.end()) continue;
      auto& first = out.triangles[other->second];
      const auto at = static_cast<std::size_t>(std::find(first.begin(), first.end(), b) - first.begin());
      const std::uint32_t a = first[(at + 2) % 3];
      if (!in_face(a, t) || !in_face(b, t) || !in_face(c, t) || !in_face(d, t) || !sum_is_same(a, d, b, c))
        continue;
      waiting.erase(other);
      first = {a, b, d};
      out.triangles[t] = {a, d, c};
      break;
    }
    for (std::size_t k = 0; k < 3; ++k)
      waiting[{out.triangle_face[t], out.triangles[t][k], out.triangles[t][(k + 1) % 3]}] = t;
  }
}

// Points on a control edge, or at a vertex, named by another face that touches them; not by one beyond an edge that
// stays sharp, whose normals are others.
template <class Real>
void name_other_faces(const data::ControlMesh& mesh, DeliveredCopy<Real>& out) {
  std::map<std::pair<std::int32_t, std::int32_t>, std::pair<std::int32_t, std::size_t>> edges;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k)
      edges[{triangles_of(mesh)[f][k], triangles_of(mesh)[f][(k + 1) % 3]}] = {static_cast<std::int32_t>(f),
                                                                               k};
  for (const data::SharpEdge& e : mesh.sharpness.edges)
    if (e.sharpness >= data::kInfiniteSharpness) edges.erase({e.a, e.b}), edges.erase({e.b, e.a});
  for (lc_provenance& p : out.provenance) {
    const std::array<std::uint32_t, 3> l{p.denominator - p.i - p.j, p.i, p.j};
    const auto& t = triangles_of(mesh)[p.face];
    for (std::size_t k = 0; k < 3; ++k) {
      if (l[(k + 2) % 3] != 0) continue;
      const auto beyond = edges.find({t[(k + 1) % 3], t[k]});
      if (beyond == edges.end()) continue;
      const auto [face, first] = beyond->second;
      std::array<std::uint32_t, 3> there{};
      there[first] = l[(k + 1) % 3];
      there[(first + 1) % 3] = l[k];
      p = {face, there[1], there[2], p.denominator};
      break;
    }
  }
}

}  // namespace

template <class Real>
void rearrange(std::string_view habit, const data::ControlMesh& mesh, DeliveredCopy<Real>& out) {
  if (habit == "soup") soup(out);
  if (habit == "shuffled") shuffle(out);
  if (habit == "other_diagonals") cut_otherwise(out);
  if (habit == "any_face") name_other_faces(mesh, out);
  if (habit == "large_denominators")
    for (lc_provenance& p : out.provenance)
      if (p.denominator != 3) p = {p.face, 2 * p.i, 2 * p.j, 2 * p.denominator};
  if (habit == "unused_vertices") {
    const DeliveredCopy<Real> all = out;
    for (std::size_t v = 0; v < all.positions.size(); v += 3) push_vertex(out, all, v);
  }
  if (habit == "negative_zeros")
    for (auto* list : {&out.positions, &out.normals})
      for (auto& p : *list)
        for (Real& x : p)
          if (x == 0) x = -Real(0);
}

template void rearrange(std::string_view, const data::ControlMesh&, DeliveredCopy<float>&);
template void rearrange(std::string_view, const data::ControlMesh&, DeliveredCopy<double>&);

}  // namespace limitcheck::verify
