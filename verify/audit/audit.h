// SPDX-License-Identifier: MIT
// An audit: subjects x meshes x checks.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "data/control_mesh.h"
#include "verify/audit/journal.h"
#include "verify/audit/reference_surface.h"
#include "verify/audit/result.h"
#include "verify/audit/sample.h"
#include "verify/subject/subject.h"

namespace limitcheck::verify {

struct AuditMesh {
  std::string name;  // as `limitcheck eval` understands it
  data::ControlMesh mesh;
  std::vector<std::int32_t> face_depth =
      {};  // 0 .. the auditor's depth or -1 (culled); empty: all that depth
  std::shared_ptr<const MeshSample> sample = nullptr;  // if given, only this part of the mesh is looked at
};

struct AuditSubject {
  const lc_subject* subject;
  std::string options;  // "key=value,key=value" or empty
};

/// What is being done now, for a progress display.
struct AuditStep {
  std::string subject, mesh, check;
  std::size_t done, total;  // pairs of subject and mesh
};

/// How much is looked at.
enum class Level {
  kQuick,     // one tessellation of each mesh
  kStandard,  // also the relations (relations.h), on meshes of at most kRelationFaces faces
  kThorough   // the relations on every mesh
};
inline constexpr std::size_t kRelationFaces = 200;

/// Audits subjects on control meshes, no deeper than one depth; keeps the reference of the last mesh for the
/// next subject.
class Auditor {
 public:
  /// depth >= 0; threads >= 1 are handed to the subjects (the checks use oneTBB's arena).
  Auditor(int depth, int threads, std::function<void(const AuditStep&)> on_step = {},
          Level level = Level::kQuick);
  ~Auditor();

  /// One subject on one mesh: a row for each check, in the order of the table, the first being `tessellates`.
  /// A subject that refuses or fails gives rows, never an exception; nor does an interrupt (interrupt.h) or a
  /// lack of memory: what could not be looked at has rows that say so. `mesh` is valid (data/validate.h).
  std::vector<Result> run(const AuditSubject& subject, const AuditMesh& mesh);

  /// The same at one depth for each control face, 0 to the auditor's depth, or -1 (culled).
  std::vector<Result> run(const AuditSubject& subject, const AuditMesh& mesh,
                          std::span<const std::int32_t> face_depth);

  /// Whether an interrupt left something out.
  bool gave_up() const { return gave_up_; }
  /// Whether a lack of memory, of this program and not of a subject, left something out.
  bool out_of_memory() const { return out_of_memory_; }

  /// All of them, results ordered by subject, then mesh. What the journal knows is not looked at again; what
  /// is looked at, as a whole, is kept there.
  std::vector<Result> run(const std::vector<AuditSubject>& subjects, const std::vector<AuditMesh>& meshes,
                          Journal* journal = nullptr);

 private:
  // Adds rows to `results` as they come, so that an end in between leaves what there is.
  void judge(const AuditSubject& subject, const AuditMesh& mesh, std::span<const std::int32_t> face_depth,
             std::vector<Result>& results);
  ReferenceSurface& reference(const data::ControlMesh& rounded, lc_points points);
  void step(const std::string& subject, const std::string& mesh, std::string_view check);

  int depth_, threads_;
  std::function<void(const AuditStep&)> on_step_;
  Level level_;
  std::size_t done_ = 0, total_ = 1;
  bool gave_up_ = false, out_of_memory_ = false;
  std::string cached_mesh_;
  std::vector<std::unique_ptr<ReferenceSurface>> cache_;  // of one mesh: by precision and kind of points
};

}  // namespace limitcheck::verify
