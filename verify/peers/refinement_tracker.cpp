// SPDX-License-Identifier: MIT
#include "verify/peers/refinement_tracker.h"

#include <string>
#include <unordered_map>
#include <utility>

#include "verify/subject/subject_error.h"

namespace limitcheck::verify {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFFu;

[[noreturn]] void broken(const char* what) {
  throw SubjectError(LC_FAILED, std::string("the refined mesh is not each face split: ") + what);
}

std::uint64_t directed(std::uint32_t from, std::uint32_t to) {
  return std::uint64_t{from} << 32 | to;
}

}  // namespace

// What is known of one step: which edges the new vertices divide, and which face has which edge.
class RefinementTracker::Step {
 public:
  Step(const RefinementTracker& before, std::int64_t vertices)
      : faces_(before.faces_),
        old_(static_cast<std::uint32_t>(before.vertex_count_)),
        ends_(static_cast<std::size_t>(vertices), {kNone, kNone}) {
    for (std::size_t f = 0; f < faces_.size(); ++f)
      for (std::size_t k = 0, n = faces_[f].corners.size(); k < n; ++k)
        leaves_.emplace(directed(faces_[f].corners[k], faces_[f].corners[(k + 1) % n]), std::pair(f, k));
  }

  // The side from one corner of a new face to the next.
  void see(std::uint32_t a, std::uint32_t b) {
    if (a >= ends_.size()) broken("a vertex that does not exist");
    join(a, b), join(b, a);
  }
  bool is_old(std::uint32_t v) const { return v < old_; }
  bool divides_none(std::uint32_t v) const { return !is_old(v) && ends_[v][0] == kNone; }
  // The other end of the edge at `end` that a new vertex divides.
  std::uint32_t across(std::uint32_t fresh, std::uint32_t end) const {
    if (is_old(fresh)) broken("a face with two old vertices");
    const auto& [a, b] = ends_[fresh];
    if (b == kNone || (a != end && b != end)) broken("a new vertex without two old neighbours");
    return a == end ? b : a;
  }
  // The old vertex between the edges that two new vertices divide.
  std::uint32_t between(std::uint32_t m, std::uint32_t n) const {
    for (const std::uint32_t end : ends_[m])
      if (end != kNone && (end == ends_[n][0] || end == ends_[n][1])) return end;
    broken("two new vertices whose edges do not meet");
  }
  // The face that has corner `at` between `before` and `after`.
  Parent parent(std::uint32_t before, std::uint32_t at, std::uint32_t after) const {
    const auto [begin, end] = leaves_.equal_range(directed(at, after));
    for (auto found = begin; found != end; ++found) {
      const auto [f, k] = found->second;
      const std::size_t n = faces_[f].corners.size();
      if (faces_[f].corners[(k + n - 1) % n] == before) return {faces_[f], k};
    }
    broken("two edges that have no face in common");
  }

 private:
  void join(std::uint32_t fresh, std::uint32_t end) {
    if (is_old(fresh) || !is_old(end)) return;
    auto& [a, b] = ends_[fresh];
    if (a == end || b == end) return;
    if (a != kNone && b != kNone) broken("a new vertex with three old neighbours");
    (a == kNone ? a : b) = end;
  }

  const std::vector<Face>& faces_;
  std::uint32_t old_;
  std::vector<std::array<std::uint32_t, 2>> ends_;
  std::unordered_multimap<std::uint64_t, std::pair<std::size_t, std::size_t>> leaves_;  // face and corner
};

RefinementTracker::RefinementTracker(const lc_mesh& control)
    : quads_(control.scheme == LC_SCHEME_CATMULL_CLARK), vertex_count_(control.vertex_count) {
  const std::int32_t* corner = control.corners;
  for (std::int32_t f = 0; f < control.face_count; ++f) {
    const auto size = static_cast<std::size_t>(control.face_sizes[f]);
    Face face{f, 0, 1, {corner, corner + size}, std::vector<Steps>(size, Steps{0, 0})};
    if (!quads_)
      face.at = {{0, 0}, {1, 0}, {0, 1}};
    else if (size == 4)
      face.at = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    faces_.push_back(std::move(face));
    corner += size;
  }
}

template <std::size_t N>
void RefinementTracker::step(std::int64_t vertex_count,
                             const std::vector<std::array<std::uint32_t, N>>& faces) {
  Step step(*this, vertex_count);
  std::size_t expected = 0;
  for (const Face& face : faces_) expected += quads_ ? face.corners.size() : 4;
  if (faces.size() != expected) broken("another number of faces");
  for (const auto& face : faces)
    for (std::size_t k = 0; k < N; ++k) step.see(face[k], face[(k + 1) % N]);

  std::vector<Face> next;
  next.reserve(faces.size());
  for (std::array<std::uint32_t, N> corners : faces) {
    // From its old vertex on; a triangle in the middle of its parent has none.
    const auto first =
        std::find_if(corners.begin(), corners.end(), [&](std::uint32_t v) { return step.is_old(v); });
    const bool middle = first == corners.end();
    if (!middle) std::rotate(corners.begin(), first, corners.end());
    if (quads_ && (middle || !step.divides_none(corners[N - 2]))) broken("a middle with an old neighbour");
    const std::uint32_t at = middle ? step.between(corners[0], corners[1]) : corners[0];
    const Parent parent = middle
                              ? step.parent(step.across(corners[0], at), at, step.across(corners[1], at))
                              : step.parent(step.across(corners[N - 1], at), at, step.across(corners[1], at));
    const Face& of = parent.face;
    const std::size_t n = of.corners.size(), k = parent.corner;
    const auto sum = [&](std::size_t a, std::size_t b) {
      const Steps &p = of.at[a % n], &q = of.at[b % n];
      return Steps{p[0] + q[0], p[1] + q[1]};
    };
    Face face{of.control, of.part, 2 * of.denominator, {corners.begin(), corners.end()}, {}};
    if (!quads_ && middle)
      face.at = {sum(k + 2, k), sum(k, k + 1), sum(k + 1, k + 2)};
    else if (!quads_)
      face.at = {sum(k, k), sum(k, k + 1), sum(k, k + 2)};
    else if (n == 4)
      face.at = {sum(k, k), sum(k, k + 1), sum(k, k + 2), sum(k, k + 3)};
    else
      face = {of.control, static_cast<std::int32_t>(k), 1, face.corners, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    next.push_back(std::move(face));
  }
  vertex_count_ = vertex_count;
  faces_ = std::move(next);
}
template void RefinementTracker::step(std::int64_t, const std::vector<std::array<std::uint32_t, 3>>&);
template void RefinementTracker::step(std::int64_t, const std::vector<std::array<std::uint32_t, 4>>&);

std::vector<std::array<std::uint32_t, 3>> RefinementTracker::triangles() const {
  std::vector<std::array<std::uint32_t, 3>> result;
  for (const Face& face : faces_)
    for (std::size_t k = 2; k < face.corners.size(); ++k)
      result.push_back({face.corners[0], face.corners[k - 1], face.corners[k]});
  return result;
}

std::vector<std::int32_t> RefinementTracker::triangle_face() const {
  std::vector<std::int32_t> result;
  for (const Face& face : faces_) result.insert(result.end(), face.corners.size() - 2, face.control);
  return result;
}

std::vector<Place> RefinementTracker::places(Namer namer) const {
  std::vector<Place> result(static_cast<std::size_t>(vertex_count_), {-1, 0, 0, 0});
  for (const Face& face : faces_)
    for (std::size_t k = 0; k < face.corners.size(); ++k) {
      // A control face that is no quad has a part at each corner.
      const bool whole = quads_ && face.corners.size() != 4;
      if (Place& p = result[face.corners[k]]; p.face < 0 || namer == Namer::kLast)
        p = {face.control, face.at[k][0], face.at[k][1], face.denominator,
             whole ? static_cast<std::int32_t>(k) : face.part};
    }
  return result;
}

}  // namespace limitcheck::verify
