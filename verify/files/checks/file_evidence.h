// SPDX-License-Identifier: MIT
// What the checks of a tessellation file look at.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "data/control_mesh.h"
#include "verify/files/read/provenance.h"
#include "verify/files/read/tessellation_file.h"
#include "verify/projection/closest_point.h"
#include "verify/row/result.h"
#include "verify/watertight/watertight.h"

namespace limitcheck::verify {

/// What a program put in between.
enum class Fit {
  kNone,
  kScale,      // one scale for all axes and an offset
  kSimilarity  // and a rotation
};

/// Moves the tessellation by the map that brings the points it uses nearest to the surface in the sense of least squares,
/// and says which: "scale 2.5, turned by 90 degrees about (1, 0, 0), offset (1, 2, 3); rms distance then 1e-8 diagonals".
///   start    the bounding boxes of points and surface, in each of the 24 orientations along the axes (y up,
///            z up ...; one for kScale); the best of them by closest points
///   rounds   closest points, then Umeyama's similarity between pairs; at the end Gauss and Newton's steps on
///            the distances along the normals, which converge quadratically
///   points   at most 4096 of those that are finite, evenly chosen; of fewer than three the map is the identity
std::string fit(const ClosestPoint& surface, FileTessellation& tessellation, Fit kind);

/// A tessellation on the limit surface of its control mesh. Vertices at one place are one point.
struct FileEvidence {
  std::string control_name;
  const data::ControlMesh& control;
  const ClosestPoint& surface;
  const FileTessellation& tessellation;
  double tolerance;  // of positions, in diagonals

  MergedPoints merged{};
  std::vector<Foot> foot{};  // of each point: the closest, or where the provenance has it
  /// Of each point: the foot as a point of the domain, put on an edge or a corner if it lies there within the
  /// tolerance. Face -1: the point is not used.
  std::vector<FacePoint> place{};
  std::vector<char> quick{};         // of each point, whether its foot was looked for quickly
  std::vector<FacePoint> claimed{};  // of each vertex, by its provenance (face -1: none); empty without

  std::int32_t point_of(std::int32_t vertex) const { return merged.point_of[vertex]; }
  const Vector& position(std::int32_t point) const { return tessellation.positions[merged.vertex_of[point]]; }

  data::Scheme scheme() const { return surface.surface().scheme(); }
  /// The point of each corner of a triangle.
  std::array<std::int32_t, 3> points_of(const std::array<std::int32_t, 3>& triangle) const {
    return {point_of(triangle[0]), point_of(triangle[1]), point_of(triangle[2])};
  }
  Result result(std::string check, std::string unit = {}, std::optional<double> bound = {}) const;
  Witness at_vertex(std::int32_t vertex) const;
  Witness at_point(const LimitSurface::ControlPoint& named) const;
  Witness at_point(const FacePoint& at) const { return at_point(surface.surface().control_point(at)); }
};

/// Whether two corners of a triangle are one point.
inline bool is_collapsed(const std::array<std::int32_t, 3>& p) {
  return p[0] == p[1] || p[1] == p[2] || p[2] == p[0];
}
/// Whether the file has none of what a row looks at, which the row then says.
template <class T>
bool lacks(const std::vector<T>& list, const char* what, Result& row) {
  if (!list.empty()) return false;
  row.status = Status::kNotSupported;
  row.message = std::string("the file has no ") + what;
  return true;
}
inline std::vector<double> list(const Vector& v) {
  return {v.begin(), v.end()};
}

/// A row's place on the surface's own domain.
FacePoint domain_point(const FileEvidence& e, const ProvenanceRow& row);

/// Where vertices lie by how the faces are connected, if these are the faces of the control mesh after some steps and half
/// of the vertices are there within the tolerance; else empty. Then each vertex is held against its own point, and one
/// that was moved along the surface shows.
std::vector<ProvenanceRow> matched_provenance(const FileEvidence& e);

/// Merges, projects and places all used vertices, in parallel; those that `provenance` has, where it says. `told`: by the
/// file's user, so that it is `claimed`. `on_step`: points done, of how many; from any
/// thread, one at a time. `quick`: where one descent ends on the surface, within a quarter of the tolerance, that is the
/// foot. Whoever would blame the file for feet that were found quickly is to search the whole surface for them
/// first, because it may have come near itself; the other feet then stay as they are.
void place_points(FileEvidence& evidence, const std::vector<ProvenanceRow>& provenance, bool told,
                  const std::function<void(std::size_t, std::size_t)>& on_step, bool quick = false);
/// All faces of the domain that a point lies in, ascending.
std::vector<std::int32_t> faces_with(const Domain& domain, const FacePoint& at);
/// A point of the domain in all faces that have it, evaluated in each: on an edge that stays sharp the normals
/// of its sides differ. `p` is the point that projected there.
std::vector<Foot> in_all_faces(const FileEvidence& e, const FacePoint& at, const Vector& p);

/// The three corners of a triangle in one face of the domain, unfolded across an edge if need be.
struct PlacedTriangle {
  std::int32_t face = -1;  // -1: not to be placed
  bool crosses = false;    // some corner lies beyond an edge of the face
  std::array<Chart::Affine, 3> l{};
  double area = 0;  // signed; 1 is the whole face
};
PlacedTriangle place_triangle(const FileEvidence& e, const std::array<std::int32_t, 3>& points);

/// The checks; each returns its rows.
std::vector<Result> check_file_finite(const FileEvidence& e);
std::vector<Result> check_file_distance(const FileEvidence& e);  // file-positions, at the provenance claimed
std::vector<Result> check_file_normals(const FileEvidence& e);   // file-normals, file-normal-length
std::vector<Result> check_file_channel(const FileEvidence& e);   // none if the control mesh has no channel
std::vector<Result> check_file_unused(const FileEvidence& e);
std::vector<Result> check_file_triangles(const FileEvidence& e);  // file-degenerate
std::vector<Result> check_file_cover(const FileEvidence& e);      // file-orientation, file-coverage
std::vector<Result> check_file_watertight(const FileEvidence& e);

}  // namespace limitcheck::verify
