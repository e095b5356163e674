// SPDX-License-Identifier: MIT
// Whether the texture coordinates of a file are those of the control mesh's channel.
#include <fmt/core.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "data/io/gltf.h"
#include "reference/surface/channel.h"
#include "verify/evidence/other_channel.h"
#include "verify/files/checks/file_evidence.h"
#include "verify/row/bounds.h"
#include "verify/row/statistics.h"

namespace limitcheck::verify {
namespace {

using data::ChannelRule;
using Uv = std::array<double, 2>;

// A corner of a triangle that has texture coordinates, and where it lies.
struct TexturedCorner {
  std::int32_t vertex;
  Uv got;
  LimitSurface::ControlPoint at;
  double slack;  // in the parameters, by what its position may be off
};

// How far a point may be from where its vertex was meant to be, in the parameters: by the direction in which the point
// moves slowest. At most a quarter of a face.
double slack_of(const FileEvidence& e, const FacePoint& at) {
  const auto p = e.surface.surface().evaluate(at, reference::Derivatives::kFirst);
  const Vector d1 = vector_of(p.d1), d2 = vector_of(p.d2);
  const double a = dot(d1, d1), b = dot(d1, d2), c = dot(d2, d2);
  const double slowest = std::sqrt(std::max(0., (a + c) / 2 - std::hypot((a - c) / 2, b)));
  const double radius = e.tolerance * e.surface.diagonal();
  return p.first_exist && slowest > 4 * radius ? radius / slowest : .25;
}

std::vector<TexturedCorner> textured_corners(const FileEvidence& e, bool flipped, std::int64_t& without) {
  const FileTessellation& t = e.tessellation;
  std::vector<TexturedCorner> corners;
  for (std::size_t i = 0; i < t.corner_texture.size(); ++i) {
    const PlacedTriangle placed = place_triangle(e, e.points_of(t.triangles[i]));
    if (placed.face < 0 || placed.crosses) continue;  // rows of their own say so
    for (std::size_t c = 0; c < 3; ++c) {
      const std::int32_t index = t.corner_texture[i][c];
      if (index < 0) {
        ++without;
        continue;
      }
      Uv got = t.texture[static_cast<std::size_t>(index)];
      if (!std::isfinite(got[0]) || !std::isfinite(got[1])) continue;  // `file-finite` says so
      if (flipped) got[1] = 1 - got[1];
      const FacePoint at{placed.face, placed.l[c]};
      corners.push_back({t.triangles[i][c], got, e.surface.surface().control_point(at), slack_of(e, at)});
    }
  }
  return corners;
}

// The errors of the corners by a channel and a rule, in diagonals.
struct Judged {
  std::vector<double> error;
  std::vector<Uv> expected;
  std::int64_t good = 0;
};
Judged judged(const FileEvidence& e, const std::vector<TexturedCorner>& corners, const data::Channel& channel,
              ChannelRule rule, double diagonal) {
  const reference::ChannelSurface surface(e.control, channel, rule, e.scheme());
  Judged result{std::vector<double>(corners.size()), std::vector<Uv>(corners.size())};
  tbb::parallel_for(std::size_t{0}, corners.size(), [&](std::size_t k) {
    const TexturedCorner& c = corners[k];
    const auto p = surface.evaluate(c.at.face, std::max(0, c.at.corner), c.at.first, c.at.second);
    result.expected[k] = {p.position.x, p.position.y};
    const double off = std::hypot(c.got[0] - p.position.x, c.got[1] - p.position.y);
    // Where derivatives grow towards a vertex, they say nothing of what is within reach: the slack is a quarter then.
    const double speed = std::hypot(std::hypot(p.d1.x, p.d1.y), std::hypot(p.d2.x, p.d2.y));
    const double excused = p.first_exist ? speed * c.slack : .25 * diagonal;
    result.error[k] = std::max(0., off - excused) / diagonal;
  });
  result.good =
      std::count_if(result.error.begin(), result.error.end(), [&](double x) { return x <= e.tolerance; });
  return result;
}

}  // namespace

std::vector<Result> check_file_channel(const FileEvidence& e) {
  const auto is_texture = [](const data::Channel& c) { return c.components == 2 || c.components == 3; };
  const auto& channels = e.control.channels;
  auto first =
      std::find_if(channels.begin(), channels.end(), [](const auto& c) { return c.components == 2; });
  if (first == channels.end()) first = std::find_if(channels.begin(), channels.end(), is_texture);
  if (first == channels.end()) return {};
  const data::Channel channel = first->some(0, 2);
  Result r = e.result("file-channel", "diagonal of the channel", e.tolerance);
  if (lacks(e.tessellation.corner_texture, "texture coordinates", r)) return {r};
  const ChannelRule rule = channel.rule.value_or(data::kUsualChannelRule);
  double low[2] = {channel.values[0], channel.values[1]}, high[2] = {low[0], low[1]}, largest = 0;
  for (std::size_t i = 0; i < channel.values.size(); ++i) {
    low[i % 2] = std::min(low[i % 2], channel.values[i]);
    high[i % 2] = std::max(high[i % 2], channel.values[i]);
    largest = std::max(largest, std::abs(channel.values[i]));
  }
  const double diagonal = unit_of_length(std::hypot(high[0] - low[0], high[1] - low[1]), largest);

  // glTF counts the second coordinate from the top of the picture, all others from its foot.
  const bool flipped = data::io::is_gltf(e.tessellation.name) != data::io::is_gltf(e.control_name);
  std::int64_t without = 0;
  const std::vector<TexturedCorner> corners = textured_corners(e, flipped, without);
  const Judged found = judged(e, corners, channel, rule, diagonal);
  const Statistics s = summarise(found.error, e.tolerance);
  take(r, s);
  r.decades = decades(found.error);
  if (s.worst_at >= 0) {
    const auto at = static_cast<std::size_t>(s.worst_at);
    r.witness = e.at_point(corners[at].at);
    r.witness->vertex = corners[at].vertex;
    name_channel(*r.witness, channel);
    r.witness->expected = {found.expected[at].begin(), found.expected[at].end()};
    r.witness->got = {corners[at].got.begin(), corners[at].got.end()};
  }
  if (s.bad > 0)
    say(r, other_channels(e.control, channel, [&](const data::Channel& other, ChannelRule by_rule) {
          const auto count = static_cast<std::int64_t>(corners.size());
          return explains(count - judged(e, corners, other, by_rule, diagonal).good, s.bad, count);
        }));
  if (std::count_if(channels.begin(), channels.end(), is_texture) > 1)
    say(r, fmt::format("of the control mesh's channels only {} was compared", channel.name));
  if (without > 0) {
    r.status = Status::kFinding;
    r.bad += without, r.of += without;
    say(r, fmt::format("{} corners of triangles have no texture coordinates", without));
  }
  return {r};
}

}  // namespace limitcheck::verify
