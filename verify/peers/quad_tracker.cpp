// SPDX-License-Identifier: MIT
#include "verify/peers/quad_tracker.h"

#include <algorithm>
#include <string>
#include <unordered_map>
#include <utility>

#include "verify/subject/subject_error.h"

namespace limitcheck::verify {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFFu;

[[noreturn]] void broken(const char* what) {
  throw SubjectError(LC_FAILED, std::string("the refined mesh is not each face in quads: ") + what);
}

std::uint64_t directed(std::uint32_t from, std::uint32_t to) {
  return std::uint64_t{from} << 32 | to;
}

// The old vertices that each new vertex is joined to: the two ends of the edge it divides, or none.
std::vector<std::array<std::uint32_t, 2>> divided_edges(std::uint32_t old, std::int64_t vertices,
                                                        const std::vector<QuadTracker::Quad>& quads) {
  std::vector<std::array<std::uint32_t, 2>> ends(static_cast<std::size_t>(vertices), {kNone, kNone});
  const auto join = [&](std::uint32_t fresh, std::uint32_t end) {
    if (fresh < old || end >= old) return;
    auto& [a, b] = ends[fresh];
    if (a == end || b == end) return;
    if (a != kNone && b != kNone) broken("a new vertex with three old neighbours");
    (a == kNone ? a : b) = end;
  };
  for (const auto& q : quads)
    for (std::size_t k = 0; k < 4; ++k) {
      if (q[k] >= vertices) broken("a vertex that does not exist");
      join(q[k], q[(k + 1) % 4]);
      join(q[(k + 1) % 4], q[k]);
    }
  return ends;
}

}  // namespace

QuadTracker::QuadTracker(const lc_mesh& control) : vertex_count_(control.vertex_count) {
  const std::int32_t* corner = control.corners;
  for (std::int32_t f = 0; f < control.face_count; ++f) {
    const auto size = static_cast<std::size_t>(control.face_sizes[f]);
    Face face{f, 0, 1, {corner, corner + size}, std::vector<Steps>(size, Steps{0, 0})};
    if (size == 4) face.at = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    faces_.push_back(std::move(face));
    corner += size;
  }
}

void QuadTracker::step(std::int64_t vertex_count, const std::vector<Quad>& quads) {
  const auto old = static_cast<std::uint32_t>(vertex_count_);
  const auto ends = divided_edges(old, vertex_count, quads);
  std::size_t sides = 0;
  for (const Face& face : faces_) sides += face.corners.size();
  if (quads.size() != sides) broken("not one for each corner");

  // The face and corner that each directed edge leaves.
  std::unordered_map<std::uint64_t, std::pair<std::uint32_t, std::uint32_t>> leaves;
  leaves.reserve(sides);
  for (std::uint32_t f = 0; f < faces_.size(); ++f) {
    const auto& corners = faces_[f].corners;
    for (std::uint32_t k = 0; k < corners.size(); ++k)
      leaves[directed(corners[k], corners[(k + 1) % corners.size()])] = {f, k};
  }

  std::vector<Face> faces;
  faces.reserve(quads.size());
  for (Quad q : quads) {
    // From its old vertex on: the corner, the side that leaves it, the middle, the side that leads to it.
    const auto first = std::find_if(q.begin(), q.end(), [old](std::uint32_t v) { return v < old; });
    if (first == q.end()) broken("a quad without an old vertex");
    std::rotate(q.begin(), first, q.end());
    const auto across = [&](std::uint32_t fresh) {
      if (fresh < old) broken("a quad with two old vertices");
      const auto& [a, b] = ends[fresh];
      if (b == kNone || (a != q[0] && b != q[0])) broken("a new vertex without two old neighbours");
      return a == q[0] ? b : a;
    };
    if (q[2] < old || ends[q[2]][0] != kNone) broken("a middle with an old neighbour");
    const auto parent_place = leaves.find(directed(q[0], across(q[1])));
    if (parent_place == leaves.end()) broken("a quad without a parent");
    const std::size_t f = parent_place->second.first, k = parent_place->second.second;
    const Face& parent = faces_[f];
    const std::size_t size = parent.corners.size(), previous = (k + size - 1) % size, next = (k + 1) % size;
    if (parent.corners[previous] != across(q[3])) broken("a quad whose sides have no face in common");

    Face face{parent.control, parent.part, parent.denominator, {q.begin(), q.end()}, {}};
    if (size == 4) {
      const auto sum = [&](std::size_t c) {
        return Steps{parent.at[k][0] + parent.at[c][0], parent.at[k][1] + parent.at[c][1]};
      };
      face.denominator *= 2;
      face.at = {sum(k), sum(next), sum((k + 2) % 4), sum(previous)};
    } else {
      face.part = static_cast<std::int32_t>(k);
      face.at = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    }
    faces.push_back(std::move(face));
  }
  vertex_count_ = vertex_count;
  faces_ = std::move(faces);
}

std::vector<std::array<std::uint32_t, 3>> QuadTracker::triangles() const {
  std::vector<std::array<std::uint32_t, 3>> result;
  for (const Face& face : faces_)
    for (std::size_t k = 2; k < face.corners.size(); ++k)
      result.push_back({face.corners[0], face.corners[k - 1], face.corners[k]});
  return result;
}

std::vector<std::int32_t> QuadTracker::triangle_face() const {
  std::vector<std::int32_t> result;
  for (const Face& face : faces_) result.insert(result.end(), face.corners.size() - 2, face.control);
  return result;
}

std::vector<Place> QuadTracker::places() const {
  std::vector<Place> result(static_cast<std::size_t>(vertex_count_), {-1, 0, 0, 0});
  for (const Face& face : faces_)
    for (std::size_t k = 0; k < face.corners.size(); ++k) {
      Place& p = result[face.corners[k]];
      // A control face that is no quad has a part at each corner.
      const bool whole = face.corners.size() != 4;
      if (p.face < 0)
        p = {face.control, face.at[k][0], face.at[k][1], face.denominator,
             whole ? static_cast<std::int32_t>(k) : face.part};
    }
  return result;
}

}  // namespace limitcheck::verify
