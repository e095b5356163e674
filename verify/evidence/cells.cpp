// SPDX-License-Identifier: MIT
#include "verify/evidence/cells.h"

#include <fmt/core.h>

#include "data/sharpness_classes.h"

namespace limitcheck::verify {
namespace {

// Classes of numbers of faces and of corners: where tables of programs end.
constexpr std::array<int, kSizeClasses> kLeast{1,  2,  3,  4,  5,  6,  7,  8,  9,   10,  11,
                                               12, 13, 16, 17, 33, 34, 64, 65, 100, 101, 256};
constexpr int kBoundaryEdges = 2;
constexpr std::size_t kLeastInside = 2;  // size class: three faces
constexpr std::size_t kFarIndex = 2;     // from this class on meshes are large
constexpr std::array kOwn{"no sharpness of its own", "a finite sharpness of its own", "held"};

std::string words(std::size_t size_class, const char* noun) {
  const int least = kLeast[size_class];
  if (size_class + 1 == kLeast.size()) return fmt::format("{} {}s and more", least, noun);
  const int most = kLeast[size_class + 1] - 1;
  return least == most ? fmt::format("{} {}{}", least, noun, least == 1 ? "" : "s")
                       : fmt::format("{} to {} {}s", least, most, noun);
}
std::string count_in_words(int count, int most, const char* what) {
  return fmt::format("{}{} {} edge{}", count, count == most ? " and more" : "", what, count == 1 ? "" : "s");
}

// The values of the axis kVertex: those inside, then those on the boundary, where fewer edges are told apart.
constexpr int most_infinite(bool boundary) {
  return boundary ? kBoundaryEdges : kInfiniteEdges;
}
constexpr int most_semi(bool boundary) {
  return boundary ? kBoundaryEdges : kSemiEdges;
}
constexpr std::size_t kVerticesInside = 3 * (kInfiniteEdges + 1) * (kSemiEdges + 1);
// Those of the axis kFan: inside, from three faces on, then on the boundary.
constexpr std::size_t kFansInside = kSizeClasses - kLeastInside;
// All features; where those of each axis begin.
struct Table {
  std::vector<Feature> list;
  std::array<std::size_t, kAxes> begin{};

  void axis(Axis a) { begin[static_cast<std::size_t>(a)] = list.size(), axis_ = a; }
  void add(std::string name, std::int32_t needs = 0) { list.push_back({axis_, std::move(name), needs}); }
  std::size_t at(Axis a, std::size_t k) const { return begin[static_cast<std::size_t>(a)] + k; }

  Table() {
    axis(Axis::kSide);
    add("inside"), add("on the boundary", kNeedsBoundary);
    axis(Axis::kInfinite);
    for (int k = 0; k <= kInfiniteEdges; ++k)
      add(count_in_words(k, kInfiniteEdges, "infinite"), k > 0 ? LC_SHARP_CREASES : 0);
    axis(Axis::kSemi);
    for (int k = 0; k <= kSemiEdges; ++k)
      add(count_in_words(k, kSemiEdges, "semi-sharp"), k > 0 ? LC_SHARP_SEMI : 0);
    axis(Axis::kOwn);
    const std::array own_needs{0, LC_SHARP_CORNERS | LC_SHARP_SEMI, int{LC_SHARP_CORNERS}};
    for (std::size_t k = 0; k < 3; ++k) add(kOwn[k], own_needs[k]);
    axis(Axis::kFaces);
    for (std::size_t k = 0; k < kLeast.size(); ++k) add(words(k, "face"));
    axis(Axis::kSharpness);
    for (std::size_t k = 0; k < data::kSharpnessClasses.size(); ++k)
      add(fmt::format("an edge of sharpness {}", data::kSharpnessClasses[k].name), sharpness_needs(k));
    axis(Axis::kAround);
    add("beside an irregular vertex");
    add("a smooth edge to another sharp vertex", LC_SHARP_CREASES);
    add("a sharp edge that goes on alike", LC_SHARP_CREASES);
    add("a sharp edge that goes on with another sharpness", LC_SHARP_CREASES | LC_SHARP_SEMI);
    add("a smooth edge between two creases", LC_SHARP_CREASES);
    add("an edge below 1 between semi-sharp ones above 2", LC_SHARP_SEMI);
    axis(Axis::kCreasing);
    add("uniform creasing", LC_SHARP_SEMI);
    for (const char* of : {"", " of unequal edges", " of unequal edges sharp for more than 2 steps"})
      add(fmt::format("Chaikin's creasing{}", of), LC_SHARP_SEMI | LC_SHARP_CHAIKIN);
    axis(Axis::kBoundary);
    add("one face by a boundary of edges", kNeedsBoundary),
        add("one face by a boundary of edges and corners", kNeedsBoundary | LC_SHARP_CORNERS);
    axis(Axis::kTriangles);
    add("a triangle by the ordinary rule", kNeedsOtherFaces);
    add("a triangle by the smooth rule", kNeedsOtherFaces | LC_SHARP_SMOOTH_TRIANGLES);
    axis(Axis::kCorners);
    for (std::size_t k = 2; k < kLeast.size(); ++k)
      add("a face of " + words(k, "corner"), k == size_class_of(4) ? 0 : kNeedsOtherFaces);
    axis(Axis::kDepth);
    for (int k = 0; k < kDepthClasses; ++k)
      add(fmt::format("depth {}{}", k, k + 1 == kDepthClasses ? " and more" : ""));
    axis(Axis::kNeighbour);
    add("faces of one depth");
    for (const char* by : {"1", "2", "3 and more"})
      add(fmt::format("depths that differ by {}", by), kNeedsDepths);
    add("some faces culled", kNeedsDepths);
    axis(Axis::kOwnClass);
    for (std::size_t k = 0; k < data::kSharpnessClasses.size(); ++k)
      add(fmt::format("of sharpness {}", data::kSharpnessClasses[k].name),
          LC_SHARP_CORNERS | sharpness_needs(k));
    axis(Axis::kVertex);
    for (const bool boundary : {false, true})
      for (int i = 0; i <= most_infinite(boundary); ++i)
        for (int s = 0; s <= most_semi(boundary); ++s)
          for (std::size_t own = 0; own < 3; ++own)
            add(fmt::format("{} with {}, {}, {}", boundary ? "on the boundary" : "inside",
                            count_in_words(i, most_infinite(boundary), "infinite"),
                            count_in_words(s, most_semi(boundary), "semi-sharp"), kOwn[own]),
                (boundary ? kNeedsBoundary : 0) | (i > 0 ? LC_SHARP_CREASES : 0) |
                    (s > 0 ? LC_SHARP_SEMI : 0) | own_needs[own]);
    axis(Axis::kFan);
    for (std::size_t k = kLeastInside; k < kLeast.size(); ++k) add(words(k, "face") + " inside");
    for (std::size_t k = 0; k < kLeast.size(); ++k)
      add(words(k, "face") + " on the boundary", kNeedsBoundary);
    axis(Axis::kIndex);
    for (const std::int64_t most : kIndexes)  // large ones are looked at in a part of a mesh
      add(fmt::format("an index up to {}", most), most >= kIndexes[kFarIndex] ? kNeedsDepths : 0);
    axis(Axis::kTags);
    add("a mesh without tags");
    for (const char* many : {"1 to 12", "13 to 100", "101 to 255", "more than 255"})
      add(fmt::format("a mesh of {} tags", many), LC_SHARP_CREASES);
    axis(Axis::kComponents);
    add("a mesh of one component"), add("a mesh of several components");
    axis(Axis::kGenus);
    for (const char* genus : {"0", "1", "2", "3 and more"}) add(fmt::format("a mesh of genus {}", genus));
    axis(Axis::kAsked);
    add("asked for the relations, too", kNeedsRelations);
  }

 private:
  static std::int32_t sharpness_needs(std::size_t k) {
    return k < data::kFirstInfiniteClass ? LC_SHARP_SEMI : LC_SHARP_CREASES;
  }
  Axis axis_{};
};

const Table& table() {
  static const Table all;
  return all;
}

// What two features, of different axes, have to do with each other.
bool go_together(const Feature& a, std::size_t i, const Feature& b, std::size_t j) {
  // How many faces of so many corners, and at which depth, an audit without meshes takes on.
  const auto deepest = [](std::size_t size_class) {
    const int least = kLeast[size_class];
    return least <= 4 ? 4U : least <= 8 ? 3U : least <= 16 ? 2U : 1U;
  };
  const auto is = [&](Axis x, Axis y) { return a.axis == x && b.axis == y; };
  const int faces = a.axis == Axis::kFaces ? kLeast[i] : 0;
  if (b.axis == Axis::kVertex)
    return a.axis == Axis::kCreasing && vertex_tags(j).semi >= (i < kUnequal ? 1 : 2);
  // The depth is that of masks and of steps, which inside and on the boundary are of different code.
  if (b.axis == Axis::kFan) return a.axis == Axis::kDepth && i <= deepest(fan(j).size_class);
  // What a tessellator may keep by, and what its numbers of vertices may be too small for: large meshes take long.
  if (b.axis == Axis::kAsked || (b.axis == Axis::kIndex && j >= kFarIndex)) {
    if (a.axis == Axis::kFaces) return faces <= 8;
    if (a.axis == Axis::kCorners) return kLeast[i + 2] <= 8;
    if (b.axis == Axis::kIndex && a.axis == Axis::kSharpness) return true;
    return a.axis < Axis::kDepth && a.axis != Axis::kSharpness && a.axis != Axis::kAround;
  }
  // Of the whole mesh, or of what lies farther away.
  if (b.axis > Axis::kVertex || a.axis >= Axis::kOwnClass) return false;
  if (a.axis == Axis::kAround ? i == 0 : b.axis == Axis::kAround && j == 0) return false;
  if (b.axis == Axis::kOwnClass)
    return is(Axis::kBoundary, b.axis) || (is(Axis::kCreasing, b.axis) && j < data::kFirstInfiniteClass);
  // A boundary vertex of one face has no edges inside.
  if (b.axis == Axis::kBoundary) {
    if (a.axis == Axis::kInfinite || a.axis == Axis::kSemi) return i == 0;
    if (a.axis == Axis::kSharpness || a.axis == Axis::kAround) return false;
    if (a.axis == Axis::kCreasing) return i < kUnequal;
    if (a.axis == Axis::kFaces) return kLeast[i] == 1;
  }
  if (is(Axis::kBoundary, Axis::kNeighbour)) return j == 0;
  if (is(Axis::kSide, Axis::kFaces)) return false;  // kFan
  if (is(Axis::kSide, Axis::kBoundary)) return i == 1;
  // More edges than there are.
  if (is(Axis::kInfinite, Axis::kFaces) || is(Axis::kSemi, Axis::kFaces))
    return kLeast[j] >= static_cast<int>(i) + (kLeast[j] <= 2 ? 1 : 0);
  if (is(Axis::kInfinite, Axis::kSharpness)) return i > 0 || j < data::kFirstInfiniteClass;
  if (is(Axis::kInfinite, Axis::kAround)) return i >= 2 || j != kBetweenCreases;
  if (is(Axis::kSemi, Axis::kAround)) return i >= 2 || j != kWeakBetweenStrong;
  if (is(Axis::kSemi, Axis::kSharpness)) return i > 0 || j >= data::kFirstInfiniteClass;
  if (is(Axis::kSemi, Axis::kCreasing)) return i >= (j < kUnequal ? 1U : 2U);
  if (a.axis == Axis::kFaces) {
    // Many edges that stay sharp for many steps take a tessellator many seconds.
    if (b.axis == Axis::kSharpness) return faces > 1 && (faces <= 16 || !data::is_long_lasting(j));
    if (b.axis == Axis::kAround) return faces > (j >= kBetweenCreases ? 2 : 1) && faces <= 16;
    if (b.axis == Axis::kCreasing) return faces > (j < kUnequal ? 1 : 2);
    if (b.axis == Axis::kCorners) return faces <= 12 || j <= 6;
    if (b.axis == Axis::kDepth) return false;  // kFan
    if (b.axis == Axis::kNeighbour) return faces > (j == 0 ? 0 : 1) && faces <= 16;
    return true;
  }
  if (is(Axis::kCorners, Axis::kDepth)) return j <= deepest(i + 2);
  if (is(Axis::kCorners, Axis::kNeighbour)) return kLeast[i + 2] <= 16;
  if (is(Axis::kDepth, Axis::kNeighbour)) return i <= 4;
  if (b.axis == Axis::kDepth) return j <= 3;
  return true;
}

struct Universe {
  std::vector<Cell> list;
  std::vector<std::int32_t> number;  // of the pair (a, b), -1 where it is no cell

  explicit Universe(data::Scheme scheme) {
    const std::vector<Feature>& all = features();
    number.assign(all.size() * all.size(), -1);
    const auto of_scheme = [&](std::size_t f) {
      const Axis a = all[f].axis;
      return scheme == data::Scheme::kCatmullClark || (a != Axis::kCorners && a != Axis::kTriangles);
    };
    const auto within = [](std::size_t f) { return on_axis(f).second; };
    for (std::size_t a = 0; a < all.size(); ++a)
      for (std::size_t b = a; b < all.size(); ++b)
        if (of_scheme(a) && of_scheme(b) &&
            (a == b || (all[a].axis != all[b].axis && go_together(all[a], within(a), all[b], within(b))))) {
          number[a * all.size() + b] = static_cast<std::int32_t>(list.size());
          list.push_back({a, b});
        }
  }
};

const Universe& universe(data::Scheme scheme) {
  static const Universe loop(data::Scheme::kLoop), quads(data::Scheme::kCatmullClark);
  return scheme == data::Scheme::kLoop ? loop : quads;
}

}  // namespace

const std::vector<Feature>& features() {
  return table().list;
}

std::string Cell::name() const {
  return first == second ? features()[first].name : features()[first].name + ", " + features()[second].name;
}

std::size_t feature_on(Axis axis, std::size_t k) {
  return table().at(axis, k);
}

Fan fan(std::size_t number) {
  return number < kFansInside ? Fan{false, number + kLeastInside} : Fan{true, number - kFansInside};
}

std::optional<std::size_t> Fan::feature() const {
  if (boundary) return feature_on(Axis::kFan, kFansInside + size_class);
  return size_class < kLeastInside ? std::nullopt
                                   : std::optional(feature_on(Axis::kFan, size_class - kLeastInside));
}

VertexTags vertex_tags(std::size_t number) {
  const bool boundary = number >= kVerticesInside;
  const int k = static_cast<int>(boundary ? number - kVerticesInside : number),
            semi = most_semi(boundary) + 1;
  return {boundary, k / 3 / semi, k / 3 % semi, k % 3};
}

std::size_t VertexTags::feature() const {
  const int edges = std::min(infinite, most_infinite(boundary)) * (most_semi(boundary) + 1) +
                    std::min(semi, most_semi(boundary));
  return feature_on(Axis::kVertex,
                    (boundary ? kVerticesInside : 0) + static_cast<std::size_t>(edges * 3 + own));
}

std::pair<Axis, std::size_t> on_axis(std::size_t feature) {
  const Axis a = features()[feature].axis;
  return {a, feature - table().at(a, 0)};
}

int least_of(std::size_t size_class) {
  return kLeast[size_class];
}

std::size_t size_class_of(std::int64_t count) {
  return static_cast<std::size_t>(std::upper_bound(kLeast.begin(), kLeast.end(), count) - kLeast.begin() - 1);
}

std::int32_t Cell::needs() const {
  const std::int32_t both = features()[first].needs | features()[second].needs;
  const auto [a, i] = on_axis(first);
  const auto [b, j] = on_axis(second);
  if (b != Axis::kAround || j == 0 || j >= 3) return both;
  // Sharp without an infinite edge; or with none at all.
  if (a == Axis::kInfinite && i == 0) return both | LC_SHARP_SEMI;
  return a == Axis::kFaces && kLeast[i] == 2 && j == 1 ? both | LC_SHARP_CORNERS : both;
}

const std::vector<Cell>& cells(data::Scheme scheme) {
  return universe(scheme).list;
}

void add_cells(CellSet& to, const std::vector<std::uint16_t>& found, data::Scheme scheme) {
  const Universe& all = universe(scheme);
  for (std::size_t i = 0; i < found.size(); ++i)
    for (std::size_t j = i; j < found.size(); ++j)
      if (const std::int32_t k = all.number[found[i] * features().size() + found[j]]; k >= 0)
        to[static_cast<std::size_t>(k)] = true;
}

void add_cells(CellSet& to, const CellSet& from) {
  for (std::size_t k = 0; k < to.size(); ++k) to[k] = to[k] || from[k];
}

CellSet cells_of(const AuditMesh& mesh) {
  CellSet set(cells(mesh.scheme()).size());
  for (const auto& found : neighbourhoods(mesh)) add_cells(set, found, mesh.scheme());
  return set;
}

std::string text_of(const CellSet& set) {
  std::string text((set.size() + 3) / 4, '0');
  for (std::size_t k = 0; k < set.size(); ++k) {
    char& c = text[k / 4];
    const int value = (c <= '9' ? c - '0' : c - 'a' + 10) | (set[k] ? 1 << k % 4 : 0);
    c = "0123456789abcdef"[value];
  }
  return text;
}

CellSet cell_set(const std::string& text, data::Scheme scheme) {
  CellSet set(cells(scheme).size());
  for (std::size_t k = 0; k < set.size() && k / 4 < text.size(); ++k) {
    const char c = text[k / 4];
    set[k] = ((c <= '9' ? c - '0' : c - 'a' + 10) >> k % 4 & 1) != 0;
  }
  return set;
}

}  // namespace limitcheck::verify
