// SPDX-License-Identifier: MIT
#include "verify/subject/registry.h"

#include "verify/gl/context.h"

namespace limitcheck::verify {

std::vector<const lc_subject*> built_in_subjects() {
  std::vector<const lc_subject*> all{lc_subject_naive(),
                                     lc_subject_sliding_window(),
                                     lc_subject_row_stream(),
                                     lc_subject_opensubdiv_far(),
                                     lc_subject_opensubdiv_far_patches(),
                                     lc_subject_opensubdiv_bfr(),
                                     lc_subject_cgal(),
                                     lc_subject_openmesh(),
                                     lc_subject_embree()};
  for (const lc_subject* maybe : {lc_subject_vtk(), lc_subject_opensubdiv_gl(), lc_subject_row_stream_gl()})
    if (maybe != nullptr) all.push_back(maybe);
  return all;
}

std::vector<MissingSubject> missing_subjects() {
  std::vector<MissingSubject> missing;
  if (lc_subject_vtk() == nullptr)
    missing.push_back(
        {"vtk",
         "this build has no vtk: VTK 9 was not there when it was configured (Debian package libvtk9-dev)"});
  for (const std::string name : {"opensubdiv-gl", "row-stream-gl"})
    if (!lack_of_gl().empty()) missing.push_back({name, "this machine has no " + name + ": " + lack_of_gl()});
  return missing;
}

const lc_subject* find_subject(std::string_view name) {
  std::vector<const lc_subject*> all = built_in_subjects();
  all.insert(all.end(), {lc_subject_null(), lc_subject_faulty(), lc_subject_unusual(), lc_subject_bare(),
                         lc_subject_anywhere(), lc_subject_model(), lc_subject_quad_model()});
  for (const lc_subject* subject : all) {
    if (subject->name == name) return subject;
  }
  return nullptr;
}

}  // namespace limitcheck::verify
