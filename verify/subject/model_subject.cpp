// SPDX-License-Identifier: MIT
// The model: a plain tessellator that is right, and can be told to be wrong in one way. Uniform refinement to
// the deepest level asked for, every point once; uneven faces become fans round their centre.
//
//   options   mutation=NAME (default none)
//             weights=loop|warren (default loop)
//             points=limit|refined (default limit); refined points come without normals, at one depth for all
//             faces
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <stdexcept>
#include <vector>

#include "reference/normal.h"
#include "reference/refine.h"
#include "reference/stam.h"
#include "verify/subject/adapter.h"
#include "verify/subject/control_mesh.h"
#include "verify/subject/model_rules.h"
#include "verify/subject/registry.h"
#include "verify/subject/weights_option.h"

namespace {

using namespace limitcheck;
using namespace limitcheck::verify;
using V = ModelRules::V;

constexpr int kDeepest = 7;

std::vector<std::string_view> names() {
  std::vector<std::string_view> list;
  for (const Mutation& m : mutations()) list.push_back(m.name);
  return list;
}

std::string_view mutation_option(Options& options) {
  return names()[static_cast<std::size_t>(options.choice("mutation", names()))];
}

struct Vertex {
  V position, normal;
  lc_provenance place;
};

class ModelSubject {
 public:
  static lc_capabilities capabilities(Options& options) {
    const std::string_view mutation = mutation_option(options);
    lc_weights weights = weights_option(options);
    if (mutation == "warren_declared" || mutation == "warren_limit_of_loop") weights = LC_WEIGHTS_WARREN;
    if (options.choice("points", {"limit", "refined"}) == 1)
      return {LC_FLOAT64, weights, LC_BOUNDARY_SPLINE, LC_POINTS_REFINED, kDeepest, 0, 0, 1};
    return {LC_FLOAT64, weights, LC_BOUNDARY_SPLINE, LC_POINTS_LIMIT, kDeepest, 1, 1, 1};
  }

  ModelSubject(const lc_mesh& mesh, Options& options)
      : capabilities_(capabilities(options)),
        rules_(mutation_option(options), family(capabilities_.weights)),
        mesh_(control_mesh(mesh)) {
    try {
      const reference::Topology topology(mesh_.positions.size(), mesh_.triangles);
      if (mesh_.triangles.empty()) throw std::invalid_argument("the mesh has no faces");
      for (const auto& e : topology.edges())
        if (e.on_boundary() && rules_.is("refuses_boundaries"))
          throw std::invalid_argument("the mesh has a boundary");
    } catch (const std::invalid_argument& error) {
      if (!rules_.is("accepts_anything")) throw SubjectError(LC_INVALID_INPUT, error.what());
      mesh_ = {};
    }
    for (int axis = 0; axis < 3; ++axis) {
      double low = 0, high = 0;
      for (std::size_t v = 0; v < mesh_.positions.size(); ++v) {
        const double x = mesh_.positions[v][static_cast<std::size_t>(axis)];
        low = v == 0 ? x : std::min(low, x);
        high = v == 0 ? x : std::max(high, x);
      }
      size_ = std::hypot(size_, high - low);
    }
  }

  void tessellate(const lc_request& request, lc_tessellation& out) {
    vertices_.clear();
    triangles_.clear();
    faces_.clear();
    if (!mesh_.triangles.empty()) display(request);
    deliver(request, out);
  }

 private:
  // Points and normals at the vertices of the deepest level.
  struct Level {
    explicit Level(reference::RefinedMesh<double> m) : mesh(std::move(m)) {}
    reference::RefinedMesh<double> mesh;  // where they are: its own points are not used
    std::vector<V> points, limits, normals;
  };

  Level refine(int depth) const {
    Level level{reference::RefinedMesh<double>(mesh_)};
    for (std::size_t v = 0; v < mesh_.positions.size(); ++v) {
      const auto& p = mesh_.positions[v];
      level.points.push_back({p[0], p[1], p[2]});
      if (rules_.is("by_vertex_number") && v % 2 == 1) level.points.back().x += 1e-9 * size_;
    }
    for (int step = 0; step < depth; ++step) {
      std::vector<V> next = rules_.refine(level.mesh.topology(), level.points);
      if (step > 0 && step + 1 == depth && rules_.is("one_step_missing"))
        std::copy(level.points.begin(), level.points.end(), next.begin());
      level.points = std::move(next);
      level.mesh.refine();
    }
    for (std::size_t v = 0; v < level.points.size(); ++v) {
      const auto k = static_cast<std::int32_t>(v);
      level.limits.push_back(capabilities_.points == LC_POINTS_REFINED
                                 ? level.points[v]
                                 : rules_.limit(level.mesh.topology(), level.points, k));
      level.normals.push_back(rules_.normal(level.mesh.topology(), level.points, k));
    }
    return level;
  }

  void display(const lc_request& request) {
    const std::size_t count = mesh_.triangles.size();
    std::vector<int> depth(request.face_depth, request.face_depth + count);
    for (int& d : depth) {
      if (rules_.is("printed_cone_depth") && d > 0) d = 0;
      if (rules_.is("one_level_short") && d > 1) --d;
      if (rules_.is("culled_shown") && d < 0) d = 0;
    }
    const int deepest = std::max(0, *std::max_element(depth.begin(), depth.end()));
    const Level level = refine(deepest);
    const reference::Topology topology(mesh_.positions.size(), mesh_.triangles);
    const auto neighbour_depth = [&](std::size_t f,
                                     int k) {  // own depth where there is none, or it is culled
      const auto& e = topology.edges()[static_cast<std::size_t>(topology.edge(f, k))];
      for (std::size_t g = 0; g < count; ++g) {
        if (g == f || depth[g] < 0) continue;
        for (int j = 0; j < 3; ++j)
          if (topology.edge(g, j) == topology.edge(f, k) && !e.on_boundary()) return depth[g];
      }
      return depth[f];
    };
    bool limits_ready = false;
    for (std::size_t f = 0; f < count; ++f) {
      const int d = depth[f];
      if (d < 0) continue;
      std::array<int, 3> edge{};
      int deeper = 0;
      for (int k = 0; k < 3; ++k) {
        const int other = neighbour_depth(f, k);
        edge[static_cast<std::size_t>(k)] = std::max(d, other);
        deeper += other > d;
      }
      if (rules_.is("exchanged_depths") && deeper > 0)
        for (int k = 0; k < 3; ++k) edge[static_cast<std::size_t>(k)] = neighbour_depth(f, k);
      if (rules_.is("no_repair") || (rules_.is("fan_needs_two") && deeper == 1)) deeper = 0;
      if (deeper == 0) {
        strips(level, f, d);
      } else {
        if (!limits_ready)
          surface_ = std::make_unique<reference::StamEvaluator<double>>(mesh_, family(capabilities_.weights));
        limits_ready = true;
        fan(level, topology, f, edge);
      }
    }
    if (!vertices_.empty() && ((rules_.is("every_other_time") && calls_++ % 2 == 1) ||
                               (rules_.is("by_threads") && request.threads > 1))) {
      double& x = vertices_.front().position.x;
      x = std::nextafter(x, std::numeric_limits<double>::infinity());
    }
  }

  std::uint32_t put(const Level& level, std::size_t f, int i, int j, int d) {
    const int times = 1 << (level.mesh.depth() - d), n = 1 << d;
    const auto v = static_cast<std::size_t>(level.mesh.vertex(f, i * times, j * times));
    Vertex out{level.limits[v],
               level.normals[v],
               {static_cast<std::int32_t>(f), static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j),
                static_cast<std::uint32_t>(n)}};
    const bool border = i == 0 || j == 0 || i + j == n;
    if (rules_.is("gap_1e-9") && border && f % 2 == 1) out.position += out.normal * (1e-9 * size_);
    if (rules_.is("by_face_number") && !border && f % 2 == 1) out.position += out.normal * (1e-9 * size_);
    if (rules_.is("by_first_corner") && !border)
      out.position += out.normal * (1e-9 * size_ * (n - i - j) / n);
    if (rules_.is("right_half") && out.position.x > 0) out.position.y += 1e-9 * size_;
    if (rules_.is("along_z")) out.position.z *= 1 + 1e-9;
    if (rules_.is("about_origin")) out.position *= 1 + 1e-9;
    if (rules_.is("absolute_offset")) out.position += V{1e-9, 1e-9, 1e-9};
    vertices_.push_back(out);
    return static_cast<std::uint32_t>(vertices_.size() - 1);
  }

  void triangle(std::size_t f, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    triangles_.push_back({a, b, c});
    faces_.push_back(static_cast<std::int32_t>(f));
  }

  void strips(const Level& level, std::size_t f, int d) {
    const int n = 1 << d;
    std::map<std::pair<int, int>, std::uint32_t> at;
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i + j <= n; ++i) at[{i, j}] = put(level, f, i, j, d);
    for (int j = 0; j < n; ++j)
      for (int i = 0; i + j < n; ++i) {
        triangle(f, at[{i, j}], at[{i + 1, j}], at[{i, j + 1}]);
        if (i + j + 1 < n) triangle(f, at[{i + 1, j}], at[{i + 1, j + 1}], at[{i, j + 1}]);
      }
    if (rules_.is("one_strip_more")) triangle(f, at[{0, n - 1}], at[{1, n - 1}], at[{0, n}]);
  }

  void fan(const Level& level, const reference::Topology& topology, std::size_t f,
           const std::array<int, 3>& edge) {
    std::vector<std::uint32_t> border;
    for (int k = 0; k < 3; ++k) {
      const int d = edge[static_cast<std::size_t>(k)], n = 1 << d;
      for (int s = 0; s < n; ++s)
        border.push_back(k == 0   ? put(level, f, s, 0, d)
                         : k == 1 ? put(level, f, n - s, s, d)
                                  : put(level, f, 0, n - s, d));
    }
    const auto third = reference::Parameter::fraction(1, 3);
    const auto centre = surface_->evaluate(static_cast<int>(f), third, third, reference::Order::kFirst);
    Vertex out{centre.position, centre.normal, {static_cast<std::int32_t>(f), 1, 1, 3}};
    const auto control = [&](int k) {
      const auto& p =
          mesh_.positions[static_cast<std::size_t>(mesh_.triangles[f][static_cast<std::size_t>(k)])];
      return V{p[0], p[1], p[2]};
    };
    const auto corner = [&](int k) {
      const int n = 1 << level.mesh.depth();
      return level.limits[static_cast<std::size_t>(level.mesh.vertex(f, k == 1 ? n : 0, k == 2 ? n : 0))];
    };
    bool at_boundary = false;
    for (int k = 0; k < 3; ++k)
      at_boundary =
          at_boundary || topology.edges()[static_cast<std::size_t>(topology.edge(f, k))].on_boundary();
    if (rules_.is("flat_centre")) out.position = (corner(0) + corner(1) + corner(2)) * (1. / 3);
    if (rules_.is("control_centroid")) out.position = (control(0) + control(1) + control(2)) * (1. / 3);
    if (rules_.is("flat_centre_normal"))
      out.normal = reference::unit(cross(control(1) - control(0), control(2) - control(0)));
    if (rules_.is("centre_without_ghosts") && at_boundary) {
      out.position = {};
      for (const auto b : border)
        out.position += vertices_[b].position * (1 / static_cast<double>(border.size()));
    }
    if (rules_.is("printed_b1") && !at_boundary) {
      // b1 weighs the first of the twelve points: neighbour 4, from the next corner on, of the edge point.
      reference::RefinedMesh<double> once(mesh_);
      once.refine();
      const std::int32_t four = once.vertex(f, 1, 0), seven = once.vertex(f, 1, 1);
      const auto ring = once.topology().ring(four);
      const auto first = static_cast<std::size_t>(std::find(ring.begin(), ring.end(), seven) - ring.begin());
      const V& one = once.positions()[static_cast<std::size_t>(ring[(first + 4) % ring.size()])];
      out.position += one * ((11. / 108 - 1. / 4) / 81);
    }
    vertices_.push_back(out);
    const auto middle = static_cast<std::uint32_t>(vertices_.size() - 1);
    for (std::size_t k = 0; k < border.size(); ++k)
      triangle(f, middle, border[k], border[(k + 1) % border.size()]);
    if (rules_.is("fan_twice")) triangle(f, middle, border.back(), border.front());
  }

  void deliver(const lc_request& request, lc_tessellation& out) const {
    const auto output =
        allocate_output<double>(request, out, static_cast<std::int64_t>(vertices_.size()),
                                static_cast<std::int64_t>(triangles_.size()), capabilities_.normals != 0);
    for (std::size_t v = 0; v < vertices_.size(); ++v) {
      const auto& [p, n, place] = vertices_[v];
      std::size_t at = 3 * v;
      for (const double x : {p.x, p.y, p.z}) output.positions[at++] = x;
      at = 3 * v;
      if (capabilities_.normals != 0)
        for (const double x : {n.x, n.y, n.z}) output.normals[at++] = x;
      output.provenance[v] = place;
    }
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      std::copy(triangles_[t].begin(), triangles_[t].end(), output.triangles + 3 * t);
      output.triangle_face[t] = faces_[t];
    }
    // As if as many vectors were there as the true sum has, in memory of the printed one.
    if (rules_.is("buffer_as_printed")) out.vertex_count += 5 + 6 * 50;
  }

  lc_capabilities capabilities_;
  ModelRules rules_;
  data::ControlMesh mesh_;
  double size_ = 0;
  std::unique_ptr<reference::StamEvaluator<double>> surface_;
  std::vector<Vertex> vertices_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::vector<std::int32_t> faces_;
  // Shared by all instances, as a counter forgotten in a static variable would be.
  inline static int calls_ = 0;
};

}  // namespace

extern "C" const lc_subject* lc_subject_model() {
  static const lc_subject subject =
      make_subject<ModelSubject>("model", "a plain tessellator that is right, or wrong in one stated way",
                                 "mutation=NAME (default none), weights=loop|warren (default loop), "
                                 "points=limit|refined (default limit)");
  return &subject;
}
