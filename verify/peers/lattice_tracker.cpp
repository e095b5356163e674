// SPDX-License-Identifier: MIT
#include "verify/peers/lattice_tracker.h"

#include <algorithm>
#include <utility>

#include "verify/subject/subject_error.h"

namespace limitcheck::verify {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFFu;

[[noreturn]] void broken(const char* what) {
  throw SubjectError(LC_FAILED, std::string("the refined mesh is not each triangle in four: ") + what);
}

// The triangles at each vertex, one after the other.
struct Incidence {
  Incidence(std::int64_t vertices, const std::vector<std::array<std::uint32_t, 3>>& triangles)
      : begin(static_cast<std::size_t>(vertices) + 1), items(3 * triangles.size()) {
    for (const auto& t : triangles) {
      for (const auto v : t) ++begin[v + 1];
    }
    for (std::size_t v = 1; v < begin.size(); ++v) begin[v] += begin[v - 1];
    auto next = begin;
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      for (const auto v : triangles[t]) items[next[v]++] = static_cast<std::uint32_t>(t);
    }
  }
  std::vector<std::size_t> begin;
  std::vector<std::uint32_t> items;
};

}  // namespace

LatticeTracker::LatticeTracker(const lc_mesh& control) : vertex_count_(control.vertex_count) {
  for (std::int32_t f = 0; f < control.triangle_count; ++f) {
    const std::int32_t* t = control.triangles + 3 * f;
    triangles_.push_back({static_cast<std::uint32_t>(t[0]), static_cast<std::uint32_t>(t[1]),
                          static_cast<std::uint32_t>(t[2])});
    face_.push_back(f);
    places_.push_back({Place{0, 0}, Place{1, 0}, Place{0, 1}});
  }
}

void LatticeTracker::step(std::int64_t vertex_count, std::vector<std::array<std::uint32_t, 3>> triangles) {
  if (triangles.size() != 4 * triangles_.size()) broken("not four times as many");
  const auto old = static_cast<std::uint32_t>(vertex_count_);
  for (const auto& t : triangles) {
    for (const auto v : t) {
      if (v >= vertex_count) broken("a vertex that does not exist");
    }
  }

  // The two old vertices whose edge each vertex divides; an old vertex is both of them.
  std::vector<std::array<std::uint32_t, 2>> ends(vertex_count, {kNone, kNone});
  for (std::uint32_t v = 0; v < old; ++v) ends[v] = {v, v};
  for (const auto& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      for (const auto& [m, v] : {std::pair{t[k], t[(k + 1) % 3]}, {t[(k + 1) % 3], t[k]}}) {
        if (m < old || v >= old) continue;
        auto& [a, b] = ends[m];
        if (a == v || b == v) continue;
        if (a != kNone && b != kNone) broken("a new vertex with three old neighbours");
        (a == kNone ? a : b) = v;
      }
    }
  }

  const Incidence incidence(vertex_count_, triangles_);
  std::vector<std::int32_t> faces(triangles.size());
  std::vector<std::array<Place, 3>> places(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    // The corners of the parent.
    std::array<std::uint32_t, 3> corners{kNone, kNone, kNone};
    for (const auto v : triangles[t]) {
      for (const auto end : ends[v]) {
        if (end == kNone) broken("a new vertex without two old neighbours");
        auto* const found = std::find_if(corners.begin(), corners.end(),
                                         [end](std::uint32_t c) { return c == end || c == kNone; });
        if (found == corners.end()) broken("a triangle that spans more than one");
        *found = end;
      }
    }
    if (corners[2] == kNone) broken("a triangle along an edge");

    const auto* const first = incidence.items.data() + incidence.begin[corners[0]];
    const auto* const last = incidence.items.data() + incidence.begin[corners[0] + 1];
    const auto* const parent = std::find_if(first, last, [&](std::uint32_t candidate) {
      return std::is_permutation(corners.begin(), corners.end(), triangles_[candidate].begin());
    });
    if (parent == last) broken("a triangle without a parent");

    faces[t] = face_[*parent];
    for (std::size_t k = 0; k < 3; ++k) {
      Place sum{0, 0};
      for (const auto end : ends[triangles[t][k]]) {
        const auto corner = std::find(triangles_[*parent].begin(), triangles_[*parent].end(), end);
        const Place& at = places_[*parent][corner - triangles_[*parent].begin()];
        sum = {sum[0] + at[0], sum[1] + at[1]};
      }
      places[t][k] = sum;
    }
  }
  vertex_count_ = vertex_count;
  denominator_ *= 2;
  triangles_ = std::move(triangles);
  face_ = std::move(faces);
  places_ = std::move(places);
}

std::vector<lc_provenance> LatticeTracker::provenance() const {
  std::vector<lc_provenance> result(vertex_count_, {-1, 0, 0, 0});
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      auto& p = result[triangles_[t][k]];
      if (p.face < 0) p = {face_[t], places_[t][k][0], places_[t][k][1], denominator_};
    }
  }
  return result;
}

}  // namespace limitcheck::verify
