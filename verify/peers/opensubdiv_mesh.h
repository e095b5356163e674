// SPDX-License-Identifier: MIT
// What the OpenSubdiv adapters share. Private to them and to tests.
#pragma once

#include <opensubdiv/far/error.h>
#include <opensubdiv/far/topologyDescriptor.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "verify/subject/adapter.h"

namespace limitcheck::verify {

/// OpenSubdiv reports errors through one process-wide callback, by default a line on standard output. While
/// an object of this class lives, what is reported on its thread is kept instead. (SetErrorCallback is called
/// once, for good.)
class OpenSubdivErrors {
 public:
  OpenSubdivErrors() {
    static const bool installed = [] {
      OpenSubdiv::Far::SetErrorCallback(
          [](OpenSubdiv::Far::ErrorType, const char* message) { text() = message; });
      OpenSubdiv::Far::SetWarningCallback([](const char*) {});
      return true;
    }();
    (void)installed;
    text().clear();
  }
  /// Throws SubjectError(LC_FAILED) if something was reported.
  void check() const {
    if (!text().empty()) throw SubjectError(LC_FAILED, text());
  }

 private:
  static std::string& text() {
    thread_local std::string message;
    return message;
  }
};

/// What PrimvarRefiner interpolates.
template <class Real>
struct OpenSubdivVector {
  std::array<Real, 3> x;
  void Clear(void* = nullptr) { x = {}; }
  void AddWithWeight(const OpenSubdivVector& v, Real weight) {
    for (std::size_t c = 0; c < 3; ++c) x[c] += weight * v.x[c];
  }
};

inline OpenSubdiv::Sdc::SchemeType opensubdiv_scheme(const lc_mesh& mesh) {
  return mesh.scheme == LC_SCHEME_LOOP ? OpenSubdiv::Sdc::SCHEME_LOOP : OpenSubdiv::Sdc::SCHEME_CATMARK;
}

/// What the library does of sharp edges: all of it. A sharpness of 10 and more is infinite there, too.
inline constexpr std::int32_t kOpenSubdivSharp =
    LC_SHARP_CREASES | LC_SHARP_SEMI | LC_SHARP_CHAIKIN | LC_SHARP_CORNERS | LC_SHARP_SMOOTH_TRIANGLES;

/// Boundary vertices on the B-spline curve, those of one face held or not as the mesh says.
inline OpenSubdiv::Sdc::Options::VtxBoundaryInterpolation boundary_rule(const lc_mesh& mesh) {
  using Rules = OpenSubdiv::Sdc::Options;
  return mesh.corners_held != 0 ? Rules::VTX_BOUNDARY_EDGE_AND_CORNER : Rules::VTX_BOUNDARY_EDGE_ONLY;
}

/// The refiner of a control mesh with its sharp edges and vertices.
inline std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> make_refiner(
    const lc_mesh& mesh, OpenSubdiv::Sdc::SchemeType type,
    OpenSubdiv::Sdc::Options::VtxBoundaryInterpolation boundary) {
  using namespace OpenSubdiv;
  const OpenSubdivErrors errors;
  Far::TopologyDescriptor descriptor;
  descriptor.numVertices = static_cast<int>(mesh.vertex_count);
  descriptor.numFaces = static_cast<int>(mesh.face_count);
  descriptor.numVertsPerFace = mesh.face_sizes;
  descriptor.vertIndicesPerFace = mesh.corners;
  std::vector<int> edges, vertices;
  std::vector<float> of_edges, of_vertices;
  for (std::int64_t k = 0; k < mesh.sharp_edge_count; ++k) {
    edges.insert(edges.end(), {mesh.sharp_edges[k].a, mesh.sharp_edges[k].b});
    of_edges.push_back(mesh.sharp_edges[k].sharpness);
  }
  for (std::int64_t k = 0; k < mesh.sharp_vertex_count; ++k) {
    vertices.push_back(mesh.sharp_vertices[k].vertex);
    of_vertices.push_back(mesh.sharp_vertices[k].sharpness);
  }
  descriptor.numCreases = static_cast<int>(of_edges.size());
  descriptor.creaseVertexIndexPairs = edges.data();
  descriptor.creaseWeights = of_edges.data();
  descriptor.numCorners = static_cast<int>(of_vertices.size());
  descriptor.cornerVertexIndices = vertices.data();
  descriptor.cornerWeights = of_vertices.data();
  Sdc::Options scheme;
  scheme.SetVtxBoundaryInterpolation(boundary);
  if (mesh.creasing == LC_CREASING_CHAIKIN) scheme.SetCreasingMethod(Sdc::Options::CREASE_CHAIKIN);
  if (mesh.smooth_triangles != 0) scheme.SetTriangleSubdivision(Sdc::Options::TRI_SUB_SMOOTH);
  using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  std::unique_ptr<Far::TopologyRefiner> refiner(Factory::Create(descriptor, Factory::Options(type, scheme)));
  errors.check();
  if (refiner == nullptr) throw SubjectError(LC_INVALID_INPUT, "OpenSubdiv makes no topology of this mesh");
  return refiner;
}
inline std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> make_refiner(const lc_mesh& mesh) {
  return make_refiner(mesh, opensubdiv_scheme(mesh), boundary_rule(mesh));
}

}  // namespace limitcheck::verify
