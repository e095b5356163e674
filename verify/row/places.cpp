// SPDX-License-Identifier: MIT
#include "verify/row/places.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <tuple>

namespace limitcheck::verify {
namespace {

auto order(const PlaceCount& c) {
  return std::tuple(c.kind, c.faces);
}

std::string_view plural(PlaceKind kind) {
  switch (kind) {
    case PlaceKind::kRegularFace:
      return "in regular faces";
    case PlaceKind::kBoundaryFace:
      return "in boundary faces";
    case PlaceKind::kIrregularFace:
      return "in irregular faces";
    case PlaceKind::kSharpFace:
      return "in faces at sharp edges or vertices";
    case PlaceKind::kSharpEdge:
      return "on sharp edges";
    case PlaceKind::kRegularVertex:
      return "at regular vertices";
    case PlaceKind::kExtraordinaryVertex:
      return "at extraordinary vertices";
    case PlaceKind::kPolygonVertex:
      return "at vertices of faces that are no quads";
    case PlaceKind::kBoundaryVertex:
      return "at boundary vertices";
    case PlaceKind::kDart:
      return "where sharp edges end";
    case PlaceKind::kCrease:
      return "at vertices between two sharp edges";
    case PlaceKind::kCorner:
      return "at sharp corners";
  }
  return "";
}

// The numbers of faces of the vertices that are wrong: "of 4 or more faces" if all seen from there on are.
std::string faces_in_words(const std::vector<PlaceCount>& counts, PlaceKind kind) {
  std::vector<int> wrong, right;
  for (const PlaceCount& c : counts)
    if (c.kind == kind) (c.bad > 0 ? wrong : right).push_back(c.faces);
  if (wrong.empty() || wrong.back() == 0) return "";
  const char* noun = kind == PlaceKind::kBoundaryVertex ? "face" : "valence";
  const auto say = [&](const std::string& numbers, bool one) {
    return kind == PlaceKind::kBoundaryVertex ? fmt::format(" of {} {}{}", numbers, noun, one ? "" : "s")
                                              : fmt::format(" of valence {}", numbers);
  };
  if (right.empty() && wrong.size() > 1) return "";
  // From some number on all that were seen are wrong.
  const int last_right = right.empty() ? 0 : right.back();
  std::vector<std::string> numbers;
  for (const int n : wrong) {
    const bool open_end = n > last_right && n != wrong.back() && last_right > 0;
    numbers.push_back(fmt::format("{}{}", n, open_end ? " or more" : ""));
    if (open_end) break;
  }
  return say(fmt::format("{}", fmt::join(numbers, ", ")), numbers.size() == 1 && wrong[0] == 1);
}

}  // namespace

std::string_view word(PlaceKind kind) {
  switch (kind) {
    case PlaceKind::kRegularFace:
      return "regular-face";
    case PlaceKind::kBoundaryFace:
      return "boundary-face";
    case PlaceKind::kIrregularFace:
      return "irregular-face";
    case PlaceKind::kSharpFace:
      return "sharp-face";
    case PlaceKind::kSharpEdge:
      return "sharp-edge";
    case PlaceKind::kRegularVertex:
      return "regular-vertex";
    case PlaceKind::kExtraordinaryVertex:
      return "extraordinary-vertex";
    case PlaceKind::kPolygonVertex:
      return "polygon-vertex";
    case PlaceKind::kBoundaryVertex:
      return "boundary-vertex";
    case PlaceKind::kDart:
      return "dart";
    case PlaceKind::kCrease:
      return "crease";
    case PlaceKind::kCorner:
      return "corner";
  }
  return "";
}

void add(std::vector<PlaceCount>& to, const std::vector<PlaceCount>& counts) {
  for (const PlaceCount& c : counts) {
    auto at = std::lower_bound(to.begin(), to.end(), c,
                               [](const PlaceCount& a, const PlaceCount& b) { return order(a) < order(b); });
    if (at == to.end() || order(*at) != order(c)) at = to.insert(at, PlaceCount{c.kind, c.faces, 0, 0});
    at->bad += c.bad;
    at->of += c.of;
  }
}

bool is_everywhere(const std::vector<PlaceCount>& counts) {
  return std::any_of(counts.begin(), counts.end(),
                     [](const PlaceCount& c) { return c.kind == PlaceKind::kRegularFace && c.bad > 0; });
}

std::string where_wrong(const std::vector<PlaceCount>& counts) {
  if (is_everywhere(counts)) return "everywhere, in regular faces, too";
  std::vector<PlaceKind> kinds;
  for (const PlaceCount& c : counts)
    if (c.bad > 0 && (kinds.empty() || kinds.back() != c.kind)) kinds.push_back(c.kind);
  if (kinds.empty()) return "";
  const bool in_faces = !is_vertex(kinds.front());
  std::vector<std::string> words;
  for (const PlaceKind kind : kinds) {
    // What is wrong inside the faces round a vertex is expected at the vertex.
    if (in_faces && is_vertex(kind) && kind != PlaceKind::kRegularVertex) continue;
    words.push_back(std::string(plural(kind)) + faces_in_words(counts, kind));
  }
  const std::string last = words.back();
  words.pop_back();
  const bool regular = std::any_of(counts.begin(), counts.end(), [](const PlaceCount& c) {
    return c.of > 0 && (c.kind == PlaceKind::kRegularFace || c.kind == PlaceKind::kRegularVertex);
  });
  return (words.empty() ? last : fmt::format("{} and {}", fmt::join(words, ", "), last)) +
         (regular ? "" : "; nothing regular was looked at");
}

}  // namespace limitcheck::verify
