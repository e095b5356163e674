/* SPDX-License-Identifier: MIT */
/* A subject in C: the tessellator of loop.h behind limitcheck's door. */
#include <limitcheck/subject.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "loop.h"

static lc_status capabilities(const char* options, lc_capabilities* out, const char** message) {
  *out = (lc_capabilities){LC_FLOAT64, LC_WEIGHTS_LOOP, LC_BOUNDARY_SPLINE, LC_POINTS_LIMIT, 6, 1, 0, 1};
  if (options == NULL) return LC_OK;
  *message = "there are no options";
  return LC_INVALID_INPUT;
}

static lc_status create(const lc_mesh* mesh, const char* options, void** instance, const char** message) {
  (void)options;
  if (mesh->vertex_count == 0 || mesh->triangle_count == 0)
    return *message = "there are no triangles", LC_INVALID_INPUT;
  for (int64_t k = 0; k < 3 * mesh->vertex_count; ++k)
    if (!isfinite(mesh->positions[k])) return *message = "a coordinate is not finite", LC_INVALID_INPUT;
  for (int64_t k = 0; k < 3 * mesh->triangle_count; ++k)
    if (mesh->triangles[k] < 0 || mesh->triangles[k] >= mesh->vertex_count)
      return *message = "a triangle names a vertex that does not exist", LC_INVALID_INPUT;
  Mesh m = mesh_allocate(mesh->vertex_count, mesh->triangle_count), *kept = malloc(sizeof *kept);
  memcpy(m.p, mesh->positions, (size_t)m.vertices * sizeof(Vec));
  memcpy(m.from, mesh->triangles, (size_t)m.halves * sizeof(int32_t));
  for (int32_t h = 0; h < m.halves; ++h) m.at[h][0] = h % 3 == 1, m.at[h][1] = h % 3 == 2;
  *kept = m;
  *message = mesh_connect(kept);
  if (*message == NULL) return *instance = kept, LC_OK;
  mesh_free(m), free(kept);
  return LC_INVALID_INPUT;
}

static lc_status tessellate(void* instance, const lc_request* request, lc_tessellation* out,
                            const char** message) {
  const Mesh* control = instance;
  const int32_t depth = request->face_depth[0];
  Mesh m = *control;
  for (int32_t d = 0; d < depth; ++d) {
    const Mesh fine = mesh_refined(&m);
    if (d > 0) mesh_free(m);
    m = fine;
  }
  const size_t v_count = (size_t)m.vertices, h_count = (size_t)m.halves;
  Vec* position = out->positions = request->allocate(request->host, v_count * sizeof(Vec));
  Vec* normal = out->normals = request->allocate(request->host, v_count * sizeof(Vec));
  out->provenance = request->allocate(request->host, v_count * sizeof(lc_provenance));
  out->triangles = request->allocate(request->host, h_count * sizeof(uint32_t));
  out->triangle_face = request->allocate(request->host, h_count / 3 * sizeof(int32_t));
  out->vertex_count = m.vertices;
  out->triangle_count = m.halves / 3;
  const int all = position && normal && out->provenance && out->triangles && out->triangle_face;
  for (int32_t v = 0; all && v < m.vertices; ++v) position[v] = mesh_moved(&m, v, &normal[v]);
  for (int32_t h = 0; all && h < m.halves; ++h) {
    const int32_t face = out->triangle_face[h / 3] = h / 3 >> 2 * depth;
    out->triangles[h] = (uint32_t)m.from[h];
    out->provenance[m.from[h]] = (lc_provenance){face, m.at[h][0], m.at[h][1], 1u << depth};
  }
  if (depth > 0) mesh_free(m);
  if (!all) *message = "out of memory";
  return all ? LC_OK : LC_FAILED;
}

static void release(void* instance, lc_tessellation* out) {
  (void)instance, (void)out;
}
static void destroy(void* instance) {
  mesh_free(*(Mesh*)instance), free(instance);
}

const lc_subject* lc_subject_get(uint32_t abi) {
  static const lc_subject subject = {LC_SUBJECT_ABI, "loop-in-c",  "Loop subdivision step by step, in C",
                                     NULL,           capabilities, create,
                                     tessellate,     release,      destroy};
  return abi == LC_SUBJECT_ABI ? &subject : NULL;
}
