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

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "data/control_mesh.h"
#include "data/scheme.h"
#include "reference/mesh/topology.h"
#include "verify/host/host.h"
#include "verify/subject/adapter.h"
#include "verify/subject/face_domain.h"
#include "verify/subject/subject.h"

namespace limitcheck::verify {

// What a fault may look at, the control mesh and the request, and what it may change: what was delivered.

/// What a subject delivered, exact in double, so that vertices and triangles can be changed, added and removed.
struct Delivered : DeliveredArrays {
  bool single = false;  // it is delivered in float
  // Of the channels that the mesh has, as lc_tessellation says; the latter empty: not delivered.
  std::vector<double> channel_values, channel_derivatives;
  // What is done when it is handed over.
  std::optional<std::int64_t> announced_vertices = std::nullopt;
  bool foreign_normals = false, overlap = false, overrun = false, underrun = false, modify_mesh = false;
  bool in_one_block = false;  // the arrays from last to first, with room between

  Delivered() = default;
  explicit Delivered(const Tessellation& good);
  Place place(std::size_t v) const { return place_of(provenance[v], corner.empty() ? 0 : corner[v]); }
  /// Another vertex like vertex v of `from`; returns its number.
  std::uint32_t add_vertex(const Delivered& from, std::size_t v);
  void erase_triangle(std::size_t t);
  /// The next number up, in the precision that is delivered.
  double one_ulp_up(double x) const;
  void move_up(std::size_t v) { positions[v][0] = one_ulp_up(positions[v][0]); }
};

/// A valid control mesh, and a request.
struct Asked {
  Asked(const data::ControlMesh& of, data::Scheme by, int deepest_face);

  /// How many faces are at a vertex, and whether it lies inside.
  int faces(std::int32_t v) const { return static_cast<int>(topology.sector(v).faces.size()); }
  bool inside(std::int32_t v) const { return topology.sector(v).closed; }
  int sharp_edges(std::int32_t v) const { return infinite[v] + semi_sharp[v]; }
  /// Whether the surface inside has two edges there that stay sharp, and no other tag.
  bool on_inner_crease(std::int32_t v) const {
    return inside(v) && infinite[v] == 2 && sharp_edges(v) == 2 && held[v] == 0;
  }
  /// Of one of the sides between two edges that stay sharp, at a vertex with two; else 0.
  int faces_of_side(std::int32_t v) const;
  /// Vertices - edges + faces.
  std::int64_t characteristic() const;
  /// Faces at a vertex, at most.
  int most_faces() const;
  /// The face beyond a side of a face, or -1.
  std::int32_t beyond(std::size_t face, std::size_t side) const;
  /// How deep it is, as the request has it; -1 if there is none or it is culled.
  int depth_beyond(std::size_t face, std::size_t side) const;
  bool is_polygon(std::size_t face) const {
    return scheme == data::Scheme::kCatmullClark && mesh.faces[face].size() != 4;
  }

  bool has_polygons() const;

  FaceDomain domain(std::size_t face) const { return {scheme, static_cast<int>(mesh.faces[face].size())}; }
  /// The side that a delivered vertex lies on and how far along it, over `steps`; the control vertex that it
  /// lies at, or -1.
  std::optional<FaceDomain::SidePoint> side_of(const Place& at) const;
  std::int64_t steps(const Place& at) const { return domain(face_of(at)).steps(at.denominator); }
  std::int32_t control_vertex(const Place& at) const;

  static std::size_t face_of(const Place& at) { return static_cast<std::size_t>(at.face); }

  const data::ControlMesh& mesh;
  const data::Scheme scheme;
  const int deepest;
  const reference::Topology topology;
  double diagonal = 0, largest = 0;       // of the box; the largest coordinate
  std::vector<int> infinite, semi_sharp;  // edges at each vertex; those of the boundary are infinite
  std::vector<float> held;                // sharpness of each vertex
  std::vector<int> component;             // of each vertex, numbered in the order of the faces

  // Of a request.
  std::span<const std::int32_t> depth;
  int threads = 1, call = 1, call_of_all = 1;  // how many requests came, to this instance and to all
  const lc_mesh* lent = nullptr;               // the mesh as it was lent to the subject
  // What is remembered: the first mesh that was like this one (Change::forget), the last that came, faces at a
  // vertex of the first, at most; the first depths, and the first whose deepest face was as deep.
  const data::ControlMesh *known = nullptr, *last = nullptr;
  int first_most = 0;
  std::vector<std::int32_t> first_depths, first_as_deep;
  /// What the sound subject delivers for another mesh of the same number of faces or another request.
  std::function<Delivered(const data::ControlMesh&, const std::vector<std::int32_t>&)> again;
};

/// Throws SubjectError(LC_NOT_SUPPORTED): there is no such thing to plant a fault in.
[[noreturn]] void nowhere(const char* what);

/// One thing that is changed: a row of the tables below.
struct Change {
  enum class On : std::uint8_t { kLoop, kQuads, kBoth };

  std::string name, description;
  std::string check;            // the row of the audit meant to find it; of a habit: none
  On on = On::kLoop;            // which scheme has it
  bool sharp = false;           // only sharp edges and vertices bring it out
  bool deep = false;            // only depths from 1 on
  bool rare = false;            // planted in `naive`: a neighbourhood that has to be met, or of channels
  bool on_some_meshes = false;  // only control meshes of its kind bring it out; on others it changes nothing
  std::string claim = {};       // of the paper, where it is the paper taken literally
  std::string of = {}, options = {};  // the subject that it is planted in, if not the model
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
/// All faults, beginning with faults().
std::span<const Fault> all_faults();
/// Habits; the first is "none".
std::span<const Habit> habits();

/// The options that plant `fault` in `subject`, run under `options`.
std::string faulty_options(std::string_view fault, std::string_view subject, std::string_view options = {});

}  // namespace limitcheck::verify
