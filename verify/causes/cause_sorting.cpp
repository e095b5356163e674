// SPDX-License-Identifier: MIT
// Puts the red rows of a report to causes.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <map>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

#include "verify/causes/causes.h"

namespace limitcheck::verify {
namespace {

// Where on a control mesh a surface is wrong, as far as it tells causes apart.
enum class Region : std::uint8_t {
  kNone,
  kIrregular,      // in faces at extraordinary vertices or at the boundary
  kSharp,          // at sharp edges and vertices
  kDart,           // at the ends of sharp edges only
  kBoundary,       // at boundary vertices only
  kExtraordinary,  // at extraordinary vertices, and those of faces that are no quads, only
  kEverywhere      // in regular places, too
};

Region region_of(PlaceKind kind) {
  using enum Region;  // in the order of PlaceKind
  constexpr Region kOf[] = {kEverywhere,    kIrregular,     kIrregular, kSharp, kSharp, kEverywhere,
                            kExtraordinary, kExtraordinary, kBoundary,  kDart,  kSharp, kSharp};
  return kOf[static_cast<std::size_t>(kind)];
}

// What is wrong in `whole` is wrong in `part` for the same reason: in the faces round a vertex and at it, along a
// sharp edge and at its end.
bool implies(Region whole, Region part) {
  return whole == Region::kIrregular ? part == Region::kBoundary || part == Region::kExtraordinary
                                     : whole == Region::kSharp && part == Region::kDart;
}

// The regions where a row of positions or normals has something wrong; at least one. A mesh without regular
// places does not tell what is wrong everywhere from what is wrong at its most ordinary places: then
// kEverywhere is among them.
std::set<Region> regions(const Result& row) {
  std::set<Region> found;
  for (const PlaceCount& c : row.places)
    if (c.bad > 0) found.insert(region_of(c.kind));
  if (found.empty() || found.contains(Region::kEverywhere)) return {Region::kEverywhere};
  const auto looked_at = std::ranges::find_if(row.places, [](const PlaceCount& c) { return c.of > 0; });
  const bool perhaps = looked_at != row.places.end() && found.contains(region_of(looked_at->kind));
  for (const Region whole : {Region::kIrregular, Region::kSharp})
    if (found.contains(whole)) std::erase_if(found, [&](Region part) { return implies(whole, part); });
  if (perhaps) found.insert(Region::kEverywhere);
  return found;
}

// The counts that belong to a region, and those of regular places.
std::vector<PlaceCount> counts_in(std::vector<PlaceCount> counts, Region region) {
  std::erase_if(counts, [&](const PlaceCount& c) {
    const Region own = region_of(c.kind);
    return region != Region::kEverywhere && own != region && own != Region::kEverywhere &&
           !implies(region, own);
  });
  return counts;
}

struct Key {
  std::string who;
  CauseKind kind = CauseKind::kOther;
  Region region = Region::kNone;
  std::string more;  // kOther, kBreakdown, kRefuses: what tells causes of this kind apart
  auto operator<=>(const Key&) const = default;
};

bool is_one_of(const std::string& check, std::initializer_list<std::string_view> names) {
  return std::ranges::find(names, check) != names.end();
}

// Points that are wrong say nothing of the values of channels.
bool is_of_channels(const std::string& check) {
  const RowKind* row = row_kind(check);
  return row != nullptr && row->group == "channels";
}

CauseKind kind_of(const std::string& check) {
  const RowKind* row = row_kind(check);
  return row != nullptr ? row->cause : CauseKind::kOrder;
}

// The label without options.
std::string base_name(const std::string& label) {
  if (label.starts_with("program:") || label.starts_with("shader:") || label.find('/') != std::string::npos)
    return label;
  return label.substr(0, label.find(':'));
}

// "OpenSubdiv" of "OpenSubdiv 3.5 Far: ..."; otherwise the subject's name.
std::string library(const Report& report, const std::string& label) {
  const auto found = report.descriptions.find(label);
  if (found == report.descriptions.end()) return base_name(label);
  const std::string& text = found->second;
  const std::size_t end = text.find(' ');
  const bool version = end != std::string::npos && end + 1 < text.size() &&
                       std::isdigit(static_cast<unsigned char>(text[end + 1])) != 0;
  return version ? text.substr(0, end) : base_name(label);
}

// Numbers make no difference between messages.
std::string without_numbers(const std::string& text) {
  std::string out;
  for (const char c : text)
    if (std::isdigit(static_cast<unsigned char>(c)) == 0) out += c;
  return out.substr(0, 60);
}

// Whether the subject's mesh is so small or large that squares of floats vanish or overflow.
bool is_out_of_scale(const Report& report, const Result& r) {
  for (const auto& m : report.meshes)
    if (m.name == r.mesh && m.diagonal > 0) return m.diagonal < 0x1p-30 || m.diagonal > 0x1p30;
  return false;
}

class Sorting {
 public:
  explicit Sorting(const Report& report) : report_(report) {
    std::map<std::tuple<std::string, Case, data::Scheme, std::string>, Rows> cases;
    for (std::size_t k = 0; k < report.results.size(); ++k) {
      const Result& r = report.results[k];
      if (is_bad(r)) cases[{r.subject, case_of(r), r.scheme, r.triangulated}].push_back(k);
    }
    pin_regions(cases);
    for (const auto& [key, rows] : cases) sort(rows);
  }

  std::vector<Cause> take() {
    merge_subjects();
    std::vector<Cause> all;
    for (auto& [key, cause] : causes_) {
      std::ranges::sort(cause.rows);
      std::ranges::sort(cause.direct);
      std::set<std::string> names;
      for (const std::size_t k : cause.rows) names.insert(base_name(row(k).subject));
      cause.who = names.size() == 1 ? *names.begin() : library(report_, row(cause.rows[0]).subject);
      cause.kind = key.kind;
      all.push_back(std::move(cause));
    }
    return all;
  }

 private:
  using Rows = std::vector<std::size_t>;  // the red ones of one subject in one case

  const Result& row(std::size_t k) const { return report_.results[k]; }
  // The first of these checks among the rows; report.results.size() if there is none.
  std::size_t find(const Rows& rows, std::initializer_list<std::string_view> names) const {
    const auto found =
        std::ranges::find_if(rows, [&](std::size_t k) { return is_one_of(row(k).check, names); });
    return found == rows.end() ? report_.results.size() : *found;
  }
  bool has(const Rows& rows, std::string_view check) const {
    return find(rows, {check}) < report_.results.size();
  }

  // Rows that are wrong in one region decide which regions there are; the others follow them.
  void pin_regions(const auto& cases) {
    std::map<std::pair<std::string, Region>, int> sure;
    Rows several;
    for (const auto& [key, rows] : cases)
      for (const std::size_t k : rows) {
        const Result& r = row(k);
        if (kind_of(r.check) != CauseKind::kSurface || r.status != Status::kFinding) continue;
        const std::set<Region> list = regions(r);  // the more special first, which wins where nothing is sure
        region_[k] = *list.begin();
        if (list.size() > 1)
          several.push_back(k);
        else
          ++sure[{base_name(r.subject), *list.begin()}];
      }
    for (const std::size_t k : several) {
      const std::set<Region> list = regions(row(k));
      const std::string name = base_name(row(k).subject);
      region_[k] = *std::ranges::max_element(list, [&](Region a, Region b) {
        return sure[{name, a}] < sure[{name, b}];
      });
    }
  }

  void put(std::size_t k, const Key& key, bool direct) {
    Cause& cause = causes_[key];
    cause.rows.push_back(k);
    if (!direct) return;
    cause.direct.push_back(k);
    if (key.region != Region::kNone)
      add(cause.places[row(k).scheme == data::Scheme::kLoop ? 0 : 1], counts_in(row(k).places, key.region));
  }

  // Whether two causes, of different subjects of one library and in one region, show the same errors: in half
  // of the rows that both have, the worst value to a tenth.
  bool is_same(const Cause& a, const Cause& b) const {
    int common = 0, equal = 0;
    for (const std::size_t i : a.direct) {
      bool both = false, same = false;
      for (const std::size_t k : b.direct) {
        const Result &r = row(i), &other = row(k);
        if (std::tie(r.check, r.mesh, r.depth, r.depths) !=
            std::tie(other.check, other.mesh, other.depth, other.depths))
          continue;
        both = true;
        same = same || std::abs(r.worst.value_or(0) - other.worst.value_or(0)) <= 0.1 * r.worst.value_or(0);
      }
      common += both;
      equal += same;
    }
    return common > 0 && 2 * equal >= common;
  }

  // Subjects of one library that call the same code.
  void merge_subjects() {
    const auto library_of = [&](const Cause& c) { return library(report_, row(c.rows.front()).subject); };
    for (auto a = causes_.begin(); a != causes_.end(); ++a)
      for (auto b = std::next(a); b != causes_.end();) {
        auto& [key, to] = *a;
        const auto& [other, from] = *b;
        const bool surface = key.kind == CauseKind::kSurface && other.kind == CauseKind::kSurface;
        if (!surface ||
            (!is_part_of(other, from, key, to) &&
             (key.region != other.region || library_of(to) != library_of(from) || !is_same(to, from)))) {
          ++b;
          continue;
        }
        to.rows.insert(to.rows.end(), from.rows.begin(), from.rows.end());
        to.direct.insert(to.direct.end(), from.direct.begin(), from.direct.end());
        for (int scheme = 0; scheme < 2; ++scheme) add(to.places[scheme], from.places[scheme]);
        b = causes_.erase(b);
      }
  }

  bool has_positions(const Cause& c) const {
    return std::ranges::any_of(c.direct, [&](std::size_t k) { return row(k).unit != "degrees"; });
  }

  // What is wrong at irregular vertices only, of a subject that is wrong in irregular faces in more rows. (At
  // depth 0 there are no other points.)
  bool is_part_of(const Key& part, const Cause& few, const Key& whole, const Cause& many) const {
    return part.who == whole.who && whole.region == Region::kIrregular &&
           implies(whole.region, part.region) && few.direct.size() < many.direct.size() &&
           (!has_positions(few) || has_positions(many));
  }

  // Where a row goes that stands for itself.
  Key key_of(const Rows& rows, std::size_t k) const {
    const Result& r = row(k);
    const std::string of_library = library(report_, r.subject), name = base_name(r.subject);
    if (r.status != Status::kFinding)
      return {name, CauseKind::kBreakdown, Region::kNone, without_numbers(r.message)};
    const CauseKind kind = kind_of(r.check);
    const bool without_length = r.unit == "degrees" && !r.worst;  // at no angle at all with the exact ones
    if ((kind == CauseKind::kSurface && without_length) ||
        (kind != CauseKind::kSurface && r.not_finite > 0 && !r.worst) ||
        (r.check == "normal-length" && (has(rows, "finite") || is_out_of_scale(report_, r))))
      return {of_library, CauseKind::kNotFinite, Region::kNone, ""};
    switch (kind) {
      case CauseKind::kSurface: {
        // The rule at the ends of sharp edges is one of the library, whatever evaluates between them.
        const Region region = region_.at(k);
        return {region == Region::kDart ? of_library : name, kind, region, ""};
      }
      case CauseKind::kRefuses:
        return {of_library, kind, Region::kNone, without_numbers(r.message)};
      case CauseKind::kOther:
        return {name, kind, Region::kNone, r.check};
      case CauseKind::kUnwritten:
      case CauseKind::kTiling:
        return {name, kind, Region::kNone, ""};
      default:
        return {of_library, kind, Region::kNone, ""};
    }
  }

  // Points off the surface turn normals, open cracks and change with the order of the faces; normals are more
  // often the reason why something changes with the order.
  void sort(const Rows& rows) {
    const auto is_finding = [&](std::size_t k) {
      return k < report_.results.size() && row(k).status == Status::kFinding;
    };
    std::size_t reason = find(rows, {"normals", "file-normals"});
    if (!is_finding(reason))
      reason = find(rows, {"positions", "refined-positions", "file-positions", "file-distance"});
    for (const std::size_t k : rows) {
      const std::string& check = row(k).check;
      const Key own = key_of(rows, k);
      const bool follows =
          is_finding(k) &&
          !is_one_of(check, {"recognised", "file-recognised"}) &&  // the reason explains no more
          !is_of_channels(check) &&
          (own.kind == CauseKind::kOrder || own.kind == CauseKind::kOther ||
           is_one_of(check, {"orientation", "continuity", "file-watertight", "file-orientation"}));
      if (follows && is_finding(reason))
        put(k, key_of(rows, reason), false);
      else
        put(k, own, !is_one_of(check, {"watertight", "t-vertices"}) || !has(rows, "shared-positions"));
    }
  }

  const Report& report_;
  std::map<std::size_t, Region> region_;  // of each red row of positions and normals
  std::map<Key, Cause> causes_;
};

}  // namespace

std::vector<Cause> sorted_into_causes(const Report& report) {
  return Sorting(report).take();
}

}  // namespace limitcheck::verify
