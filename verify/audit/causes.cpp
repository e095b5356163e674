// SPDX-License-Identifier: MIT
#include "verify/audit/causes.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "verify/audit/cause_words.h"
#include "verify/audit/reproduce.h"

namespace limitcheck::verify {
namespace {

// Where the surface is wrong, as far as it tells causes apart.
enum class Region : std::uint8_t {
  kNone,
  kEverywhere,
  kIrregular,     // in faces at extraordinary vertices or at the boundary
  kSharp,         // at sharp edges and vertices
  kBoundary,      // at boundary vertices only
  kExtraordinary  // at extraordinary vertices, and those of faces that are no quads, only
};

// The region that a kind of place is part of.
Region region_of(PlaceKind kind) {
  switch (kind) {
    case PlaceKind::kRegularFace:
    case PlaceKind::kRegularVertex:
      return Region::kEverywhere;
    case PlaceKind::kBoundaryFace:
    case PlaceKind::kIrregularFace:
      return Region::kIrregular;
    case PlaceKind::kBoundaryVertex:
      return Region::kBoundary;
    case PlaceKind::kExtraordinaryVertex:
    case PlaceKind::kPolygonVertex:
      return Region::kExtraordinary;
    default:
      return Region::kSharp;
  }
}

struct Key {
  std::string who;
  CauseKind kind = CauseKind::kOther;
  Region region = Region::kNone;
  std::string more;  // kOther, kBreakdown, kRefuses: what tells causes of this kind apart
  auto tie() const { return std::tie(who, kind, region, more); }
  friend bool operator<(const Key& a, const Key& b) { return a.tie() < b.tie(); }
};

bool is_one_of(const std::string& check, std::initializer_list<std::string_view> names) {
  return std::find(names.begin(), names.end(), check) != names.end();
}

bool says_not_finite(const Result& r) {
  return !r.worst && r.message.find("not finite") != std::string::npos;
}

// The label without options.
std::string base_name(const std::string& label) {
  if (label.starts_with("program:") || label.find('/') != std::string::npos) return label;
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

// The regions where a row of positions or normals has something wrong.
std::set<Region> regions(const Result& r) {
  std::set<Region> found;
  for (const PlaceCount& c : r.places)
    if (c.bad > 0) found.insert(region_of(c.kind));
  if (found.empty() || found.contains(Region::kEverywhere)) return {Region::kEverywhere};
  // What is wrong in the faces round a vertex is wrong at the vertex for the same reason.
  if (found.contains(Region::kIrregular)) {
    found.erase(Region::kBoundary);
    found.erase(Region::kExtraordinary);
  }
  return found;
}

// The counts that belong to a region.
std::vector<PlaceCount> counts_in(const std::vector<PlaceCount>& counts, Region region) {
  if (region == Region::kEverywhere) return counts;
  std::vector<PlaceCount> inside;
  for (const PlaceCount& c : counts) {
    const Region own = region_of(c.kind);
    if (own == region ||
        (region == Region::kIrregular && (own == Region::kBoundary || own == Region::kExtraordinary)))
      inside.push_back(c);
  }
  return inside;
}

bool is_of_surface(const Result& r) {
  return is_one_of(r.check, {"positions", "refined-positions", "normals", "file-positions", "file-distance",
                             "file-normals"});
}

// Normals at no angle at all with the exact ones.
bool is_without_length(const Result& r) {
  return r.unit == "degrees" && !r.worst;
}

// Numbers make no difference between messages.
std::string without_numbers(const std::string& text) {
  std::string out;
  for (const char c : text)
    if (std::isdigit(static_cast<unsigned char>(c)) == 0) out += c;
  return out.substr(0, 60);
}

// The red rows of one subject in one case.
class Case {
 public:
  Case(const Report& report, std::vector<std::size_t> rows) : report_(report), rows_(std::move(rows)) {}

  const std::vector<std::size_t>& rows() const { return rows_; }
  const Result* find(std::initializer_list<std::string_view> names) const {
    for (const std::size_t k : rows_)
      if (is_one_of(report_.results[k].check, names)) return &report_.results[k];
    return nullptr;
  }

 private:
  const Report& report_;
  std::vector<std::size_t> rows_;
};

// Whether the subject's mesh is so small or large that squares of floats vanish or overflow.
bool is_out_of_scale(const Report& report, const Result& r) {
  for (const auto& m : report.meshes)
    if (m.name == r.mesh && m.diagonal > 0) return m.diagonal < 0x1p-30 || m.diagonal > 0x1p30;
  return false;
}

// Puts the red rows of a report to causes.
class Sorting {
 public:
  explicit Sorting(const Report& report) : report_(report) {
    std::map<std::tuple<std::string, std::string, int, std::string, std::string, data::Scheme, std::string>,
             std::vector<std::size_t>>
        rows;
    for (std::size_t k = 0; k < report.results.size(); ++k) {
      const Result& r = report.results[k];
      if (is_bad(r))
        rows[{r.subject, r.mesh, r.depth, r.depths, r.sample, r.scheme, r.triangulated}].push_back(k);
    }
    for (auto& [key, list] : rows) cases_.emplace_back(report, std::move(list));
    pin_regions();
    for (const Case& c : cases_) sort(c);
  }

  std::vector<Cause> take() {
    merge_subjects();
    std::vector<Cause> all;
    for (auto& [key, cause] : causes_) {
      std::sort(cause.rows.begin(), cause.rows.end());
      std::sort(cause.direct.begin(), cause.direct.end());
      std::set<std::string> names;
      for (const std::size_t k : cause.rows) names.insert(base_name(report_.results[k].subject));
      cause.who =
          names.size() == 1 ? *names.begin() : library(report_, report_.results[cause.rows[0]].subject);
      cause.kind = key.kind;
      all.push_back(std::move(cause));
    }
    return all;
  }

 private:
  // Rows that are wrong in one region decide which regions there are; the others follow them.
  void pin_regions() {
    std::map<std::pair<std::string, Region>, int> pinned;
    std::vector<std::size_t> several;
    for (const Case& c : cases_)
      for (const std::size_t k : c.rows()) {
        const Result& r = report_.results[k];
        if (!is_of_surface(r) || r.status != Status::kFinding) continue;
        const std::set<Region> list = regions(r);
        if (list.size() > 1) {
          several.push_back(k);
          continue;
        }
        region_[k] = *list.begin();
        ++pinned[{base_name(r.subject), *list.begin()}];
      }
    const std::map<std::pair<std::string, Region>, int> sure = pinned;
    for (const std::size_t k : several) {
      const Result& r = report_.results[k];
      const std::set<Region> list = regions(r);
      const auto count = [&](Region region) {
        const auto found = sure.find({base_name(r.subject), region});
        return found == sure.end() ? 0 : found->second;
      };
      region_[k] = *std::max_element(list.begin(), list.end(),
                                     [&](Region a, Region b) { return count(a) < count(b); });
    }
  }

  void put(std::size_t k, Key key, bool direct) {
    const Region region = key.region;
    Cause& cause = causes_[std::move(key)];
    cause.rows.push_back(k);
    if (!direct) return;
    cause.direct.push_back(k);
    const Result& r = report_.results[k];
    if (region != Region::kNone)
      add(cause.places[r.scheme == data::Scheme::kLoop ? 0 : 1], counts_in(r.places, region));
  }

  // Whether two causes, of different subjects of one library and in one region, show the same errors: in half
  // of the rows that both have, the worst value to a tenth.
  bool is_same(const Cause& a, const Cause& b) const {
    int common = 0, equal = 0;
    for (const std::size_t i : a.direct) {
      bool both = false, same = false;
      for (const std::size_t k : b.direct) {
        const Result &r = report_.results[i], &other = report_.results[k];
        if (r.check != other.check || r.mesh != other.mesh || r.depth != other.depth ||
            r.depths != other.depths)
          continue;
        both = true;
        same = same || std::abs(r.worst.value_or(0) - other.worst.value_or(0)) <= 0.1 * r.worst.value_or(0);
      }
      common += both;
      equal += same;
    }
    return common > 0 && 2 * equal >= common;
  }

  // Two doors of a library to the same code.
  void merge_subjects() {
    for (auto a = causes_.begin(); a != causes_.end(); ++a)
      for (auto b = std::next(a); b != causes_.end();) {
        if (is_part_of(b->first, b->second, a->first, a->second)) {
          b = merge(a->second, b);
          continue;
        }
        const auto library_of = [&](const Cause& c) {
          return library(report_, report_.results[c.rows.front()].subject);
        };
        if (a->first.kind != CauseKind::kSurface || b->first.kind != CauseKind::kSurface ||
            a->first.region != b->first.region || library_of(a->second) != library_of(b->second) ||
            !is_same(a->second, b->second)) {
          ++b;
          continue;
        }
        b = merge(a->second, b);
      }
  }

  std::map<Key, Cause>::iterator merge(Cause& to, std::map<Key, Cause>::iterator from) {
    const Cause& c = from->second;
    to.rows.insert(to.rows.end(), c.rows.begin(), c.rows.end());
    to.direct.insert(to.direct.end(), c.direct.begin(), c.direct.end());
    for (int scheme = 0; scheme < 2; ++scheme) add(to.places[scheme], c.places[scheme]);
    return causes_.erase(from);
  }

  bool has_positions(const Cause& c) const {
    return std::any_of(c.direct.begin(), c.direct.end(),
                       [&](std::size_t k) { return report_.results[k].unit != "degrees"; });
  }

  // What is wrong at irregular vertices only, of a subject that is wrong in irregular faces in more rows. (At
  // depth 0 there are no other points.)
  bool is_part_of(const Key& part, const Cause& few, const Key& whole, const Cause& many) const {
    return part.kind == CauseKind::kSurface && whole.kind == CauseKind::kSurface && part.who == whole.who &&
           whole.region == Region::kIrregular &&
           (part.region == Region::kBoundary || part.region == Region::kExtraordinary) &&
           few.direct.size() < many.direct.size() && (!has_positions(few) || has_positions(many));
  }

  // Where a row goes that stands for itself.
  Key key_of(const Case& c, std::size_t k) const {
    const Result& r = report_.results[k];
    const std::string of_library = library(report_, r.subject), name = base_name(r.subject);
    if (r.status != Status::kFinding)
      return {name, CauseKind::kBreakdown, Region::kNone, without_numbers(r.message)};
    if (r.check == "tessellates")
      return {of_library, CauseKind::kRefuses, Region::kNone, without_numbers(r.message)};
    if (r.check == "written") return {name, CauseKind::kUnwritten, Region::kNone, ""};
    if (is_of_surface(r) && !is_without_length(r)) return {name, CauseKind::kSurface, region_.at(k), ""};
    if (is_of_surface(r) || is_one_of(r.check, {"finite", "degenerate-geometry", "file-finite"}) ||
        says_not_finite(r) ||
        (r.check == "normal-length" && (c.find({"finite"}) != nullptr || is_out_of_scale(report_, r))))
      return {of_library, CauseKind::kNotFinite, Region::kNone, ""};
    if (is_one_of(r.check, {"coverage", "orientation", "file-coverage", "file-orientation"}))
      return {name, CauseKind::kTiling, Region::kNone, ""};
    if (is_one_of(r.check, {"shared-positions", "shared-normals", "watertight", "t-vertices", "continuity",
                            "file-watertight"}))
      return {of_library, CauseKind::kSeams, Region::kNone, ""};
    if (r.check == "rejected-inputs") return {of_library, CauseKind::kAccepts, Region::kNone, ""};
    if (is_one_of(r.check, {"normals-against-positions", "normal-length"}) || r.check.starts_with("file-"))
      return {name, CauseKind::kOther, Region::kNone, r.check};
    return {of_library, CauseKind::kOrder, Region::kNone, ""};
  }

  void sort(const Case& c) {
    // The row that the others of the case may follow from: points rather than normals.
    const Result* surface = nullptr;
    for (const auto& names : {std::initializer_list<std::string_view>{"normals", "file-normals"},
                              {"positions", "refined-positions", "file-positions", "file-distance"}}) {
      const Result* found = c.find(names);
      if (surface == nullptr || found != nullptr) surface = found;
    }
    const Result* normals = c.find({"normals", "file-normals"});
    const auto index = [&](const Result* r) { return static_cast<std::size_t>(r - report_.results.data()); };
    for (const std::size_t k : c.rows()) {
      const Result& r = report_.results[k];
      const Key own = key_of(c, k);
      // Normals are more often the reason why something turns with the order of the input.
      const bool turned = normals != nullptr && normals->status == Status::kFinding;
      const Result* reason = turned ? normals : surface;
      const bool follows =
          r.status == Status::kFinding &&
          (own.kind == CauseKind::kOrder || own.kind == CauseKind::kOther || r.check == "orientation" ||
           r.check == "continuity" || r.check == "file-watertight" || r.check == "file-orientation");
      if (follows && reason != nullptr && reason->status == Status::kFinding)
        put(k, key_of(c, index(reason)), false);
      else
        put(k, own,
            r.check != "watertight" && r.check != "t-vertices" ? true
                                                               : c.find({"shared-positions"}) == nullptr);
    }
  }

  const Report& report_;
  std::vector<Case> cases_;
  std::map<std::size_t, Region> region_;  // of each red row of positions and normals
  std::map<Key, Cause> causes_;
};

// Pairs of subject and case among rows.
std::int64_t count_cases(const Report& report, const std::vector<std::size_t>& rows) {
  std::set<std::tuple<std::string, std::string, int, std::string, std::string>> cases;
  for (const std::size_t k : rows) {
    const Result& r = report.results[k];
    cases.emplace(r.subject, r.mesh, r.depth, r.depths, r.sample);
  }
  return static_cast<std::int64_t>(cases.size());
}

std::int64_t faces_of(const Report& report, const Result& r) {
  for (const auto& m : report.meshes)
    if (m.name == r.mesh) return m.faces;
  return 0;
}

void complete(const Report& report, Cause& cause) {
  std::set<std::string> subjects, checks, consequences;
  for (const std::size_t k : cause.rows) subjects.insert(report.results[k].subject);
  for (const std::size_t k : cause.direct) checks.insert(report.results[k].check);
  for (const std::size_t k : cause.rows)
    if (!checks.contains(report.results[k].check)) consequences.insert(report.results[k].check);
  for (const std::string& s : report.subjects)
    if (subjects.contains(s)) cause.subjects.push_back(s);
  cause.consequences.assign(consequences.begin(), consequences.end());
  if (cause.direct.empty()) cause.direct = cause.rows;

  // The smallest mesh; a row whose point can be shown rather than another one.
  const auto rank = [&](std::size_t k) {
    const Result& r = report.results[k];
    return std::tuple(!r.sample.empty(), difference_command(r).empty(), faces_of(report, r), r.depth, k);
  };
  cause.example = *std::min_element(cause.direct.begin(), cause.direct.end(),
                                    [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });

  cause.cases = count_cases(report, cause.direct);
  std::vector<std::size_t> looked;
  for (std::size_t k = 0; k < report.results.size(); ++k) {
    const Result& r = report.results[k];
    if (subjects.contains(r.subject) && (checks.empty() || checks.contains(r.check)) &&
        r.status != Status::kNotRun && r.status != Status::kNotSupported)
      looked.push_back(k);
  }
  cause.of = count_cases(report, looked);
  cause.share = 2 * cause.cases >= cause.of ? 3 : 10 * cause.cases >= cause.of ? 2 : 1;
}

}  // namespace

std::string_view word(CauseKind kind) {
  switch (kind) {
    case CauseKind::kBreakdown:
      return "breakdown";
    case CauseKind::kRefuses:
      return "refuses";
    case CauseKind::kUnwritten:
      return "unwritten";
    case CauseKind::kNotFinite:
      return "not-finite";
    case CauseKind::kSurface:
      return "surface";
    case CauseKind::kTiling:
      return "tiling";
    case CauseKind::kSeams:
      return "seams";
    case CauseKind::kOrder:
      return "order";
    case CauseKind::kAccepts:
      return "accepts";
    case CauseKind::kOther:
      return "other";
  }
  return "other";
}

std::string_view Cause::severity() const {
  const int product = size * share;
  return product >= 6 ? "high" : product >= 3 ? "medium" : "low";
}

std::vector<Cause> causes(const Report& report) {
  std::vector<Cause> all = Sorting(report).take();
  for (Cause& cause : all) {
    complete(report, cause);
    put_in_words(report, cause);
  }
  const auto rank = [](const Cause& c) { return std::tuple(c.size * c.share, c.size, c.cases); };
  std::stable_sort(all.begin(), all.end(), [&](const Cause& a, const Cause& b) { return rank(a) > rank(b); });
  return all;
}

std::string command_for(const Report& report, const Cause& cause, const std::string& level) {
  const Result& r = report.results[cause.example];
  if (report.depths == "file") return "";
  if (const std::string command = difference_command(r); !command.empty()) return command;
  return audit_command(r, level) + " --details";
}

}  // namespace limitcheck::verify
