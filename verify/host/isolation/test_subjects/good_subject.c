/* SPDX-License-Identifier: MIT */
/* A right subject with provenance: the tessellator of examples/c, which has none. */
#include <limitcheck/subject.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "verify/subject/examples/c/loop.h"

/* (i, j) of corner k of triangle t after so many steps; n steps to a side. */
static void place(int32_t t, int32_t depth, int k, uint32_t at[2]) {
  const uint32_t n = 1u << depth;
  uint32_t c[3][2] = {{0, 0}, {n, 0}, {0, n}};
  for (int32_t d = depth - 1; d >= 0; --d) {
    const int child = t >> 2 * d & 3;
    uint32_t middle[3][2];
    for (int e = 0; e < 3; ++e)
      for (int x = 0; x < 2; ++x) middle[e][x] = (c[e][x] + c[(e + 1) % 3][x]) / 2;
    for (int x = 0; x < 2; ++x) {
      if (child < 3) c[0][x] = c[child][x], c[1][x] = middle[child][x], c[2][x] = middle[(child + 2) % 3][x];
      for (int e = 0; e < 3 && child == 3; ++e) c[e][x] = middle[e][x];
    }
  }
  at[0] = c[k][0], at[1] = c[k][1];
}

static lc_status capabilities(const char* options, lc_capabilities* out, const char** message) {
  *out = (lc_capabilities){LC_FLOAT64, LC_WEIGHTS_LOOP, LC_BOUNDARY_SPLINE, LC_POINTS_LIMIT, 6, 1, 0, 1};
  if (options == NULL) return LC_OK;
  *message = "there are no options";
  return LC_INVALID_INPUT;
}

static lc_status create(const lc_mesh* mesh, const char* options, void** instance, const char** message) {
  (void)options;
  Mesh m = mesh_allocate(mesh->vertex_count, mesh->triangle_count), *kept = malloc(sizeof *kept);
  if (m.vertices > 0) memcpy(m.p, mesh->positions, (size_t)m.vertices * sizeof(Vec));
  if (m.halves > 0) memcpy(m.from, mesh->triangles, (size_t)m.halves * sizeof(int32_t));
  *kept = m;
  *message = mesh_connect(kept);
  if (*message == NULL) return *instance = kept, LC_OK;
  mesh_free(m), free(kept);
  return LC_INVALID_INPUT;
}

static lc_status tessellate(void* instance, const lc_request* request, lc_tessellation* out,
                            const char** message) {
  const int32_t depth = request->face_depth[0];
  Mesh m = mesh_refined(instance, depth);
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
    uint32_t at[2];
    place(h / 3, depth, h % 3, at);
    out->provenance[m.from[h]] = (lc_provenance){face, at[0], at[1], 1u << depth};
  }
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
