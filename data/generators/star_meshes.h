// SPDX-License-Identifier: MIT
// One tagged neighbourhood as a small mesh, or several as its components: what a point of a subdivision
// surface depends on, in general position.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "data/control_mesh.h"

namespace limitcheck::data {

/// A vertex amid its faces.
///
///   spokes   the tag of each edge at the vertex, counter-clockwise: letters of data/sharpness_classes.h
///   open     the vertex lies on the boundary, and the first and the last spoke with it
///   bare     nothing lies beyond its faces; otherwise there is a second ring of faces
///   own      of the vertex itself
///   beyond   of the edge that goes on straight from the end of each spoke that is sharp; '=': as the spoke
///   aside    of the edge that goes on from the end of the first spoke inside that is smooth ..
///   across   .. and of the two edges beside it there, which cross that spoke's way
///   corners  of its faces, from that between spokes 0 and 1 on; the others have 3 or 4
struct Star {
  std::string spokes;
  bool open = false, bare = false;
  char own = '.', beyond = '.', aside = '.', across = '.';
  std::vector<int> corners = {};

  std::size_t faces() const { return spokes.size() - (open ? 1 : 0); }
  /// "ovBwJ.3i/5-3": o open, r bare, v own, w beyond, z aside, y across, the spokes (a number repeats the one
  /// before it), and behind a slash the corners.
  std::string text() const;
};

/// Stars and the choices that go with all of them.
struct Stars {
  std::uint64_t seed = 1;  ///< of the positions
  bool chaikin = false, corners_held = false, smooth_triangles = false;
  /// They are there three times, from vertices 0, 32768 and 65536 on; tetrahedra or cubes fill the gaps.
  bool thrice = false;
  std::vector<Star> stars = {};

  /// "SEED[c][h][s][t]:STAR[_STAR...]".
  std::string text() const;
};

/// What text() writes. Throws InputError NAME_BAD_PARAMETER.
Stars parse_stars(const std::string& text);

/// One component for each star, of triangles or of quads and the faces that a star asks for. The faces of all
/// stars come first, those of the second rings behind them. Every coordinate is exact in float.
/// Throws InputError NAME_BAD_PARAMETER: fewer than 3 spokes inside, than 2 on the boundary; no such letter; a
/// face of fewer than 3 corners, or of more than 3 amid triangles; more than a million faces.
ControlMesh star_mesh(const Stars& stars, bool triangles);

/// The stars of the audit without meshes: every kind of neighbourhood, as few meshes as possible. Mesh k is
/// called "stars:k", from 1 on, or "quad-stars:k".
struct PlannedStars {
  const char* stars;   ///< as parse_stars() reads it
  int depth;           ///< at which the audit asks for it ..
  const char* depths;  ///< .. and how the depths of its faces are chosen, as --depths takes it
  bool relations;      ///< whether the relations are looked at, too
};
/// Found by `limitcheck_make_plan` (verify/audit/make_plan.cpp).
const std::vector<PlannedStars>& planned_stars(bool triangles);

}  // namespace limitcheck::data
