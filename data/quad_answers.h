// SPDX-License-Identifier: MIT
// Known answers for Catmull-Clark's surfaces, and Loop's with sharp edges: points, derivatives and normals to
// 42 digits, each computed by two independent routes outside this project.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "data/faces.h"
#include "data/numeral.h"

namespace limitcheck::data {

/// One point of a surface, and what lies there.
struct QuadSample {
  int face = 0;
  int corner = 0;             ///< of a face that is no quad: whose sub-quad (u, v) is in
  std::array<Numeral, 2> uv;  ///< Loop's: (l1, l2), and du is by l1
  bool at_vertex = false;     ///< an extraordinary vertex itself: no derivatives
  bool no_tangent_plane = false;
  Numeral3 position;
  std::optional<Numeral3> normal, du, dv, dudu, dudv, dvdv;
};

/// An edge (a, b) or a vertex (a, -1), and its sharpness: "23/10"; infinite is "10".
struct SharpnessAnswer {
  std::int32_t a, b;
  Numeral sharpness;
};

/// A mesh and samples on it.
struct QuadAnswer {
  std::string id;
  std::string scheme;     ///< "catmull-clark" or "loop"
  std::string boundary;   ///< "edge": vertices of one face are smooth; "edge+corner": they are held
  std::string triangles;  ///< "catmark" or "smooth"
  std::string creasing;   ///< "uniform" or "chaikin"
  std::vector<SharpnessAnswer> sharp_edges, sharp_vertices;
  std::vector<Numeral3> vertices;
  Faces faces;
  std::vector<QuadSample> samples;

  bool has_sharp() const { return !sharp_edges.empty() || !sharp_vertices.empty(); }
};

/// All cases of data/known_answers_catmull_clark.json in the source tree, or where it was installed.
///   throws   InputError (FILE_CANNOT_OPEN, FILE_SYNTAX) if the file is absent or not of this form
std::vector<QuadAnswer> load_quad_answers();

}  // namespace limitcheck::data
