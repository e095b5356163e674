/* SPDX-License-Identifier: MIT */
/* A library as it was built for interface 2 when that ended with channels. These are its declarations as they were
 * then, less the comments: if they no longer fit what the host hands over, the host has broken its word, not this
 * file. It takes quads whose corners are held, each by itself, whose limit points and values at depth 0 are those of
 * the control mesh. */
#include <stddef.h>
#include <stdint.h>
#include <string.h>

typedef enum lc_status { LC_OK = 0, LC_NOT_SUPPORTED = 1, LC_INVALID_INPUT = 2, LC_FAILED = 3 } lc_status;
typedef enum lc_scheme { LC_SCHEME_LOOP = 0, LC_SCHEME_CATMULL_CLARK = 1 } lc_scheme;

typedef struct lc_sharp_edge {
  int32_t a, b;
  float sharpness;
} lc_sharp_edge;
typedef struct lc_sharp_vertex {
  int32_t vertex;
  float sharpness;
} lc_sharp_vertex;
typedef struct lc_channel {
  int32_t components, rule;
  const double* values;
  int64_t value_count;
  const int32_t* corners;
} lc_channel;

typedef struct lc_capabilities {
  int32_t precision, weights, boundary, points, max_depth, normals, per_face_depth, exact_lattice;
  uint32_t size;
  int32_t scheme, schemes, sharp, does_not_validate, no_provenance, channel_rules;
} lc_capabilities;

typedef struct lc_mesh {
  const double* positions;
  int64_t vertex_count;
  const int32_t* triangles;
  int64_t triangle_count;
  uint32_t size;
  lc_scheme scheme;
  const int32_t* corners;
  int64_t corner_count;
  const int32_t* face_sizes;
  int64_t face_count;
  const lc_sharp_edge* sharp_edges;
  int64_t sharp_edge_count;
  const lc_sharp_vertex* sharp_vertices;
  int64_t sharp_vertex_count;
  int32_t creasing, corners_held, smooth_triangles;
  const lc_channel* channels;
  int64_t channel_count;
} lc_mesh;

typedef struct lc_request {
  const int32_t* face_depth;
  int32_t threads;
  void* host;
  void* (*allocate)(void* host, size_t bytes);
  uint32_t size;
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
  uint32_t size;
  int32_t* corner;
  void* channel_values;
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

/* What was laid out on a machine of 64 bits. */
typedef char capabilities_have_60_bytes[sizeof(lc_capabilities) == 60 ? 1 : -1];
typedef char a_mesh_has_136_bytes[sizeof(lc_mesh) == 136 ? 1 : -1];
typedef char a_request_has_40_bytes[sizeof(lc_request) == 40 ? 1 : -1];
typedef char a_tessellation_has_88_bytes[sizeof(lc_tessellation) == 88 ? 1 : -1];

static lc_status capabilities(const char* options, lc_capabilities* out, const char** message) {
  /* In double, limit points at depth 0, no normals; quads, corners that are held, all rules of channels. */
  const lc_capabilities mine = {1, 0, 0, 0, 0, 0, 0, 1, sizeof(lc_capabilities), out->scheme, 2, 8, 1, 0, 63};
  (void)options, (void)message;
  if (out->size < sizeof *out) return LC_FAILED;
  *out = mine;
  return LC_OK;
}
static lc_status create(const lc_mesh* mesh, const char* options, void** instance, const char** message) {
  static const lc_mesh* kept;
  (void)options;
  if (mesh->size < sizeof *mesh) return *message = "the mesh is too short", LC_FAILED;
  if (mesh->corner_count != 4 * mesh->face_count || mesh->vertex_count != 4 * mesh->face_count ||
      !mesh->corners_held)
    return *message = "it is no mesh of quads apart, whose corners are held", LC_NOT_SUPPORTED;
  kept = mesh;
  *instance = &kept;
  return LC_OK;
}
static lc_status tessellate(void* instance, const lc_request* request, lc_tessellation* out,
                            const char** message) {
  static const int corner_of[6] = {0, 1, 2, 0, 2, 3};
  static const uint32_t at[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const lc_mesh* m = *(const lc_mesh**)instance;
  const size_t faces = (size_t)m->face_count;
  size_t components = 0;
  double* value;
  if (out->size < sizeof *out || request->size < sizeof *request) return *message = "too short", LC_FAILED;
  for (int64_t c = 0; c < m->channel_count; ++c) components += (size_t)m->channels[c].components;
  out->vertex_count = m->vertex_count;
  out->triangle_count = 2 * m->face_count;
  out->positions = request->allocate(request->host, 12 * faces * sizeof(double));
  out->provenance = request->allocate(request->host, 4 * faces * sizeof(lc_provenance));
  out->triangles = request->allocate(request->host, 6 * faces * sizeof(uint32_t));
  out->triangle_face = request->allocate(request->host, 2 * faces * sizeof(int32_t));
  if (components > 0)
    out->channel_values = request->allocate(request->host, 6 * faces * components * sizeof(double));
  memcpy(out->positions, m->positions, 12 * faces * sizeof(double));
  for (size_t f = 0; f < faces; ++f) {
    for (int k = 0; k < 4; ++k)
      out->provenance[m->corners[4 * f + (size_t)k]] = (lc_provenance){(int32_t)f, at[k][0], at[k][1], 1};
    for (int k = 0; k < 6; ++k)
      out->triangles[6 * f + (size_t)k] = (uint32_t)m->corners[4 * f + (size_t)corner_of[k]];
    for (int t = 0; t < 2; ++t) out->triangle_face[2 * f + (size_t)t] = (int32_t)f;
  }
  value = out->channel_values;
  for (const lc_channel* c = m->channels; c != m->channels + m->channel_count; ++c)
    for (size_t f = 0; f < faces; ++f)
      for (int k = 0; k < 6; ++k)
        for (int n = 0; n < c->components; ++n)
          *value++ = c->values[c->components * c->corners[4 * f + (size_t)corner_of[k]] + n];
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
      2, "interface-2", "quads with held corners", NULL, capabilities, create, tessellate, release, destroy};
  return abi == 2 ? &subject : NULL;
}
