/* SPDX-License-Identifier: MIT */
/* A tessellator such as yours may be: Loop subdivision of a whole mesh, one step after another, in double.
 * Slow, short and right, boundaries included. It knows nothing of limitcheck; subject.c does. */
#ifndef LOOP_H
#define LOOP_H
#include <stdint.h>

typedef struct Vec {
  double x, y, z;
} Vec;

/* Half-edge h = 3 t + k leaves corner k of triangle t; after d steps triangle t is part of control face t >>
 * 2d. */
typedef struct Mesh {
  int32_t vertices, halves;
  Vec* p;            /* of each vertex: its position, */
  int32_t* out;      /* and a half-edge that leaves it, or -1 */
  int32_t* from;     /* of each half-edge: the vertex it leaves, */
  int32_t* twin;     /* the half-edge back, or -1 at a boundary, */
  uint32_t (*at)[2]; /* and (i, j) of the corner it leaves */
} Mesh;

Mesh mesh_allocate(int64_t vertices, int64_t triangles);
void mesh_free(Mesh m);

/* Finds out and twin from the rest. Returns what is wrong with the triangles, or NULL. */
const char* mesh_connect(Mesh* m);

/* One step. Triangle t becomes 4 t + k at its corner k, and 4 t + 3 in its middle. */
Mesh mesh_refined(const Mesh* m);

/* Vertex v after one step (normal == NULL), or its limit position and unit normal. */
Vec mesh_moved(const Mesh* m, int32_t v, Vec* normal);

#endif
