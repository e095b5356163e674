// SPDX-License-Identifier: MIT
// What one row of an audit is about: a subject, and a mesh at its depths.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "data/control_mesh.h"
#include "verify/audit/sample.h"
#include "verify/subject/subject.h"

namespace limitcheck::verify {

/// A control mesh and how deep it is asked for. The same mesh may be asked for more than once.
struct AuditMesh {
  std::string name;  // as `limitcheck eval` understands it
  data::ControlMesh mesh;
  std::vector<std::int32_t> face_depth = {};           // 0 .. depth or -1 (culled); empty: `depth` for all
  std::shared_ptr<const MeshSample> sample = nullptr;  // if given, only this part of the mesh is looked at
  int depth = -1;                                      // of the deepest face; -1: the auditor's
  std::string depths{};   // how the faces got theirs, as --depths takes it (face_depths.h); may be empty
  bool relations = true;  // looked at, too, if the auditor's level says so
};

struct AuditSubject {
  const lc_subject* subject;
  std::string options;  // "key=value,key=value" or empty
  /// The same behind verify/subject/in_turns.h, where that has to be in a process of the subject's own.
  const lc_subject* in_turns = nullptr;
};

}  // namespace limitcheck::verify
