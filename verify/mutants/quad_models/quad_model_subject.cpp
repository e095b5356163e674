// SPDX-License-Identifier: MIT
// The quad model: a plain, correct tessellator of Catmull-Clark's surfaces that can be told to be wrong in
// one way. Uniform refinement to the deepest level asked for, every point once; triangles along a deeper
// neighbour are cut until they meet its points. Computes in double.
//
//   options   mutation=NAME (default none), route=refine|kernel (default refine): the whole mesh at once, or
//             quad by quad as kernels do it; faults of kernels choose the latter
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "reference/catmull_clark/refined_mesh.h"
#include "reference/loop/refine.h"
#include "verify/mutants/quad_models/quad_kernel_model.h"
#include "verify/mutants/quad_models/quad_model_rules.h"
#include "verify/subject/adapter.h"
#include "verify/subject/control_mesh.h"
#include "verify/subject/face_domain.h"
#include "verify/subject/registry.h"

namespace {

using namespace limitcheck;
using namespace limitcheck::verify;
using V = QuadModelRules::V;
using Point = FaceDomain::Point;

constexpr int kDeepest = 6;

std::vector<std::string_view> names() {
  std::vector<std::string_view> list;
  for (const Mutation& m : quad_mutations()) list.push_back(m.name);
  return list;
}

double one_ulp_up(double x) {
  return std::nextafter(x, std::numeric_limits<double>::infinity());
}

// Points and normals at the vertices of one level.
struct Level {
  reference::catmull_clark::RefinedMesh<double> mesh;  // where they are: its own points are not used
  std::vector<V> points;
  std::vector<ModelLimit> limits;

  Level(const data::ControlMesh& control, const QuadModelRules& rules, int depth)
      : mesh(control.faces, reference::positions_of<double>(control)), points(mesh.positions()) {
    ModelTags tags = rules.tags(control.sharpness, mesh.topology());
    for (int step = 0; step < depth; ++step) {
      std::vector<V> next = rules.refine(mesh.topology(), points, tags, step);
      if (step > 0 && step + 1 == depth && rules.is("one_step_missing"))
        std::copy(points.begin(), points.end(), next.begin());
      points = std::move(next);
      if (tags.none()) {
        mesh.refine();
        continue;
      }
      const reference::Topology before = mesh.topology();
      mesh.refine();
      tags = tags.refined(before, mesh.topology());
    }
    for (std::size_t v = 0; v < points.size(); ++v)
      limits.push_back(rules.limit(mesh.topology(), points, tags, static_cast<std::int32_t>(v)));
  }
};

bool by_kernel(Options& options, std::string_view mutation) {
  const bool asked = options.choice("route", {"refine", "kernel"}) == 1;
  const auto faults = quad_kernel_mutations();
  return asked ||
         std::any_of(faults.begin(), faults.end(), [&](const Mutation& m) { return m.name == mutation; });
}

// The triangles of one face, by points over n steps to a side.
class Tiles {
 public:
  std::vector<std::array<Point, 3>> triangles;

  ///   side_depth   of each side, `depth` or more
  Tiles(FaceDomain domain, int depth, std::vector<int> side_depth, int level, bool with_middle)
      : domain_(domain), n_(std::int64_t{1} << level), side_depth_(std::move(side_depth)) {
    const std::int64_t step = n_ >> depth, most = domain.denominator(n_);
    if (domain.parts() > 1 && depth == 0) {
      for (int k = 1; k + 1 < domain.corners(); ++k)
        emit({domain.corner_point(0, n_), domain.corner_point(k, n_), domain.corner_point(k + 1, n_)});
      return;
    }
    for (std::int32_t part = 0; part < domain.parts(); ++part)
      for (std::int64_t j = 0; j < most; j += step)
        for (std::int64_t i = 0; i < most; i += step) {
          const auto at = [&](std::int64_t di, std::int64_t dj) {
            return Point{i + di * step, j + dj * step, part};
          };
          emit({at(0, 0), at(1, 0), at(1, 1)});
          if (with_middle || i + step < most || j + step < most) emit({at(0, 0), at(1, 1), at(0, 1)});
        }
  }

 private:
  // How far along a side a point lies, if it lies on it.
  std::int64_t along(const Point& p, int side) const {
    const auto at = domain_.side_of(p, n_);
    if (!at) return -1;
    if (at->side == side) return at->along;
    return at->along == 0 && at->side == domain_.next(side) ? n_ : -1;
  }

  void emit(const std::array<Point, 3>& t) {
    for (std::size_t k = 0; k < 3; ++k)
      for (int side = 0; side < domain_.corners(); ++side) {
        const std::int64_t from = along(t[k], side), to = along(t[(k + 1) % 3], side);
        const std::int64_t step = n_ >> side_depth_[side];
        if (from < 0 || to < 0 || to - from <= step) continue;
        for (std::int64_t at = from; at < to; at += step)
          emit({domain_.on_side(side, at, n_), domain_.on_side(side, at + step, n_), t[(k + 2) % 3]});
        return;
      }
    triangles.push_back(t);
  }

  FaceDomain domain_;
  std::int64_t n_;
  std::vector<int> side_depth_;
};

class QuadModelSubject {
 public:
  static constexpr std::int32_t kSchemes = LC_DOES_CATMULL_CLARK;
  static lc_capabilities capabilities(Options& options, lc_scheme) {
    lc_capabilities c{LC_FLOAT64, LC_WEIGHTS_LOOP, LC_BOUNDARY_SPLINE, LC_POINTS_LIMIT, kDeepest, 1, 1, 1};
    const std::string_view name = mutation(options);
    c.sharp = by_kernel(options, name) ? LC_SHARP_CREASES | LC_SHARP_CORNERS : declared_kinds(name);
    c.sharp |= LC_SHARP_SMOOTH_TRIANGLES;
    return c;
  }

  QuadModelSubject(const lc_mesh& mesh, Options& options) : rules_(mutation(options)) {
    control_ = control_mesh(mesh);
    refuse_tags(mutation(options), control_.sharpness);
    if (rules_.is("tags_by_count"))
      control_.sharpness =
          tags_.try_emplace({control_.positions.size(), control_.faces.size()}, control_.sharpness)
              .first->second;
    if (rules_.is("cache_by_count"))
      control_ =
          cache_.try_emplace({control_.positions.size(), control_.faces.size()}, control_).first->second;
    if (control_.faces.empty()) throw SubjectError(LC_INVALID_INPUT, "the mesh has no faces");
    try {
      topology_ = std::make_unique<reference::Topology>(control_.positions.size(), control_.faces);
    } catch (const data::ArgumentError& error) {
      throw SubjectError(LC_INVALID_INPUT, error.what());
    }
    const std::string_view name = mutation(options);
    if (by_kernel(options, name)) kernel_ = std::make_unique<QuadKernelModel>(control_, name);
  }

  void tessellate(const lc_request& request, lc_tessellation& out) {
    const std::span depth(request.face_depth, control_.faces.size());
    const int deepest = *std::max_element(depth.begin(), depth.end());
    const int level = std::max(deepest, 0) + 1;  // one more: room for the level more of a mutation
    vertices_.clear(), triangles_.clear();
    if (deepest >= 0) {
      const Level points(shown(depth), rules_, level);
      for (std::size_t f = 0; f < depth.size(); ++f)
        if (depth[f] >= 0) show(f, depth, level, points);
    }
    if (rules_.is("every_other_time") && calls_++ % 2 == 1 && !vertices_.empty())
      vertices_[0].position.x = one_ulp_up(vertices_[0].position.x);
    deliver(request, out);
  }

 private:
  // The last instance empties the cache.
  struct Alive {
    Alive() { ++count; }
    ~Alive() {
      if (--count == 0) cache_.clear(), tags_.clear();
    }
    Alive(const Alive&) = delete;
    Alive& operator=(const Alive&) = delete;
    inline static int count = 0;
  };
  struct Vertex {
    V position, normal;
    lc_provenance place;
    std::int32_t corner;
  };

  static std::string_view mutation(Options& options) { return names()[options.choice("mutation", names())]; }

  data::ControlMesh shown(std::span<const std::int32_t> depth) const {
    if (!rules_.is("culled_are_holes")) return control_;
    data::ControlMesh mesh = control_;
    mesh.faces.clear();
    for (std::size_t f = 0; f < depth.size(); ++f)
      if (depth[f] >= 0) mesh.faces.push_back(control_.faces[f]);
    return mesh;
  }

  std::vector<int> side_depths(std::size_t f, std::span<const std::int32_t> depth) const {
    std::vector<int> sides(control_.faces[f].size(), depth[f]);
    for (std::size_t k = 0; k < sides.size(); ++k) {
      const reference::Edge& edge = topology_->edges()[topology_->edge(f, k)];
      const std::int32_t g =
          edge.left_face == static_cast<std::int32_t>(f) ? edge.right_face : edge.left_face;
      if (g < 0 || rules_.is("unstitched") || (rules_.is("stitched_on_side_0") && k > 0)) continue;
      sides[k] = std::max(sides[k], depth[g]);
    }
    return sides;
  }

  void show(std::size_t f, std::span<const std::int32_t> depth, int level, const Level& points) {
    const FaceDomain domain(data::Scheme::kCatmullClark, static_cast<int>(control_.faces[f].size()));
    const bool polygon = domain.parts() > 1;
    const std::int64_t n = std::int64_t{1} << level;
    std::vector<int> sides = side_depths(f, depth);
    int own = depth[f];
    if (polygon && rules_.is("one_level_more_in_polygons")) sides.assign(sides.size(), ++own);
    Tiles tiles(domain, own, sides, level, !polygon || !rules_.is("middle_left_out"));

    const std::size_t face_of_level = f - hidden_before(f, depth);
    std::map<std::array<std::int64_t, 3>, std::uint32_t> known;
    const auto vertex = [&](const Point& named) {
      const Point p = domain.canonical(named, n);
      const auto [at, is_new] =
          known.try_emplace({p.part, p.i, p.j}, static_cast<std::uint32_t>(vertices_.size()));
      if (is_new) {
        const auto number = [&](std::int64_t i, std::int64_t j) {
          return points.mesh.vertex(face_of_level, static_cast<std::size_t>(p.part), static_cast<int>(i),
                                    static_cast<int>(j));
        };
        const std::int32_t v = number(p.i, p.j);
        const std::int64_t most = domain.denominator(n);
        const std::int32_t inside = number(p.i < most ? p.i + 1 : p.i - 1, p.j < most ? p.j + 1 : p.j - 1);
        const ModelLimit& limit = points.limits[v];
        Vertex made{limit.position, limit.normal(points.mesh.topology(), v, inside, inside), {}, p.part};
        if (kernel_) {
          const auto [x, w] = kernel_->at(f, p.part, p.i, p.j, level);
          made.position = {x.x, x.y, x.z}, made.normal = {w.x, w.y, w.z};
        }
        auto i = static_cast<std::uint32_t>(p.i), j = static_cast<std::uint32_t>(p.j);
        if (rules_.is("u_for_v")) std::swap(i, j);
        if (rules_.is("sides_apart_by_an_ulp") && f % 2 == 1 && limit.normals.size() > 1)
          made.position.x = one_ulp_up(made.position.x);
        if (polygon && rules_.is("next_corner")) made.corner = domain.next(p.part);
        if (polygon && rules_.is("ulp_on_polygons")) made.position.x = one_ulp_up(made.position.x);
        if (polygon && rules_.is("flipped_on_polygons") && !domain.side_of(p, n))
          made.normal = made.normal * -1.;
        made.place = {static_cast<std::int32_t>(f), i, j, static_cast<std::uint32_t>(domain.denominator(n))};
        vertices_.push_back(made);
      }
      return at->second;
    };
    for (const auto& t : tiles.triangles) {
      std::array<std::uint32_t, 3> corners{vertex(t[0]), vertex(t[1]), vertex(t[2])};
      if (polygon && rules_.is("clockwise_polygons")) std::swap(corners[1], corners[2]);
      triangles_.push_back(corners);
      faces_.resize(triangles_.size(), static_cast<std::int32_t>(f));
      faces_.back() = static_cast<std::int32_t>(f);
    }
  }

  std::size_t hidden_before(std::size_t f, std::span<const std::int32_t> depth) const {
    if (!rules_.is("culled_are_holes")) return 0;
    return static_cast<std::size_t>(
        std::count(depth.begin(), depth.begin() + static_cast<std::ptrdiff_t>(f), -1));
  }

  void deliver(const lc_request& request, lc_tessellation& out) const {
    const auto output =
        allocate_output<double>(request, out, static_cast<std::int64_t>(vertices_.size()),
                                static_cast<std::int64_t>(triangles_.size()), /*normals=*/true,
                                /*corners=*/!rules_.is("corner_is_null"));
    for (std::size_t v = 0; v < vertices_.size(); ++v) {
      const auto& [p, n, place, corner] = vertices_[v];
      for (std::size_t c = 0; const double x : {p.x, p.y, p.z}) output.positions[3 * v + c++] = x;
      for (std::size_t c = 0; const double x : {n.x, n.y, n.z}) output.normals[3 * v + c++] = x;
      output.provenance[v] = place;
      if (output.corner != nullptr) output.corner[v] = corner;
    }
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      std::copy(triangles_[t].begin(), triangles_[t].end(), output.triangles + 3 * t);
      output.triangle_face[t] = faces_[t];
    }
  }

  const QuadModelRules rules_;
  data::ControlMesh control_;
  std::unique_ptr<reference::Topology> topology_;
  std::unique_ptr<QuadKernelModel> kernel_;
  std::vector<Vertex> vertices_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::vector<std::int32_t> faces_;
  const Alive alive_;
  // Shared by all instances, as what is forgotten in a static variable would be.
  inline static int calls_ = 0;
  inline static std::map<std::pair<std::size_t, std::size_t>, data::ControlMesh> cache_;
  inline static std::map<std::pair<std::size_t, std::size_t>, data::Sharpness> tags_;
};

}  // namespace

extern "C" const lc_subject* lc_subject_quad_model() {
  static const lc_subject subject = make_subject<QuadModelSubject>(
      "quad-model",
      "a plain tessellator of Catmull-Clark's surfaces that is right, or wrong in one stated way",
      "mutation=NAME (default none), route=refine|kernel (default refine)");
  return &subject;
}
