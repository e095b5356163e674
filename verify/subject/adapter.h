// SPDX-License-Identifier: MIT
// The subject's side of the plug-in interface, for adapters written in C++: a class becomes an lc_subject,
// its exceptions become statuses with messages.
#pragma once

#include <cmath>
#include <cstdint>
#include <exception>
#include <new>
#include <string>

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
};

/// Refuses what does not fit in 32-bit indices when each triangle becomes 4^depth, halfedges included.
inline void refuse_too_many_triangles(const lc_mesh& mesh, int depth) {
  if (mesh.triangle_count > (std::int64_t{UINT32_MAX} / 6 >> (2 * depth))) {
    throw SubjectError(LC_NOT_SUPPORTED, "more triangles at this depth than 32-bit indices can name");
  }
}

/// Refuses a mesh that would be read beyond its arrays, or computed with coordinates that are no numbers.
/// Whether it is a manifold the tessellator itself has to check.
inline void refuse_unusable(const lc_mesh& mesh) {
  for (std::int64_t k = 0; k < 3 * mesh.vertex_count; ++k)
    if (!std::isfinite(mesh.positions[k])) throw SubjectError(LC_INVALID_INPUT, "a coordinate is not finite");
  for (std::int64_t k = 0; k < 3 * mesh.triangle_count; ++k)
    if (mesh.triangles[k] < 0 || mesh.triangles[k] >= mesh.vertex_count)
      throw SubjectError(LC_INVALID_INPUT, "a triangle names a vertex that does not exist");
}

/// The depth of a request that has one for all faces; 0 where there are no faces.
inline int uniform_depth(const lc_request& request, const lc_mesh& mesh) {
  return mesh.triangle_count > 0 ? request.face_depth[0] : 0;
}

/// Allocates from the host and announces the arrays in `out`. Throws SubjectError if the host has no memory,
/// or the vertices outnumber 32-bit indices.
template <class Real>
Output<Real> allocate_output(const lc_request& request, lc_tessellation& out, std::int64_t vertices,
                             std::int64_t triangles, bool normals) {
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
  return {static_cast<Real*>(out.positions), static_cast<Real*>(out.normals), out.provenance, out.triangles,
          out.triangle_face};
}

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

}  // namespace detail

/// The function table of the adapter class T, which has
///   static lc_capabilities capabilities(Options&)
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
      *out = T::capabilities(options);
      options.finish();
    });
  };
  subject.create = [](const lc_mesh* mesh, const char* text, void** instance, const char** message) {
    return detail::guarded(message, [&] {
      Options options(text);
      (void)T::capabilities(options);
      options.finish();
      refuse_unusable(*mesh);
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
