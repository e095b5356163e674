/* SPDX-License-Identifier: MIT */
/* A library as it was built for interface 1. These are its declarations as limitcheck 0.1 installed them,
 * less the comments: if they no longer fit what the host hands over, the host has broken its word, not this
 * file. Its points are the control mesh at depth 0. With WHATEVER_IS_ASKED it answers as a library may that
 * never looks at the interface asked for. */
#include <stddef.h>
#include <stdint.h>
#include <string.h>

typedef enum lc_status { LC_OK = 0, LC_NOT_SUPPORTED = 1, LC_INVALID_INPUT = 2, LC_FAILED = 3 } lc_status;
typedef enum lc_precision { LC_FLOAT32 = 0, LC_FLOAT64 = 1 } lc_precision;
typedef enum lc_weights { LC_WEIGHTS_LOOP = 0, LC_WEIGHTS_WARREN = 1 } lc_weights;
typedef enum lc_boundary { LC_BOUNDARY_SPLINE = 0, LC_BOUNDARY_NONE = 1 } lc_boundary;
typedef enum lc_points { LC_POINTS_LIMIT = 0, LC_POINTS_REFINED = 1 } lc_points;

typedef struct lc_capabilities {
  lc_precision precision;
  lc_weights weights;
  lc_boundary boundary;
  lc_points points;
  int32_t max_depth, normals, per_face_depth, exact_lattice;
} lc_capabilities;

typedef struct lc_mesh {
  const double* positions;
  int64_t vertex_count;
  const int32_t* triangles;
  int64_t triangle_count;
} lc_mesh;

typedef struct lc_request {
  const int32_t* face_depth;
  int32_t threads;
  void* host;
  void* (*allocate)(void* host, size_t bytes);
} lc_request;

typedef struct lc_provenance {
  int32_t face;
  uint32_t i, j, denominator;
} lc_provenance;

typedef struct lc_tessellation {
  int64_t vertex_count, triangle_count;
  void *positions, *normals;
  lc_provenance* provenance;
  uint32_t* triangles;
  int32_t* triangle_face;
  void* owner;
} lc_tessellation;

typedef struct lc_subject {
  uint32_t abi;
  const char *name, *description, *options;
  lc_status (*capabilities)(const char* options, lc_capabilities* out, const char** message);
  lc_status (*create)(const lc_mesh* mesh, const char* options, void** instance, const char** message);
  lc_status (*tessellate)(void* instance, const lc_request* request, lc_tessellation* out,
                          const char** message);
  void (*release)(void* instance, lc_tessellation* out);
  void (*destroy)(void* instance);
} lc_subject;

/* What 0.1 laid out on a machine of 64 bits. */
typedef char capabilities_have_32_bytes[sizeof(lc_capabilities) == 32 ? 1 : -1];
typedef char a_mesh_has_32_bytes[sizeof(lc_mesh) == 32 ? 1 : -1];
typedef char a_request_has_32_bytes[sizeof(lc_request) == 32 ? 1 : -1];
typedef char a_tessellation_has_64_bytes[sizeof(lc_tessellation) == 64 ? 1 : -1];

static lc_mesh control;

static lc_status capabilities(const char* options, lc_capabilities* out, const char** message) {
  const lc_capabilities mine = {LC_FLOAT64, LC_WEIGHTS_LOOP, LC_BOUNDARY_SPLINE, LC_POINTS_REFINED, 0, 0, 0,
                                1};
  (void)options, (void)message;
  *out = mine;
  return LC_OK;
}
static lc_status create(const lc_mesh* mesh, const char* options, void** instance, const char** message) {
  (void)options;
  if (mesh->triangles == NULL) return *message = "interface 1 knows triangles", LC_INVALID_INPUT;
  control = *mesh;
  *instance = &control;
  return LC_OK;
}
static lc_status tessellate(void* instance, const lc_request* request, lc_tessellation* out,
                            const char** message) {
  const lc_mesh* m = instance;
  const size_t v_count = (size_t)m->vertex_count, t_count = (size_t)m->triangle_count;
  (void)message;
  out->vertex_count = m->vertex_count;
  out->triangle_count = m->triangle_count;
  out->positions = request->allocate(request->host, v_count * 3 * sizeof(double));
  out->provenance = request->allocate(request->host, v_count * sizeof(lc_provenance));
  out->triangles = request->allocate(request->host, t_count * 3 * sizeof(uint32_t));
  out->triangle_face = request->allocate(request->host, t_count * sizeof(int32_t));
  memcpy(out->positions, m->positions, v_count * 3 * sizeof(double));
  memcpy(out->triangles, m->triangles, t_count * 3 * sizeof(uint32_t));
  for (size_t t = 0; t < t_count; ++t) {
    const lc_provenance corner[3] = {{(int32_t)t, 0, 0, 1}, {(int32_t)t, 1, 0, 1}, {(int32_t)t, 0, 1, 1}};
    for (int k = 0; k < 3; ++k) out->provenance[m->triangles[3 * t + (size_t)k]] = corner[k];
    out->triangle_face[t] = (int32_t)t;
  }
  return LC_OK;
}
static void release(void* instance, lc_tessellation* out) {
  (void)instance;
  memset(out, 0, sizeof *out);
}
static void destroy(void* instance) {
  (void)instance;
}

__attribute__((visibility("default"))) const lc_subject* lc_subject_get(uint32_t abi);
const lc_subject* lc_subject_get(uint32_t abi) {
  static const lc_subject subject = {
      1, "interface-1", "the control mesh", NULL, capabilities, create, tessellate, release, destroy};
#if defined(WHATEVER_IS_ASKED)
  (void)abi;
  return &subject;
#else
  return abi == 1 ? &subject : NULL;
#endif
}
