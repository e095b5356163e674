// SPDX-License-Identifier: MIT
// The cases of a hunt: meshes without end, each with a name that can be typed again.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "data/scheme.h"
#include "verify/audit/audit_case.h"

namespace limitcheck::verify {

/// What a subject does of one scheme.
struct Does {
  data::Scheme scheme = data::Scheme::kLoop;
  std::int32_t sharp = 0;  // lc_capabilities::sharp
};

/// What the subject says that it does, of these schemes. A subject that breaks down when it is asked does
/// both, without sharp edges: the audit will say why.
std::vector<Does> schemes_of(const AuditSubject& subject, const std::vector<data::Scheme>& schemes);

/// One case: the mesh at its depths, and whether the relations are looked at, too.
struct HuntCase {
  std::uint64_t number = 0;
  AuditMesh mesh;
};

/// The edges of a mesh told apart by what lies about them: valences and boundary at both ends, corners of the
/// faces, sharpness, and how much the depths of its faces differ. One number for each kind.
std::set<std::uint64_t> kinds_of_edges(const AuditMesh& mesh);

/// Case n is decided by the seed, n and what the subject does. Families of meshes, sizes, stretching and the
/// ways of choosing depths take turns; of four meshes drawn for a case the one with most kinds of edges that
/// its block of cases has not had yet is taken.
class HuntPlan {
 public:
  static constexpr std::uint64_t kBlock = 16;  // cases: shards have whole blocks

  /// Throws data::ArgumentError: the subject does none of the schemes.
  HuntPlan(std::uint64_t seed, std::vector<Does> does);

  /// Fast for the case after the last one; for any other the block is begun anew.
  HuntCase at(std::uint64_t number);

 private:
  HuntCase next();

  std::uint64_t seed_, number_ = 0;  // of the case that next() makes
  std::vector<Does> does_;
  std::set<std::uint64_t> seen_;  // in this block
};

}  // namespace limitcheck::verify
