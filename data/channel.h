// SPDX-License-Identifier: MIT
// Face-varying data: values at the corners of faces that break where texture coordinates do, along seams.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace limitcheck::data {

struct ControlMesh;
class Faces;

/// What a channel does at seams and on the boundary: OpenSubdiv's "face-varying linear interpolation" and USD's
/// faceVaryingLinearInterpolation. Each rule holds more values where they are than the one before.
/// reference/SURFACE.md defines them.
enum class ChannelRule : std::uint8_t {
  kNone,          ///< smooth everywhere: seams are B-spline curves
  kCornersOnly,   ///< values of one face are held
  kCornersPlus1,  ///< and vertices where three charts meet
  kCornersPlus2,  ///< and the ends of seams and concave corners
  kBoundaries,    ///< seams and boundary are piecewise linear
  kAll            ///< linear, or bilinear, on every face
};
/// USD's words in the order of the rules, with hyphens: "none", "corners-only", .. "all".
inline constexpr std::string_view kChannelRules[] = {"none",          "corners-only", "corners-plus1",
                                                     "corners-plus2", "boundaries",   "all"};
/// The rule that USD has where a file says none.
inline constexpr ChannelRule kUsualChannelRule = ChannelRule::kCornersPlus1;

/// Values by corner of a control mesh. Two corners have the same value if they have the same vertex and the same
/// index: an index that is used at two vertices is two values.
///   components   numbers of a value, 1 .. kMostComponents
///   values       components of all values, one value after the other, finite
///   corners      an index of a value for each corner of all faces (Faces::corners)
///   rule         that the file says, if it does
struct Channel {
  std::string name;
  int components = 2;
  std::vector<double> values = {};
  std::vector<std::int32_t> corners = {};
  std::optional<ChannelRule> rule = {};

  /// One component of the value at a corner.
  double at(std::size_t corner, int component) const {
    return values[static_cast<std::size_t>(corners[corner]) * static_cast<std::size_t>(components) +
                  static_cast<std::size_t>(component)];
  }
  /// `count` components from `first` on, as a channel.
  Channel some(int first, int count) const;
  friend bool operator==(const Channel&, const Channel&) = default;
};
inline constexpr int kMostComponents = 4;

/// Why a channel is none of the mesh: too few or too many components or corners, an index without a value, a value that is
/// not finite. Faces and values are counted from `first`. Empty if it is one.
std::string fault_of(const Channel& channel, const ControlMesh& mesh, std::int64_t first = 0);

/// The channel of that name. Throws ArgumentError: there is none; the message names those there are.
const Channel& channel_of(const ControlMesh& mesh, std::string_view name);

/// What channels of a whole mesh some of its faces have: their corners, and the values that these name.
///   faces   of the whole, in the order of the part
std::vector<Channel> channels_of(const std::vector<Channel>& whole, const Faces& whole_faces,
                                 std::span<const std::int32_t> faces);

}  // namespace limitcheck::data
