// SPDX-License-Identifier: MIT
// Sound subjects in which one thing is changed after the fact: what they declare, take, are asked or deliver.
// `faulty` has faults, so that checks can be tried; `unusual` has habits that are rare and right, which no check
// may blame.
//
//   options   fault=NAME (of `unusual`: habit=NAME; default none), of=SUBJECT, and any option of that subject
//
//   Session session(*lc_subject_faulty(), mesh, faulty_options("one_ulp_crack", "opensubdiv-far",
//   "precision=double"));
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "data/control_mesh.h"
#include "verify/mutants/asked.h"
#include "verify/subject/subject.h"

namespace limitcheck::verify {

/// One thing that is changed: a row of the tables below.
struct Change {
  enum class On : std::uint8_t { kLoop, kQuads, kBoth };

  std::string name, description;
  std::string check;            // the row of the audit meant to find it; of a habit: none
  On on = On::kLoop;            // which scheme has it
  bool sharp = false;           // only sharp edges and vertices bring it out
  bool on_some_meshes = false;  // only control meshes of its kind bring it out; on others it changes nothing
  std::string claim = {};       // of the paper, where it is the paper taken literally
  std::string of = {}, options = {};  // the subject that it is planted in, if not that of its table
  /// Whether a mesh and a depth can bring it out; empty: each can.
  std::function<bool(const Asked&)> shows = {};
  bool of_the_process = false;  // touches what all code of a process shares: to be tried in one of its own

  /// What it does; most do one of these.
  std::function<void(lc_capabilities&)> declare = {};
  std::function<void(data::ControlMesh&)> take = {};  // before the sound subject sees the mesh, valid or not
  bool deaf = false;  // takes what the sound subject refuses, and delivers nothing
  std::function<void(const Asked&)> refuse = {};  // throws where a valid mesh is refused
  /// What two meshes have in common that it takes for one: all but what this makes equal. Asked::known has
  /// the first.
  std::function<void(data::ControlMesh&)> forget = {};
  std::function<void(const Asked&, std::vector<std::int32_t>&)> ask = {};  // depths
  std::function<void(const Asked&, data::ControlMesh&)> remake = {};       // the mesh, for one request
  std::function<void(const Asked&, Delivered&)> deliver = {};
  std::function<void()> behave = {};  // before it is made, and before each request
  bool in_a_thread = false;           // computes in one of its own
};
using Fault = Change;
using Habit = Change;

/// Faults of what is delivered; the first is "none". Some need something to be planted in (a depth >= 1,
/// normals, a vertex of another valence than 6): without it tessellate() returns LC_NOT_SUPPORTED.
std::span<const Fault> faults();
/// All faults, those of faults() among them, with the subject that a mutant has them planted in.
struct FaultTable {
  std::span<const Fault> faults;
  const char *of_loop, *of_quads;  // if the fault does not say
  const char* loop_prefix;         // of the names of mutants of Loop's scheme; the others have "quad_"
};
const std::vector<FaultTable>& fault_tables();
/// Habits; the first is "none".
std::span<const Habit> habits();

/// The options that plant `fault` in `subject`, run under `options`, or give it the habit.
std::string faulty_options(std::string_view fault, std::string_view subject, std::string_view options = {});
std::string unusual_options(std::string_view habit, std::string_view subject, std::string_view options = {});

}  // namespace limitcheck::verify
