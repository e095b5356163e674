// SPDX-License-Identifier: MIT
// Which meshes `limitcheck audit` looks at, and at which depths.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "verify/audit/audit.h"
#include "verify/cli/mesh_options.h"
#include "verify/cli/progress.h"
#include "verify/evidence/face_depths.h"

namespace limitcheck::cli {

/// --sample: "FACES" or "FACES:SEED".
struct Sampling {
  std::size_t faces = 0;
  std::uint64_t seed = 1;
};
/// Nothing for an empty text. Throws data::ArgumentError.
std::optional<Sampling> parse_sample(const std::string& text);

/// What is looked at, and the line that says for which scheme.
struct AuditedMeshes {
  std::vector<verify::AuditMesh> list;
  std::string scheme_line;
};

/// The default plan (audit/default_plan.h): of both schemes what the subjects do or, with --scheme, of one.
AuditedMeshes planned_meshes(const MeshOptions& options, verify::Level level,
                             const std::vector<verify::AuditSubject>& audited);

struct MeshRequest {
  std::vector<std::string> names;  // of files, or as `limitcheck generate` takes them; none: the default ones
  MeshOptions options;
  int depth;
  verify::Depths depths;
  std::optional<Sampling> sampling;
  verify::Level level;
  bool must_refuse;  // they are broken, and are read as they are
};
/// Throws data::ArgumentError and data::InputError.
AuditedMeshes open_meshes(const MeshRequest& request, const std::vector<verify::AuditSubject>& audited,
                          Progress& progress);

}  // namespace limitcheck::cli
