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
 * Conventions: faces counter-clockwise seen from outside, corners c0, c1, c2 ...; normals of unit length,
 * outward.
 *   Loop          every face is a triangle: barycentric l0 = 1 - l1 - l2 at c0, l1 at c1, l2 at c2; the
 *                 normal is along ds/dl1 x ds/dl2
 *   Catmull-Clark a quad has (u, v): c0 at (0, 0), c1 at (1, 0), c2 at (1, 1), c3 at (0, 1); the normal is
 *                 along ds/du x ds/dv. Any other face, a triangle too, is cut by the first step into one quad
 *                 for each corner k: from c_k to the middle of the side to c_k+1, to the middle of the face,
 *                 to the middle of the side from c_k-1. Each has a (u, v) of its own, (0, 0) at c_k.
 *
 * Sharp edges follow DeRose, Kass and Truong 1998 as OpenSubdiv has it, in both schemes: a sharpness is the
 * number of steps in which an edge or a vertex is sharp, its fraction blends, and 10 and more is for ever.
 * On an edge that stays sharp the surface has a normal for each side: a vertex there has that of the faces
 * whose triangles it is a corner of.
 *
 * Versions: what interface 2 added stands at the end of each structure, behind what interface 1 has, so that
 * a subject built for 1 is called as it always was; it is asked for Loop's scheme on triangles alone. The
 * members `size` say how many bytes the host knows: a subject built for a later interface may not touch more.
 * LC_KNOWS asks it about a member.
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
#define LC_SUBJECT_ABI 2u

/* Whether the host has this member, one of those behind `size`: 0.2.0 lacks those that came later. */
#define LC_KNOWS(structure, member) \
  ((structure)->size >= (size_t)((const char*)(&(structure)->member + 1) - (const char*)(structure)))

/* How a call went. */
typedef enum lc_status {
  LC_OK = 0,
  LC_NOT_SUPPORTED = 1, /* its capabilities exclude what was asked, or a size nobody declares: no fault */
  LC_INVALID_INPUT = 2, /* the subject refuses this mesh or these options */
  LC_FAILED = 3         /* it tried and could not */
} lc_status;

/* Which subdivision scheme. */
typedef enum lc_scheme { LC_SCHEME_LOOP = 0, LC_SCHEME_CATMULL_CLARK = 1 } lc_scheme;

/* Sets of schemes, to be or-ed. */
enum { LC_DOES_LOOP = 1, LC_DOES_CATMULL_CLARK = 2 };

/* What of sharp edges and vertices there is to do, to be or-ed. */
enum {
  LC_SHARP_CREASES = 1,           /* edges that stay sharp: a sharpness of 10 and more */
  LC_SHARP_SEMI = 2,              /* edges and vertices of a sharpness between 0 and 10 */
  LC_SHARP_CHAIKIN = 4,           /* Chaikin's way of letting sharpness fall */
  LC_SHARP_CORNERS = 8,           /* sharp vertices, and boundary vertices of one face that are held */
  LC_SHARP_SMOOTH_TRIANGLES = 16, /* the smooth rule for Catmull-Clark's triangles */
  LC_SHARP_NO_DARTS = 32          /* a limit: no edge that stays sharp may end inside the surface */
};

/* An edge between two vertices of the control mesh, 0 < sharpness. */
typedef struct lc_sharp_edge {
  int32_t a, b;
  float sharpness;
} lc_sharp_edge;

/* A vertex of the control mesh, 0 < sharpness. */
typedef struct lc_sharp_vertex {
  int32_t vertex;
  float sharpness;
} lc_sharp_vertex;

/* What a face-varying channel does at seams and on the boundary: OpenSubdiv's FVarLinearInterpolation and USD's
 * faceVaryingLinearInterpolation. Each holds more values than the one before. */
typedef enum lc_channel_rule {
  LC_CHANNEL_NONE = 0,
  LC_CHANNEL_CORNERS_ONLY = 1,
  LC_CHANNEL_CORNERS_PLUS1 = 2,
  LC_CHANNEL_CORNERS_PLUS2 = 3,
  LC_CHANNEL_BOUNDARIES = 4,
  LC_CHANNEL_ALL = 5
} lc_channel_rule;

/* A face-varying channel, such as texture coordinates: of each corner the index of a value. An index that is used
 * at two vertices is two values; where the two faces of an edge name different values, there is a seam. */
typedef struct lc_channel {
  int32_t components; /* of a value, 1..4 */
  lc_channel_rule rule;
  const double* values; /* components * value_count, representable in the subject's precision */
  int64_t value_count;
  const int32_t* corners; /* corner_count of the mesh */
} lc_channel;

/* How sharpness falls from step to step. */
typedef enum lc_creasing {
  LC_CREASING_UNIFORM = 0, /* by 1 */
  LC_CREASING_CHAIKIN = 1  /* by 1, after a mean with the neighbours along the crease: OpenSubdiv's */
} lc_creasing;

/* Of positions and normals. */
typedef enum lc_precision { LC_FLOAT32 = 0, LC_FLOAT64 = 1 } lc_precision;

/* Which family of vertex weights of Loop's scheme; they give different surfaces. Catmull-Clark has one. */
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

  /* Interface 2. The host sets the first two beforehand; all else is 0. */
  uint32_t size;    /* of this structure, as the host knows it */
  lc_scheme scheme; /* what is asked about: the answer may differ by the scheme */
  int32_t schemes;  /* which there are, LC_DOES_LOOP | LC_DOES_CATMULL_CLARK; 0: Loop's alone */
  int32_t sharp;    /* what it does of sharp edges, LC_SHARP_CREASES | ..; 0: nothing */
  /* 1: relies on its callers to hand over oriented manifolds with vertices that exist and finite coordinates,
   * and is handed nothing else; 0: refuses others */
  int32_t does_not_validate;
  /* 1: delivers neither provenance nor triangle_face nor corner. The host finds them by how the triangles are
   * connected, which are those of the whole mesh at one depth (per_face_depth is 0): each face cut into 4^depth
   * triangles or, by Catmull-Clark, into quads of two triangles that follow one another. Vertices that several faces
   * share may be delivered once, or once for each face with equal bits. */
  int32_t no_provenance;
  /* The rules by which it interpolates face-varying channels, 1 << lc_channel_rule each, or-ed. It is handed only
   * channels that have one of these; 0: none. */
  int32_t channel_rules;
  int32_t channel_derivatives; /* 1: delivers the derivatives of channels with their values */
  /* 1: vertices may lie anywhere in a face, as those of hardware tessellation or of an adaptive one do: at any
   * fractions, and no lattice point needs to be a vertex. The triangles still tile each face, and faces that meet have
   * the same points on their common edge. 2^depth, times 3 (Loop) or 2, and all reduced denominators have a common
   * multiple below 2^32, in each tessellation. The depth asked for is what the subject makes of it. Limit points
   * only, and not together with no_provenance. */
  int32_t points_anywhere;
  int32_t quads_only; /* 1: subdivides by Catmull-Clark meshes of quads alone, and is asked for no others */
} lc_capabilities;

/* A control mesh: an oriented 2-manifold, boundaries allowed, with tags on edges and vertices that exist, or
 * what a subject that validates has to refuse: also, if it declares sharp edges or vertices, a sharpness that
 * is no number or below 0, and one of an edge or vertex that the mesh does not have. Each vertex of a valid
 * mesh is a corner of a face: the host leaves out others. This structure and the arrays are the host's. */
typedef struct lc_mesh {
  const double* positions; /* 3 * vertex_count, representable in the subject's precision */
  int64_t vertex_count;
  const int32_t* triangles; /* 3 * triangle_count; NULL and 0 if some face is no triangle */
  int64_t triangle_count;

  /* Interface 2. All faces, triangles or not. */
  uint32_t size; /* of this structure, as the host knows it */
  lc_scheme scheme;
  const int32_t* corners; /* corner_count vertices: the corners of all faces, one face after the other */
  int64_t corner_count;
  const int32_t* face_sizes; /* face_count numbers of corners, 3 or more */
  int64_t face_count;
  const lc_sharp_edge* sharp_edges; /* sharp_edge_count, each edge once; boundary edges are always sharp */
  int64_t sharp_edge_count;
  const lc_sharp_vertex* sharp_vertices; /* sharp_vertex_count, each vertex once */
  int64_t sharp_vertex_count;
  lc_creasing creasing;
  int32_t corners_held; /* 1: a boundary vertex of one face stays where it is */
  int32_t
      smooth_triangles; /* 1: Catmull-Clark's first step gives edges of triangles OpenSubdiv's smooth rule */
  const lc_channel* channels; /* channel_count, or NULL and 0 */
  int64_t channel_count;
} lc_mesh;

/* One tessellation that is asked for. */
typedef struct lc_request {
  const int32_t* face_depth; /* one for each face: 0..max_depth, or -1 for a culled face (or a hole of the
                                control mesh: it is not shown, and shapes its neighbours). A face may be
                                displayed deeper than asked for, but not deeper than a visible neighbour.
                                Every lattice point of the depth asked for is a corner of the face's
                                triangles, in whichever way they tile it. */
  int32_t threads;           /* at most so many; results must not depend on it */
  void* host;
  /* NULL if refused; aligned to 64 bytes; never freed by the subject. Of 0 bytes an address, at which nothing may
   * be written. */
  void* (*allocate)(void* host, size_t bytes);

  /* Interface 2. */
  uint32_t size; /* of this structure, as the host knows it */
} lc_request;

/* Where a vertex lies on control face `face`. Lattice points of depth d are the vertices of the control mesh
 * refined d times, moved to the limit surface.
 *   Loop            l1 = i / denominator, l2 = j / denominator; lattice points have denominator 2^d, the
 *                   centre of a face is i = j = 1, denominator 3
 *   Catmull-Clark   u = i / denominator, v = j / denominator; lattice points have denominator 2^d on a quad
 *                   and 2^(d-1) on the quads of another face, which lc_tessellation.corner tells apart. At
 *                   depth 0 such a face has its corners only. */
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

  /* Interface 2. */
  uint32_t size;   /* of this structure, as the host knows it; set beforehand */
  int32_t* corner; /* vertex_count: the corner whose quad i and j are of; 0 on quads and triangles of Loop's.
                      NULL if all are 0 */
  /* Of each channel of the mesh, one after the other: for each corner of each triangle its components, on the
   * side of a seam on which the triangle lies. Floats or doubles, by capabilities.precision. NULL if the mesh has
   * no channels. */
  void* channel_values;
  /* In the same order and precision: for each corner of each triangle the derivatives of its components by u, then
   * those by v (by l1 and l2 on Loop's triangles), as they are on the triangle's side of an edge or seam. u and v are
   * those of the control face; on a face that is no quad those of the quad in which the triangle lies, or, if it
   * lies in none, of the quad that the vertex names. Where the limit has no derivatives, anything may stand. NULL if
   * the capabilities promise none, or the mesh has no channels. */
  void* channel_derivatives;
} lc_tessellation;

/* The table of functions that a subject consists of. */
typedef struct lc_subject {
  uint32_t abi; /* LC_SUBJECT_ABI of the header it was built with */
  const char* name;
  const char* description; /* one line: what it is, and of which version */
  const char* options;     /* help text for the options of create(), or NULL */

  /* What the subject can do under these options ("key=value,key=value", or NULL). An unknown option or value:
   * LC_INVALID_INPUT. A scheme that it does not do is no error: it fills in `schemes`. */
  lc_status (*capabilities)(const char* options, lc_capabilities* out, const char** message);

  /* Prepares a mesh. *mesh and its arrays stay valid and unchanged until destroy(): a subject may keep the
   * pointer instead of a copy. On failure *instance is not used, and destroy() is not called. */
  lc_status (*create)(const lc_mesh* mesh, const char* options, void** instance, const char** message);
  /* *out is zeroed beforehand, but for `size`. */
  lc_status (*tessellate)(void* instance, const lc_request* request, lc_tessellation* out,
                          const char** message);
  /* Frees what the subject itself keeps for `out` (its owner); the arrays belong to the host. */
  void (*release)(void* instance, lc_tessellation* out);
  void (*destroy)(void* instance);
} lc_subject;

/*
 * A shared library exports one function. `abi` is the interface the host speaks, LC_SUBJECT_ABI of its own
 * copy of this header; NULL if the subject cannot serve it. The host asks for the latest interface first,
 * then for earlier ones. The table stays valid while the library is loaded. LC_EXPORT makes the function
 * visible whatever the default visibility is.
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
