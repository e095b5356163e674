// SPDX-License-Identifier: MIT
#include "verify/relations/variants.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

#include "reference/mesh/sharpness.h"
#include "reference/mesh/topology.h"

namespace limitcheck::verify {
namespace {

template <class T>
std::vector<T> in_order(const std::vector<T>& list, const std::vector<std::int32_t>& order) {
  std::vector<T> result;
  result.reserve(list.size());
  for (const std::int32_t k : order) result.push_back(list[k]);
  return result;
}

void face_order(const Evidence& e, Variant& v) {
  data::SplitMix64 random(1);
  v.order_faces(shuffled(v.face.size(), random));
  for (std::size_t f = 0; f < v.face.size(); ++f) v.face_depth[f] = e.face_depth[v.face[f]];
}

void vertex_order(const Evidence& e, Variant& v) {
  data::SplitMix64 random(2);
  v.number_vertices(shuffled(e.mesh.positions.size(), random));
}

// Some stay as they are, so that faces meet in every way; the first does not, or a mesh of few may be the same.
void corner_rotation(const Evidence&, Variant& v) {
  data::SplitMix64 random(3);
  for (std::size_t f = 0; f < v.face.size(); ++f) {
    const auto corners = static_cast<std::uint64_t>(v.mesh.faces[f].size());
    v.turn_face(f, f == 0 ? 1 : static_cast<int>(random.next() % corners));
  }
}

void move(Variant& v, const std::function<Vector(const Vector&)>& there) {
  v.magnitude = 0;
  for (Vector& p : v.mesh.positions) {
    p = there(p);
    v.magnitude = std::max(v.magnitude, largest(p));
  }
}

void mirror(const Evidence&, Variant& v) {
  v.position = v.normal = [](const Vector& p) { return Vector{-p[0], p[1], p[2]}; };
  move(v, v.position);
  v.mirror_faces();
}

void rotation(const Evidence&, Variant& v) {
  move(v, [](const Vector& p) { return Vector{p[1], -p[2], -p[0]}; });
  v.position = v.normal = [](const Vector& p) { return Vector{-p[2], p[0], -p[1]}; };
}

Relation::Change scaled(int exponent) {
  const auto times = [](int k) {
    return [k](const Vector& p) {
      return Vector{std::ldexp(p[0], k), std::ldexp(p[1], k), std::ldexp(p[2], k)};
    };
  };
  return [=](const Evidence& e, Variant& v) {
    move(v, times(exponent));
    v.magnitude = e.magnitude;  // compared after scaling back
    v.position = times(-exponent);
  };
}

// By some diagonals, or by many times as many, so that some bits are left.
Relation::Change moved(bool far) {
  return [far](const Evidence& e, Variant& v) {
    const int exponent = !far ? 0 : e.capabilities.precision == LC_FLOAT32 ? 10 : 20;
    const double step = std::ldexp(1.0, std::ilogb(std::max(e.diagonal, 1e-30)) + exponent);
    const Vector by{step, -2 * step, 3 * step};
    move(v, [&](const Vector& p) { return p + by; });
    v.position = [by](const Vector& p) { return p - by; };
    v.normals = false;
  };
}

bool always(const data::ControlMesh&, const Lattice&) {
  return true;
}

using Edge = std::pair<std::int32_t, std::int32_t>;

bool lasts(float sharpness) {
  return sharpness >= data::kInfiniteSharpness;
}

bool ends(float sharpness) {
  return sharpness > 0 && !lasts(sharpness);
}

std::vector<Lattice::Edge> boundary_of(const Lattice& lattice) {
  std::vector<Lattice::Edge> edges = lattice.edges();
  std::erase_if(edges, [](const Lattice::Edge& e) { return !e.on_boundary(); });
  return edges;
}

// How many edges that stay sharp end at each vertex, those of the boundary included.
std::vector<int> lasting_edges_at(const data::ControlMesh& mesh, const Lattice& lattice) {
  std::set<Edge> edges;
  for (const data::SharpEdge& e : mesh.sharpness.edges)
    if (lasts(e.sharpness)) edges.insert(std::minmax(e.a, e.b));
  for (const Lattice::Edge& e : boundary_of(lattice)) edges.insert({e.a, e.b});
  std::vector<int> count(mesh.positions.size(), 0);
  for (const auto& [a, b] : edges) ++count[a], ++count[b];
  return count;
}

void crease_order(const Evidence&, Variant& v) {
  data::Sharpness& sharp = v.mesh.sharpness;
  std::reverse(sharp.edges.begin(), sharp.edges.end());
  std::reverse(sharp.vertices.begin(), sharp.vertices.end());
  for (data::SharpEdge& edge : sharp.edges) std::swap(edge.a, edge.b);
}

// Whether some edge or vertex, or an edge, is of such a sharpness.
template <class Tags>
bool any_is(const Tags& tags, bool (*of)(float)) {
  return std::any_of(tags.begin(), tags.end(), [&](const auto& tag) { return of(tag.sharpness); });
}
bool any_is(const data::ControlMesh& mesh, bool (*of)(float)) {
  return any_is(mesh.sharpness.edges, of) || any_is(mesh.sharpness.vertices, of);
}

bool has_infinite(const data::ControlMesh& mesh, const Lattice&) {
  return any_is(mesh, lasts);
}
Relation::Change with_infinite(float sharpness) {
  return [sharpness](const Evidence&, Variant& v) {
    const auto replace = [&](auto& tags) {
      for (auto& tag : tags)
        if (lasts(tag.sharpness)) tag.sharpness = sharpness;
    };
    replace(v.mesh.sharpness.edges);
    replace(v.mesh.sharpness.vertices);
  };
}

bool has_lasting_crease_and_boundary(const data::ControlMesh& mesh, const Lattice& lattice) {
  return any_is(mesh.sharpness.edges, lasts) && !boundary_of(lattice).empty();
}
void boundary_crease(const Evidence& e, Variant& v) {
  std::vector<data::SharpEdge>& sharp = v.mesh.sharpness.edges;
  const auto boundary = boundary_of(e.lattice);
  std::erase_if(sharp, [&](const data::SharpEdge& tag) {
    const Edge edge = std::minmax(tag.a, tag.b);
    return std::any_of(boundary.begin(), boundary.end(),
                       [&](const Lattice::Edge& b) { return Edge(b.a, b.b) == edge; });
  });
  for (const Lattice::Edge& edge : boundary) sharp.push_back({edge.a, edge.b, data::kInfiniteSharpness});
}

// A cut is the same surface if sharpness lasts wherever there is some, and no sharp edge ends in a dart.
bool can_be_cut(const data::ControlMesh& mesh, const Lattice& lattice) {
  if (has_semi_sharp(mesh) || !any_is(mesh.sharpness.edges, lasts)) return false;
  const std::vector<int> count = lasting_edges_at(mesh, lattice);
  return std::none_of(count.begin(), count.end(), [](int n) { return n == 1; });
}
void cut_by_hand(const Evidence& e, Variant& v) {
  data::ControlMesh& mesh = v.mesh;
  const reference::Topology topology(mesh.positions.size(), mesh.faces);
  const auto cut = reference::Sharpness(topology, mesh.sharpness).cut(topology);
  mesh.faces = cut.faces;
  // Of boundary vertices of one face those that the mesh holds stay held, not those that the cut makes.
  mesh.sharpness.edges.clear();
  mesh.sharpness.vertices.clear();
  mesh.sharpness.boundary = data::Boundary::kEdge;
  for (std::size_t w = 0; w < cut.origin.size(); ++w) {
    if (w >= topology.vertex_count()) mesh.positions.push_back(e.mesh.positions[cut.origin[w]]);
    if (cut.states[w] == reference::VertexState::kHeld)
      mesh.sharpness.vertices.push_back({static_cast<std::int32_t>(w), data::kInfiniteSharpness});
  }
}

bool any(const data::ControlMesh& mesh, const Lattice&) {
  return mesh.sharpness.edges.size() + mesh.sharpness.vertices.size() > 0;
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
  mesh.channels.clear();  // which shape nothing, and would have to be rewritten
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

std::vector<Variant> Relation::variants(const Evidence& e) const {
  std::vector<Variant> all;
  for (const Way& way : ways) {
    Variant& v = all.emplace_back(identity(e));
    v.name = way.name;
    v.same_numbers = way.same_numbers;
    way.change(e, v);
  }
  return all;
}

const std::vector<Relation>& surface_relations() {
  static const std::vector<Relation> all{
      {"face-order", always, {{"with its faces in another order", true, face_order}}},
      {"vertex-order", always, {{"with its vertices numbered otherwise", true, vertex_order}}},
      {"corner-rotation", always, {{"with some of its faces begun at other corners", true, corner_rotation}}},
      {"mirror", always, {{"mirrored", false, mirror}}},
      {"rotation", always, {{"turned", false, rotation}}},
      {"scaling",
       always,
       {{"times 2^10", true, scaled(10)},
        {"times 2^-10", true, scaled(-10)},
        {"times 2^40", true, scaled(40)},
        {"times 2^-40", true, scaled(-40)}}},
      {"translation", always, {{"moved", false, moved(false)}, {"moved far away", false, moved(true)}}},
      {"crease-order", any, {{"with its sharp edges and vertices in another order", true, crease_order}}},
      {"infinite-sharpness",
       has_infinite,
       {{"with the sharpness 10 where it is more", true, with_infinite(data::kInfiniteSharpness)},
        {"with the sharpness 100 where it is 10 and more", true, with_infinite(100)}}},
      {"boundary-crease",
       has_lasting_crease_and_boundary,
       {{"with the edges of its boundary sharp for ever, which they are", true, boundary_crease}}},
      {"cut-by-hand",
       can_be_cut,
       {{"cut along its sharp edges, with a copy of their points for each side", false, cut_by_hand}}}};
  return all;
}

std::optional<float> common_sharpness(const data::ControlMesh& mesh) {
  std::set<float> all;
  for (const data::SharpEdge& e : mesh.sharpness.edges) all.insert(e.sharpness);
  for (const data::SharpVertex& v : mesh.sharpness.vertices) all.insert(v.sharpness);
  std::erase_if(all, [](float s) { return !ends(s); });
  return all.size() == 1 ? std::optional(*all.begin()) : std::nullopt;
}

bool has_semi_sharp(const data::ControlMesh& mesh) {
  return any_is(mesh, ends);
}

data::ControlMesh with_sharpness(data::ControlMesh mesh, float sharpness) {
  const auto change = [sharpness](auto& tags) {
    for (auto& tag : tags)
      if (ends(tag.sharpness)) tag.sharpness = sharpness;
    std::erase_if(tags, [](const auto& tag) { return tag.sharpness == 0; });
  };
  change(mesh.sharpness.edges);
  change(mesh.sharpness.vertices);
  return mesh;
}

}  // namespace limitcheck::verify
