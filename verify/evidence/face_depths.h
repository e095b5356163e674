// SPDX-License-Identifier: MIT
// The ways in which the faces of a mesh get their depths.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "data/control_mesh.h"

namespace limitcheck::verify {

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
