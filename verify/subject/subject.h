/* SPDX-License-Identifier: MIT */
/*
 * The plug-in interface: the one way in which limitcheck reaches a tessellator, its own included. Plain C99.
 * Installed as <limitcheck/subject.h>; CMake: find_package(limitcheck), target limitcheck::subject.
 *
 * A subject is a table of functions. For each control mesh the host calls capabilities(), then create() once
 * with the same options, and tessellate() any number of times, each success followed by release(), then
 * destroy(). The host calls from one thread at a time; a subject may use up to request->threads of its own
 * inside tessellate().
 *
 * Output memory comes from the host: the subject asks request->allocate() for each array, on the thread
 * tessellate() was called on. Every byte of it is 0xFF beforehand (a NaN in both precisions, an impossible
 * index), it has guard zones on both sides, and beyond these there is no memory: what a subject forgets to
 * write, or writes beyond the end, is found.
 *
 * A *message is a text without a line end that explains a status other than LC_OK. It stays valid until the
 * subject is called again; NULL if there is nothing to say.
 *
 * Conventions: faces counter-clockwise seen from outside; corners c0, c1, c2; barycentric l0 = 1 - l1 - l2 at
 * c0, l1 at c1, l2 at c2; normals of unit length along ds/dl1 x ds/dl2.
 */
#ifndef LIMITCHECK_SUBJECT_H
#define LIMITCHECK_SUBJECT_H

/* NOLINTBEGIN(modernize-deprecated-headers): this is C */
#include <stddef.h>
#include <stdint.h>
/* NOLINTEND(modernize-deprecated-headers) */

#ifdef __cplusplus
extern "C" {
#endif

/* The version of this interface. */
#define LC_SUBJECT_ABI 1u

/* How a call went. */
typedef enum lc_status {
  LC_OK = 0,
  LC_NOT_SUPPORTED = 1, /* its capabilities exclude what was asked, or a size nobody declares: no fault */
  LC_INVALID_INPUT = 2, /* the subject refuses this mesh or these options */
  LC_FAILED = 3         /* it tried and could not */
} lc_status;

/* Of positions and normals. */
typedef enum lc_precision { LC_FLOAT32 = 0, LC_FLOAT64 = 1 } lc_precision;

/* Which family of vertex weights; they give different surfaces. */
typedef enum lc_weights {
  LC_WEIGHTS_LOOP = 0,  /* Loop 1987: a(n) = 5/8 - (3 + 2 cos(2 pi / n))^2 / 64 */
  LC_WEIGHTS_WARREN = 1 /* Warren: 3/(8n), 3/16 at n = 3. Another surface. */
} lc_weights;

/* What happens at boundary edges. */
typedef enum lc_boundary {
  LC_BOUNDARY_SPLINE = 0, /* cubic B-spline boundary curve, ordinary rule on all interior edges */
  LC_BOUNDARY_NONE = 1    /* closed meshes only */
} lc_boundary;

/* Where the vertices lie. */
typedef enum lc_points {
  LC_POINTS_LIMIT = 0,  /* points of the limit surface */
  LC_POINTS_REFINED = 1 /* vertices of the control mesh refined `depth` times; not on the limit surface */
} lc_points;

/* What a subject does under given options. */
typedef struct lc_capabilities {
  lc_precision precision; /* of positions and normals; the control mesh is rounded to it beforehand */
  lc_weights weights;
  lc_boundary boundary;
  lc_points points;
  int32_t max_depth;
  int32_t normals;        /* 1: delivers unit normals */
  int32_t per_face_depth; /* 1: accepts another depth for each face, and -1 (culled) */
  int32_t exact_lattice;  /* 1: claims to be exact at lattice points; 0: documented as an approximation */
} lc_capabilities;

/* A valid control mesh: an oriented 2-manifold, boundaries allowed. The arrays are the host's. */
typedef struct lc_mesh {
  const double* positions; /* 3 * vertex_count, representable in the subject's precision */
  int64_t vertex_count;
  const int32_t* triangles; /* 3 * triangle_count */
  int64_t triangle_count;
} lc_mesh;

/* One tessellation that is asked for. */
typedef struct lc_request {
  const int32_t* face_depth; /* triangle_count entries: 0..max_depth, or -1 for a culled face. A face may be
                                displayed deeper than asked for, but not deeper than a visible neighbour.
                                Every lattice point of the depth asked for is a corner of the face's
                                triangles, in whichever way they tile it. */
  int32_t threads;           /* at most so many; results must not depend on it */
  void* host;
  void* (*allocate)(void* host,
                    size_t bytes); /* NULL if refused; aligned to 64 bytes; never freed by the subject */
} lc_request;

/* Where a vertex lies: l1 = i / denominator, l2 = j / denominator on control face `face`.
 * Lattice points of depth d have denominator 2^d; the centre of a face is i = j = 1, denominator 3. */
typedef struct lc_provenance {
  int32_t face;
  uint32_t i, j;
  uint32_t denominator;
} lc_provenance;

/* What the subject delivers: arrays that it got from request->allocate() and filled to the last byte. */
typedef struct lc_tessellation {
  int64_t vertex_count;
  int64_t triangle_count;
  void* positions;           /* 3 * vertex_count floats or doubles, by capabilities.precision */
  void* normals;             /* likewise, or NULL */
  lc_provenance* provenance; /* vertex_count. A vertex shared by faces names any one of them. */
  uint32_t* triangles;       /* 3 * triangle_count vertex indices, counter-clockwise from outside */
  int32_t* triangle_face;    /* triangle_count: the control face each triangle is part of */
  void* owner;               /* the subject's own; untouched by the host */
} lc_tessellation;

/* The table of functions that a subject consists of. */
typedef struct lc_subject {
  uint32_t abi; /* LC_SUBJECT_ABI */
  const char* name;
  const char* description; /* one line: what it is, and of which version */
  const char* options;     /* help text for the options of create(), or NULL */

  /* What the subject can do under these options ("key=value,key=value", or NULL). An unknown option or value:
   * LC_INVALID_INPUT. */
  lc_status (*capabilities)(const char* options, lc_capabilities* out, const char** message);

  /* Prepares a mesh. The mesh arrays stay valid and unchanged until destroy(). On failure *instance is not
   * used, and destroy() is not called. */
  lc_status (*create)(const lc_mesh* mesh, const char* options, void** instance, const char** message);
  /* *out is zeroed beforehand. */
  lc_status (*tessellate)(void* instance, const lc_request* request, lc_tessellation* out,
                          const char** message);
  /* Frees what the subject itself keeps for `out` (its owner); the arrays belong to the host. */
  void (*release)(void* instance, lc_tessellation* out);
  void (*destroy)(void* instance);
} lc_subject;

/*
 * A shared library exports one function. `abi` is the interface the host speaks, LC_SUBJECT_ABI of its own
 * copy of this header; NULL if the subject cannot serve it. The table stays valid while the library is
 * loaded. LC_EXPORT makes the function visible whatever the default visibility is.
 *
 *   const lc_subject* lc_subject_get(uint32_t abi) { return abi == LC_SUBJECT_ABI ? &my_table : NULL; }
 */
#if defined(__GNUC__)
#define LC_EXPORT __attribute__((visibility("default")))
#else
#define LC_EXPORT
#endif
/* The name of the function below. */
#define LC_SUBJECT_ENTRY "lc_subject_get"
/* What a shared library exports: see above. */
LC_EXPORT const lc_subject* lc_subject_get(uint32_t abi);

#ifdef __cplusplus
}
#endif
#endif
