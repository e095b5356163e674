// SPDX-License-Identifier: MIT
// What one row of an audit is about: a subject, and a mesh at its depths.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "data/control_mesh.h"
#include "data/scheme.h"
#include "verify/evidence/sample.h"
#include "verify/subject/subject.h"

namespace limitcheck::verify {

/// A control mesh and the depths at which it is tessellated. One mesh may be audited at several depths.
struct AuditMesh {
  std::string name;  // as `limitcheck eval` understands it
  data::ControlMesh mesh;
  std::vector<std::int32_t> face_depth = {};           // 0 .. depth or -1 (culled); empty: `depth` for all
  std::shared_ptr<const MeshSample> sample = nullptr;  // if given, only this part of the mesh is looked at
  int depth = -1;                                      // of the deepest face; -1: the auditor's
  std::string depths{};     // how the depths were chosen, as --depths takes it (face_depths.h); may be empty
  bool relations = true;    // whether the relations are checked, if the auditor's level includes them
  bool asked_again = true;  // whether a mesh without relations has the row `determinism` all the same
  std::optional<data::Scheme> asked_scheme = {};  // empty: the one that the mesh is meant for
  std::string
      triangulated{};  // how larger faces of what `name` means were cut, as --triangulate takes it; or empty

  data::Scheme scheme() const { return asked_scheme.value_or(data::natural_scheme(mesh)); }
};

/// A subject under options, which are part of its name in tables and reports.
struct AuditSubject {
  const lc_subject* subject;
  std::string options;  // "key=value,key=value" or empty
  /// The same subject wrapped by verify/host/in_turns.h, if the wrapper has to run in the subject's own
  /// process.
  const lc_subject* in_turns = nullptr;

  /// "name" or "name:options".
  std::string label() const {
    return options.empty() ? subject->name : std::string(subject->name) + ":" + options;
  }
};

}  // namespace limitcheck::verify
