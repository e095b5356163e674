// SPDX-License-Identifier: MIT
#include "verify/proof/topologies/neighbourhood.h"

#include <cstddef>
#include <set>
#include <utility>

#include "data/cut_out.h"
#include "fast/mesh/cut_mesh.h"
#include "verify/proof/topologies/corner_name.h"

namespace limitcheck::verify {
namespace {

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
