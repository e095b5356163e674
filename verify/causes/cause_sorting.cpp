// SPDX-License-Identifier: MIT
#include "verify/causes/cause_sorting.h"

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

#include "verify/causes/region.h"

namespace limitcheck::verify {
namespace {

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
        const std::set<Region> list = regions(r);  // the more special first, which wins where nothing is sure
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

  // Subjects of one library that call the same code.
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
    if (is_of_surface(r) && !is_without_length(r)) {
      // The rule at the ends of sharp edges is one of the library, whatever evaluates between them.
      const Region region = region_.at(k);
      return {region == Region::kDart ? of_library : name, CauseKind::kSurface, region, ""};
    }
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
    if (is_one_of(r.check, {"normals-against-positions", "normal-length", "recognised"}) ||
        r.check.starts_with("file-"))
      return {name, CauseKind::kOther, Region::kNone, r.check};
    return {of_library, CauseKind::kOrder, Region::kNone, ""};
  }

  // Points off the surface turn normals, open cracks and change with the order of the faces; normals are more
  // often the reason why something changes with the order.
  void sort(const Case& c) {
    const Result* reason = c.find({"normals", "file-normals"});
    if (reason == nullptr || reason->status != Status::kFinding)
      reason = c.find({"positions", "refined-positions", "file-positions", "file-distance"});
    const bool has_reason = reason != nullptr && reason->status == Status::kFinding;
    for (const std::size_t k : c.rows()) {
      const Result& r = report_.results[k];
      const Key own = key_of(c, k);
      const bool follows =
          r.status == Status::kFinding &&
          !is_one_of(r.check, {"recognised", "file-recognised"}) &&  // what the reason does not explain
          (own.kind == CauseKind::kOrder || own.kind == CauseKind::kOther ||
           is_one_of(r.check, {"orientation", "continuity", "file-watertight", "file-orientation"}));
      if (follows && has_reason) {
        put(k, key_of(c, static_cast<std::size_t>(reason - report_.results.data())), false);
      } else {
        const bool cracks = is_one_of(r.check, {"watertight", "t-vertices"});
        put(k, own, !cracks || c.find({"shared-positions"}) == nullptr);
      }
    }
  }

  const Report& report_;
  std::vector<Case> cases_;
  std::map<std::size_t, Region> region_;  // of each red row of positions and normals
  std::map<Key, Cause> causes_;
};

}  // namespace

std::vector<Cause> sorted_into_causes(const Report& report) {
  return Sorting(report).take();
}

}  // namespace limitcheck::verify
