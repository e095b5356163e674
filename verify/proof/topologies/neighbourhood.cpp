// SPDX-License-Identifier: MIT
#include "verify/proof/topologies/neighbourhood.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <utility>

#include "data/cut_out.h"
#include "data/error.h"
#include "data/splitmix64.h"
#include "fast/mesh/adjacency.h"
#include "fast/mesh/cut_mesh.h"

namespace limitcheck::verify {
namespace {

using data::Faces;
using fast::Adjacency;

constexpr std::int32_t kCorners = 4;

/// A corner in words (signature()).
///   own   faces of the middle at the vertex, from that of half-edge h on
template <int K>
std::string corner_name(const fast::BasicAdjacency<K>& adjacency, std::int32_t h, std::ptrdiff_t own) {
  const std::int32_t v = adjacency.origin(h);
  const auto fan = adjacency.fan(v);
  if (!adjacency.on_boundary(v)) return fmt::format("{}", fan.size());
  const std::ptrdiff_t before = std::ranges::find(fan, h) - fan.begin();
  return fmt::format("{}|{}", before, std::ssize(fan) - own - before);
}

/// Half-edges from A, B, C, D to their first neighbour of the pair, counter-clockwise: A to B, B to C, C to
/// D, D to A; and the number of the pair's faces at each.
struct CornerStart {
  std::int32_t half_edge;
  int faces;
};
std::array<CornerStart, 4> corner_starts(const Adjacency& adjacency, std::int32_t ac) {
  const std::int32_t ca = adjacency.twin(ac);
  if (ca < 0) throw data::ArgumentError("a pair needs a second face");
  return {{{Adjacency::next(ca), 2},
           {Adjacency::prev(ca), 1},
           {Adjacency::next(ac), 2},
           {Adjacency::prev(ac), 1}}};
}

std::string pair_name(const Adjacency& adjacency, std::int32_t half_edge) {
  std::string text;
  for (const CornerStart& corner : corner_starts(adjacency, half_edge))
    text += (text.empty() ? "" : " ") + corner_name(adjacency, corner.half_edge, corner.faces);
  return text;
}

Neighbourhood named(Faces faces) {
  Neighbourhood result{"", with_positions(std::move(faces))};
  result.name = signature(result.mesh, 0);
  return result;
}

/// Closes the fans of the four corners one after the other; false if that cannot be done in this order.
bool close_corners(const std::array<int, 4>& valence, const std::array<int, 4>& order,
                   std::vector<std::array<std::int32_t, 3>>& faces) {
  faces = {{0, 2, 3}, {0, 1, 2}};
  std::vector<std::int32_t> loop{0, 1, 2, 3};  // boundary, counter-clockwise
  std::int32_t vertices = kCorners;
  const auto joined = [&](std::int32_t a, std::int32_t b) {
    return std::ranges::any_of(faces, [&](const auto& face) {
      return std::ranges::find(face, a) != face.end() && std::ranges::find(face, b) != face.end();
    });
  };
  for (const int v : order) {
    int missing = valence[v];
    for (const auto& face : faces) missing -= std::ranges::find(face, v) != face.end() ? 1 : 0;
    const auto at = std::ranges::find(loop, v);
    if (at == loop.end()) {  // closed along with another
      if (missing != 0) return false;
      continue;
    }
    std::rotate(loop.begin(), at, loop.end());
    const std::int32_t after = loop[1], before = loop.back();
    const bool last = loop.size() == 3;
    if (missing < 1 || (missing == 1 && joined(before, after) && !last)) return false;
    // Around v the faces go on from `before` to `after`.
    std::int32_t from = before;
    std::vector<std::int32_t> fresh;
    for (int k = 1; k < missing; ++k) {
      fresh.push_back(vertices++);
      faces.push_back({v, from, fresh.back()});
      from = fresh.back();
    }
    faces.push_back({v, from, after});
    loop.erase(loop.begin());
    if (missing == 1 && last) {
      loop.clear();
    } else {
      loop.insert(loop.end(), fresh.begin(), fresh.end());
    }
  }
  return true;
}

/// The faces around the pair in the order in which one walks around it.
std::vector<std::size_t> surrounding(const data::ControlMesh& mesh) {
  const Adjacency adjacency(mesh);
  std::vector<std::size_t> ring;
  const auto starts = corner_starts(adjacency, 0);
  for (const std::size_t which : {0, 3, 2, 1}) {
    const CornerStart& corner = starts[which];
    // Clockwise around the corner, from the pair's first face there on.
    std::int32_t h = corner.half_edge;
    for (h = adjacency.twin(h); h >= 0; h = adjacency.twin(Adjacency::next(h))) {
      const std::size_t face = Adjacency::face(h);
      if (face < 2) break;
      if (std::ranges::find(ring, face) == ring.end()) ring.push_back(face);
    }
  }
  return ring;
}

// Of quads.

using Edge = std::pair<std::int32_t, std::int32_t>;

/// The quad, the faces beyond its sides, then those that fill each corner; and an edge of each corner that
/// leads away from the quad.
struct Ring {
  data::Faces quads;
  std::array<Edge, 4> further;
  std::vector<std::size_t> around;  // the faces around the quad as one walks around it
};
Ring ring_of(const std::array<int, 4>& valence) {
  Ring ring;
  std::int32_t vertices = 4;
  // Of the face beyond side k: p[k] next to corner k, q[k] next to corner k + 1.
  std::array<std::int32_t, 4> p{}, q{};
  for (std::size_t k = 0; k < 4; ++k) p[k] = vertices++;
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t next = (k + 1) % 4;
    q[k] = valence[next] == 3 ? p[next] : vertices++;
  }
  ring.quads.push_back(std::array<std::int32_t, 4>{0, 1, 2, 3});
  for (std::size_t k = 0; k < 4; ++k)
    ring.quads.push_back(std::array<std::int32_t, 4>{static_cast<std::int32_t>((k + 1) % 4),
                                                     static_cast<std::int32_t>(k), p[k], q[k]});
  for (std::size_t k = 0; k < 4; ++k) {
    const auto corner = static_cast<std::int32_t>(k);
    const std::int32_t last = p[k];
    std::int32_t from = q[(k + 3) % 4];
    ring.further[k] = {corner, from};
    // Counter-clockwise around the corner from the face beyond the side before to that beyond its own.
    ring.around.push_back(1 + (k + 3) % 4);
    for (int missing = valence[k] - 3; missing > 0; --missing) {
      const std::int32_t to = missing == 1 ? last : vertices++;
      ring.around.push_back(ring.quads.size());
      ring.quads.push_back(std::array<std::int32_t, 4>{corner, from, vertices++, to});
      from = to;
    }
  }
  return ring;
}

std::string valences(const std::array<int, 4>& valence) {
  return fmt::format("{} {} {} {}", valence[0], valence[1], valence[2], valence[3]);
}

// As the name says, read off the mesh.
std::string name_of(const data::ControlMesh& mesh) {
  const fast::QuadAdjacency adjacency(mesh);
  std::string text;
  for (std::int32_t h = 0; h < 4; ++h) text += (text.empty() ? "" : " ") + corner_name(adjacency, h, 1);
  return text;
}

}  // namespace

data::ControlMesh with_positions(Faces faces) {
  std::int32_t vertices = 0;
  for (const std::int32_t v : faces.corners()) vertices = std::max(vertices, v + 1);
  data::ControlMesh mesh;
  mesh.faces = std::move(faces);
  data::SplitMix64 random(static_cast<std::uint64_t>(vertices));
  const auto coordinate = [&] { return static_cast<double>(random.next() >> 43) * 0x1p-20 - 1; };
  for (std::int32_t v = 0; v < vertices; ++v)
    mesh.positions.push_back({coordinate(), coordinate(), coordinate()});
  return mesh;
}

std::string signature(const data::ControlMesh& mesh, std::int32_t half_edge) {
  return pair_name(Adjacency(mesh), half_edge);
}

Neighbourhood cut_out(const data::ControlMesh& mesh, std::int32_t half_edge) {
  const Adjacency adjacency(mesh);
  const auto starts = corner_starts(adjacency, half_edge);
  std::map<std::int32_t, std::int32_t> number;
  for (const CornerStart& corner : starts)
    number.emplace(adjacency.origin(corner.half_edge), static_cast<std::int32_t>(number.size()));
  Faces faces{{0, 2, 3}, {0, 1, 2}};
  const std::int32_t face0 = Adjacency::face(half_edge), face1 = Adjacency::face(adjacency.twin(half_edge));
  for (std::int32_t f = 0; f < adjacency.face_count(); ++f) {
    const auto& corners = triangles_of(mesh)[f];
    const bool touches = std::ranges::any_of(corners, [&](std::int32_t v) {
      const auto known = number.find(v);
      return known != number.end() && known->second < kCorners;
    });
    if (!touches || f == face0 || f == face1) continue;
    std::array<std::int32_t, 3> face{};
    for (std::size_t k = 0; k < 3; ++k)
      face[k] = number.emplace(corners[k], static_cast<std::int32_t>(number.size())).first->second;
    faces.push_back(face);
  }
  data::split_fans(faces, number.size());
  return named(std::move(faces));
}

std::optional<Neighbourhood> interior_pair(const std::array<int, 4>& valence) {
  std::array<int, 4> order{0, 1, 2, 3};
  do {
    std::vector<std::array<std::int32_t, 3>> faces;
    if (close_corners(valence, order, faces)) return named(Faces(faces));
  } while (std::ranges::next_permutation(order).found);
  return std::nullopt;
}

std::vector<Neighbourhood> boundary_pairs(const std::array<int, 4>& valence) {
  std::vector<Neighbourhood> result;
  const auto whole = interior_pair(valence);
  if (!whole) return result;
  std::set<std::string> seen{whole->name};
  const auto without = [&](const std::set<std::size_t>& removed) {
    data::ControlMesh mesh = whole->mesh;
    mesh.faces.clear();
    for (std::size_t f = 0; f < whole->mesh.faces.size(); ++f)
      if (!removed.contains(f)) mesh.faces.push_back(whole->mesh.faces[f]);
    data::split_fans(mesh.faces, mesh.positions.size());
    Neighbourhood cut = cut_out(with_positions(mesh.faces), 0);
    if (seen.insert(cut.name).second) result.push_back(std::move(cut));
  };
  const Adjacency adjacency(whole->mesh);
  const auto beyond = [&](std::int32_t h) { return static_cast<std::size_t>(adjacency.twin(h) / 3); };
  // The pair's half-edges C D, D A, A B, B C.
  for_each_removal(surrounding(whole->mesh), {beyond(1), beyond(2), beyond(3), beyond(4)}, without);
  return result;
}

void for_each_removal(const std::vector<std::size_t>& around, const std::array<std::size_t, 4>& sides,
                      const std::function<void(const std::set<std::size_t>& removed)>& visit) {
  const std::size_t n = around.size();
  for (std::size_t length = 1; length < n; ++length) {
    for (std::size_t first = 0; first < n; ++first) {
      std::set<std::size_t> removed;
      for (std::size_t k = 0; k < length; ++k) removed.insert(around[(first + k) % n]);
      visit(removed);
    }
  }
  for (unsigned chosen = 1; chosen < 16; ++chosen) {
    std::set<std::size_t> removed;
    for (unsigned k = 0; k < 4; ++k)
      if ((chosen >> k & 1U) != 0) removed.insert(sides[k]);
    visit(removed);
  }
  visit({around.begin(), around.end()});
}

Neighbourhood face_alone() {
  return {"alone", with_positions({{0, 1, 2}})};
}

std::vector<Neighbourhood> pairs_of(const data::ControlMesh& mesh) {
  const Adjacency adjacency(mesh);
  std::map<std::string, std::int32_t> first;
  for (std::int32_t h = 0; h < 3 * adjacency.face_count(); ++h)
    if (adjacency.twin(h) >= 0) first.emplace(pair_name(adjacency, h), h);
  std::vector<Neighbourhood> result;
  for (const auto& [text, h] : first) result.push_back(cut_out(mesh, h));
  return result;
}

Neighbourhood interior_quad(const std::array<int, 4>& valence) {
  return {valences(valence), with_positions(ring_of(valence).quads)};
}

std::vector<Neighbourhood> boundary_quads(const std::array<int, 4>& valence) {
  const Ring whole = ring_of(valence);
  std::vector<Neighbourhood> result;
  std::set<std::string> seen{valences(valence)};
  const auto add = [&](const std::set<std::size_t>& removed) {
    std::vector<std::int32_t> left;
    for (std::size_t f = 0; f < whole.quads.size(); ++f)
      if (!removed.contains(f)) left.push_back(static_cast<std::int32_t>(f));
    data::ControlMesh mesh = with_positions(data::cut_out(whole.quads, left).faces);
    std::string name = name_of(mesh);
    if (seen.insert(name).second) result.push_back({std::move(name), std::move(mesh)});
  };
  for_each_removal(whole.around, {1, 2, 3, 4}, add);
  return result;
}

std::vector<Neighbourhood> creased_quads(const std::array<int, 4>& valence) {
  const Ring ring = ring_of(valence);
  const data::ControlMesh mesh = with_positions(ring.quads);
  std::vector<Neighbourhood> result;
  for (unsigned sides = 0; sides < 16; ++sides) {
    // Corners with one sharp side, and with two: where a crease goes on, or a third edge meets it.
    unsigned one = 0, two = 0;
    for (unsigned k = 0; k < 4; ++k) {
      const unsigned count = (sides >> k & 1U) + (sides >> (k + 3) % 4 & 1U);
      if (count == 1) one |= 1U << k;
      if (count == 2) two |= 1U << k;
    }
    for (const unsigned further : std::set{0U, 1U, 2U, 4U, 8U, 15U, one, two, one | two}) {
      if (sides == 0 && further == 0) continue;
      Neighbourhood sharp{valences(valence), mesh};
      const auto add = [&](const Edge& e, const std::string& name) {
        sharp.mesh.sharpness.edges.push_back({e.first, e.second, data::kInfiniteSharpness});
        sharp.name += ' ' + name;
      };
      for (std::int32_t k = 0; k < 4; ++k)
        if ((sides >> k & 1U) != 0) add({k, (k + 1) % 4}, {"ABCD"[k], "ABCD"[(k + 1) % 4]});
      for (std::int32_t k = 0; k < 4; ++k)
        if ((further >> k & 1U) != 0) add(ring.further[static_cast<std::size_t>(k)], {"ABCD"[k], '+'});
      result.push_back(std::move(sharp));
    }
  }
  return result;
}

std::vector<Neighbourhood> semi_sharp_quads(const std::array<int, 4>& valence) {
  const Ring ring = ring_of(valence);
  const data::ControlMesh mesh = with_positions(ring.quads);
  std::vector<Neighbourhood> result;
  const auto side = [](std::int32_t k, float s) { return data::SharpEdge{k, (k + 1) % 4, s}; };
  const auto further = [&](std::size_t k, float s) {
    return data::SharpEdge{ring.further[k].first, ring.further[k].second, s};
  };
  const auto add = [&](const std::vector<data::SharpEdge>& edges,
                       const std::vector<data::SharpVertex>& vertices = {}) {
    for (const auto creasing : {data::Creasing::kUniform, data::Creasing::kChaikin}) {
      Neighbourhood sharp{valences(valence), mesh};
      sharp.mesh.sharpness.edges = edges;
      sharp.mesh.sharpness.vertices = vertices;
      sharp.mesh.sharpness.creasing = creasing;
      const auto letter = [](std::int32_t v) { return v < 4 ? "ABCD"[v] : '+'; };
      for (const data::SharpEdge& e : edges)
        sharp.name += fmt::format(" {}{} {}", letter(e.a), letter(e.b), e.sharpness);
      for (const data::SharpVertex& v : vertices)
        sharp.name += fmt::format(" {} {}", letter(v.vertex), v.sharpness);
      if (creasing == data::Creasing::kChaikin) sharp.name += " chaikin";
      result.push_back(std::move(sharp));
    }
  };
  for (const float s : {.5F, 1.F, 1.5F, 2.25F, 2.3F}) {
    add({side(0, s)});
    add({side(1, s), side(2, s)});
    add({side(3, s), further(0, s)});
    add({side(0, s), side(1, s), side(2, s), side(3, s)});
    add({further(0, s), further(2, s / 2)});
    add({side(0, s), side(2, 1)});
    add({side(0, s), side(3, data::kInfiniteSharpness), further(0, data::kInfiniteSharpness)});
    add({}, {{1, s}});
    add({side(0, s)}, {{0, s}});
  }
  return result;
}

bool has_dart(const data::ControlMesh& mesh) {
  const fast::QuadMesh quads(mesh);
  for (int k = 0; k < 4; ++k)
    if (quads.kind(quads.adjacency.corner(0, k)) == fast::VertexKind::kDart) return true;
  return false;
}

}  // namespace limitcheck::verify
