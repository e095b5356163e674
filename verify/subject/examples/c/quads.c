/* SPDX-License-Identifier: MIT */
/* A subject of Catmull-Clark's in one file of C: a mesh of quads, refined step by step in double. It
 * delivers the vertices of the refined mesh, not points of the limit surface, and its capabilities say so.
 * Meshes of other faces it is not asked for, as they say, too; examples/python/quads.py takes them. */
#include <limitcheck/subject.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Half-edge h = 4 q + k leaves corner k of quad q. A step makes quad h of it: after d steps quad q is part
 * of control face q >> 2d. */
typedef struct Mesh {
  int32_t vertices, halves, edges;
  double (*p)[3];    /* of each vertex */
  int32_t* from;     /* of each half-edge: the vertex it leaves, */
  int32_t* twin;     /* the half-edge back, or -1 at a boundary, */
  int32_t* edge;     /* the edge that it is a side of, */
  uint32_t (*at)[2]; /* and (i, j) of the corner it leaves */
} Mesh;

static int32_t next(int32_t h) {
  return h % 4 == 3 ? h - 3 : h + 1;
}
static int32_t previous(int32_t h) {
  return h % 4 == 0 ? h + 3 : h - 1;
}
static void add(double* to, double weight, const double* p) {
  for (int c = 0; c < 3; ++c) to[c] += weight * p[c];
}

static Mesh allocate(int32_t vertices, int32_t halves) {
  const size_t v = (size_t)vertices + 1, h = (size_t)halves + 1, n = sizeof(int32_t);
  return (Mesh){vertices,
                halves,
                0,
                calloc(v, sizeof(double[3])),
                calloc(h, n),
                calloc(h, n),
                calloc(h, n),
                calloc(h, sizeof(uint32_t[2]))};
}
static void discard(Mesh m) {
  free(m.p), free(m.from), free(m.twin), free(m.edge), free(m.at);
}

typedef struct Side {
  int32_t low, high, half;
} Side;
static int by_ends(const void* x, const void* y) {
  const Side *a = x, *b = y;
  if (a->low != b->low) return a->low < b->low ? -1 : 1;
  return a->high != b->high ? (a->high < b->high ? -1 : 1) : a->half - b->half;
}

/* Finds twins and edges. Returns what is wrong with the quads, or NULL. */
static const char* connect(Mesh* m) {
  const char* wrong = NULL;
  Side* side = malloc(((size_t)m->halves + 1) * sizeof *side);
  int32_t* leaving =
      calloc((size_t)m->vertices + 1, sizeof *leaving); /* boundary edges that leave a vertex */
  for (int32_t h = 0; h < m->halves; ++h) {
    const int32_t a = m->from[h], b = m->from[next(h)];
    side[h] = (Side){a < b ? a : b, a < b ? b : a, h};
    m->twin[h] = -1;
    if (a == b || a == m->from[next(next(h))]) wrong = "a quad has a vertex twice";
  }
  qsort(side, (size_t)m->halves, sizeof *side, by_ends);
  for (int32_t k = 0, n; k < m->halves; k += n, ++m->edges) {
    for (n = 1; k + n < m->halves && side[k + n].low == side[k].low && side[k + n].high == side[k].high;) ++n;
    const int32_t h = side[k].half, g = side[k + n - 1].half;
    m->edge[h] = m->edge[g] = m->edges;
    if (n > 2) wrong = "an edge has more than two faces";
    if (n == 2) m->twin[h] = g, m->twin[g] = h;
    if (n == 2 && m->from[h] == m->from[g]) wrong = "two quads run along an edge in the same direction";
    if (n == 1 && ++leaving[m->from[h]] > 1) wrong = "two fans of quads meet in a vertex";
  }
  free(side), free(leaving);
  return wrong;
}

/* One step. The vertices come first, then a point for each edge, then one for each quad. */
static Mesh refined(const Mesh* m) {
  const int32_t v_count = m->vertices, f0 = v_count + m->edges;
  Mesh fine = allocate(f0 + m->halves / 4, 4 * m->halves);
  int32_t *faces = calloc((size_t)v_count + 1, sizeof *faces),
          *open = calloc((size_t)v_count + 1, sizeof *open);
  for (int32_t h = 0; h < m->halves; ++h) {
    ++faces[m->from[h]];
    if (m->twin[h] < 0) open[m->from[h]] = open[m->from[next(h)]] = 1;
    add(fine.p[f0 + h / 4], 1.0 / 4, m->p[m->from[h]]);
  }
  for (int32_t h = 0; h < m->halves; ++h) {
    const int32_t a = m->from[h], b = m->from[next(h)];
    double *edge = fine.p[v_count + m->edge[h]], n = faces[a];
    if (m->twin[h] < 0) {
      add(edge, 1.0 / 2, m->p[a]), add(edge, 1.0 / 2, m->p[b]);
      add(fine.p[a], 1.0 / 8, m->p[b]), add(fine.p[b], 1.0 / 8, m->p[a]);
    } else {
      add(edge, 1.0 / 4, m->p[a]), add(edge, 1.0 / 4, fine.p[f0 + h / 4]); /* the rest comes from the twin */
    }
    if (!open[a]) add(fine.p[a], 1 / (n * n), m->p[b]), add(fine.p[a], 1 / (n * n), fine.p[f0 + h / 4]);
  }
  for (int32_t v = 0; v < v_count; ++v)
    add(fine.p[v], faces[v] == 0 ? 1 : open[v] ? 3.0 / 4 : (faces[v] - 2.0) / faces[v], m->p[v]);
  for (int32_t h = 0; h < m->halves; ++h) {
    const int32_t g = previous(h), towards[4] = {h, next(h), next(next(h)), g};
    const int32_t corner[4] = {m->from[h], v_count + m->edge[h], f0 + h / 4, v_count + m->edge[g]};
    for (int k = 0; k < 4; ++k) {
      fine.from[4 * h + k] = corner[k];
      for (int x = 0; x < 2; ++x) fine.at[4 * h + k][x] = m->at[h][x] + m->at[towards[k]][x];
    }
  }
  free(faces), free(open);
  connect(&fine);
  return fine;
}

static lc_status capabilities(const char* options, lc_capabilities* out, const char** message) {
  out->precision = LC_FLOAT64;
  out->points = LC_POINTS_REFINED;
  out->max_depth = 6;
  out->exact_lattice = 1;
  out->schemes = LC_DOES_CATMULL_CLARK; /* all else is 0: a spline at the boundary, no normals */
  if (LC_KNOWS(out, quads_only)) out->quads_only = 1;
  if (options == NULL) return LC_OK;
  *message = "there are no options";
  return LC_INVALID_INPUT;
}

static lc_status create(const lc_mesh* mesh, const char* options, void** instance, const char** message) {
  (void)options;
  for (int64_t f = 0; f < mesh->face_count; ++f)
    if (mesh->face_sizes[f] != 4) return *message = "a face is no quad", LC_NOT_SUPPORTED;
  for (int64_t k = 0; k < 3 * mesh->vertex_count; ++k)
    if (!isfinite(mesh->positions[k])) return *message = "a coordinate is not finite", LC_INVALID_INPUT;
  for (int64_t k = 0; k < mesh->corner_count; ++k)
    if (mesh->corners[k] < 0 || mesh->corners[k] >= mesh->vertex_count)
      return *message = "a quad names a vertex that does not exist", LC_INVALID_INPUT;
  Mesh m = allocate((int32_t)mesh->vertex_count, (int32_t)mesh->corner_count), *kept = malloc(sizeof *kept);
  if (m.vertices > 0) memcpy(m.p, mesh->positions, (size_t)m.vertices * sizeof *m.p);
  if (m.halves > 0) memcpy(m.from, mesh->corners, (size_t)m.halves * sizeof *m.from);
  for (int32_t h = 0; h < m.halves; ++h)
    m.at[h][0] = h % 4 == 1 || h % 4 == 2, m.at[h][1] = h % 4 >= 2; /* (0, 0), (1, 0), (1, 1), (0, 1) */
  *message = connect(&m);
  *kept = m;
  if (*message == NULL) return *instance = kept, LC_OK;
  discard(m), free(kept);
  return LC_INVALID_INPUT;
}

static lc_status tessellate(void* instance, const lc_request* request, lc_tessellation* out,
                            const char** message) {
  const Mesh* control = instance;
  const int32_t depth = control->halves > 0 ? request->face_depth[0] : 0;
  Mesh m = *control;
  for (int32_t d = 0; d < depth; ++d) {
    const Mesh fine = refined(&m);
    if (d > 0) discard(m);
    m = fine;
  }
  const size_t v_count = (size_t)m.vertices, t_count = (size_t)m.halves / 2; /* each quad is two triangles */
  double(*position)[3] = out->positions = request->allocate(request->host, v_count * sizeof *position);
  out->provenance = request->allocate(request->host, v_count * sizeof(lc_provenance));
  out->triangles = request->allocate(request->host, 3 * t_count * sizeof(uint32_t));
  out->triangle_face = request->allocate(request->host, t_count * sizeof(int32_t));
  const int refused = out->positions == NULL || out->provenance == NULL || out->triangles == NULL ||
                      out->triangle_face == NULL;
  if (!refused) {
    out->vertex_count = m.vertices, out->triangle_count = (int64_t)t_count;
    memcpy(position, m.p, v_count * sizeof *position);
    for (int32_t h = 0; h < m.halves; ++h) {
      const int32_t q = h / 4, face = q >> (2 * depth), t = 2 * q + (h % 4 == 3);
      out->provenance[m.from[h]] = (lc_provenance){face, m.at[h][0], m.at[h][1], 1U << depth};
      out->triangle_face[t] = face;
      if (h % 4 == 0)
        for (int k = 0; k < 3; ++k) /* (0, 1, 2) and (0, 2, 3) */
          out->triangles[6 * q + k] = (uint32_t)m.from[h + k],
                                 out->triangles[6 * q + 3 + k] = (uint32_t)m.from[h + k + (k > 0)];
    }
  }
  if (depth > 0) discard(m);
  if (refused) *message = "the host has no memory";
  return refused ? LC_FAILED : LC_OK;
}

static void release(void* instance, lc_tessellation* out) {
  (void)instance, (void)out;
}
static void destroy(void* instance) {
  discard(*(Mesh*)instance), free(instance);
}

const lc_subject* lc_subject_get(uint32_t abi) {
  static const lc_subject subject = {LC_SUBJECT_ABI, "quads-in-c", "Catmull-Clark refinement of quads, in C",
                                     NULL,           capabilities, create,
                                     tessellate,     release,      destroy};
  return abi == LC_SUBJECT_ABI ? &subject : NULL;
}
