// SPDX-License-Identifier: MIT
// One row of the relations while its requests are made: two tessellations of one surface, point by point.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "verify/evidence/audit_case.h"
#include "verify/relations/variants.h"

namespace limitcheck::verify {

/// What one variant came to.
struct Comparison {
  std::int64_t of = 0, bad = 0, other_bits = 0;
  std::int64_t not_finite = 0;      // points that are, in the original
  std::int64_t split = 0;           // shared points delivered with unlike bits, where the original has none
  double position = 0, normal = 0;  // the largest differences: diagonals, degrees
  double worst = 0;                 // the largest of both in units of its bound
  std::optional<Witness> witness;
  std::optional<Witness> split_at;  // the first of `split`
  std::string message;
};

/// How many points of `a` have positions and normals that those of `b` have not; a face may name them otherwise.
std::int64_t different_points(const Tessellation& a, const Tessellation& b);
/// How many corners of triangles of `a` have no corner of `b` in the same face, at the same position, with the same
/// bits of channels and their derivatives.
std::int64_t different_channels(const Tessellation& a, const Tessellation& b);

/// Compares with the tessellation of the evidence, which outlives this.
class Compared {
 public:
  explicit Compared(const Evidence& e);

  /// `t` is what the subject made of `v`; `slack` is how many results' errors may add up. Points that are not
  /// finite on either side are left out, as long as there are no more of them than in the original. What faces share
  /// has to have equal bits in each variant, if it has in the original: how a mesh is written is no excuse.
  Comparison with(const Tessellation& t, const Variant& v, double slack) const;
  /// `t` is what the subject made of the same request: each bit that differs is bad.
  ///   where   the first answer is, for the message: "in the first"
  Comparison bits_with(const Tessellation& t, const char* where) const;

 private:
  using Key = std::int64_t;  // of a point and a face
  // The vertices by which a face delivers a point. There may be as many as a polygon has corners.
  struct Delivered {
    std::int64_t first, last;
  };
  struct Digest {
    Key key;
    std::uint64_t bits;
    std::int64_t vertex;
    auto operator<=>(const Digest&) const = default;
  };

  bool same(const Tessellation& t, std::int64_t k, const Variant& v, std::int64_t mine) const;
  // The first vertex of several that has the same bits.
  std::optional<std::int64_t> with_same_bits(const Tessellation& t, std::int64_t k, const Variant& v,
                                             Key key) const;

  const Evidence& e_;
  const Variant same_;
  const bool uniform_;
  std::unordered_map<Key, Delivered> by_face_;
  std::vector<Digest> several_;  // all vertices where a face delivers a point more than once, sorted
  std::unordered_map<Lattice::Id, std::int64_t> by_point_;
  std::unordered_set<Lattice::Id> not_finite_;  // points
  std::int64_t split_ = 0;  // vertices at shared points that have other bits than the first one there
};

/// What a request came to that ended with an error.
///   status   kNotSupported for LC_NOT_SUPPORTED, kFinding for LC_INVALID_INPUT (the mesh was valid) and for an answer
///            that breaks the protocol, kCrash or kTimeout for a process that ended or hung, otherwise kError
///   origin   kLimit of what took too long or too much, otherwise kSubject
struct Breakdown {
  Status status;
  Origin origin;
};
Breakdown breakdown_of(const std::exception& error);

/// All requests are made, also after one has failed. The row has the worst status of them all, and its
/// message says what went wrong in each.
class RelationRow {
 public:
  RelationRow(const AuditSubject& subject, const Evidence& e, std::string_view name, const char* unit,
              double bound);

  /// Opens a session for one mesh and calls `work` with it, which may tessellate any number of times.
  /// Whatever `work` or the end of the session throws is noted together with `what`, which `work` may have
  /// changed.
  ///   other   the subject that is asked in place of the row's
  void ask(const std::string& what, const data::ControlMesh& mesh, const std::function<void(Session&)>& work,
           const AuditSubject* other = nullptr);

  /// Notes defects of the arrays, unless the tessellation of the evidence has some too.
  void inspect(const std::string& what, const Tessellation& t);

  /// `bits_matter`: points that differ beneath the bound are worth a warning.
  void judge(const std::string& what, const Comparison& c, bool bits_matter);

  /// Adds `of` elements that were compared, `bad` of them wrong.
  void count(std::int64_t bad, std::int64_t of) {
    r_.bad += bad;
    r_.of += of;
  }
  ///   origin   of a breakdown
  void note(Status status, const std::string& message, std::optional<Origin> origin = {});
  /// What was taken that should have been refused.
  void accepted(const std::string& what) { r_.accepted.push_back(what); }
  /// Sets the witness if there is none yet.
  void witness(const Witness& w) {
    if (!r_.witness) r_.witness = w;
  }

  /// The row. If nothing was compared it is not run, never held.
  Result take();

 private:
  const AuditSubject& subject_;
  const Evidence& e_;
  Result r_;
  std::string comparison_;
};

/// Asks for the tessellation of the evidence eight times in one session, each time after something else
/// (verify/host/in_turns.h), and the fourth time with 8 threads, and once in a session for each mesh that may
/// come first: each must have the bits that it had in a process that was asked for nothing else. NaNs are
/// compared by their bits, too.
void ask_in_turns(RelationRow& row, const AuditSubject& subject, const Evidence& e, const Compared& compared);

}  // namespace limitcheck::verify
