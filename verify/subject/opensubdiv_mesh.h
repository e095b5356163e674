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

/// The refiner of a control mesh: by default boundary vertices on the B-spline curve, none of them a corner.
inline std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> make_refiner(
    const lc_mesh& mesh, OpenSubdiv::Sdc::SchemeType type,
    OpenSubdiv::Sdc::Options::VtxBoundaryInterpolation boundary =
        OpenSubdiv::Sdc::Options::VTX_BOUNDARY_EDGE_ONLY) {
  using namespace OpenSubdiv;
  const OpenSubdivErrors errors;
  Far::TopologyDescriptor descriptor;
  descriptor.numVertices = static_cast<int>(mesh.vertex_count);
  descriptor.numFaces = static_cast<int>(mesh.face_count);
  descriptor.numVertsPerFace = mesh.face_sizes;
  descriptor.vertIndicesPerFace = mesh.corners;
  Sdc::Options scheme;
  scheme.SetVtxBoundaryInterpolation(boundary);
  using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  std::unique_ptr<Far::TopologyRefiner> refiner(Factory::Create(descriptor, Factory::Options(type, scheme)));
  errors.check();
  if (refiner == nullptr) throw SubjectError(LC_INVALID_INPUT, "OpenSubdiv makes no topology of this mesh");
  return refiner;
}
inline std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> make_refiner(const lc_mesh& mesh) {
  return make_refiner(mesh, opensubdiv_scheme(mesh));
}

}  // namespace limitcheck::verify
