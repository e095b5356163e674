// SPDX-License-Identifier: MIT
#include "verify/audit/default_plan.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "data/generators/named_mesh.h"
#include "data/generators/star_meshes.h"
#include "data/sharpness_classes.h"
#include "data/splitmix64.h"
#include "verify/subject/lent_mesh.h"

namespace limitcheck::verify {
namespace {

constexpr double kCaseCost = 3000;  // of a case beside its points, in points
constexpr double kMostCost = 30000;
constexpr int kMeshes = 5, kStars = 30, kCandidates = 10, kPatience = 300;
constexpr double kRelationsCost = 10;   // of all requests of the relations, in requests that are judged
constexpr double kFarCost = 25000;      // of handing over a mesh of large indices
constexpr std::size_t kSampled = 3000;  // faces of a mesh of large indices
constexpr std::array<std::size_t, 2> kLongClasses{9, 10};  // "2 to 4" and "4"
constexpr std::size_t kWeakClass = 1;                      // "1/16 to 1"
constexpr int kNone = -1;

struct Ways {
  int depth;
  const char* kind;
};
constexpr std::array<Ways, 11> kWays{{{0, "uniform"},
                                      {1, "uniform"},
                                      {1, "uniform"},
                                      {2, "uniform"},
                                      {2, "uniform"},
                                      {3, "uniform"},
                                      {4, "uniform"},
                                      {2, "random"},
                                      {3, "random"},
                                      {4, "random"},
                                      {4, "visible"}}};

constexpr std::size_t kUniformWays = 7;

// What a neighbourhood is to have on each axis: the value's number, or kNone.
using Wish = std::array<int, kAxes>;

class Cover {
 public:
  Cover(data::Scheme scheme, std::vector<Looked>& known, std::uint64_t seed)
      : scheme_(scheme), known_(known), random_(seed) {}

  void run(std::int32_t ability, std::vector<PlannedCase>& cases) {
    ability_ = ability;
    Covered now = covered_by(known_, scheme_, ability);
    for (int failures = 0; failures < kPatience;) {
      std::optional<Try> best;
      missing_.clear();
      for (std::size_t k = 0; k < now.wanted.size(); ++k)
        if (now.wanted[k] && !now.looked[k]) missing_.push_back(k);
      if (missing_.empty()) break;
      for (int k = 0; k < kMeshes; ++k) {
        Try one = mesh();
        if (one.gain > 0 && (!best || one.worth() > best->worth())) best = std::move(one);
      }
      if (!best) {
        ++failures;
        continue;
      }
      failures = 0;
      add_cells(now.looked, best->looked.cells);
      known_.push_back(best->looked);
      best->planned.mesh = best->stars.text();
      cases.push_back(best->planned);
    }
  }

 private:
  struct Try {
    data::Stars stars;
    PlannedCase planned;
    Looked looked;
    double gain = 0, cost = 0;
    double worth() const { return gain / (kCaseCost + cost); }
  };

  std::uint64_t below(std::uint64_t n) { return random_.next() % n; }
  bool chance(double p) { return random_.unit() < p; }
  bool can(std::int32_t needs) const { return (needs & ~ability_) == 0; }

  void judge(Try& one) const {
    const bool loop = scheme_ == data::Scheme::kLoop;

    data::Stars stars = one.stars;
    stars.thrice = false;  // the filling is the same for all
    AuditMesh m{"", data::star_mesh(stars, loop)};
    m.relations = one.planned.relations;
    m.asked_scheme = scheme_;
    m.depth = one.planned.depth;
    m.depths = one.planned.depths;
    m.face_depth = face_depths(parse_depths(m.depths), m.mesh, m.depth);
    one.looked = one.stars.thrice ? look_thrice(m) : look_at(m);
    one.gain = one.cost = 0;
    for (const std::size_t k : missing_) one.gain += one.looked.cells[k] ? 1 : 0;
    for (std::size_t f = 0; f < m.mesh.faces.size(); ++f) {
      const int depth = m.face_depth.empty() ? m.depth : m.face_depth[f];
      const std::size_t corners = m.mesh.faces[f].size();
      if (depth >= 0)
        one.cost += std::ldexp(loop ? 0.5 : corners == 4 ? 1.0 : static_cast<double>(corners) / 4, 2 * depth);
    }
    one.cost += static_cast<double>(m.mesh.faces.size());
    if (one.stars.thrice) one.cost += kFarCost;
    if (one.planned.relations) one.cost = kRelationsCost * (one.cost + kCaseCost);
    if (one.planned.relations && size_for_relations(m.mesh) > kRelationFaces) one.gain = 0;
    if (!can(one.looked.needs)) one.gain = 0;
    // By Catmull-Clark's scheme and not by Loop's.
    if (!loop && m.mesh.faces.are_triangles()) one.gain = 0;
  }

  // What it looks at behind more vertices than 15 and 16 bits number.
  Looked look_thrice(const AuditMesh& m) const {
    Looked looked{sharp_kinds(m.mesh, scheme_) | kNeedsDepths, CellSet(cells(scheme_).size())};
    for (const auto& found : neighbourhoods(m))
      for (const std::size_t index : {0U, 2U, 3U}) {
        std::vector<std::uint16_t> far = found;
        for (std::uint16_t& f : far) {
          const auto [axis, k] = on_axis(f);
          if (axis == Axis::kIndex) f = static_cast<std::uint16_t>(f - k + std::max(k, index));
          if (axis == Axis::kComponents) f = static_cast<std::uint16_t>(f - k + 1);
        }
        add_cells(looked.cells, far, scheme_);
      }
    return looked;
  }

  static double most_cost(const Try& one) {
    return one.planned.relations ? kRelationsCost * kMostCost : kMostCost + (one.stars.thrice ? kFarCost : 0);
  }

  Try mesh() {
    Try best;
    best.stars.seed = below(1000);
    best.stars.chaikin = can(LC_SHARP_CHAIKIN) && chance(0.5);
    best.stars.corners_held = can(LC_SHARP_CORNERS) && chance(0.4);
    best.stars.smooth_triangles =
        scheme_ == data::Scheme::kCatmullClark && can(LC_SHARP_SMOOTH_TRIANGLES) && chance(0.4);
    const Ways& way = kWays[below(can(kNeedsDepths) ? kWays.size() : kUniformWays)];
    best.planned.depth = way.depth;
    best.planned.relations = way.depth == 2 && chance(0.4);
    best.stars.thrice = can(kNeedsDepths) && !best.planned.relations && way.depth == 1 && chance(0.5);
    if (way.kind != std::string("uniform"))
      best.planned.depths =
          fmt::format("random:{}{}", below(100), way.kind == std::string("visible") ? ":visible" : "");
    for (int k = 0; k < kStars; ++k) {
      std::optional<Try> next;
      for (int c = 0; c < kCandidates; ++c) {
        const auto star = star_for(missing_[below(missing_.size())], best);
        if (!star) continue;
        Try one = best;
        one.stars.stars.push_back(*star);
        judge(one);
        if (one.cost <= most_cost(one) && one.gain > best.gain &&
            (!next || (one.gain - best.gain) / (200 + one.cost - best.cost) >
                          (next->gain - best.gain) / (200 + next->cost - best.cost)))
          next = std::move(one);
      }
      if (!next) break;
      if (k > 0 && next->worth() < 0.7 * best.worth()) break;
      best = std::move(*next);
    }
    return best;
  }

  // A star that looks at a cell, in a mesh with these choices.
  std::optional<data::Star> star_for(std::size_t cell, const Try& in) {
    Wish wish;
    wish.fill(kNone);
    const Cell& wanted = cells(scheme_)[cell];
    for (const std::size_t f : {wanted.first, wanted.second}) {
      const auto [axis, k] = on_axis(f);
      wish[static_cast<std::size_t>(axis)] = static_cast<int>(k);
      if (axis == Axis::kFan) {
        set(wish, Axis::kSide, fan(k).boundary ? 1 : 0);
        set(wish, Axis::kFaces, static_cast<int>(fan(k).size_class));
      }
      if (axis != Axis::kVertex) continue;
      const VertexTags tags = vertex_tags(k);
      set(wish, Axis::kSide, tags.boundary ? 1 : 0), set(wish, Axis::kInfinite, tags.infinite);
      set(wish, Axis::kSemi, tags.semi), set(wish, Axis::kOwn, tags.own);
    }
    const auto want = [&](Axis a) { return wish[static_cast<std::size_t>(a)]; };
    const auto is_not = [&](Axis a, bool second) { return want(a) != kNone && want(a) != (second ? 1 : 0); };
    const bool uniform = in.planned.depths == "uniform";
    if ((want(Axis::kCreasing) != kNone && (want(Axis::kCreasing) > 0) != in.stars.chaikin) ||
        is_not(Axis::kBoundary, in.stars.corners_held) ||
        is_not(Axis::kTriangles, in.stars.smooth_triangles) || (want(Axis::kNeighbour) > 0 && uniform) ||
        (want(Axis::kAsked) == 0 && !in.planned.relations) || (want(Axis::kIndex) > 1 && !in.stars.thrice) ||
        (want(Axis::kDepth) != kNone &&
         (uniform ? want(Axis::kDepth) != in.planned.depth : want(Axis::kDepth) > in.planned.depth)))
      return std::nullopt;
    return star(wish);
  }
  static void set(Wish& wish, Axis a, int value) { wish[static_cast<std::size_t>(a)] = value; }

  std::optional<data::Star> star(const Wish& wish) {
    const auto want = [&](Axis a) { return wish[static_cast<std::size_t>(a)]; };
    const auto or_else = [&](Axis a, int value) { return want(a) != kNone ? want(a) : value; };
    constexpr int kInfiniteClass = data::kFirstInfiniteClass;
    data::Star star;
    const bool alone = want(Axis::kBoundary) != kNone;  // the vertex of one face
    const int size = alone && want(Axis::kFaces) == kNone ? 0 : want(Axis::kFaces);
    const int faces_wanted =
        size == kNone ? 0 : least_of(static_cast<std::size_t>(size)) + (size == 20 ? 28 : 0);
    star.open = want(Axis::kBoundary) != kNone || (faces_wanted > 0 && faces_wanted < 3) ||
                (want(Axis::kSide) != kNone ? want(Axis::kSide) == 1 : chance(0.25));
    const int sharpness = want(Axis::kSharpness);
    int infinite =
        or_else(Axis::kInfinite,
                can(LC_SHARP_CREASES) && chance(0.6) ? static_cast<int>(below(star.open ? 2 : 4)) : 0);
    int semi = or_else(Axis::kSemi,
                       can(LC_SHARP_SEMI) && chance(0.6) ? static_cast<int>(below(star.open ? 3 : 4)) : 0);
    if (sharpness >= kInfiniteClass) infinite = std::max(infinite, 1);
    if ((sharpness != kNone && sharpness < kInfiniteClass) ||
        (want(Axis::kCreasing) != kNone && want(Axis::kSemi) == kNone))
      semi = std::max(semi, want(Axis::kCreasing) < 2 ? 1 : sharpness == kNone ? 2 : 3);
    const bool between = want(Axis::kAround) == 4, weak = want(Axis::kAround) == 5;
    if (weak && want(Axis::kSemi) == kNone)
      semi = std::max(semi, sharpness != kNone || want(Axis::kCreasing) == 3 ? 3 : 2);
    if (between && want(Axis::kInfinite) == kNone) infinite = std::max(infinite, 2);
    if (want(Axis::kAround) >= 2 && infinite + semi == 0)
      (want(Axis::kSemi) == kNone && can(LC_SHARP_SEMI) ? semi : infinite) = 1;

    const int inner = faces_wanted - (star.open ? 1 : 0);
    if (faces_wanted > 0 && want(Axis::kInfinite) == kNone)
      infinite = std::min(infinite, std::max(0, inner - semi));
    if (faces_wanted > 0 && want(Axis::kSemi) == kNone && infinite + semi > inner)
      semi = std::max(0, inner - infinite);
    // Where there is room for more, semi-sharp edges of many kinds.
    if (faces_wanted > 8 && want(Axis::kSemi) == kNone && want(Axis::kCreasing) == kNone &&
        can(LC_SHARP_SEMI) && chance(0.3))
      semi = std::min(inner - infinite, 14);
    if (want(Axis::kSemi) == 3 && inner > infinite + 3)
      semi = 3 + static_cast<int>(
                     below(std::min<std::uint64_t>(12, static_cast<std::uint64_t>(inner - infinite - 2))));
    const int tags = infinite + semi, aside = want(Axis::kAround) == 1 || between ? 1 : 0;
    const int least = std::max(star.open ? 1 : 3, tags + aside + (star.open ? 1 : 0));
    const int faces = faces_wanted > 0 ? faces_wanted : least + static_cast<int>(below(4));
    if (faces < least) return std::nullopt;

    star.spokes.assign(static_cast<std::size_t>(faces + (star.open ? 1 : 0)), '.');
    std::vector<std::size_t> places;
    for (std::size_t i = star.open ? 1 : 0; i + (star.open ? 1 : 0) < star.spokes.size(); ++i)
      places.push_back(i);
    for (std::size_t k = places.size(); k > 1; --k) std::swap(places[k - 1], places[below(k)]);
    const std::size_t first = below(kInfiniteClass), finite = faces > 16 ? 11 : kInfiniteClass;
    for (int k = 0; k < tags; ++k) {
      std::size_t c =
          k < infinite ? kInfiniteClass + below(2) : (first + static_cast<std::size_t>(k)) % finite;
      if (weak && k == infinite + 1) c = kWeakClass;
      if (weak && k == infinite) c = kLongClasses[0];
      if (weak && k == infinite + 2) c = kLongClasses[1];
      if (want(Axis::kCreasing) == 3 && k >= infinite && k < infinite + 2)
        c = weak && k > infinite ? kWeakClass : kLongClasses[static_cast<std::size_t>(k - infinite)];
      if (sharpness >= kInfiniteClass && k == 0) c = static_cast<std::size_t>(sharpness);
      if (sharpness != kNone && sharpness < kInfiniteClass && k == tags - 1)
        c = static_cast<std::size_t>(sharpness);
      star.spokes[places[static_cast<std::size_t>(k)]] = data::kSharpnessClasses[c].letter;
    }
    const auto any = [&](bool may_be_finite, bool may_be_infinite) {
      const std::size_t from = may_be_finite ? 0 : kInfiniteClass;
      const std::size_t to = may_be_infinite ? data::kSharpnessClasses.size() : kInfiniteClass;
      return data::kSharpnessClasses[from + below(to - from)].letter;
    };
    const auto any_edge = [&] { return any(can(LC_SHARP_SEMI), can(LC_SHARP_CREASES)); };
    int own = or_else(Axis::kOwn, can(LC_SHARP_CORNERS) && chance(0.25)
                                      ? (can(LC_SHARP_SEMI) ? 1 + static_cast<int>(below(2)) : 2)
                                      : 0);
    if (aside > 0 && tags == 0 && own == 0) own = 2;
    if (want(Axis::kCreasing) != kNone && semi == 0) own = 1;
    if (own > 0) star.own = any(own == 1, own == 2);
    if (want(Axis::kOwnClass) != kNone)
      star.own = data::kSharpnessClasses[static_cast<std::size_t>(want(Axis::kOwnClass))].letter;
    if (between) star.across = any(false, true);
    if (tags > 0 && (want(Axis::kAround) == 2 || want(Axis::kAround) == 3 || weak || chance(0.35)))
      star.beyond = want(Axis::kAround) == 2 || (want(Axis::kAround) != 3 && chance(0.5))
                        ? star.spokes[places[below(static_cast<std::uint64_t>(tags))]]
                        : any_edge();
    if (weak) star.beyond = data::kSharpnessClasses[kLongClasses[1]].letter;
    if (aside > 0 && !between) star.aside = any_edge();
    star.bare = star.beyond == '.' && star.aside == '.' && star.across == '.' && (faces > 16 || chance(0.7));
    if (faces > 32) star.bare = true, star.beyond = star.aside = star.across = '.';
    if (scheme_ == data::Scheme::kCatmullClark) {
      if (const int c = want(Axis::kCorners); c != kNone) {
        star.corners.push_back(least_of(static_cast<std::size_t>(c) + 2));
        if (want(Axis::kTriangles) != kNone && faces > 1) star.corners.push_back(3);
      } else if (want(Axis::kTriangles) != kNone || chance(0.15)) {
        star.corners.push_back(want(Axis::kTriangles) != kNone ? 3 : 3 + static_cast<int>(below(6)));
      }
    }
    return star;
  }

  data::Scheme scheme_;
  std::vector<Looked>& known_;
  std::int32_t ability_ = 0;
  data::SplitMix64 random_;
  std::vector<std::size_t> missing_;
};

}  // namespace

AuditMesh made(const PlannedCase& planned) {
  AuditMesh m{planned.mesh, data::named_mesh(planned.mesh)};
  m.depth = planned.depth;
  m.face_depth = face_depths(parse_depths(planned.depths), m.mesh, planned.depth);
  m.depths = planned.depths;
  m.relations = planned.relations;
  m.asked_again = planned.asked_again;
  // Deep levels and large meshes cost most, and what turned corners show is seen on the others, too.
  m.turned = planned.depth < 4 && m.mesh.faces.size() <= 8192;
  if (m.mesh.positions.size() > 0x8000 && m.depth > 0)
    m.sample = std::make_shared<MeshSample>(m.mesh, kSampled, 1);
  return m;
}

Looked look_at(const AuditMesh& mesh) {
  const bool uniform = mesh.face_depth.empty() && !mesh.sample;
  return {sharp_kinds(mesh.mesh, mesh.scheme()) | (uniform ? 0 : kNeedsDepths), cells_of(mesh)};
}

const std::vector<std::int32_t>& steps_of_ability() {
  constexpr std::int32_t kHeld = LC_SHARP_CREASES | LC_SHARP_CORNERS, kUniform = kHeld | LC_SHARP_SEMI;
  constexpr std::int32_t kAll = kUniform | LC_SHARP_CHAIKIN | LC_SHARP_SMOOTH_TRIANGLES;
  static const std::vector<std::int32_t> all{
      0, LC_SHARP_CREASES, kHeld, kUniform, kAll, kNeedsDepths, kHeld | kNeedsDepths, kAll | kNeedsDepths};
  return all;
}

Covered covered_by(const std::vector<Looked>& known, data::Scheme scheme, std::int32_t ability) {
  Covered result{CellSet(cells(scheme).size()), CellSet(cells(scheme).size())};
  for (std::size_t k = 0; k < result.wanted.size(); ++k)
    result.wanted[k] = (cells(scheme)[k].needs() & ~(ability | kNeedsBoundary | kNeedsRelations)) == 0;
  for (const Looked& one : known)
    if ((one.needs & ~ability) == 0) add_cells(result.looked, one.cells);
  return result;
}

std::vector<PlannedCase> cover(data::Scheme scheme, std::vector<Looked>& known, std::uint64_t seed) {
  std::vector<PlannedCase> cases;
  Cover search(scheme, known, seed);
  for (const std::int32_t ability : steps_of_ability()) search.run(ability, cases);
  return cases;
}

}  // namespace limitcheck::verify
