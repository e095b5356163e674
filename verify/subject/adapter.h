// SPDX-License-Identifier: MIT
// The subject's side of the plug-in interface, for adapters written in C++: a class becomes an lc_subject,
// its exceptions become statuses with messages.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <exception>
#include <new>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "verify/subject/lent_mesh.h"
#include "verify/subject/options.h"
#include "verify/subject/subject.h"
#include "verify/subject/subject_error.h"

namespace limitcheck::verify {

/// The arrays of one tessellation, typed. Real is float or double, as the capabilities say.
template <class Real>
struct Output {
  Real* positions;  // 3 * vertices
  Real* normals;    // 3 * vertices, or nullptr
  lc_provenance* provenance;
  std::uint32_t* triangles;  // 3 * triangles
  std::int32_t* triangle_face;
  std::int32_t* corner;  // vertices, or nullptr
};

/// Refuses what does not fit in 32-bit indices when each triangle becomes 4^depth, halfedges included.
inline void refuse_too_many_triangles(const lc_mesh& mesh, int depth) {
  // A face of n corners has no more than n quads after a step, each of two triangles; a triangle of Loop's is
  // one.
  const std::int64_t triangles = mesh.scheme == LC_SCHEME_LOOP ? mesh.face_count : 2 * mesh.corner_count;
  if (triangles > (std::int64_t{UINT32_MAX} / 6 >> (2 * depth))) {
    throw SubjectError(LC_NOT_SUPPORTED, "more triangles at this depth than 32-bit indices can name");
  }
}

/// Refuses a mesh that would be read beyond its arrays, or computed with coordinates that are no numbers.
/// Whether it is a manifold the tessellator itself has to check.
inline void refuse_unusable(const lc_mesh& mesh) {
  for (std::int64_t k = 0; k < 3 * mesh.vertex_count; ++k)
    if (!std::isfinite(mesh.positions[k])) throw SubjectError(LC_INVALID_INPUT, "a coordinate is not finite");
  for (std::int64_t k = 0; k < mesh.corner_count; ++k)
    if (mesh.corners[k] < 0 || mesh.corners[k] >= mesh.vertex_count)
      throw SubjectError(LC_INVALID_INPUT, "a face names a vertex that does not exist");
}

/// The same for tags that mean nothing.
///   any_edge   whether there is such an edge is left to the tessellator, if its ends exist
inline void refuse_unusable_tags(const lc_mesh& mesh, bool any_edge = false) {
  std::set<std::pair<std::int32_t, std::int32_t>> edges;
  const std::int32_t* corner = mesh.corners;
  for (std::int64_t f = 0; mesh.sharp_edge_count > 0 && f < mesh.face_count; corner += mesh.face_sizes[f++])
    for (std::int32_t k = 0, n = mesh.face_sizes[f]; k < n; ++k)
      edges.insert(std::minmax(corner[k], corner[(k + 1) % n]));
  for (std::int64_t k = 0; k < mesh.sharp_edge_count; ++k) {
    const lc_sharp_edge& e = mesh.sharp_edges[k];
    const bool ends_exist = std::min(e.a, e.b) >= 0 && std::max(e.a, e.b) < mesh.vertex_count;
    if (!(any_edge ? ends_exist : edges.contains(std::minmax(e.a, e.b))))
      throw SubjectError(LC_INVALID_INPUT, "a sharp edge is none");
    if (!(e.sharpness > 0)) throw SubjectError(LC_INVALID_INPUT, "the sharpness of an edge is not above 0");
  }
  for (std::int64_t k = 0; k < mesh.sharp_vertex_count; ++k) {
    const lc_sharp_vertex& v = mesh.sharp_vertices[k];
    if (v.vertex < 0 || v.vertex >= mesh.vertex_count)
      throw SubjectError(LC_INVALID_INPUT, "a sharp vertex does not exist");
    if (!(v.sharpness > 0)) throw SubjectError(LC_INVALID_INPUT, "the sharpness of a vertex is not above 0");
  }
}

/// The depth of a request that has one for all faces; 0 where there are no faces.
inline int uniform_depth(const lc_request& request, const lc_mesh& mesh) {
  return mesh.face_count > 0 ? request.face_depth[0] : 0;
}

/// The fraction over 2^30 that is nearest to (u, v): that point, where they are multiples of 2^-30.
inline lc_provenance nearest_place(std::int32_t face, float u, float v) {
  constexpr std::uint32_t kOver = 1U << 30;
  const auto whole = [](float x) {
    return static_cast<std::uint32_t>(
        std::fmax(0.0, std::fmin(std::nearbyint(static_cast<double>(x) * kOver), 4e9)));
  };
  return {face, whole(u), whole(v), kOver};
}

/// Allocates from the host and announces the arrays in `out`. Throws SubjectError if the host has no memory,
/// or the vertices outnumber 32-bit indices.
///   corners  the provenance names corners of faces that are no quads
template <class Real>
Output<Real> allocate_output(const lc_request& request, lc_tessellation& out, std::int64_t vertices,
                             std::int64_t triangles, bool normals, bool corners = false) {
  if (vertices > std::int64_t{UINT32_MAX})
    throw SubjectError(LC_NOT_SUPPORTED, "more vertices than 32-bit indices");
  const auto get = [&](std::int64_t elements, std::size_t size) {
    void* memory = request.allocate(request.host, static_cast<std::size_t>(elements) * size);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
  };
  out.vertex_count = vertices;
  out.triangle_count = triangles;
  out.positions = get(vertices, 3 * sizeof(Real));
  out.normals = normals ? get(vertices, 3 * sizeof(Real)) : nullptr;
  out.provenance = static_cast<lc_provenance*>(get(vertices, sizeof(lc_provenance)));
  out.triangles = static_cast<std::uint32_t*>(get(triangles, 3 * sizeof(std::uint32_t)));
  out.triangle_face = static_cast<std::int32_t*>(get(triangles, sizeof(std::int32_t)));
  out.corner = corners ? static_cast<std::int32_t*>(get(vertices, sizeof(std::int32_t))) : nullptr;
  return {static_cast<Real*>(out.positions),
          static_cast<Real*>(out.normals),
          out.provenance,
          out.triangles,
          out.triangle_face,
          out.corner};
}

/// All rules of channels.
inline constexpr std::int32_t kAllChannelRules = (2 << LC_CHANNEL_ALL) - 1;

/// Allocates the values of the mesh's channels, or their derivatives: see lc_tessellation, whose triangle_count is set.
template <class Real>
Real* allocate_channels(const lc_request& request, const lc_mesh& mesh, lc_tessellation& out,
                        void* lc_tessellation::*array = &lc_tessellation::channel_values) {
  std::size_t numbers = array == &lc_tessellation::channel_values ? 3 : 6;
  numbers *= static_cast<std::size_t>(out.triangle_count) * components_of_channels(mesh);
  out.*array = request.allocate(request.host, numbers * sizeof(Real));
  if (out.*array == nullptr) throw std::bad_alloc();
  return static_cast<Real*>(out.*array);
}

/// A tessellation whose sizes are known only when it is done: in double, which holds a float exactly.
struct DeliveredArrays {
  using Vector = std::array<double, 3>;
  std::vector<Vector> positions, normals;  // no normals: empty
  std::vector<lc_provenance> provenance;
  std::vector<std::int32_t> corner;  // empty: not delivered
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::int32_t> triangle_face;

  /// Returns its number.
  std::uint32_t add_vertex(const auto& position, const auto& normal, const lc_provenance& at,
                           std::int32_t of_corner) {
    positions.push_back({position.x, position.y, position.z});
    normals.push_back({normal.x, normal.y, normal.z});
    provenance.push_back(at);
    corner.push_back(of_corner);
    return static_cast<std::uint32_t>(positions.size() - 1);
  }
  void add_triangle(const std::array<std::uint32_t, 3>& triangle, std::int32_t face) {
    triangles.push_back(triangle);
    triangle_face.push_back(face);
  }
  /// To arrays that have room for it; what they have no array for is left out.
  template <class Real>
  void write(const Output<Real>& output) const {
    const auto put = [](const std::vector<Vector>& list, Real* to) {
      for (const Vector& p : list)
        for (const double x : p) *to++ = static_cast<Real>(x);
    };
    put(positions, output.positions);
    if (output.normals != nullptr) put(normals, output.normals);
    std::copy(provenance.begin(), provenance.end(), output.provenance);
    if (output.corner != nullptr) std::copy(corner.begin(), corner.end(), output.corner);
    std::uint32_t* to = output.triangles;
    for (const auto& t : triangles) to = std::copy(t.begin(), t.end(), to);
    std::copy(triangle_face.begin(), triangle_face.end(), output.triangle_face);
  }
  /// To arrays of the host.
  template <class Real>
  void hand_over(const lc_request& request, lc_tessellation& out, bool with_normals,
                 bool with_corners) const {
    write(allocate_output<Real>(request, out, static_cast<std::int64_t>(positions.size()),
                                static_cast<std::int64_t>(triangles.size()), with_normals, with_corners));
  }
};

namespace detail {

template <class Work>
lc_status guarded(const char** message, Work&& work) noexcept {
  thread_local std::string text;
  try {
    work();
    return LC_OK;
  } catch (const SubjectError& refusal) {
    text = refusal.what();
    *message = text.c_str();
    return refusal.status();
  } catch (const std::bad_alloc&) {
    *message = "out of memory";
  } catch (const std::exception& error) {
    text = error.what();
    *message = text.c_str();
  } catch (...) {
    *message = "an exception of unknown type";
  }
  return LC_FAILED;
}

/// What T says of itself, with the schemes that it has.
template <class T>
lc_capabilities capabilities_of(Options& options, lc_scheme scheme) {
  lc_capabilities result = T::capabilities(options, scheme);
  if (result.schemes == 0) result.schemes = LC_DOES_LOOP | LC_DOES_CATMULL_CLARK;
  if constexpr (requires { T::kSchemes; }) result.schemes = T::kSchemes;
  if constexpr (requires { T::kSharp; }) result.sharp = T::kSharp;
  result.size = sizeof result;
  result.scheme = scheme;
  return result;
}

}  // namespace detail

/// The function table of the adapter class T, which has
///   static lc_capabilities capabilities(Options&, lc_scheme)   for one scheme
///   static constexpr std::int32_t kSchemes                     if it does not do both: LC_DOES_...
///   static constexpr std::int32_t kSharp                       if it does sharp edges: LC_SHARP_...
///   static constexpr bool kLeavesRefusals                      if it refuses unusable meshes itself
///   T(const lc_mesh&, Options&)
///   void tessellate(const lc_request&, lc_tessellation&)    all memory from the request
/// Options that T does not read are refused.
template <class T>
lc_subject make_subject(const char* name, const char* description, const char* options_help = nullptr) {
  lc_subject subject{};
  subject.abi = LC_SUBJECT_ABI;
  subject.name = name;
  subject.description = description;
  subject.options = options_help;
  subject.capabilities = [](const char* text, lc_capabilities* out, const char** message) {
    return detail::guarded(message, [&] {
      Options options(text);
      const std::uint32_t known = out->size;
      const lc_capabilities mine = detail::capabilities_of<T>(options, out->scheme);
      std::memcpy(out, &mine, std::min<std::size_t>(known, sizeof mine));
      out->size = known;
      options.finish();
    });
  };
  subject.create = [](const lc_mesh* mesh, const char* text, void** instance, const char** message) {
    return detail::guarded(message, [&] {
      Options options(text);
      const lc_capabilities has = detail::capabilities_of<T>(options, mesh->scheme);
      options.finish();
      if (!does(has, scheme_of(mesh->scheme)))
        throw SubjectError(LC_NOT_SUPPORTED, "does not do this scheme");
      if constexpr (!requires { T::kLeavesRefusals; }) {
        refuse_unusable(*mesh);
        refuse_unusable_tags(
            *mesh, requires { T::kTakesAnyEdge; });
      }
      *instance = new T(*mesh, options);
    });
  };
  subject.tessellate = [](void* instance, const lc_request* request, lc_tessellation* out,
                          const char** message) {
    return detail::guarded(message, [&] { static_cast<T*>(instance)->tessellate(*request, *out); });
  };
  subject.release = [](void*, lc_tessellation*) {};
  subject.destroy = [](void* instance) { delete static_cast<T*>(instance); };
  return subject;
}

}  // namespace limitcheck::verify
