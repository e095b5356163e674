// SPDX-License-Identifier: MIT
// `limitcheck audit`: the ways a subject gets in, and the options that belong to them.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "data/control_mesh.h"
#include "verify/subject/isolation/remote_subject.h"

namespace limitcheck::cli {

struct DoorArguments {
  std::string program;
  std::string containment = "auto";
  bool isolate = false;
  verify::ProcessLimits limits;
  std::string witness_folder = "limitcheck-witness";
};

void add_door_options(CLI::App& command, DoorArguments& arguments);

/// With --program there is no SUBJECT among the positional
/// arguments: what was taken for one is the first mesh.
void take_program(const DoorArguments& arguments, std::string& subject, std::vector<std::string>& meshes);

/// The subjects of one audit; owns those that run in processes of their own.
class Doors {
 public:
  explicit Doors(DoorArguments arguments) : arguments_(std::move(arguments)) {}

  /// NAME, FILE.so, an executable, or program:COMMAND; all but the last may be followed by ":key=value,...".
  /// Returns the subject and those options. Throws std::invalid_argument: there is no such subject.
  std::pair<const lc_subject*, std::string> open(const std::string& text);

  /// A built-in subject: itself, or in a process of its own with --isolate.
  const lc_subject* built_in(const lc_subject& subject);

  /// How the processes of the subjects were held, in words; empty if there were none.
  std::string containment() const;

 private:
  const lc_subject* remote(verify::RemoteSubject::Kind kind, const std::string& what);

  DoorArguments arguments_;
  std::vector<std::unique_ptr<verify::RemoteSubject>> remote_;
};

/// One depth for each face, from -1 to `deepest`, separated by white space. Throws std::invalid_argument.
std::vector<std::int32_t> read_depths(const std::string& file, const data::ControlMesh& mesh, int deepest);

}  // namespace limitcheck::cli
