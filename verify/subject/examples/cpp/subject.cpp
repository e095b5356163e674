// SPDX-License-Identifier: MIT
// A subject in C++: the tessellator of loop.h behind limitcheck's plug-in interface, delivering in float.
#include <limitcheck/subject.h>

#include <exception>
#include <memory>
#include <new>
#include <string>
#include <type_traits>

#include "loop.h"

namespace {

void deliver(const Mesh& mesh, const lc_request& request, lc_tessellation& out) {
  const auto get = [&](auto*& array, std::size_t count) {
    array = static_cast<std::remove_reference_t<decltype(array)>>(
        request.allocate(request.host, count * sizeof(*array)));
    if (array == nullptr) throw std::bad_alloc();
  };
  float *position = nullptr, *normal = nullptr;
  get(position, 3 * mesh.positions.size());
  get(normal, 3 * mesh.positions.size());
  get(out.provenance, mesh.positions.size());
  get(out.triangles, 3 * mesh.triangles.size());
  get(out.triangle_face, mesh.triangles.size());
  out.positions = position;
  out.normals = normal;
  for (; out.vertex_count < static_cast<std::int64_t>(mesh.positions.size()); ++out.vertex_count) {
    Vec n{};
    for (const double x : mesh.moved(static_cast<int>(out.vertex_count), &n))
      *position++ = static_cast<float>(x);
    for (const double x : n) *normal++ = static_cast<float>(x);
  }
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      out.triangles[3 * out.triangle_count + static_cast<std::int64_t>(k)] = static_cast<unsigned>(t.v[k]);
      out.provenance[t.v[k]] = {t.face, t.at[k][0], t.at[k][1], 1U << request.face_depth[0]};
    }
    out.triangle_face[out.triangle_count++] = t.face;
  }
}

// Exceptions end here: the interface is C. The text is to stay until the next call.
lc_status refuse(lc_status status, const std::exception& error, const char** message) {
  static std::string text;
  text = error.what();
  *message = text.c_str();
  return status;
}

}  // namespace

extern "C" const lc_subject* lc_subject_get(std::uint32_t abi) {
  static lc_subject subject{};
  subject.abi = LC_SUBJECT_ABI;
  subject.name = "loop-in-c++";
  subject.description = "Loop subdivision step by step, in C++";
  subject.capabilities = [](const char*, lc_capabilities* out, const char**) {
    *out = {LC_FLOAT32, LC_WEIGHTS_LOOP, LC_BOUNDARY_SPLINE, LC_POINTS_LIMIT, 6, 1, 0, 1};
    return LC_OK;
  };
  subject.create = [](const lc_mesh* control, const char*, void** instance, const char** message) {
    try {
      auto mesh = std::make_unique<Mesh>();
      for (std::int64_t v = 0; v < control->vertex_count; ++v) {
        const double* p = control->positions + 3 * v;
        mesh->positions.push_back({p[0], p[1], p[2]});
      }
      for (int f = 0; f < control->triangle_count; ++f) {
        const std::int32_t* t = control->triangles + 3 * f;
        mesh->triangles.push_back({{t[0], t[1], t[2]}, f, {{{0, 0}, {1, 0}, {0, 1}}}});
      }
      mesh->connect();
      *instance = mesh.release();
      return LC_OK;
    } catch (const std::invalid_argument& refusal) {
      return refuse(LC_INVALID_INPUT, refusal, message);
    } catch (const std::exception& error) {
      return refuse(LC_FAILED, error, message);
    }
  };
  subject.tessellate = [](void* instance, const lc_request* request, lc_tessellation* out,
                          const char** message) {
    try {
      Mesh mesh = *static_cast<const Mesh*>(instance);
      for (int d = 0; d < request->face_depth[0]; ++d) mesh = mesh.refined();
      deliver(mesh, *request, *out);
      return LC_OK;
    } catch (const std::exception& error) {
      return refuse(LC_FAILED, error, message);
    }
  };
  subject.release = [](void*, lc_tessellation*) {};
  subject.destroy = [](void* instance) { delete static_cast<Mesh*>(instance); };
  return abi == LC_SUBJECT_ABI ? &subject : nullptr;
}
