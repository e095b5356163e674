// SPDX-License-Identifier: MIT
// A wrapper that makes other requests in between, so that state which a subject keeps between requests shows.
#pragma once

#include <array>

#include "verify/subject/subject.h"

namespace limitcheck::verify {

/// What has happened before each request to tessellate is passed on, in this order; behind the last one,
/// nothing more.
inline constexpr std::array<const char*, 8> kTurns{
    "after other meshes, one of them of as many vertices and faces",
    "after a smaller depth",
    "after another mesh that is alive beside it",
    "beside another mesh of as many vertices and faces, with 8 threads",
    "after the other mesh was destroyed",
    "after a greater depth, where that is not many triangles",
    "for the eighth time, another mesh made in between",
    "made again after another mesh, and asked for another depth first"};

/// Another subject around `inner`: create() first makes two other meshes and tessellates them, then the one
/// that is asked for, and all live together; each tessellate() is passed on after the turn above. All other
/// meshes are valid and closed. A failure in a turn is a failure of the request. One at a time in a process.
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
