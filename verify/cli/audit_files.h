// SPDX-License-Identifier: MIT
// `limitcheck audit --control cage.obj --tessellation out.ply`: the part of the audit command that needs no
// program.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "verify/cli/mesh_options.h"

namespace limitcheck::cli {

struct FilesArguments {
  std::string control, tessellation, provenance, per_vertex, fit;
  double tolerance = 1e-6, hausdorff = 0;
  bool normals = false, no_hausdorff = false;

  bool given() const { return !tessellation.empty(); }
};

/// Adds the options to the audit command, in a group of their own.
void add_files_options(CLI::App& audit, FilesArguments& files);

/// Runs it. `json` as in the audit command; returns the exit code.
int audit_files(const FilesArguments& files, const MeshOptions& mesh, const std::string& json, int threads);

}  // namespace limitcheck::cli
