// SPDX-License-Identifier: MIT
#include "verify/repair/repair.h"

#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Simple_cartesian.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <set>
#include <string_view>
#include <tuple>
#include <utility>

#include "data/near_on_border.h"
#include "data/validate.h"

namespace limitcheck::verify {
namespace {

namespace pmp = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Polygon = std::vector<std::size_t>;

struct WatchOrientation : pmp::Default_orientation_visitor {
  std::int64_t* turned;  // the visitor is copied
  std::vector<std::pair<std::size_t, std::size_t>>* copies;
  void polygon_orientation_reversed(std::size_t) { ++*turned; }
  void duplicated_vertex(std::size_t vertex, std::size_t copy) { copies->emplace_back(vertex, copy); }
};

class Repair {
 public:
  explicit Repair(const data::io::PolygonSoup& soup) : tags_(soup.sharp), choices_(soup.choices) {
    for (const auto& p : soup.positions) points_.emplace_back(p[0], p[1], p[2]);
    std::int64_t no_vertex = 0;
    std::size_t begin = 0;
    for (const std::size_t end : soup.polygon_end) {
      Polygon polygon;
      bool good = true;
      for (std::size_t k = begin; k < end; ++k) {
        good = good && soup.corners[k] >= 0 && static_cast<std::size_t>(soup.corners[k]) < points_.size();
        polygon.push_back(static_cast<std::size_t>(soup.corners[k]));
      }
      begin = end;
      no_vertex += !good;
      if (good) polygons_.push_back(std::move(polygon));
    }
    note("dropped", static_cast<std::int64_t>(soup.holes.size()), "hole",
         "which is a face like any other now");
    note("dropped", static_cast<std::int64_t>(soup.hides_boundary), "tag",
         "that hides the faces beside the boundary, which are faces like any other now");
    // First of all: cutting makes vertices of these numbers.
    const auto vertices = static_cast<std::int64_t>(points_.size());
    const auto no_edge =
        std::erase_if(tags_, [&](const Tag& t) { return t.a < 0 || t.a >= vertices || t.b >= vertices; });
    note("dropped", static_cast<std::int64_t>(no_edge), "sharpness", kNoPlace);
    note("dropped", no_vertex, "face", "that named a vertex which does not exist");
    drop("with fewer than three corners", [](const Polygon& p) { return p.size() < 3; });
    drop_repeated_corners("with a repeated corner");
    drop("with a coordinate that is not finite", [&](const Polygon& p) {
      return std::any_of(p.begin(), p.end(), [&](std::size_t v) {
        return !std::isfinite(points_[v].x()) || !std::isfinite(points_[v].y()) ||
               !std::isfinite(points_[v].z());
      });
    });
  }

  std::size_t faces() const { return polygons_.size(); }

  /// Whether there is nothing to do but for tags, found in a tenth of the time that it takes to do nothing.
  bool is_valid() const {
    return points_.size() <= kMostIndices && data::validate(mesh(), data::Scheme::kCatmullClark).empty();
  }

  /// Whether vertices at different places became one: they leave fewer places, so it is not so for ever.
  bool weld(double distance) {
    weld_equal();
    bool any = false;
    while (distance > 0 && weld_near(distance)) {
      any = true;
      weld_equal();  // where faces went, others lie on the border
    }
    return any;
  }

  void weld_equal() {
    // Only finite points have an order, so unused vertices are dropped first.
    drop_unused();
    const std::vector<Point> before = points_;
    const std::size_t merged = pmp::merge_duplicate_points_in_polygon_soup(points_, polygons_);
    std::map<Point, std::size_t> number;
    for (std::size_t v = 0; v < points_.size(); ++v) number[points_[v]] = v;
    move_tags([&](std::size_t v) { return v < before.size() ? number.at(before[v]) : v; });
    note("welded", static_cast<std::int64_t>(merged), "vertex", "that lay exactly where another one does");
    drop_repeated_corners("whose corners fell together when vertices were welded");
  }

  bool weld_near(double distance) {
    if (points_.size() > kMostIndices) return false;
    const std::vector<std::int32_t> to = data::joined_on_border(mesh(), distance);
    std::int64_t merged = 0;
    for (std::size_t v = 0; v < to.size(); ++v) merged += to[v] != static_cast<std::int32_t>(v);
    for (Polygon& p : polygons_)
      for (std::size_t& v : p) v = static_cast<std::size_t>(to[v]);
    move_tags([&](std::size_t v) { return v < to.size() ? static_cast<std::size_t>(to[v]) : v; });
    note("welded", merged, "vertex", "on the border that lay close to another one there");
    drop_repeated_corners("whose corners fell together when vertices were welded");
    drop_unused(false);
    return merged > 0;
  }

  void drop_duplicates() {
    const std::size_t before = polygons_.size();
    std::set<Polygon> seen;
    std::erase_if(polygons_, [&](Polygon p) {
      std::sort(p.begin(), p.end());
      return !seen.insert(std::move(p)).second;
    });
    note("dropped", static_cast<std::int64_t>(before - polygons_.size()), "face",
         "with the corners of a face before it");
  }

  void orient() {
    const std::size_t vertices = points_.size();
    std::int64_t turned = 0;
    std::vector<std::pair<std::size_t, std::size_t>> copies;
    // False: it had to cut, which the points it added show.
    (void)pmp::orient_polygon_soup(points_, polygons_,
                                   CGAL::parameters::visitor(WatchOrientation{{}, &turned, &copies}));
    copy_tags(copies);
    was_cut_ = was_cut_ || !copies.empty();
    note("turned", turned, "face", "so that neighbours run the same way round");
    note("added", static_cast<std::int64_t>(points_.size() - vertices), "vertex",
         "where the mesh was cut apart: at edges of three faces or more, and where fans touch in a vertex");
  }

  /// Two faces around an interior vertex are one face with a vertex too many. Where they touch elsewhere, too,
  /// and would be no polygon, the second one goes.
  void merge_at_valence_2() {
    std::int64_t removed = 0, dropped = 0;
    std::vector<std::vector<std::size_t>> around(points_.size());
    for (std::size_t f = 0; f < polygons_.size(); ++f)
      for (const std::size_t v : polygons_[f]) around[v].push_back(f);
    std::vector<bool> changed(polygons_.size(), false);
    for (std::size_t v = 0; v < points_.size(); ++v) {
      if (around[v].size() != 2) continue;
      const std::size_t f = around[v][0], g = around[v][1];
      if (changed[f] || changed[g]) continue;  // the next pass looks at it
      Polygon one = beginning_at(v, polygons_[f]), other = beginning_at(v, polygons_[g]);
      if (one[1] != other.back() || one.back() != other[1]) continue;  // a boundary vertex
      Polygon merged(one.begin() + 1, one.end());
      merged.insert(merged.end(), other.begin() + 2, other.end() - 1);
      const bool polygon = merged.size() >= 3 && !has_repeated_corners(merged);
      ++(polygon ? removed : dropped);
      if (polygon) polygons_[f] = std::move(merged);
      polygons_[g].clear();
      changed[f] = changed[g] = true;
    }
    std::erase_if(polygons_, [](const Polygon& p) { return p.empty(); });
    note("removed", removed, "vertex", "inside with two faces only, which became one");
    note("dropped", dropped, "face",
         "that made with another one all faces of a vertex, and touched it elsewhere");
  }

  void drop_unused(bool say = true) {
    std::vector<bool> used(points_.size(), false);
    for (const Polygon& p : polygons_)
      for (const std::size_t v : p) used[v] = true;
    std::vector<std::size_t> to(points_.size());
    std::vector<Point> kept;
    for (std::size_t v = 0; v < points_.size(); ++v) {
      to[v] = kept.size();
      if (used[v]) kept.push_back(points_[v]);
    }
    if (say)
      note("dropped", static_cast<std::int64_t>(points_.size() - kept.size()), "vertex",
           "that no face names");
    points_ = std::move(kept);
    for (Polygon& p : polygons_)
      for (std::size_t& v : p) v = to[v];
    constexpr std::size_t kGone = std::numeric_limits<std::size_t>::max();
    move_tags([&](std::size_t v) { return v < used.size() && used[v] ? to[v] : kGone; });
  }

  /// Sharp edges and vertices that are none any more go; of several at one place the sharpest stays.
  void drop_tags() {
    if (tags_.empty()) return;
    std::map<std::pair<std::int64_t, std::int64_t>, double> most;
    constexpr double kNone = -1;  // no edge or vertex of the mesh
    for (const Tag& t : tags_) most[ends(t)] = kNone;
    std::set<std::pair<std::int64_t, std::int64_t>> there;
    for_each_edge_and_vertex([&](std::int64_t a, std::int64_t b) {
      if (const auto at = most.find(std::minmax(a, b)); at != most.end()) there.insert(at->first);
    });
    for (const Tag& t : tags_)
      if (double& sharpness = most[ends(t)]; there.contains(ends(t)))
        sharpness = std::max(sharpness, t.sharpness);
    const std::size_t before = tags_.size();
    std::erase_if(tags_, [&](const Tag& t) {
      double& sharpness = most[ends(t)];
      const bool stays = t.sharpness >= 0 && sharpness == t.sharpness;
      if (stays) sharpness = kNone;
      return !stays;
    });
    // Copies stand at the end, wherever the vertex was cut: in an order of their own they stay as they are.
    if (was_cut_) {
      for (Tag& t : tags_)
        if (t.b >= 0) std::tie(t.a, t.b) = ends(t);
      std::sort(tags_.begin(), tags_.end(), [](const Tag& a, const Tag& b) { return ends(a) < ends(b); });
    }
    note("dropped", static_cast<std::int64_t>(before - tags_.size()), "sharpness", kNoPlace);
  }

  /// The mesh, and what was done to it: nothing, if welding and cutting ended where they began.
  Repaired take(const data::io::PolygonSoup& before) {
    Repaired result;
    for (const Point& p : points_) result.soup.positions.push_back({p.x(), p.y(), p.z()});
    for (const Polygon& p : polygons_) {
      for (const std::size_t v : p) result.soup.corners.push_back(static_cast<std::int64_t>(v));
      result.soup.close_polygon();
    }
    result.soup.sharp = std::move(tags_);
    result.soup.choices = choices_;
    bool alike =
        result.soup.polygon_end == before.polygon_end;  // no polygon went; vertices may have other numbers
    for (std::size_t k = 0; alike && k < before.corners.size(); ++k)
      alike = result.soup.positions[static_cast<std::size_t>(result.soup.corners[k])] ==
              before.positions[static_cast<std::size_t>(before.corners[k])];
    if (alike)
      result.soup.channels = before.channels;
    else
      note("dropped", static_cast<std::int64_t>(before.channels.size()), "channel",
           "of faces that are not those of before");
    const auto same_tag = [](const Tag& a, const Tag& b) {
      return a.a == b.a && a.b == b.b && a.sharpness == b.sharpness;
    };
    const bool same = result.soup.positions == before.positions && result.soup.corners == before.corners &&
                      result.soup.polygon_end == before.polygon_end && before.holes.empty() &&
                      std::equal(result.soup.sharp.begin(), result.soup.sharp.end(), before.sharp.begin(),
                                 before.sharp.end(), same_tag);
    if (!same)
      for (const Change& c : changes_) result.changes.push_back(c.text());
    return result;
  }

 private:
  data::ControlMesh mesh() const {
    data::ControlMesh mesh;
    for (const Point& p : points_) mesh.positions.push_back({p.x(), p.y(), p.z()});
    std::vector<std::int32_t> face;
    for (const Polygon& p : polygons_) {
      face.assign(p.begin(), p.end());
      mesh.faces.push_back(face);
    }
    return mesh;
  }

  using Tag = data::io::PolygonSoup::SharpTag;
  static constexpr std::string_view kNoPlace = "of no edge or vertex, or of one that has a larger one";
  static constexpr std::size_t kMostIndices = std::numeric_limits<std::int32_t>::max();

  static bool has_repeated_corners(Polygon p) {
    std::sort(p.begin(), p.end());
    return std::adjacent_find(p.begin(), p.end()) != p.end();
  }
  static Polygon beginning_at(std::size_t v, Polygon p) {
    std::rotate(p.begin(), std::find(p.begin(), p.end(), v), p.end());
    return p;
  }
  static std::pair<std::int64_t, std::int64_t> ends(const Tag& t) { return std::minmax(t.a, t.b); }
  template <class To>
  void move_tags(To to) {
    const auto move = [&](std::int64_t& v) {
      if (v >= 0) v = static_cast<std::int64_t>(to(static_cast<std::size_t>(v)));
    };
    std::erase_if(tags_, [&](Tag& t) {
      const bool edge = t.b >= 0;
      move(t.a);
      move(t.b);
      return t.a < 0 || (edge && t.b < 0);
    });
  }
  /// Edges and vertices of copies are as sharp as those that they were copied from.
  void copy_tags(const std::vector<std::pair<std::size_t, std::size_t>>& copies) {
    if (tags_.empty() || copies.empty()) return;
    std::map<std::int64_t, std::int64_t> origin;
    for (const auto& [vertex, copy] : copies) {
      const auto from = origin.find(static_cast<std::int64_t>(vertex));
      origin[static_cast<std::int64_t>(copy)] =
          from == origin.end() ? static_cast<std::int64_t>(vertex) : from->second;
    }
    const auto origin_of = [&](std::int64_t v) {
      const auto from = origin.find(v);
      return from == origin.end() ? v : from->second;
    };
    std::multimap<std::pair<std::int64_t, std::int64_t>, Tag> known;
    for (const Tag& t : tags_) known.emplace(ends(t), t);
    std::set<std::pair<std::int64_t, std::int64_t>> seen;
    const auto copy = [&](std::int64_t a, std::int64_t b) {
      if (!origin.contains(a) && !origin.contains(b)) return;
      if (!seen.insert(std::minmax(a, b)).second) return;
      const auto [first, last] = known.equal_range(std::minmax(origin_of(a), b < 0 ? b : origin_of(b)));
      for (auto t = first; t != last; ++t) tags_.push_back({a, b, t->second.sharpness, t->second.line});
    };
    for_each_edge_and_vertex(copy);
  }

  /// Calls what(v, -1) for the vertex at each corner, and what(v, w) for the edge to the next.
  template <class What>
  void for_each_edge_and_vertex(What&& what) const {
    for (const Polygon& p : polygons_)
      for (std::size_t k = 0; k < p.size(); ++k) {
        const auto v = static_cast<std::int64_t>(p[k]);
        what(v, std::int64_t{-1});
        what(v, static_cast<std::int64_t>(p[(k + 1) % p.size()]));
      }
  }

  /// A kind of change, and how often; the texts live as long as the program.
  struct Change {
    std::string_view verb, what, which;
    std::int64_t count;
    std::string text() const {
      const std::string many = what == "vertex"      ? "vertices"
                               : what == "sharpness" ? "sharpnesses"
                                                     : fmt::format("{}s", what);
      return fmt::format("{} {} {} {}", verb, count, count == 1 ? what : many, which);
    }
  };
  void note(std::string_view verb, std::int64_t count, std::string_view what, std::string_view which) {
    if (count == 0) return;
    for (Change& c : changes_)
      if (c.verb == verb && c.which == which) {
        c.count += count;
        return;
      }
    changes_.push_back({verb, what, which, count});
  }

  template <class Bad>
  void drop(std::string_view which, Bad bad) {
    note("dropped", static_cast<std::int64_t>(std::erase_if(polygons_, bad)), "face", which);
  }

  void drop_repeated_corners(std::string_view which) { drop(which, has_repeated_corners); }

  std::vector<Point> points_;
  std::vector<Polygon> polygons_;
  std::vector<Tag> tags_;
  data::Sharpness choices_;
  bool was_cut_ = false;
  std::vector<Change> changes_;
};

}  // namespace

Repaired repair(const data::io::PolygonSoup& soup, const RepairOptions& options) {
  Repair work(soup);
  // Where faces went or became one, others may have the corners of another, or a seam may close that was cut
  // before: it ends, as each further pass begins with fewer faces or places.
  bool joined = false;
  for (std::size_t before = 0; joined || before != work.faces();) {
    before = work.faces();
    joined = options.weld && work.weld(options.weld_distance);
    if (work.is_valid()) break;
    work.drop_duplicates();
    work.orient();
    work.drop_unused();
    work.merge_at_valence_2();
    work.drop_unused(false);
  }
  work.drop_tags();
  return work.take(soup);
}

}  // namespace limitcheck::verify
