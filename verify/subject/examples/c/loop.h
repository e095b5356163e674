/* SPDX-License-Identifier: MIT */
/* A tessellator such as yours may be: Loop subdivision of a whole mesh, one step after another, in double.
 * Slow, short and right, boundaries included. It knows nothing of limitcheck; subject.c does. */
#ifndef LOOP_H
#define LOOP_H
#include <stdint.h>

typedef struct Vec {
  double x, y, z;
} Vec;

/* Half-edge h = 3 t + k leaves corner k of triangle t. */
typedef struct Mesh {
  int32_t vertices, halves;
  Vec* p;        /* of each vertex: its position, */
  int32_t* out;  /* and a half-edge that leaves it, or -1 */
  int32_t* from; /* of each half-edge: the vertex it leaves, */
  int32_t* twin; /* and the half-edge back, or -1 at a boundary */
} Mesh;

Mesh mesh_allocate(int64_t vertices, int64_t triangles);
void mesh_free(Mesh m);

/* Finds out and twin from the rest. Returns what is wrong with the mesh, or NULL. */
const char* mesh_connect(Mesh* m);

/* After so many steps, in each of which a triangle becomes four. */
Mesh mesh_refined(const Mesh* m, int steps);

/* Vertex v after one step (normal == NULL), or its limit position and unit normal. */
Vec mesh_moved(const Mesh* m, int32_t v, Vec* normal);

#endif
