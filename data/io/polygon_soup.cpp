// SPDX-License-Identifier: MIT
#include "data/io/polygon_soup.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <utility>

#include "data/building_blocks.h"
#include "data/triangulate.h"
#include "data/validate.h"

namespace limitcheck::data::io {
namespace {

using Corners = std::span<const std::int64_t>;

std::int64_t line_of(const std::vector<std::int64_t>& lines, std::int64_t element) {
  return element >= 0 && static_cast<std::size_t>(element) < lines.size() ? lines[element] : 0;
}

bool has_larger_polygons(const PolygonSoup& soup) {
  std::size_t begin = 0;
  for (const std::size_t end : soup.polygon_end) {
    if (end - begin > 3) return true;
    begin = end;
  }
  return false;
}

// What is wrong with a polygon by itself, before triangulation, which would hide it: an index that does not
// exist, a corner twice, too few corners. The first fault as code and message; an empty message if there is none.
//   last   of each vertex, the last polygon that named it, before this one
std::pair<MeshFault, std::string> fault_of(Corners polygon, std::int64_t number, std::int64_t first,
                                           std::vector<std::int64_t>& last) {
  if (polygon.size() < 3)
    return {MeshFault::kDegenerateFace,
            fmt::format("face {} has {} corners", number + first, polygon.size())};
  const auto vertices = static_cast<std::int64_t>(last.size());
  for (const std::int64_t v : polygon) {
    if (v < 0 || v >= vertices)
      return {MeshFault::kIndexOutOfRange,
              fmt::format("face {} names vertex {}, the mesh has {}", number + first, v + first, vertices)};
    if (last[v] == number)
      return {MeshFault::kDegenerateFace,
              fmt::format("face {} names vertex {} twice", number + first, v + first)};
    last[v] = number;
  }
  return {};
}

// A mesh has no tags of unused vertices but sharp vertices.
void leave_out(ControlMesh& mesh, const std::vector<SoupFault>& unused) {
  std::vector<std::int32_t> to(mesh.positions.size(), 0);
  for (const SoupFault& f : unused) to[f.vertex] = -1;
  std::int32_t kept = 0;
  for (std::size_t v = 0; v < to.size(); ++v) {
    if (to[v] < 0) continue;
    mesh.positions[kept] = mesh.positions[v];
    to[v] = kept++;
  }
  mesh.positions.resize(kept);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (std::int32_t& v : mesh.faces[f]) v = to[v];
  for (SharpEdge& e : mesh.sharpness.edges) e.a = to[e.a], e.b = to[e.b];
  for (SharpVertex& v : mesh.sharpness.vertices) v.vertex = to[v.vertex];
  std::erase_if(mesh.sharpness.vertices, [](const SharpVertex& v) { return v.vertex < 0; });
}

// The faces that a mesh does not show whose boundary is not interpolated (PolygonSoup::hides_boundary).
std::vector<bool> beside_boundary(const ControlMesh& mesh) {
  std::set<VertexPair> lasting;
  for (const SharpEdge& e : mesh.sharpness.edges)
    if (e.sharpness >= kInfiniteSharpness) lasting.insert(std::minmax(e.a, e.b));
  std::vector<bool> at(mesh.positions.size(), false), result(mesh.faces.size(), false);
  const std::vector<VertexPair> sides = sides_of(mesh.faces);
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end] == sides[begin]) ++end;
    if (end - begin == 1 && !lasting.contains(sides[begin]))
      at[sides[begin].first] = at[sides[begin].second] = true;
  }
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    result[f] =
        std::any_of(mesh.faces[f].begin(), mesh.faces[f].end(), [&](std::int32_t v) { return at[v]; });
  return result;
}

// Gives corners of one vertex whose values have the same numbers the same index.
void join_equal_values(Channel& channel, const Faces& faces) {
  const auto components = static_cast<std::size_t>(channel.components);
  std::map<std::pair<std::int32_t, std::vector<double>>, std::int32_t> first;
  for (std::size_t c = 0; c < channel.corners.size(); ++c) {
    const auto value = channel.values.begin() +
                       static_cast<std::ptrdiff_t>(static_cast<std::size_t>(channel.corners[c]) * components);
    const std::vector<double> numbers(value, value + static_cast<std::ptrdiff_t>(components));
    channel.corners[c] = first.try_emplace({faces.corners()[c], numbers}, channel.corners[c]).first->second;
  }
}

// The channels of the file. Where one is unusable, the mesh is not, and a note says why it is left out.
//   polygon_of   of each face
void add_channels(const PolygonSoup& soup, const std::vector<std::int64_t>& polygon_of, Examination& result) {
  for (const PolygonSoup::SoupChannel& given : soup.channels) {
    Channel channel{given.name, given.components, given.values, {}, given.rule};
    constexpr std::int64_t kMost = std::numeric_limits<std::int32_t>::max();
    std::int64_t without = -1;  // the first polygon with such an index
    for (const std::int64_t polygon : polygon_of)
      for (std::size_t c = polygon == 0 ? 0 : soup.polygon_end[polygon - 1]; c < soup.polygon_end[polygon];
           ++c) {
        const std::int64_t index = c < given.corners.size() ? given.corners[c] : -1;
        if ((index < -1 || index > kMost) && without < 0) without = polygon;
        channel.corners.push_back(static_cast<std::int32_t>(index));
      }
    if (const std::string fault = without >= 0
                                      ? fmt::format("face {} has an index of no value", soup.first + without)
                                      : fault_of(channel, result.mesh, soup.first);
        !fault.empty()) {
      result.notes.push_back(fmt::format("the channel {} is left out: {}", given.name, fault));
      continue;
    }
    if (given.by_value) join_equal_values(channel, result.mesh.faces);
    result.mesh.channels.push_back(std::move(channel));
  }
}

}  // namespace

void join_equal_positions(PolygonSoup& soup) {
  const std::vector<std::int32_t> first = first_at_place(soup.positions);
  std::vector<std::int64_t> index(first.size());
  std::size_t kept = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (first[i] != static_cast<std::int32_t>(i)) continue;
    index[i] = static_cast<std::int64_t>(kept);
    soup.positions[kept] = soup.positions[i];
    if (!soup.position_lines.empty()) soup.position_lines[kept] = soup.position_lines[i];
    ++kept;
  }
  soup.positions.resize(kept);
  if (!soup.position_lines.empty()) soup.position_lines.resize(kept);
  for (std::int64_t& v : soup.corners) v = v < 0 ? v : index[static_cast<std::size_t>(first[v])];
}

bool is_unused(const SoupFault& fault) {
  return fault.code == code(MeshFault::kIsolatedVertex);
}

Sharpness sharpness_of(const PolygonSoup& soup) {
  const auto index = [](std::int64_t v) {
    return v < 0 || v > std::numeric_limits<std::int32_t>::max() ? -1 : static_cast<std::int32_t>(v);
  };
  Sharpness result = soup.choices;
  for (const auto& tag : soup.sharp) {
    const auto sharpness = static_cast<float>(tag.sharpness);
    if (tag.b < 0)
      result.vertices.push_back({index(tag.a), sharpness});
    else
      result.edges.push_back({index(tag.a), index(tag.b), sharpness});
  }
  return result;
}

Examination examine(const PolygonSoup& soup, const ReadOptions& options) {
  Examination result;
  const std::size_t polygons = soup.polygon_end.size();
  const bool keep = options.polygons == Triangulation::kKeep;
  const Scheme natural = keep && has_larger_polygons(soup) ? Scheme::kCatmullClark : Scheme::kLoop;
  result.scheme = options.scheme.value_or(keep ? soup.scheme.value_or(natural) : natural);
  const auto faces = static_cast<std::int64_t>(polygons),
             corners = static_cast<std::int64_t>(soup.corners.size());
  const auto too_many = validate_counts(static_cast<std::int64_t>(soup.positions.size()), faces,
                                        keep ? corners : std::max(faces, 3 * (corners - 2 * faces)));
  if (!too_many.empty()) {
    result.faults.push_back({std::string(code(too_many[0].fault)), 0, too_many[0].message, -1});
    return result;
  }

  // Polygon by polygon.
  ControlMesh& mesh = result.mesh;
  mesh.positions = soup.positions;
  mesh.faces.reserve(polygons);
  std::vector<std::int64_t> polygon_of;  // each face
  polygon_of.reserve(polygons);
  std::vector<bool> of_a_bad_polygon(soup.positions.size(), false);
  std::vector<std::int64_t> last_polygon(soup.positions.size(), -1);
  std::vector<std::int32_t> face;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < polygons; begin = soup.polygon_end[i++]) {
    const auto number = static_cast<std::int64_t>(i);
    const Corners polygon(soup.corners.data() + begin, soup.polygon_end[i] - begin);
    if (auto [fault, message] = fault_of(polygon, number, soup.first, last_polygon); !message.empty()) {
      result.faults.push_back(
          {std::string(code(fault)), line_of(soup.polygon_lines, number), std::move(message), -1});
      for (const std::int64_t v : polygon)
        if (v >= 0 && v < static_cast<std::int64_t>(of_a_bad_polygon.size())) of_a_bad_polygon[v] = true;
      continue;
    }
    face.assign(polygon.begin(), polygon.end());
    mesh.faces.push_back(face);
    polygon_of.push_back(number);
  }
  result.notes = soup.notes;
  add_channels(soup, polygon_of, result);
  if (!keep) {
    Triangulated triangles = triangulate(mesh, options.polygons);
    mesh.faces = std::move(triangles.faces);
    mesh.channels = std::move(triangles.channels);
    for (std::int64_t& f : triangles.face) f = polygon_of[f];
    polygon_of = std::move(triangles.face);
    result.cut = triangles.cut;
  }

  mesh.sharpness = sharpness_of(soup);
  std::vector<std::int64_t> tag_lines;  // edges first, as findings number them
  for (const bool of_vertices : {false, true})
    for (const auto& tag : soup.sharp)
      if ((tag.b < 0) == of_vertices) tag_lines.push_back(tag.line);

  std::vector<bool> is_hole(polygons, false);
  for (const auto& hole : soup.holes) {
    if (hole.polygon >= 0 && hole.polygon < faces)
      is_hole[hole.polygon] = true;
    else
      result.faults.push_back(
          {std::string(code(MeshFault::kHole)), hole.line,
           fmt::format("the hole {} is no face (holes have numbers from 0)", hole.polygon), -1});
  }
  const std::vector<bool> hidden =
      soup.hides_boundary ? beside_boundary(mesh) : std::vector<bool>(mesh.faces.size());
  for (std::size_t f = 0; f < polygon_of.size(); ++f)
    if (is_hole[polygon_of[f]] || hidden[f]) mesh.holes.push_back(static_cast<std::int32_t>(f));
  if (const auto count = std::count(hidden.begin(), hidden.end(), true); count > 0)
    result.notes.push_back(
        fmt::format("{} of {} faces lie beside a boundary that is not interpolated: they are "
                    "holes, which shape the others and are not shown",
                    count, mesh.faces.size()));

  // All of them together.
  for (MeshFinding& finding : validate(mesh, result.scheme, {soup.first, polygon_of})) {
    const auto of_bad_polygons = [&] {
      return std::all_of(finding.elements.begin(), finding.elements.end(), [&](std::int64_t v) {
        return v >= 0 && static_cast<std::size_t>(v) < of_a_bad_polygon.size() && of_a_bad_polygon[v];
      });
    };
    const bool entailed =
        ((finding.fault == MeshFault::kBowtieVertex || finding.fault == MeshFault::kIsolatedVertex) &&
         of_a_bad_polygon[finding.vertex]) ||
        (finding.fault == MeshFault::kSharpness && of_bad_polygons());
    if (entailed || finding.fault == MeshFault::kEmpty) continue;
    result.faults.push_back({std::string(code(finding.fault)),
                             finding.tag >= 0    ? line_of(tag_lines, finding.tag)
                             : finding.face >= 0 ? line_of(soup.polygon_lines, polygon_of[finding.face])
                                                 : line_of(soup.position_lines, finding.vertex),
                             std::move(finding.message), finding.vertex});
  }
  return result;
}

Examination require_valid(const PolygonSoup& soup, const std::string& name, const ReadOptions& options) {
  Examination found = examine(soup, options);
  if (options.leave_out_unused) {
    const auto unused = std::stable_partition(found.faults.begin(), found.faults.end(),
                                              [](const SoupFault& f) { return !is_unused(f); });
    const std::vector<SoupFault> left_out(unused, found.faults.end());
    found.faults.erase(unused, found.faults.end());
    if (found.faults.empty() && !left_out.empty()) leave_out(found.mesh, left_out);
    found.left_out = static_cast<std::int64_t>(left_out.size());
  }
  if (found.faults.empty()) return found;
  const SoupFault& first = found.faults[0];
  const std::string more =
      found.faults.size() == 1 ? "" : fmt::format("; {} more faults", found.faults.size() - 1);
  const bool numbered = first.code != code(MeshFault::kEmpty) && first.code != code(MeshFault::kTooLarge);
  const std::string from = numbered ? fmt::format(" (numbers from {})", soup.first) : "";
  throw InputError(first.code, name, first.line, first.message + from + more);
}

}  // namespace limitcheck::data::io
