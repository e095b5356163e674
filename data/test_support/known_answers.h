// SPDX-License-Identifier: MIT
// Known answers: points, derivatives and normals of limit surfaces to 42 digits, each computed by two independent
// routes outside this project. Loop's: standard boundary rule; Stam's order for the regular patch.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "data/control_mesh.h"
#include "data/numeral.h"
#include "data/worst_cases.h"

namespace limitcheck::data {

/// An interior vertex and its ring v_1..v_n, counter-clockwise seen from the normal's side.
/// [mueller2000, eq. 3-5; C14-C17]
struct InteriorRingAnswer {
  std::string id;
  int valence = 0;
  Numeral3 center;
  std::vector<Numeral3> ring;
  Numeral3 limit_position;
  Numeral3 c, s;  ///< sum of cos(2 pi i/n) v_i and of sin(2 pi i/n) v_i, i = 1..n
  Numeral3 unit_normal;
};

/// A boundary vertex with K faces and its open ring r_0..r_K, counter-clockwise; r_0 and r_K lie on the
/// boundary.   [D1, D2]
struct BoundaryRingAnswer {
  std::string id;
  int faces = 0;  ///< K
  Numeral3 center;
  std::vector<Numeral3> ring;
  Numeral3 limit_position;
  Numeral3 along;   ///< r_0 - r_K
  Numeral3 across;  ///< points into the surface
  Numeral3 unit_normal;
};

/// A closed mesh with exact rational answers.
struct ClosedMeshAnswer {
  /// The midpoint of an edge moved by the edge rule.
  struct EdgePoint {
    std::int32_t v0 = 0, v1 = 0;
    Numeral3 position;
  };
  std::string id;
  std::vector<Numeral3> vertices;
  std::vector<std::array<std::int32_t, 3>> faces;
  std::vector<Numeral3> step1_vertex_points;  ///< after one subdivision step, in vertex order
  std::vector<EdgePoint> step1_edge_points;
  std::vector<Numeral3> limit_positions;  ///< of the vertices
  Numeral3 face0_center_limit;            ///< at (1/3, 1/3, 1/3) of face 0
};

/// The twelve basis functions of the regular patch at one parameter, gamma = 1 - alpha - beta.
/// [Appendix A; C69, C70]
struct BasisAnswer {
  std::string id;
  Numeral alpha, beta;
  std::array<Numeral, 12> b, db_dalpha, db_dbeta;
};

/// Loop's without sharp edges, but for points of surfaces.
struct KnownAnswers {
  std::vector<InteriorRingAnswer> interior_rings;
  std::vector<BoundaryRingAnswer> boundary_rings;
  std::vector<ClosedMeshAnswer> closed_meshes;
  std::vector<BasisAnswer> basis;
};

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
  std::string scheme = "loop";        ///< or "catmull-clark"
  std::string boundary = "edge";      ///< vertices of one face are smooth; "edge+corner": they are held
  std::string triangles = "catmark";  ///< or "smooth"
  std::string creasing = "uniform";   ///< or "chaikin"
  std::vector<SharpnessAnswer> sharp_edges, sharp_vertices;
  std::vector<Numeral3> vertices;
  Faces faces;
  std::vector<QuadSample> samples;

  bool has_sharp() const { return !sharp_edges.empty() || !sharp_vertices.empty(); }
};

// Both throw InputError (FILE_CANNOT_OPEN, FILE_SYNTAX) if the file is absent or not of its form.

/// The cases of known_answers.json that are no points of surfaces.
KnownAnswers load_known_answers(const std::filesystem::path& file = data_file("known_answers.json"));
/// Points of surfaces of both schemes, with sharp edges and without.
std::vector<QuadAnswer> load_quad_answers();

/// The vertices rounded to double, with the faces: what an evaluator takes.
ControlMesh control_mesh(const std::vector<Numeral3>& vertices, const Faces& faces);

}  // namespace limitcheck::data
