// SPDX-License-Identifier: MIT
// `limitcheck audit`: how the subject is found, and the options that say how.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "verify/evidence/audit_case.h"
#include "verify/host/isolation/remote_subject.h"

namespace limitcheck::cli {

struct SubjectArguments {
  std::string program, shader;
  bool isolate = false;
  verify::ProcessLimits limits;
  std::string witness_folder = "limitcheck-witness";
};

void add_subject_options(CLI::App& command, SubjectArguments& arguments);
/// --option: key=value,... for the subject.
void add_subject_settings(CLI::App& command, std::vector<std::string>& options);

/// With --program or --shader there is no SUBJECT among the positional arguments: what was taken for one is the first mesh.
void take_program(const SubjectArguments& arguments, std::string& subject, std::vector<std::string>& meshes);

/// `audit MESH` without a subject means all of them: if SUBJECT names a mesh and no subject, it becomes the
/// first mesh, and a line on standard error says so.
void take_mesh(const SubjectArguments& arguments, std::string& subject, std::vector<std::string>& meshes);

/// The subjects of one audit; owns those that run in processes of their own.
class SubjectLoader {
 public:
  explicit SubjectLoader(SubjectArguments arguments);

  /// NAME, FILE.so, an executable, program:COMMAND or shader:FILE; all but the last two may be followed by ":key=value,...".
  /// Returns the subject with those options. Throws data::ArgumentError: there is no such subject.
  verify::AuditSubject open(const std::string& text);

  /// The same with more options, which it is asked about. Throws data::ArgumentError: it refuses them, too.
  verify::AuditSubject open(const std::string& text, const std::vector<std::string>& options);

  /// A built-in subject: itself, or in a process of its own with --isolate.
  verify::AuditSubject built_in(const lc_subject& subject);

  /// How the processes of the subjects were held, in words; empty if there were none.
  std::string containment() const;
  /// What these processes took; of each subject that had any.
  std::vector<verify::Receipt> receipts() const;

 private:
  const lc_subject* remote(verify::RemoteSubject::Kind kind, const std::string& what, bool in_turns = false);
  // The subject with its wrapper, each in a process of its own.
  verify::AuditSubject wrapped(verify::RemoteSubject::Kind kind, const std::string& what,
                               const std::string& options = "") {
    return {remote(kind, what), options, remote(kind, what, true)};
  }

  SubjectArguments arguments_;
  std::vector<std::unique_ptr<verify::RemoteSubject>> remote_;
};

}  // namespace limitcheck::cli
