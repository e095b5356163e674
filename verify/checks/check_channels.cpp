// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <unordered_map>
#include <unordered_set>

#include "data/error.h"
#include "reference/surface/channel.h"
#include "verify/checks/checks.h"
#include "verify/evidence/channel_rule.h"
#include "verify/row/bounds.h"
#include "verify/row/statistics.h"

namespace limitcheck::verify {
namespace {

// A corner of a triangle, and where it lies on the face of the triangle.
struct Corner {
  std::int64_t triangle;
  int k;
  Place place;
};

std::vector<Corner> corners_of(const Evidence& e) {
  std::vector<Corner> corners;
  for (std::int64_t t = 0; t < e.tessellation.triangle_count(); ++t) {
    std::array<Lattice::Coordinates, 3> at;
    if (!e.place(t, at)) continue;  // `coverage` says so
    for (int k = 0; k < 3; ++k)
      corners.push_back(
          {t, k, e.lattice.place(e.tessellation.triangle_face()[t], at[static_cast<std::size_t>(k)])});
  }
  return corners;
}

// At most three components of a channel of the mesh.
struct Part {
  std::size_t channel;
  int first, count;
  data::Channel values;  // of these components alone
};
std::vector<Part> parts_of(const data::ControlMesh& mesh) {
  std::vector<Part> parts;
  for (std::size_t c = 0; c < mesh.channels.size(); ++c)
    for (int first = 0; first < mesh.channels[c].components; first += 3) {
      const int count = std::min(3, mesh.channels[c].components - first);
      parts.push_back({c, first, count, mesh.channels[c].some(first, count)});
    }
  return parts;
}

struct Size {
  double magnitude = 0, diagonal = 0;
};
Size size_of(const data::Channel& channel) {
  Size size;
  for (int k = 0; k < channel.components; ++k) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t i = static_cast<std::size_t>(k); i < channel.values.size();
         i += static_cast<std::size_t>(channel.components)) {
      low = std::min(low, channel.values[i]);
      high = std::max(high, channel.values[i]);
    }
    size.magnitude = std::max({size.magnitude, std::abs(low), std::abs(high)});
    size.diagonal = std::hypot(size.diagonal, high - low);
  }
  size.diagonal = unit_of_length(size.diagonal, size.magnitude);
  return size;
}

using Values = std::array<double, 3>;
Values delivered(const Evidence& e, const Corner& c, const Part& part) {
  Values values{};
  for (int k = 0; k < part.count; ++k)
    values[static_cast<std::size_t>(k)] =
        e.tessellation.channel_value(part.channel, c.triangle, c.k, part.first + k);
  return values;
}
Values exact(const reference::ChannelSurface& surface, const Place& p) {
  const auto at =
      surface.evaluate(p.face, p.corner, double(p.i) / p.denominator, double(p.j) / p.denominator).position;
  return {at.x, at.y, at.z};
}

// Errors of all corners, in diagonals of the channel; nothing where no cut is exact.
std::optional<std::vector<double>> errors(const Evidence& e, const std::vector<Corner>& corners,
                                          const Part& part, data::ChannelRule rule, double diagonal) try {
  const reference::ChannelSurface surface(e.mesh, part.values, rule, e.lattice.scheme());
  std::vector<double> error(corners.size());
  for (std::size_t n = 0; n < corners.size(); ++n) {
    const Values got = delivered(e, corners[n], part), is = exact(surface, corners[n].place);
    // (Of three numbers, libstdc++'s hypot may lose a NaN.)
    const double off = std::hypot(std::hypot(got[0] - is[0], got[1] - is[1]), got[2] - is[2]);
    error[n] = std::isfinite(off) ? off / diagonal : std::numeric_limits<double>::infinity();
  }
  return error;
} catch (const data::ArgumentError&) {
  return std::nullopt;
}

// Of each point, on its side of a seam, the corners that have it: the numbers of the cut mesh tell the sides apart.
void check_shared_values(const Evidence& e, const std::vector<Corner>& corners, std::size_t channel,
                         Result& row) {
  data::ControlMesh cut = e.mesh;
  cut.faces = reference::faces_of_cut(e.mesh, e.mesh.channels[channel]);
  std::int32_t most = 0;
  for (const std::int32_t v : cut.faces.corners()) most = std::max(most, v);
  cut.positions.resize(static_cast<std::size_t>(most) + 1);
  cut.sharpness = {};
  const Lattice lattice(cut, e.lattice.scheme(), e.lattice.depth());
  std::unordered_map<Lattice::Id, const Corner*> first;
  std::unordered_set<Lattice::Id> several, different;
  for (const Corner& c : corners) {
    const Lattice::Id id = lattice.id(c.place);
    const auto [found, is_new] = first.try_emplace(id, &c);
    if (is_new) continue;
    several.insert(id);
    const auto a = e.tessellation.channel_bits(channel, c.triangle, c.k),
               b = e.tessellation.channel_bits(channel, found->second->triangle, found->second->k);
    if (std::memcmp(a.data(), b.data(), a.size()) == 0 || !different.insert(id).second || row.witness)
      continue;
    row.witness = e.at(c.place);
    row.witness->vertex = e.tessellation.triangles()[c.triangle][static_cast<std::size_t>(c.k)];
  }
  row.of += static_cast<std::int64_t>(several.size());
  row.bad += static_cast<std::int64_t>(different.size());
}

}  // namespace

std::vector<Result> check_channels(const Evidence& e) {
  Result positions = e.result("channel-positions", "diagonal of the channel"),
         shared = e.result("channel-shared", "points", 0);
  const auto unlooked = [&](Status status, const char* why) {
    positions.status = shared.status = status;
    positions.message = shared.message = why;
    return std::vector<Result>{positions, shared};
  };
  if (e.mesh.channels.empty())
    return unlooked(Status::kNotSupported,
                    "was handed no channel: it does not do the rule, or by Chaikin's creasing a semi-sharp "
                    "edge ends on a seam");
  if (e.tessellation.channel_count() == 0)
    return unlooked(Status::kNotRun, "no channel values were delivered");
  if (e.capabilities.points != LC_POINTS_LIMIT)
    return unlooked(Status::kNotSupported, "delivers no limit points");

  const std::vector<Corner> corners = corners_of(e);
  for (std::size_t c = 0; c < e.mesh.channels.size(); ++c) check_shared_values(e, corners, c, shared);
  settle(shared);

  std::vector<double> all;
  std::string said;
  std::optional<double> bound;
  double worst = -1;
  for (const Part& part : parts_of(e.mesh)) {
    const data::ChannelRule rule = part.values.rule.value_or(data::kUsualChannelRule);
    const Size size = size_of(part.values);
    const double allowed =
        position_bound(e.capabilities.precision, e.reference.steps(), size.magnitude, size.diagonal);
    std::optional<std::vector<double>> found = errors(e, corners, part, rule, size.diagonal);
    if (!found)
      return unlooked(Status::kNotSupported,
                      "by Chaikin's creasing a semi-sharp edge ends on a seam: only eval judges that");
    if (!bound) bound = allowed;
    const auto within = [&](double x) { return x <= allowed; };
    const auto at = std::max_element(found->begin(), found->end());
    if (at != found->end() && !within(*at) && said.empty())
      said = other_rules(rule, corners.size(), [&](data::ChannelRule other) -> std::optional<std::int64_t> {
        const auto by_other = errors(e, corners, part, other, size.diagonal);
        if (!by_other) return std::nullopt;
        return std::count_if(by_other->begin(), by_other->end(), within);
      });
    // Channels of other sizes have other bounds: their errors are in units of the first one's.
    const double scale = *bound / allowed;
    if (at != found->end() && *at * scale > worst) {
      worst = *at * scale;
      const Corner& c = corners[static_cast<std::size_t>(at - found->begin())];
      positions.witness = e.at(c.place);
      positions.witness->vertex = e.tessellation.triangles()[c.triangle][static_cast<std::size_t>(c.k)];
      const Values got = delivered(e, c, part),
                   is = exact(reference::ChannelSurface(e.mesh, part.values, rule, e.lattice.scheme()),
                              c.place);
      positions.witness->got.assign(got.begin(), got.begin() + part.count);
      positions.witness->expected.assign(is.begin(), is.begin() + part.count);
    }
    for (const double x : *found) all.push_back(x * scale);
  }
  positions.bound = bound;
  take(positions, summarise(all, *bound));
  positions.decades = decades(all);
  positions.message = said;
  return {positions, shared};
}

}  // namespace limitcheck::verify
