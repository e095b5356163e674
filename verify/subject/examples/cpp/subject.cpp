// SPDX-License-Identifier: MIT
// The tessellator of loop.h behind limitcheck's door, in float. The host finds out where its points lie.
#include <limitcheck/subject.h>

#include "loop.h"

extern "C" const lc_subject* lc_subject_get(std::uint32_t abi) {
  static lc_subject subject{LC_SUBJECT_ABI, "loop-in-c++", "Loop subdivision step by step, in C++"};
  subject.capabilities = [](const char*, lc_capabilities* out, const char** message) {
    if (!LC_KNOWS(out, no_provenance)) return *message = "this limitcheck is too old", LC_NOT_SUPPORTED;
    out->max_depth = 6;  // all else is 0: float, Loop's weights, a spline at the boundary, limit points
    out->normals = out->exact_lattice = out->no_provenance = 1;
    return LC_OK;
  };
  subject.create = [](const lc_mesh* m, const char*, void** instance, const char** message) {
    auto* mesh = new Mesh(m->positions, m->vertex_count, m->triangles, m->triangle_count);
    if ((*message = mesh->connect()) == nullptr) return *instance = mesh, LC_OK;
    return delete mesh, LC_INVALID_INPUT;
  };
  subject.tessellate = [](void* instance, const lc_request* request, lc_tessellation* out, const char**) {
    const Mesh mesh = static_cast<const Mesh*>(instance)->refined(request->face_depth[0]);
    const std::size_t vertices = mesh.positions.size(), triangles = mesh.triangles.size();
    out->vertex_count = static_cast<std::int64_t>(vertices);
    out->triangle_count = static_cast<std::int64_t>(triangles);
    auto* p = static_cast<float*>(out->positions = request->allocate(request->host, 12 * vertices));
    auto* n = static_cast<float*>(out->normals = request->allocate(request->host, 12 * vertices));
    out->triangles = static_cast<std::uint32_t*>(request->allocate(request->host, 12 * triangles));
    if (p == nullptr || n == nullptr || out->triangles == nullptr) return LC_FAILED;
    for (std::size_t v = 0; v < vertices; ++v, p += 3, n += 3) {
      Vec normal{};
      std::ranges::copy(mesh.moved(static_cast<int>(v), &normal), p);
      std::ranges::copy(normal, n);
    }
    std::memcpy(out->triangles, mesh.triangles.data(), 12 * triangles);
    return LC_OK;
  };
  subject.release = [](void*, lc_tessellation*) {};
  subject.destroy = [](void* instance) { delete static_cast<Mesh*>(instance); };
  return abi == LC_SUBJECT_ABI ? &subject : nullptr;
}
