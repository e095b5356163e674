// SPDX-License-Identifier: MIT
// Whether every point that faces share has the same bits from each of them; and row streaming in all its forms, of a
// control mesh written differently at random whose faces are paired at random.                        [claim D14]
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "data/control_mesh.h"
#include "fast/mesh/adjacency.h"
#include "fast/plan/pairing.h"
#include "fast/stream/kernel/targets.h"
#include "verify/relations/variants.h"
#include "verify/subject/lattice.h"

namespace limitcheck::verify {

/// What row streaming guarantees, and the tests beside this file hold it to.
///
/// The position and the unit normal of a point on a control edge at that edge's depth, and of a control
/// vertex at any depth, are a function of
///   - where the vertices of the control mesh lie, as float positions, and which of them are joined: near the
///     point, the cyclic order of the rings of the edge's two ends or of the vertex;
///   - the mesh's bounding box, from which the common origin and scale come;
///   - the edge's depth. The same parameter at two depths may differ in bits, except at control vertices.
/// So they have the same bits, -0 and +0 counted as different,
///   - from every face that touches the point, as the border of a pair, as the diagonal of a pair, as the
///     border of a face without partner, and from RowStream::edges in either direction;
///   - for every pairing, every order of the faces, every rotation of corners within a face, every numbering
///     of the vertices. Nothing else is left free: rings start at the neighbour whose position comes first
///     lexicographically, boundary rings at the boundary. Where positions coincide the ring that follows
///     decides; where that coincides too, either start gives the same sums;
///   - whatever the depths of the faces at the edge, as strips, fans, stitched rings or an indexed mesh;
///   - for every target and lane count, in every lane and beside any other pairs, for any number of threads;
///   - from g++ and clang, given one libm (cosine and sine of 2 pi / n).
/// Not promised: points inside a face, which may depend on which face is its partner and which corner comes
/// first; the centres of fans, which one face owns; the same bits after moving, scaling (but by powers of
/// two), mirroring the mesh or adding to its bounding box.
///
/// This table keeps the first bits it sees for each shared point of a mesh at each depth, and counts how many
/// of those that follow differ.
class SharedBits {
 public:
  using Bits = std::array<std::uint32_t, 6>;  // position, unit normal

  /// `mesh` must outlive this.
  SharedBits(const data::ControlMesh& mesh, int deepest);

  /// A point on the border of a face, at depth d if its denominator is 2^d. Points inside a face are passed
  /// over.
  void add(const Place& at, const float* vertex);

  std::int64_t points() const { return points_; }                  // shared points seen
  std::int64_t compared() const { return compared_; }              // evaluations after the first of each
  std::int64_t different() const { return different_; }            // of those, with any bit that differs
  std::int64_t different_bits() const { return different_bits_; }  // in their six numbers
  /// The first point that differed, for messages.
  const std::string& witness() const { return witness_; }

  /// FNV-1a over the bits of all points seen, in the order of the lattices.
  std::uint64_t hash() const;

 private:
  struct Level {
    Level(const data::ControlMesh& mesh, int depth) : lattice(mesh, depth) {}
    Lattice lattice;
    std::vector<Bits> first;
  };
  Level& level(int depth);

  const data::ControlMesh& mesh_;
  std::vector<std::unique_ptr<Level>> levels_;
  std::int64_t points_ = 0, compared_ = 0, different_ = 0, different_bits_ = 0;
  std::string witness_;
};

/// The positions as a float subject sees them.
data::ControlMesh rounded(data::ControlMesh mesh);

/// Vertices renumbered, faces reordered, their corners rotated, all at random. Seed 0: as it is.
Rewriting rewrite(const data::ControlMesh& mesh, std::uint64_t seed);

/// Every face is in one pair; its partner and its corner A are drawn at random. One face in `singles` stays
/// without a partner though it has neighbours. All have one depth.
std::vector<fast::Grid> random_pairs(const fast::Adjacency& adjacency, int depth, std::uint64_t seed,
                                     std::uint64_t singles = 5);

enum class Form { kRows, kWhole };

/// Every pair at one depth, paired at random.
void add_pairs(const Rewriting& mesh, int depth, const fast::row_stream::Kernel& kernel, Form form,
               std::uint64_t seed, SharedBits& bits);

/// Every half-edge by itself, in a random order, hence both ways.
void add_edges(const Rewriting& mesh, int depth, const fast::row_stream::Kernel& kernel, std::uint64_t seed,
               SharedBits& bits);

/// A frame of the subject row-stream with these options, a depth for each of the original's faces.
/// Points of edges go into the table of the edge's depth.
void add_frame(const Rewriting& mesh, std::span<const std::int32_t> depth, const std::string& options,
               int threads, SharedBits& bits);

}  // namespace limitcheck::verify
