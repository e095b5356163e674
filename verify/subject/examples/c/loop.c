/* SPDX-License-Identifier: MIT */
/* A subject in C: Loop subdivision of the whole mesh, step by step, in double; then every vertex is moved to
 * its limit. Slow, short and right; boundaries included. */
#include <limitcheck/subject.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct Vec {
  double x, y, z;
} Vec;
typedef struct Triangle {
  int32_t v[3], face;
  uint32_t at[3][2];
} Triangle; /* corners, and (i, j) of each */
typedef struct Half {
  int64_t key;
  int32_t opposite, middle;
} Half; /* a -> b: third corner, edge point */
typedef struct Mesh {
  Vec* p;
  Triangle* t;
  int32_t vertices, triangles;
  Half* table;
  size_t mask;
} Mesh;

static Vec add(Vec a, double w, Vec b) {
  return (Vec){a.x + w * b.x, a.y + w * b.y, a.z + w * b.z};
}

static Half* half(const Mesh* m, int32_t a, int32_t b) { /* its entry, or the free one where it belongs */
  const int64_t key = ((int64_t)a << 32 | b) + 1;
  size_t k = (size_t)((uint64_t)key * 0x9E3779B97F4A7C15u >> 20) & m->mask;
  while (m->table[k].key != 0 && m->table[k].key != key) k = (k + 1) & m->mask;
  return &m->table[k];
}

static int32_t opposite(const Mesh* m, int32_t a, int32_t b) { /* -1: a -> b is no side of a triangle */
  const Half* h = half(m, a, b);
  return h->key != 0 ? h->opposite : -1;
}

static void connect(Mesh* m) {
  size_t size = 16;
  while (size < 12 * (size_t)m->triangles) size *= 2;
  m->table = calloc(size, sizeof(Half));
  m->mask = size - 1;
  for (int32_t t = 0; m->table != NULL && t < m->triangles; ++t)
    for (int k = 0; k < 3; ++k) {
      const int32_t *v = m->t[t].v, a = v[k], b = v[(k + 1) % 3];
      *half(m, a, b) = (Half){((int64_t)a << 32 | b) + 1, v[(k + 2) % 3], -1};
    }
}

static int32_t before(const Mesh* m, int32_t v, int32_t a) {
  return opposite(m, a, v);
} /* clockwise of a */

/* The neighbours of v counter-clockwise, from the boundary if there is one, given one of them. */
static int ring(const Mesh* m, int32_t v, int32_t a, int32_t** out, int* boundary) {
  int32_t first = a;
  while (before(m, v, first) >= 0 && before(m, v, first) != a) first = before(m, v, first);
  *boundary = before(m, v, first) < 0;
  if (!*boundary) first = a;
  int n = 0;
  for (int32_t next = first; next >= 0 && (n == 0 || next != first); next = opposite(m, v, next)) {
    if (n % 64 == 0) *out = realloc(*out, (size_t)(n + 64) * sizeof(int32_t));
    (*out)[n++] = next;
  }
  return n;
}

static double loop_a(int n) {
  const double s = 3 + 2 * cos(2 * acos(-1.0) / n);
  return 5.0 / 8 - s * s / 64;
}

/* One step for vertex v (limit == NULL), or its limit position and normal. */
static Vec move(const Mesh* m, int32_t v, int32_t neighbour, int32_t** r, Vec* normal) {
  int boundary;
  const int n = ring(m, v, neighbour, r, &boundary);
  const Vec p = m->p[v], none = {0, 0, 0};
  Vec sum = none, t1 = none, t2 = none;
  const double pi = acos(-1.0), K = n - 1, c = cos(pi / K), s = sin(pi / K);
  for (int i = 0; i < n; ++i) {
    const int end = boundary && (i == 0 || i == n - 1);
    const Vec d = add(m->p[(*r)[i]], -1, p);
    if (!boundary || end) sum = add(sum, 1, d);
    const double across = n == 2 ? 1 : end ? -c * (1 + c) / ((1 + 2 * c) * s) : sin(i * pi / K);
    t1 = add(t1, boundary ? (i == 0) - (i == n - 1) : cos(2 * pi * i / n), d);
    t2 = add(t2, boundary ? across : sin(2 * pi * i / n), d);
  }
  const double a = loop_a(n);
  if (normal == NULL) return add(p, boundary ? 1.0 / 8 : a / n, sum);
  const Vec cross = {t1.y * t2.z - t1.z * t2.y, t1.z * t2.x - t1.x * t2.z, t1.x * t2.y - t1.y * t2.x};
  const double length = sqrt(cross.x * cross.x + cross.y * cross.y + cross.z * cross.z);
  *normal = length > 0 ? add(none, 1 / length, cross) : (Vec){0, 0, 1};
  return add(p, boundary ? 1.0 / 6 : 8 * a / (n * (3 + 8 * a)), sum);
}

static int32_t* neighbours(const Mesh* m) { /* one of each vertex */
  int32_t* one = calloc((size_t)m->vertices + 1, sizeof *one);
  for (int32_t t = 0; t < m->triangles; ++t)
    for (int k = 0; k < 3; ++k) one[m->t[t].v[k]] = m->t[t].v[(k + 1) % 3];
  return one;
}

static void drop(Mesh* m) {
  free(m->p), free(m->t), free(m->table);
}

static Mesh refine(const Mesh* m) {
  Mesh fine = {NULL, NULL, m->vertices, 4 * m->triangles, NULL, 0};
  fine.p = malloc((size_t)(m->vertices + 3 * m->triangles) * sizeof(Vec));
  fine.t = malloc((size_t)fine.triangles * sizeof(Triangle));
  int32_t *one = neighbours(m), *r = NULL;
  for (int32_t v = 0; v < m->vertices; ++v) fine.p[v] = move(m, v, one[v], &r, NULL);
  free(one), free(r);
  for (int32_t t = 0; t < m->triangles; ++t) {
    const Triangle old = m->t[t];
    Triangle inner = old, corner = old;
    for (int k = 0; k < 3; ++k) {
      const int32_t a = old.v[k], b = old.v[(k + 1) % 3], d = opposite(m, b, a);
      Half* h = half(m, a, b);
      if (h->middle < 0) {
        const double w = d < 0 ? 1.0 / 2 : 3.0 / 8;
        Vec p = add(add((Vec){0, 0, 0}, w, m->p[a]), w, m->p[b]);
        if (d >= 0) p = add(add(p, 1.0 / 8, m->p[h->opposite]), 1.0 / 8, m->p[d]);
        fine.p[h->middle = fine.vertices++] = p;
        if (d >= 0) half(m, b, a)->middle = h->middle;
      }
      inner.v[k] = h->middle;
      for (int x = 0; x < 2; ++x) inner.at[k][x] = old.at[k][x] + old.at[(k + 1) % 3][x];
    }
    for (int k = 0; k < 3; ++k) {
      const int order[3] = {k, k, (k + 2) % 3}; /* the old corner, then the points beside it */
      for (int c = 0; c < 3; ++c) {
        corner.v[c] = c == 0 ? old.v[k] : inner.v[order[c]];
        for (int x = 0; x < 2; ++x) corner.at[c][x] = c == 0 ? 2 * old.at[k][x] : inner.at[order[c]][x];
      }
      fine.t[4 * t + k] = corner;
    }
    fine.t[4 * t + 3] = inner;
  }
  connect(&fine);
  return fine;
}

static lc_status capabilities(const char* options, lc_capabilities* out, const char** message) {
  *out = (lc_capabilities){LC_FLOAT64, LC_WEIGHTS_LOOP, LC_BOUNDARY_SPLINE, LC_POINTS_LIMIT, 6, 1, 0, 1};
  if (options == NULL) return LC_OK;
  *message = "there are no options";
  return LC_INVALID_INPUT;
}

static lc_status create(const lc_mesh* mesh, const char* options, void** instance, const char** message) {
  (void)options, (void)message;
  lc_mesh* copy = malloc(sizeof *copy); /* of the pointers: the arrays stay */
  *copy = *mesh;
  *instance = copy;
  return LC_OK;
}

static lc_status tessellate(void* instance, const lc_request* request, lc_tessellation* out,
                            const char** message) {
  const lc_mesh* control = instance;
  Mesh m = {NULL, NULL, (int32_t)control->vertex_count, (int32_t)control->triangle_count, NULL, 0};
  m.p = malloc((size_t)m.vertices * sizeof(Vec));
  m.t = calloc((size_t)m.triangles, sizeof(Triangle));
  memcpy(m.p, control->positions, (size_t)m.vertices * sizeof(Vec));
  for (int32_t t = 0; t < m.triangles; ++t) {
    memcpy(m.t[t].v, control->triangles + 3 * t, sizeof m.t[t].v);
    m.t[t].face = t;
    m.t[t].at[1][0] = m.t[t].at[2][1] = 1;
  }
  connect(&m);
  for (int32_t d = 0; d < request->face_depth[0]; ++d) {
    Mesh fine = refine(&m);
    drop(&m);
    m = fine;
  }

  const size_t v_count = (size_t)m.vertices, t_count = (size_t)m.triangles;
  Vec* position = out->positions = request->allocate(request->host, v_count * sizeof(Vec));
  Vec* normal = out->normals = request->allocate(request->host, v_count * sizeof(Vec));
  out->provenance = request->allocate(request->host, v_count * sizeof(lc_provenance));
  out->triangles = request->allocate(request->host, t_count * 3 * sizeof(uint32_t));
  out->triangle_face = request->allocate(request->host, t_count * sizeof(int32_t));
  out->vertex_count = m.vertices;
  out->triangle_count = m.triangles;
  if (!position || !normal || !out->provenance || !out->triangles || !out->triangle_face) {
    drop(&m);
    *message = "out of memory";
    return LC_FAILED;
  }
  int32_t *one = neighbours(&m), *r = NULL;
  for (int32_t v = 0; v < m.vertices; ++v) position[v] = move(&m, v, one[v], &r, &normal[v]);
  for (int32_t t = 0; t < m.triangles; ++t) {
    out->triangle_face[t] = m.t[t].face;
    for (int k = 0; k < 3; ++k) {
      out->triangles[3 * t + k] = (uint32_t)m.t[t].v[k];
      out->provenance[m.t[t].v[k]] =
          (lc_provenance){m.t[t].face, m.t[t].at[k][0], m.t[t].at[k][1], 1u << request->face_depth[0]};
    }
  }
  free(one), free(r), drop(&m);
  return LC_OK;
}

static void release(void* instance, lc_tessellation* out) {
  (void)instance, (void)out;
}
static void destroy(void* instance) {
  free(instance);
}

const lc_subject* lc_subject_get(uint32_t abi) {
  static const lc_subject subject = {LC_SUBJECT_ABI, "loop-in-c",  "Loop subdivision step by step, in C",
                                     NULL,           capabilities, create,
                                     tessellate,     release,      destroy};
  return abi == LC_SUBJECT_ABI ? &subject : NULL;
}
