/* SPDX-License-Identifier: MIT */
/* A subject in C: the tessellator of loop.h behind limitcheck's door. It does not say where its points lie: the
 * host finds out (no_provenance). */
#include <limitcheck/subject.h>
#include <stdlib.h>
#include <string.h>

#include "loop.h"

static lc_status capabilities(const char* options, lc_capabilities* out, const char** message) {
  (void)options;
  if (!LC_KNOWS(out, no_provenance)) return *message = "this limitcheck is too old", LC_NOT_SUPPORTED;
  out->precision = LC_FLOAT64; /* all else is 0: Loop's weights, a spline at the boundary, limit points */
  out->max_depth = 6;
  out->normals = out->exact_lattice = out->no_provenance = 1;
  return LC_OK;
}

static lc_status create(const lc_mesh* mesh, const char* options, void** instance, const char** message) {
  (void)options;
  Mesh* kept = malloc(sizeof *kept);
  *kept = mesh_allocate(mesh->vertex_count, mesh->triangle_count);
  if (kept->vertices > 0) memcpy(kept->p, mesh->positions, (size_t)kept->vertices * sizeof(Vec));
  if (kept->halves > 0) memcpy(kept->from, mesh->triangles, (size_t)kept->halves * sizeof(int32_t));
  *message = mesh_connect(kept);
  if (*message == NULL) return *instance = kept, LC_OK;
  mesh_free(*kept), free(kept);
  return LC_INVALID_INPUT;
}

static lc_status tessellate(void* instance, const lc_request* request, lc_tessellation* out,
                            const char** message) {
  Mesh m = mesh_refined(instance, request->face_depth[0]);
  Vec* position = out->positions = request->allocate(request->host, (size_t)m.vertices * sizeof(Vec));
  Vec* normal = out->normals = request->allocate(request->host, (size_t)m.vertices * sizeof(Vec));
  out->triangles = request->allocate(request->host, (size_t)m.halves * sizeof(uint32_t));
  out->vertex_count = m.vertices;
  out->triangle_count = m.halves / 3;
  const int all = position && normal && out->triangles;
  for (int32_t v = 0; all && v < m.vertices; ++v) position[v] = mesh_moved(&m, v, &normal[v]);
  if (all) memcpy(out->triangles, m.from, (size_t)m.halves * sizeof(uint32_t));
  mesh_free(m);
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
