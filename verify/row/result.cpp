// SPDX-License-Identifier: MIT
#include "verify/row/result.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

namespace limitcheck::verify {
namespace {

struct PlaceWords {
  std::string_view word, where;
};
// In the order of PlaceKind.
constexpr PlaceWords kPlaces[] = {{"regular-face", "in regular faces"},
                                  {"boundary-face", "in boundary faces"},
                                  {"irregular-face", "in irregular faces"},
                                  {"sharp-face", "in faces at sharp edges or vertices"},
                                  {"sharp-edge", "on sharp edges"},
                                  {"regular-vertex", "at regular vertices"},
                                  {"extraordinary-vertex", "at extraordinary vertices"},
                                  {"polygon-vertex", "at vertices of faces that are no quads"},
                                  {"boundary-vertex", "at boundary vertices"},
                                  {"dart", "where sharp edges end"},
                                  {"crease", "at vertices between two sharp edges"},
                                  {"corner", "at sharp corners"}};

const PlaceWords& words_of(PlaceKind kind) {
  return kPlaces[static_cast<std::size_t>(kind)];
}

auto order(const PlaceCount& c) {
  return std::tuple(c.kind, c.faces);
}

// The numbers of faces of the vertices that are wrong: "of 4 or more faces" if all seen from there on are.
std::string faces_in_words(const std::vector<PlaceCount>& counts, PlaceKind kind) {
  std::vector<int> wrong, right;
  for (const PlaceCount& c : counts)
    if (c.kind == kind) (c.bad > 0 ? wrong : right).push_back(c.faces);
  if (wrong.empty() || wrong.back() <= 0 || (right.empty() && wrong.size() > 1)) return "";
  // From some number on all that were seen are wrong.
  const int last_right = right.empty() ? 0 : right.back();
  std::vector<std::string> numbers;
  for (const int n : wrong) {
    const bool open_end = n > last_right && n != wrong.back() && last_right > 0;
    numbers.push_back(fmt::format("{}{}", n, open_end ? " or more" : ""));
    if (open_end) break;
  }
  const std::string list = fmt::format("{}", fmt::join(numbers, ", "));
  return kind == PlaceKind::kBoundaryVertex
             ? fmt::format(" of {} face{}", list, numbers.size() == 1 && wrong[0] == 1 ? "" : "s")
             : fmt::format(" of valence {}", list);
}

}  // namespace

std::string_view word(Origin origin) {
  constexpr std::string_view kWords[] = {"subject", "limit", "host"};
  return kWords[static_cast<std::size_t>(origin)];
}

std::string_view word(Status status) {
  constexpr std::string_view kWords[] = {
      "held",          "finding", "quality-warning", "waived",  "unexpected-pass",
      "not-supported", "not-run", "crash",           "timeout", "error"};
  return kWords[static_cast<std::size_t>(status)];
}

Status verdict_of(const Result& row) {
  const bool beyond = row.worst && row.bound && !(*row.worst <= *row.bound);
  switch (row.status) {
    case Status::kHeld:
    case Status::kFinding:
      return beyond || row.bad != 0 ? Status::kFinding : Status::kHeld;
    case Status::kQualityWarning:  // of a file's rows `bad` counts what the warning is about
    case Status::kUnexpectedPass:
      return beyond ? Status::kFinding : row.status;
    case Status::kNotRun:
      if (beyond || row.bad != 0) return Status::kFinding;
      return row.of != 0 ? Status::kHeld : Status::kNotRun;
    default:
      return row.status;
  }
}

void say(Result& row, const std::string& sentence) {
  if (sentence.empty()) return;
  row.message += (row.message.empty() ? "" : "; ") + sentence;
}

std::string_view word(PlaceKind kind) {
  return words_of(kind).word;
}

void add(std::vector<PlaceCount>& to, const std::vector<PlaceCount>& counts) {
  for (const PlaceCount& c : counts) {
    auto at = std::lower_bound(to.begin(), to.end(), c,
                               [](const PlaceCount& a, const PlaceCount& b) { return order(a) < order(b); });
    if (at == to.end() || order(*at) != order(c)) at = to.insert(at, {c.kind, c.faces, 0, 0});
    at->bad += c.bad;
    at->of += c.of;
  }
}

bool is_everywhere(const std::vector<PlaceCount>& counts) {
  return std::ranges::any_of(
      counts, [](const PlaceCount& c) { return c.kind == PlaceKind::kRegularFace && c.bad > 0; });
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
    words.push_back(std::string(words_of(kind).where) + faces_in_words(counts, kind));
  }
  const std::string last = words.back();
  words.pop_back();
  const bool regular = std::ranges::any_of(counts, [](const PlaceCount& c) {
    return c.of > 0 && (c.kind == PlaceKind::kRegularFace || c.kind == PlaceKind::kRegularVertex);
  });
  return (words.empty() ? last : fmt::format("{} and {}", fmt::join(words, ", "), last)) +
         (regular ? "" : "; nothing regular was looked at");
}

}  // namespace limitcheck::verify
