// SPDX-License-Identifier: MIT
// Faults that one class of tags, one neighbourhood or one memory brings out, of both schemes: the recursive
// subdivider is given other tags, its points at some places move, or it keeps what it knows of an earlier mesh.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "data/control_mesh.h"
#include "data/scheme.h"
#include "reference/mesh/topology.h"

namespace limitcheck::verify {

/// What a fault may look at: a valid control mesh and the deepest face that is asked for.
struct Around {
  Around(const data::ControlMesh& of, data::Scheme by, int at_depth);

  /// How many faces are at a vertex, and whether it lies inside.
  int faces(std::int32_t v) const { return static_cast<int>(topology.sector(v).faces.size()); }
  bool inside(std::int32_t v) const { return topology.sector(v).closed; }
  int sharp_edges(std::int32_t v) const { return infinite[v] + semi_sharp[v]; }
  /// Of one of the sides between two edges that stay sharp, at a vertex with two; else 0.
  int faces_of_side(std::int32_t v) const;
  /// Vertices - edges + faces.
  std::int64_t characteristic() const;

  const data::ControlMesh& mesh;
  const data::Scheme scheme;
  const int depth;
  const reference::Topology topology;
  std::vector<int> infinite, semi_sharp;  // edges at each vertex; those of the boundary are infinite
  std::vector<float> held;                // sharpness of each vertex
  std::vector<int> component;             // of each vertex, numbered in the order of the faces
  int first_most = 0;                     // faces at a vertex of the first mesh of the process, at most
};

struct Distortion {
  std::string name, description;
  std::string check = "positions";  // the row of the audit meant for it
  bool sharp = true;                // only sharp edges and vertices bring it out
  bool loop = true;                 // not only Catmull-Clark's scheme has it
  /// One of these: what it makes of the tags; which control vertices, or the inside of which faces, are off by
  /// 1e-5 of the mesh; what of a mesh it forgets when it looks for the first one like it; or which request or
  /// mesh before it takes instead (kept).
  std::function<void(const Around&, data::Sharpness&)> take{};
  std::function<bool(const Around&, std::int32_t)> vertex{};
  std::function<bool(const Around&, std::size_t)> face{};
  std::function<void(data::ControlMesh&)> forget{};
  enum class Kept : std::uint8_t { kNothing, kTagsOfTheLast, kCulling } kept = Kept::kNothing;
};

/// The first is "none". The subject `distorted` has them (options fault=NAME).
std::span<const Distortion> distortions();

/// Whether a mesh can bring it out; what depends on the meshes before: always.
bool shows(const Distortion& fault, const data::ControlMesh& mesh, data::Scheme scheme, int depth);

}  // namespace limitcheck::verify
