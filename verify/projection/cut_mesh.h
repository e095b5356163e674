// SPDX-License-Identifier: MIT
// Refined control meshes with sharp edges and vertices, cut for the bounds of their pieces. Heavy, as
// sharpness.h is: include from .cpp files.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "reference/mesh/sharpness.h"
#include "verify/projection/patch_bound.h"

namespace limitcheck::verify {

/// A mesh with a copy of the points of each edge that stays sharp for either of its sides. Its faces are
/// those of the mesh, in their order, and its first vertices too. Over faces without semi-sharp tags it has
/// the same limit surface.
struct CutMesh {
  reference::Topology topology;
  std::vector<reference::Vec3<double>> positions;
  std::vector<reference::VertexState> states;
  std::vector<std::int32_t> origin;  // of each vertex, the one of the mesh that it is a copy of

  CutMesh(const reference::Topology& whole, std::span<const reference::Vec3<double>> points,
          const reference::Sharpness& sharpness)
      : topology(whole) {
    reference::Sharpness::Cut cut = sharpness.cut(whole);
    for (const std::int32_t v : cut.origin) positions.push_back(points[v]);
    states = std::move(cut.states);
    origin = std::move(cut.origin);
    topology = reference::Topology(positions.size(), std::move(cut.faces));
  }
};

/// Refines a mesh so many times; returns how sharp its edges are then, nothing if it has no tags.
///   refined   of either scheme, made with the tags
template <class Refined>
std::optional<reference::Sharpness> refine_tagged(Refined& refined, const reference::SharpTags& tags,
                                                  int steps) {
  std::optional<reference::Sharpness> sharpness;
  if (!tags.empty()) sharpness.emplace(refined.topology(), tags);
  for (int step = 0; step < steps; ++step) {
    if (!sharpness) {
      refined.refine();
      continue;
    }
    const reference::Topology before = refined.topology();
    refined.refine();
    sharpness = sharpness->refined(before, refined.topology());
  }
  return sharpness;
}

/// The edges of a face that stay sharp, as tags of a mesh in which it has the corners `named`.
inline void add_lasting_edges(reference::SharpTags& tags, const reference::Topology& topology,
                              const reference::Sharpness& sharpness, std::int32_t face,
                              std::span<const std::int32_t> named) {
  for (std::size_t k = 0; k < named.size(); ++k) {
    const std::int32_t e = topology.edge(static_cast<std::size_t>(face), k);
    if (topology.edges()[static_cast<std::size_t>(e)].on_boundary() ||
        !reference::Sharpness::is_infinite(sharpness.edge(e)))
      continue;
    tags.edges.push_back({named[k], named[(k + 1) % named.size()], 10.0});
  }
}

/// A vertex (number 0) with the faces around it and some beyond, refined again and again on the spot.
struct Surroundings {
  std::vector<reference::Vec3<double>> positions;
  data::Faces faces;
  reference::SharpTags tags;
};

/// Some faces of a mesh, as surroundings of a vertex of theirs.
inline Surroundings surroundings_of(const reference::Topology& topology,
                                    std::span<const reference::Vec3<double>> positions, std::int32_t vertex,
                                    std::span<const std::int32_t> faces, const SharpVertexOf& sharp) {
  Surroundings s;
  std::unordered_map<std::int32_t, std::int32_t> number{{vertex, 0}};
  s.positions.push_back(positions[vertex]);
  std::vector<std::int32_t> corners;
  for (const std::int32_t f : faces) {
    const auto face = topology.faces()[static_cast<std::size_t>(f)];
    corners.assign(face.begin(), face.end());
    for (std::int32_t& v : corners) {
      const auto [it, is_new] = number.try_emplace(v, static_cast<std::int32_t>(s.positions.size()));
      if (is_new) s.positions.push_back(positions[v]);
      v = it->second;
    }
    s.faces.push_back(corners);
    if (sharp.sharpness != nullptr) add_lasting_edges(s.tags, topology, *sharp.sharpness, f, corners);
  }
  if (sharp.held) s.tags.vertices.push_back({0, 10.0});
  return s;
}

}  // namespace limitcheck::verify
