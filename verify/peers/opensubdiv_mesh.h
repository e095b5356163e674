// SPDX-License-Identifier: MIT
// What the OpenSubdiv adapters share. Private to them and to tests.
#pragma once

#include <opensubdiv/bfr/tessellation.h>
#include <opensubdiv/far/error.h>
#include <opensubdiv/far/topologyDescriptor.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "verify/peers/evaluated_faces.h"
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
template <class Real, std::size_t size = 3>
struct OpenSubdivVector {
  std::array<Real, size> x;
  void Clear(void* = nullptr) { x = {}; }
  void AddWithWeight(const OpenSubdivVector& v, Real weight) {
    for (std::size_t c = 0; c < size; ++c) x[c] += weight * v.x[c];
  }
};
/// A value of a channel: its components, and zeros.
template <class Real>
using OpenSubdivValue = OpenSubdivVector<Real, 4>;

template <class Real>
std::vector<OpenSubdivVector<Real>> opensubdiv_points(const lc_mesh& mesh) {
  std::vector<OpenSubdivVector<Real>> points(static_cast<std::size_t>(mesh.vertex_count));
  for (std::size_t v = 0; v < points.size(); ++v)
    for (std::size_t c = 0; c < 3; ++c) points[v].x[c] = static_cast<Real>(mesh.positions[3 * v + c]);
  return points;
}
template <class Real>
std::vector<OpenSubdivValue<Real>> opensubdiv_values(const lc_channel& channel) {
  std::vector<OpenSubdivValue<Real>> values(static_cast<std::size_t>(channel.value_count));
  const double* component = channel.values;
  for (auto& value : values)
    for (std::int32_t k = 0; k < channel.components; ++k)
      value.x[static_cast<std::size_t>(k)] = static_cast<Real>(*component++);
  return values;
}

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

/// The mesh with one of its channels, or with none: a refiner has one rule for all.
inline constexpr std::int64_t kNoChannel = -1;
inline lc_mesh with_channel(lc_mesh mesh, std::int64_t channel) {
  mesh.channel_count = channel == kNoChannel ? 0 : 1;
  if (channel != kNoChannel) mesh.channels += channel;
  return mesh;
}

/// The refiner of a control mesh with its sharp edges and vertices, and its channel, if it has one.
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
  Far::TopologyDescriptor::FVarChannel channel;
  if (mesh.channel_count > 0) {
    channel.numValues = static_cast<int>(mesh.channels->value_count);
    channel.valueIndices = mesh.channels->corners;
    descriptor.numFVarChannels = 1;
    descriptor.fvarChannels = &channel;
    scheme.SetFVarLinearInterpolation(
        static_cast<Sdc::Options::FVarLinearInterpolation>(mesh.channels->rule));
  }
  using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  std::unique_ptr<Far::TopologyRefiner> refiner(Factory::Create(descriptor, Factory::Options(type, scheme)));
  errors.check();
  if (refiner == nullptr) throw SubjectError(LC_INVALID_INPUT, "OpenSubdiv makes no topology of this mesh");
  return refiner;
}
inline std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> make_refiner(const lc_mesh& mesh) {
  return make_refiner(mesh, opensubdiv_scheme(mesh), boundary_rule(mesh));
}

/// The library's own tessellation of a triangle at one depth: (u, v) is (l1, l2), the corners of the face are
/// (0, 0), (1, 0), (0, 1).
inline FacePattern opensubdiv_triangle(int depth) {
  using namespace OpenSubdiv;
  const Bfr::Parameterization triangle(Sdc::SCHEME_LOOP, 3);
  const Bfr::Tessellation tessellation(triangle, 1 << depth);
  std::vector<double> coords(2 * static_cast<std::size_t>(tessellation.GetNumCoords()));
  std::vector<int> facets(3 * static_cast<std::size_t>(tessellation.GetNumFacets()));
  tessellation.GetCoords(coords.data());
  tessellation.GetFacets(facets.data());
  FacePattern pattern;
  pattern.denominator = std::uint32_t{1} << depth;
  const auto on_lattice = [&](double coordinate) {
    const double scaled = coordinate * pattern.denominator;
    if (std::round(scaled) != scaled) throw SubjectError(LC_FAILED, "Bfr leaves the dyadic lattice");
    return static_cast<std::int64_t>(scaled);
  };
  for (std::size_t k = 0; k < coords.size(); k += 2)
    pattern.points.push_back({on_lattice(coords[k]), on_lattice(coords[k + 1])});
  for (std::size_t t = 0; t < facets.size(); t += 3)
    pattern.triangles.push_back({static_cast<std::uint32_t>(facets[t]),
                                 static_cast<std::uint32_t>(facets[t + 1]),
                                 static_cast<std::uint32_t>(facets[t + 2])});
  return pattern;
}

/// The option boundary=edge|none: the interpolation rule of boundary vertices. By the library's own
/// default, none, the faces that touch a boundary have no limit surface.
inline bool without_boundary(Options& options) {
  return options.choice("boundary", {"edge", "none"}) == 1;
}
inline OpenSubdiv::Sdc::Options::VtxBoundaryInterpolation boundary_rule(const lc_mesh& mesh,
                                                                        Options& options) {
  return without_boundary(options) ? OpenSubdiv::Sdc::Options::VTX_BOUNDARY_NONE : boundary_rule(mesh);
}
inline lc_boundary boundary_of(Options& options) {
  return without_boundary(options) ? LC_BOUNDARY_NONE : LC_BOUNDARY_SPLINE;
}

}  // namespace limitcheck::verify
