// SPDX-License-Identifier: MIT
// The subjects that are built in.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "verify/subject/subject.h"

extern "C" {
const lc_subject* lc_subject_naive();
const lc_subject* lc_subject_sliding_window();
const lc_subject* lc_subject_row_stream();
const lc_subject* lc_subject_row_stream_gl();  // nullptr: this machine has no libraries of OpenGL
const lc_subject* lc_subject_opensubdiv_far();
const lc_subject* lc_subject_opensubdiv_far_patches();
const lc_subject* lc_subject_opensubdiv_bfr();
const lc_subject* lc_subject_opensubdiv_gl();  // nullptr: the same
const lc_subject* lc_subject_cgal();
const lc_subject* lc_subject_openmesh();
const lc_subject* lc_subject_embree();
const lc_subject* lc_subject_vtk();  // nullptr: this build has none
const lc_subject* lc_subject_null();
const lc_subject* lc_subject_model();  // right, or wrong in one stated way: verify/mutants/mutant_rules.h
const lc_subject* lc_subject_quad_model();  // the same of Catmull-Clark's surfaces
const lc_subject* lc_subject_faulty();      // options: verify/mutants/faulty_subjects.h
const lc_subject* lc_subject_unusual();     // options: the same
const lc_subject* lc_subject_bare();        // options: bare=SUBJECT first
const lc_subject* lc_subject_anywhere();    // right, at points that are on no lattice
}

namespace limitcheck::verify {

/// The tessellators, in the order in which they are listed and audited.
std::vector<const lc_subject*> built_in_subjects();

/// A tessellator that this build, or this machine, could have and does not, and what it lacks.
struct MissingSubject {
  std::string name, why;
};
std::vector<MissingSubject> missing_subjects();

/// By name, `null`, `faulty`, `unusual`, `model` and `quad-model` included; nullptr if there is none.
const lc_subject* find_subject(std::string_view name);

}  // namespace limitcheck::verify
