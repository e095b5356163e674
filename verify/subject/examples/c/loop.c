/* SPDX-License-Identifier: MIT */
#include "loop.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int32_t next(int32_t h) {
  return h % 3 == 2 ? h - 2 : h + 1;
}
static int32_t previous(int32_t h) {
  return h % 3 == 0 ? h + 2 : h - 1;
}
static Vec add(Vec a, double w, Vec b) {
  return (Vec){a.x + w * b.x, a.y + w * b.y, a.z + w * b.z};
}

Mesh mesh_allocate(int64_t vertices, int64_t triangles) {
  const size_t v = (size_t)vertices + 1, h = 3 * (size_t)triangles + 1;
  return (Mesh){(int32_t)vertices,          (int32_t)(3 * triangles),   calloc(v, sizeof(Vec)),
                calloc(v, sizeof(int32_t)), calloc(h, sizeof(int32_t)), calloc(h, sizeof(int32_t))};
}
void mesh_free(Mesh m) {
  free(m.p), free(m.out), free(m.from), free(m.twin);
}

/* The neighbours of the vertex that h leaves: how many, and the half-edge to the first, counter-clockwise. At
 * a boundary that is the first on the boundary, and the last neighbour has no half-edge to it. */
static int ring(const Mesh* m, int32_t h, int32_t* first, int* boundary) {
  int n = 1;
  *first = h;
  while (m->twin[*first] >= 0 && next(m->twin[*first]) != h) *first = next(m->twin[*first]);
  for (h = m->twin[previous(*first)]; h >= 0 && h != *first; h = m->twin[previous(h)]) ++n;
  *boundary = h < 0;
  return n + *boundary;
}

const char* mesh_connect(Mesh* m) {
  const char* wrong = NULL;
  if (m->halves == 0) return "there are no triangles";
  for (int32_t v = 0; v < m->vertices; ++v)
    if (!isfinite(m->p[v].x + m->p[v].y + m->p[v].z)) return "a coordinate is not finite";
  for (int32_t h = 0; h < m->halves; ++h)
    if (m->from[h] < 0 || m->from[h] >= m->vertices) return "a triangle names a vertex that does not exist";
  int32_t *link = malloc(((size_t)m->halves + 1) * sizeof *link),
          first; /* from one leaving a vertex to the next */
  memset(m->out, -1, (size_t)m->vertices * sizeof *m->out);
  for (int32_t h = 0; h < m->halves; ++h) link[h] = m->out[m->from[h]], m->out[m->from[h]] = h;
  for (int32_t h = 0; h < m->halves; ++h) {
    const int32_t a = m->from[h], b = m->from[next(h)];
    m->twin[h] = -1;
    for (int32_t g = m->out[b]; g >= 0; g = link[g])
      if (m->from[next(g)] == a) m->twin[h] = g;
    for (int32_t g = m->out[a]; g >= 0; g = link[g])
      if (g != h && m->from[next(g)] == b) wrong = "two triangles run along an edge in the same direction";
  }
  for (int32_t v = 0; v < m->vertices && wrong == NULL; ++v) {
    int boundary = 0, faces = m->out[v] < 0 ? 0 : ring(m, m->out[v], &first, &boundary) - boundary;
    for (int32_t g = m->out[v]; g >= 0; g = link[g]) --faces;
    if (faces != 0) wrong = "the triangles at a vertex form more than one fan";
  }
  free(link);
  return wrong;
}

Vec mesh_moved(const Mesh* m, int32_t v, Vec* normal) {
  const Vec p = m->p[v], none = {0, 0, 0};
  if (m->out[v] < 0) return p; /* no triangle has it */
  int boundary;
  int32_t h;
  const int n = ring(m, m->out[v], &h, &boundary);
  const double pi = acos(-1.0), angle = boundary ? pi / (n - 1) : 2 * pi / n, c = cos(angle), s = sin(angle);
  Vec sum = none, t = none, u = none;
  for (int i = 0; i < n; ++i) {
    const int last = boundary && i == n - 1, end = last || (boundary && i == 0);
    const Vec d = add(m->p[m->from[last ? previous(h) : next(h)]], -1, p);
    if (!boundary || end) sum = add(sum, 1, d);
    t = add(t, !boundary ? cos(i * angle) : last ? -1 : i == 0, d);
    u = add(u, !end ? sin(i * angle) : n == 2 ? 1 : -c * (1 + c) / ((1 + 2 * c) * s), d);
    if (m->twin[previous(h)] >= 0) h = m->twin[previous(h)];
  }
  const double a = 5.0 / 8 - (3 + 2 * c) * (3 + 2 * c) / 64; /* Loop's, for an interior vertex */
  if (normal == NULL) return add(p, boundary ? 1.0 / 8 : a / n, sum);
  const Vec x = {t.y * u.z - t.z * u.y, t.z * u.x - t.x * u.z, t.x * u.y - t.y * u.x};
  const double length = sqrt(x.x * x.x + x.y * x.y + x.z * x.z);
  *normal = length > 0 ? add(none, 1 / length, x) : (Vec){0, 0, 1};
  return add(p, boundary ? 1.0 / 6 : 8 * a / (n * (3 + 8 * a)), sum);
}

static Mesh refined_once(const Mesh* m) {
  Mesh fine = mesh_allocate(m->vertices + m->halves, 4 * m->halves / 3);
  int32_t* middle = malloc(((size_t)m->halves + 1) * sizeof *middle); /* of each half-edge: its edge point */
  fine.vertices = m->vertices;
  for (int32_t v = 0; v < m->vertices; ++v) fine.p[v] = mesh_moved(m, v, NULL);
  for (int32_t h = 0; h < m->halves; ++h) {
    const int32_t g = m->twin[h];
    middle[h] = g >= 0 && g < h ? middle[g] : fine.vertices++;
    const double w = g < 0 ? 1.0 / 2 : 3.0 / 8;
    Vec q = add(add((Vec){0, 0, 0}, w, m->p[m->from[h]]), w, m->p[m->from[next(h)]]);
    if (g >= 0) q = add(add(q, 1.0 / 8, m->p[m->from[previous(h)]]), 1.0 / 8, m->p[m->from[previous(g)]]);
    if (g < h) fine.p[middle[h]] = q;
  }
  for (int32_t h = 0; h < m->halves; ++h) {
    const int32_t corner = 3 * (4 * (h / 3) + h % 3), inner = 3 * (4 * (h / 3) + 3) + h % 3, g = previous(h);
    fine.from[corner] = m->from[h];
    fine.from[corner + 1] = fine.from[inner] = middle[h];
    fine.from[corner + 2] = middle[g];
  }
  free(middle);
  mesh_connect(&fine);
  return fine;
}

Mesh mesh_refined(const Mesh* m, int steps) {
  Mesh fine = mesh_allocate(m->vertices, m->halves / 3);
  memcpy(fine.p, m->p, (size_t)m->vertices * sizeof(Vec));
  memcpy(fine.from, m->from, (size_t)m->halves * sizeof(int32_t));
  mesh_connect(&fine);
  for (; steps > 0; --steps) {
    const Mesh next_one = refined_once(&fine);
    mesh_free(fine);
    fine = next_one;
  }
  return fine;
}
