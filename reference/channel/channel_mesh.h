// SPDX-License-Identifier: MIT
// A face-varying channel on its mesh: where its seams are, what each of its values does in a step, and the cut along
// the seams, after which the channel is an ordinary surface. The same in both schemes. Definitions: SURFACE.md.
// Heavy: include from .cpp files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "data/channel.h"
#include "data/cut_out.h"
#include "reference/mesh/sharpness.h"
#include "reference/mesh/support.h"
#include "reference/mesh/topology.h"
#include "reference/number/vec3.h"

namespace limitcheck::reference {

/// What a value does at its vertex, fixed in the control mesh.
enum class ValueState : std::uint8_t {
  kMatches,    ///< the rule that the surface has there
  kHeld,       ///< it stays what it is
  kSemiSharp,  ///< held as long as its vertex or an edge inside its run is sharp, then a crease
  kDependent,  ///< held as long as its vertex or an edge inside the other run is sharp, then a crease
  kCrease      ///< a B-spline curve along the two edges that bound its run
};

/// A maximal sequence of faces round a vertex that no seam parts: so many faces of the sector from `first` on, round the
/// vertex if it is inside. It is bounded by the edges `first` and `first + count` of the sector.
struct Run {
  std::size_t first, count;
};

/// A channel without its values. Corners of all faces are numbered through, as data::Faces::corners are.
struct ChannelTopology {
  Topology topology;
  Sharpness sharpness;             ///< of the surface
  std::vector<bool> seams;         ///< of each edge
  std::vector<ValueState> states;  ///< of the value at each corner

  /// Of a control mesh.
  ///   values   an index at each corner
  ///   throws   data::ArgumentError as Topology and Sharpness do, or if there are more or fewer indices than corners
  ChannelTopology(Topology mesh, const SharpTags& tags, std::span<const std::int32_t> values,
                  data::ChannelRule rule);
  ChannelTopology(Topology mesh, Sharpness sharp) : topology(std::move(mesh)), sharpness(std::move(sharp)) {}

  /// Round a vertex, counter-clockwise. One run of all faces where no seam ends.
  std::vector<Run> runs(std::int32_t v) const;
  /// Face i of a run, and edge i of it; of `count + 1` edges the first and the last bound the run.
  std::int32_t face(const Sector& sector, const Run& run, std::size_t i) const {
    return sector.faces[(run.first + i) % sector.faces.size()];
  }
  std::size_t edge(const Sector& sector, const Run& run, std::size_t i) const {
    return (run.first + i) % sector.edges.size();
  }
  /// The corner of a face at one of its vertices.
  std::size_t corner(std::int32_t face, std::int32_t v) const;

  /// The sharpnesses that hold a semi-sharp or dependent value: of its vertex, and of the edges inside its run or inside
  /// the others; now and after a step.
  struct Holding {
    Rational now, after;
  };
  std::vector<Holding> holding(std::int32_t v, const Run& run) const;

  /// Whether a semi-sharp tag is at a corner of a face: on the vertex or on an edge of it.
  bool is_semi_sharp(std::size_t face) const;
};

/// The mesh that is cut along the seams: each run has a vertex of its own, which knows the semi-sharp edges that its vertex
/// has beyond the run: by Chaikin's creasing sharpness falls by theirs, too, and they hold a dependent value. With boundary
/// `edge` its surface is the channel.
struct ChannelCut {
  data::Faces faces;                   ///< those of the mesh, corner by corner
  std::vector<std::size_t> corner_of;  ///< for each vertex a corner that has its value
  SharpTags tags;
};
ChannelCut cut_and_hold(const ChannelTopology& channel, data::TriangleRule triangles);

/// A channel with its values, three components of them.
template <class N>
struct ChannelMesh : ChannelTopology {
  std::vector<Vec3<N>> values;  ///< at each corner

  ChannelMesh(ChannelTopology channel, std::vector<Vec3<N>> at_corners)
      : ChannelTopology(std::move(channel)), values(std::move(at_corners)) {}

  /// A face, which comes first, and all that its channel depends on.
  ChannelMesh around(std::size_t face) const {
    const std::vector<std::int32_t> faces =
        support_of({static_cast<std::int32_t>(face)}, topology, sharpness.creasing());
    const data::CutOut part = data::cut_out(topology.faces(), faces);
    Topology local(part.vertices.size(), part.faces);
    Sharpness sharp = sharpness.of_part(topology, local, faces, part.vertices);
    ChannelMesh result(ChannelTopology(std::move(local), std::move(sharp)), {});
    result.seams.assign(result.topology.edges().size(), false);
    for (std::size_t f = 0; f < faces.size(); ++f) {
      const auto whole = static_cast<std::size_t>(faces[f]);
      for (std::size_t k = 0; k < part.faces[f].size(); ++k) {
        const std::size_t at = topology.faces().first_corner(whole) + k;
        result.states.push_back(states[at]);
        result.values.push_back(values[at]);
        const auto e = static_cast<std::size_t>(result.topology.edge(f, k));
        if (!result.topology.edges()[e].on_boundary())
          result.seams[e] = seams[static_cast<std::size_t>(topology.edge(whole, k))];
      }
    }
    return result;
  }
};

}  // namespace limitcheck::reference
