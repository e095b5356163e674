// SPDX-License-Identifier: MIT
// A wrapper that makes other requests in between, so that state which a subject keeps between requests shows.
#pragma once

#include <array>

#include "verify/subject/subject.h"

namespace limitcheck::verify {

/// What has happened before each request to tessellate is passed on, in this order; behind the last one,
/// nothing more. A look-alike differs from the mesh in one thing: its positions, all tags or some of them,
/// the creasing, the boundary option or the rule of triangles, as far as the subject declares these; or all
/// its vertices have other numbers.
inline constexpr std::array<const char*, 8> kTurns{
    "after another mesh and its look-alikes",
    "after a smaller depth",
    "after another mesh that is alive beside it",
    "beside its look-alikes, each made again, with 8 threads",
    "after the other mesh was destroyed",
    "after a greater depth, where that is not many triangles",
    "after the eighth time, another mesh made in between, and after other culling",
    "made again after its first look-alike, and asked for depths of the same sum, another depth and other "
    "culling first"};

/// What else a subject may have met first. The options then begin with this text, which is not passed on, and
/// there is one turn: after the mesh was made and tessellated.
struct First {
  const char* option;
  const char* what;
};
inline constexpr std::array<First, 2> kFirst{
    First{"in-turns-first=low,", "after a mesh with vertices of three neighbours alone"},
    First{"in-turns-first=high,", "after a mesh with vertices of 60 neighbours"}};

/// Another subject around `inner`: create() first makes another mesh and look-alikes and tessellates them, then the one
/// that is asked for, and all live together; each tessellate() is passed on after the turn above. All other
/// meshes are valid; those that are no look-alikes are closed. A failure in a turn is a failure of the
/// request, unless it is of a mesh of kFirst. One at a time in a process.
class InTurns {
 public:
  explicit InTurns(const lc_subject& inner);
  ~InTurns();
  InTurns(const InTurns&) = delete;
  InTurns& operator=(const InTurns&) = delete;

  const lc_subject& subject() const { return subject_; }

 private:
  lc_subject subject_;
};

}  // namespace limitcheck::verify
