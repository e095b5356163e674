// SPDX-License-Identifier: MIT
// An audit: subjects x meshes x checks.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "data/control_mesh.h"
#include "verify/evidence/audit_case.h"
#include "verify/evidence/evidence.h"
#include "verify/evidence/reference_surface.h"
#include "verify/recognise/recognise.h"
#include "verify/relations/relations.h"
#include "verify/row/result.h"
#include "verify/shard/shard.h"

namespace limitcheck::verify {

/// What is being done now, for a progress display.
struct AuditStep {
  std::string subject, mesh, check;
  std::size_t done, total;  // pairs of subject and mesh
};

/// How much is looked at.
enum class Level {
  kQuick,     // one tessellation of each mesh
  kStandard,  // also the relations (relations.h), on meshes of at most kRelationFaces faces of four corners,
              // and on larger ones whether a deep request is answered with the same bits
  kThorough   // the relations on every mesh
};

/// Audits subjects on control meshes; keeps the reference of the last mesh for the next subject.
class Auditor {
 public:
  /// `depth` >= 0 is that of meshes that have none of their own. `threads` >= 1 are handed to the subjects;
  /// the checks run in oneTBB's arena.
  Auditor(int depth, int threads, std::function<void(const AuditStep&)> on_step = {},
          Level level = Level::kQuick);
  ~Auditor();

  /// One subject on one mesh: a row for each check, in the order of the table, the first being `tessellates`.
  /// A subject that refuses or fails makes no exception, nor does an interrupt (interrupt.h) or what
  /// the host lacks: what could not be looked at has rows that say so. `mesh` is valid (data/validate.h).
  std::vector<Result> run(const AuditSubject& subject, const AuditMesh& mesh);

  /// Leaves out the rows of a subject on a mesh that `wanted` does not say.
  using Wanted = std::function<bool(const AuditSubject&, const AuditMesh&, std::string_view check)>;
  void judge_only(Wanted wanted) { shared_->wanted = std::move(wanted); }

  /// Whether an interrupt left something out.
  bool gave_up() const { return gave_up_; }
  /// From now on an interrupt does not wait for a check, or a subject in this process, that takes longer than
  /// kToEnd: it is left on a thread of its own (run_or_abandon).
  void leave_what_is_interrupted() { leaves_ = true; }
  /// Whether that has happened: then neither this nor the subjects and meshes that it was given may be
  /// destroyed before the process ends.
  bool abandoned() const { return abandoned_; }
  /// What this program or its system lacked, and no subject, so that something was left out; empty: nothing.
  const std::string& lack() const { return lack_; }

  /// Every subject on every mesh; results are ordered by subject, then by mesh. Unit m * subjects + s of the
  /// journal's plan is subject s on mesh m: those that its shard has not are left out, those that it knows are
  /// taken from it, and every other is audited and, if that was not interrupted, added to it. Different
  /// subjects are asked at a time, on as many of the threads as there are subjects; one subject is asked one
  /// thing at a time, because what it knows may be all its sessions'.
  std::vector<Result> run(const std::vector<AuditSubject>& subjects, const std::vector<AuditMesh>& meshes,
                          Journal* journal = nullptr);

  /// The rows of a subject on a mesh, one for each check that is wanted, whatever becomes of it.
  std::vector<std::string> row_names(const AuditSubject& subject, const AuditMesh& mesh) const;

 private:
  struct Rows;
  // What all that work at an audit have in common.
  struct Shared {
    std::function<void(const AuditStep&)> on_step;
    Wanted wanted;
    std::mutex mutex;
    std::size_t done = 0, total = 1;
    std::map<std::pair<std::string, data::Scheme>, std::vector<Refusal>> refusals;  // of each subject, once
  };
  struct Work;

  // Takes meshes until there is none left.
  void take_part(Work& work);
  void run_unit(Work& work, std::size_t mesh, std::size_t subject);

  // Adds rows to `results` as they come, so that an interrupt keeps those that are there.
  void judge(const AuditSubject& subject, const AuditMesh& mesh, std::vector<Result>& results);
  void run_checks(const AuditSubject& subject, const AuditMesh& mesh, const Evidence& evidence,
                  const Rows& rows, const std::string& no_reference);
  // Adds each row that is still missing, and why: out of memory, or interrupted. If nothing was begun it is one
  // row: at a signal there may be thousands of such pairs, and a second to write a report.
  void add_missing(const AuditSubject& subject, const AuditMesh& mesh, bool begun, const std::string& lack,
                   std::vector<Result>& results);
  bool wants(const AuditSubject& subject, const AuditMesh& mesh, std::string_view check) const {
    return !shared_->wanted || shared_->wanted(subject, mesh, check);
  }
  int depth_of(const AuditMesh& mesh) const { return mesh.depth < 0 ? depth_ : mesh.depth; }
  ReferenceSurface& reference(const data::ControlMesh& rounded, data::Scheme scheme, int depth,
                              const lc_capabilities& capabilities);
  void forget();  // all that is kept of a mesh
  void step(const std::string& subject, const std::string& mesh, std::string_view check);

  int depth_, threads_;
  Level level_;
  std::shared_ptr<Shared> shared_;
  // That work beside it: the same audit, with references of their own.
  std::vector<std::unique_ptr<Auditor>> others_;
  std::string lack_;
  bool gave_up_ = false, leaves_ = false, abandoned_ = false;
  std::function<void()> keep_rows_;  // called between two checks
  std::string cached_mesh_;
  KeptGuesses guesses_;
  std::vector<std::unique_ptr<ReferenceSurface>>
      cache_;  // of one mesh: by precision, kind of points and weights
};

}  // namespace limitcheck::verify
