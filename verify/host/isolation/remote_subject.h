// SPDX-License-Identifier: MIT
// Subjects that run in a process of their own, behind the same plug-in interface as all others.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "verify/host/isolation/child_process.h"
#include "verify/subject/subject.h"

namespace limitcheck::verify {

struct IsolationSettings {
  ProcessLimits limits;
  /// The program that serves libraries, shaders and built-in subjects: `WORKER worker library FILE`, `WORKER worker
  /// shader FILE`, `WORKER worker built-in NAME`. It calls serve() (worker.h).
  std::string worker = std::filesystem::read_symlink("/proc/self/exe");
  /// Where the control mesh and the depths of a breakdown are saved; empty: nowhere.
  std::string witness_folder;
  /// Libraries and built-in subjects: whether the worker puts in_turns.h in front of the subject.
  bool in_turns = false;
};

/// A subject whose every session is one new process: what it breaks or leaks ends with it. Its functions
/// throw SubjectDied when the process breaks down; the message ends with the command that repeats the call.
/// One session at a time from one thread; destroy() throws if the process does not end in good order.
class RemoteSubject {
 public:
  enum class Kind { kLibrary, kProgram, kBuiltIn, kShader };
  /// `what`: a file (of a library, of a shader), a command for /bin/sh, the name of a built-in subject. Starts
  /// nothing. Throws data::ArgumentError: more than 64 at a time.
  RemoteSubject(Kind kind, std::string what, IsolationSettings settings);
  ~RemoteSubject();
  RemoteSubject(const RemoteSubject&) = delete;
  RemoteSubject& operator=(const RemoteSubject&) = delete;

  /// Valid as long as this. Its name is `what`, "program:" in front of a command, "shader:" in front of a shader.
  const lc_subject& subject() const { return subject_; }

  /// How its last process was contained; none if there was no process yet.
  std::optional<Containment> containment() const { return containment_; }
  /// What its processes took so far.
  const Receipt& receipt() const { return receipt_; }

 private:
  friend struct RemoteCalls;
  std::unique_ptr<ChildProcess> start();

  Kind kind_;
  std::string what_, name_;
  IsolationSettings settings_;
  lc_subject subject_{};
  Receipt receipt_;
  std::size_t slot_ = 0;
  // Started for capabilities(), and used by the create() that follows.
  std::unique_ptr<ChildProcess> waiting_;
  std::string waiting_options_;
  lc_scheme waiting_scheme_ = LC_SCHEME_LOOP;
  std::string options_text_;
  protocol::Capabilities capabilities_;
  bool has_answered_ = false;
  std::optional<Containment> containment_;
};

}  // namespace limitcheck::verify
