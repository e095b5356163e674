// SPDX-License-Identifier: MIT
#include "verify/proof/topologies/neighbourhood.h"

#include <algorithm>
#include <map>

#include "data/cut_out.h"
#include "data/error.h"
#include "data/splitmix64.h"
#include "verify/proof/topologies/corner_name.h"

namespace limitcheck::verify {
namespace {

using data::Faces;
using fast::Adjacency;

constexpr std::int32_t kCorners = 4;

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

}  // namespace limitcheck::verify
