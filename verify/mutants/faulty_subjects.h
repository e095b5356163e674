// SPDX-License-Identifier: MIT
// The subject `faulty`: another subject with one fault planted in what it delivers, so that checks can be
// tried.
//
//   options   of=SUBJECT, fault=NAME (default none), and any option of that subject
//
//   Session session(*lc_subject_faulty(), mesh, faulty_options("one_ulp_crack", "opensubdiv-far",
//   "precision=double"));
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "verify/subject/subject.h"

namespace limitcheck::verify {

struct Fault {
  std::string_view name;
  std::string_view description;
  bool on_some_meshes = false;  // only control meshes of its kind bring it out; on others it changes nothing
};

/// All faults that can be planted; the first is "none". Some need something to be planted in (a depth >= 1,
/// normals, a vertex of another valence than 6): without it tessellate() returns LC_NOT_SUPPORTED.
std::span<const Fault> faults();

/// The options that plant `fault` in `subject`, run under `options`.
std::string faulty_options(std::string_view fault, std::string_view subject, std::string_view options = {});

/// Faults of what stays from one frame to the next, which the subject `faulty-frames` plants at the end of a
/// walk of frames; the first is "none".
struct FrameFault {
  std::string_view name;
  std::string_view description;
  std::string_view check;  // the row of the audit that is meant for it
};
std::span<const FrameFault> frame_faults();

}  // namespace limitcheck::verify
