/* SPDX-License-Identifier: MIT */
/* The door must stay plain C: a subject written in C, compiled as strict C99, audited like any other. */
#include "verify/subject/subject.h"

static lc_status capabilities(const char* options, lc_capabilities* out, const char** message) {
  if (options != NULL) {
    *message = "no options";
    return LC_INVALID_INPUT;
  }
  out->precision = LC_FLOAT32;
  out->weights = LC_WEIGHTS_LOOP;
  out->boundary = LC_BOUNDARY_SPLINE;
  out->points = LC_POINTS_REFINED;
  out->max_depth = 0;
  out->normals = 0;
  out->per_face_depth = 0;
  out->exact_lattice = 1;
  return LC_OK;
}

static lc_status create(const lc_mesh* mesh, const char* options, void** instance, const char** message) {
  (void)options, (void)message;
  *instance = (void*)mesh->positions;
  return LC_OK;
}

static lc_status tessellate(void* instance, const lc_request* request, lc_tessellation* out,
                            const char** message) {
  (void)instance;
  if (request->face_depth[0] != 0) {
    *message = "depth 0 only";
    return LC_NOT_SUPPORTED;
  }
  out->positions = request->allocate(request->host, 0);
  return LC_OK;
}

static void release(void* instance, lc_tessellation* out) {
  (void)instance, (void)out;
}
static void destroy(void* instance) {
  (void)instance;
}

const lc_subject* subject_in_c(void) {
  static const lc_subject subject = {LC_SUBJECT_ABI, "c",        "a subject in C", NULL,   capabilities,
                                     create,         tessellate, release,          destroy};
  return &subject;
}
