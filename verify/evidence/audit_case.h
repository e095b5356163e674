// SPDX-License-Identifier: MIT
// What one row of an audit is about: a subject, and a mesh, or a part of it, at its depths.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "data/control_mesh.h"
#include "data/scheme.h"
#include "verify/subject/subject.h"

namespace limitcheck::verify {

/// Patches of faces of a control mesh (all faces around some vertices) and the faces on which their limit
/// surface depends (reference/mesh/support.h), so over the patches the part has the same surface as the whole.
/// The subject gets the whole, with every face outside the patches culled.
class MeshSample {
 public:
  /// At least `faces` faces (or all), around vertices drawn at random. `whole` is valid (data/validate.h).
  /// Time and memory O(vertices + faces of the whole).
  MeshSample(const data::ControlMesh& whole, std::size_t faces, std::uint64_t seed);

  /// As it was asked for: "FACES:SEED".
  const std::string& text() const { return text_; }

  /// The patches and their surroundings, a valid control mesh. Where the surroundings touch themselves in a
  /// vertex only, they are cut apart.
  const data::ControlMesh& part() const { return part_; }
  /// For each face of the part, the face of the whole.
  std::span<const std::int32_t> faces() const { return faces_; }
  /// For each face of the whole, the face of the part or -1.
  const std::vector<std::int32_t>& part_of() const { return part_of_; }

  /// Depths of the whole, with all faces outside the patches culled.
  std::vector<std::int32_t> cull(std::vector<std::int32_t> depth_of_whole) const;
  /// Depths of the part.
  std::vector<std::int32_t> depths_of_part(std::span<const std::int32_t> depth_of_whole) const;
  /// The part with the positions and channels of another mesh of the same connectivity as the whole (a rounded one).
  data::ControlMesh part_with(const data::ControlMesh& positions) const;

 private:
  std::string text_;
  data::ControlMesh part_;
  std::vector<std::int32_t> faces_, part_of_;
  std::vector<std::int32_t> vertices_;  // for each vertex of the part, that of the whole
  std::vector<bool> in_patch_;          // for each face of the whole
};

/// A control mesh and the depths at which it is tessellated. One mesh may be audited at several depths.
struct AuditMesh {
  std::string name;  // as `limitcheck eval` understands it
  data::ControlMesh mesh;
  std::vector<std::int32_t> face_depth = {};           // 0 .. depth or -1 (culled); empty: `depth` for all
  std::shared_ptr<const MeshSample> sample = nullptr;  // if given, only this part of the mesh is looked at
  int depth = -1;                                      // of the deepest face; -1: the auditor's
  std::string depths{};     // how the depths were chosen, as --depths takes it (Depths); may be empty
  bool relations = true;    // whether the relations are checked, if the auditor's level includes them
  bool asked_again = true;  // whether a mesh without relations has the row `determinism` all the same
  bool turned = true;       // and the row `corner-rotation`
  std::optional<data::Scheme> asked_scheme = {};  // empty: the one that the mesh is meant for
  std::string
      triangulated{};  // how larger faces of what `name` means were cut, as --triangulate takes it; or empty

  data::Scheme scheme() const { return asked_scheme.value_or(data::natural_scheme(mesh)); }
};

/// A subject under options, which are part of its name in tables and reports.
struct AuditSubject {
  const lc_subject* subject;
  std::string options;  // "key=value,key=value" or empty
  /// The same subject wrapped by verify/host/in_turns.h, if the wrapper has to run in the subject's own
  /// process.
  const lc_subject* in_turns = nullptr;

  /// "name" or "name:options".
  std::string label() const {
    return options.empty() ? subject->name : std::string(subject->name) + ":" + options;
  }
};

// The ways in which the faces of a mesh get their depths.

/// What --depths says:
///   uniform                  the same for all faces
///   random[:SEED[:visible]]  -1 (culled) to the deepest, each as likely; with `visible` none is culled
///   view                     by size on the screen, seen from outside; faces that look away are culled
///   face0-culled             the deepest, face 0 culled
///   all-culled               nothing is to be displayed
///   file:FILE                one number for each face, separated by white space
///   after:SEED:...           any of these, after the same object was asked for other depths
struct Depths {
  std::string kind = "uniform";  // the word in front of the first colon
  std::optional<std::uint64_t> seed;
  bool visible = false;  // random: no face is culled
  std::string file;
  std::optional<std::uint64_t> after;

  /// As it was written, the seed of random in any case.
  std::string text() const;
};

/// Throws data::ArgumentError for anything else.
Depths parse_depths(const std::string& text);

/// A depth for every face, -1 to `deepest`, or none at all if it is `deepest` for each. Throws
/// data::ArgumentError: a file cannot be read, or does not have one such number for each face.
std::vector<std::int32_t> face_depths(const Depths& depths, const data::ControlMesh& mesh, int deepest);

/// "after:SEED:" if the text begins so, else nothing.
std::string after_of(const std::string& depths);

/// What `after:SEED:` at the beginning of the text asks for beforehand: one to three lists of depths, each
/// with a depth for every face. None without it.
///   each   false: the subject takes one depth for all faces
std::vector<std::vector<std::int32_t>> earlier_depths(const std::string& depths, std::size_t faces,
                                                      int deepest, bool each);

/// A depth for every face, each of least .. most as likely.
std::vector<std::int32_t> random_depths(std::size_t faces, int least, int most, std::uint64_t seed);

}  // namespace limitcheck::verify
