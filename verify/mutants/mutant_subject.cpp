// SPDX-License-Identifier: MIT
// The model: a plain, correct tessellator of either scheme that can be told to have one rule wrong where nothing is
// sharp. Uniform refinement to the deepest level asked for; each face has vertices of its own. Triangles along a deeper
// neighbour are cut until they meet its points; triangles of Loop's below depth 2, where nothing is sharp,
// become fans round their centre. Computes in double.
//
//   options   mutation=NAME (default none); of `model`, whose scheme is Loop's, also
//             precision=double|float (default double; of what is delivered)
//             weights=loop|warren (default loop)
//             points=limit|refined (default limit); refined points come without normals, at one depth for all
//             faces
#include <algorithm>
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "reference/loop/stam.h"
#include "verify/mutants/mutant_rules.h"
#include "verify/subject/adapter.h"
#include "verify/subject/registry.h"
#include "verify/subject/weights_option.h"

namespace {

using namespace limitcheck;
using namespace limitcheck::verify;
using V = MutantRules::V;
using Point = FaceDomain::Point;

struct Settings {
  Settings(Options& options, data::Scheme of) : scheme(of) {
    std::vector<std::string_view> names;
    for (const Change& m : mutations(scheme)) names.push_back(m.name);
    mutation = names[options.choice("mutation", names)];
    if (scheme != data::Scheme::kLoop) return;
    single = options.choice("precision", {"double", "float"}) == 1;
    weights = weights_option(options);
    refined = options.choice("points", {"limit", "refined"}) == 1;
    if (mutation == "warren_declared" || mutation == "warren_limit_of_loop") weights = LC_WEIGHTS_WARREN;
  }
  std::unique_ptr<MutantRules> rules() const {
    return scheme == data::Scheme::kLoop ? loop_rules(mutation, family(weights), refined)
                                         : quad_rules(mutation);
  }

  data::Scheme scheme;
  std::string_view mutation;
  bool single = false, refined = false;
  lc_weights weights = LC_WEIGHTS_LOOP;
};

// One frame: the faces of depth 0 and more, as vertices and triangles.
class Frame {
 public:
  DeliveredArrays made;

  Frame(const data::ControlMesh& control, const reference::Topology& topology, const Settings& settings,
        const MutantRules& rules, std::span<const std::int32_t> depth)
      : control_(control),
        topology_(topology),
        settings_(settings),
        rules_(rules),
        depth_(depth),
        // Faces that are no quads have points from one step on.
        level_(control, settings.scheme, rules,
               std::max(*std::max_element(depth.begin(), depth.end()),
                        settings.scheme == data::Scheme::kLoop ? 0 : 1)),
        n_(std::int64_t{1} << level_.depth()) {
    for (face_ = 0; face_ < depth.size(); ++face_)
      if (depth[face_] >= 0) show();
  }

 private:
  void show() {
    domain_ = FaceDomain(settings_.scheme, static_cast<int>(control_.faces[face_].size()));
    known_.clear();
    const int own = depth_[face_];
    int deeper = 0;
    sides_.assign(static_cast<std::size_t>(domain_.corners()), own);
    std::vector<int> beyond = sides_;
    for (std::size_t k = 0; k < sides_.size(); ++k) {
      const reference::Edge& e = topology_.edges()[topology_.edge(face_, k)];
      const std::int32_t g = e.left_face == static_cast<std::int32_t>(face_) ? e.right_face : e.left_face;
      if (g >= 0 && depth_[g] >= 0) beyond[k] = depth_[g];
      sides_[k] = std::max(own, beyond[k]);
      deeper += beyond[k] > own ? 1 : 0;
    }
    if (deeper > 0 && rules_.is("exchanged_depths")) sides_ = beyond;
    if (rules_.is("stitched_on_side_0")) std::fill(sides_.begin() + 1, sides_.end(), own);
    if (rules_.is("no_repair") || rules_.is("unstitched") || (rules_.is("fan_needs_two") && deeper == 1)) {
      sides_.assign(sides_.size(), own);
      deeper = 0;
    }
    // The centre of a fan is no lattice point.
    const bool may_be_fan = settings_.scheme == data::Scheme::kLoop && control_.sharpness.empty();
    const bool shallow = own < 2 || rules_.is("one_inner_point") || rules_.is("exchanged_depths");
    if (deeper > 0 && may_be_fan && shallow)
      fan();
    else
      domain_.for_each_triangle(n_, n_ >> own, [&](Point a, Point b, Point c) { emit({a, b, c}); });
  }

  // A triangle, cut where it lies along a side that has more points.
  void emit(const std::array<Point, 3>& t) {
    for (std::size_t k = 0; k < 3; ++k)
      for (int side = 0; side < domain_.corners(); ++side) {
        const std::int64_t from = domain_.along(t[k], side, n_), to = domain_.along(t[(k + 1) % 3], side, n_);
        const std::int64_t step = n_ >> sides_[static_cast<std::size_t>(side)];
        if (from < 0 || to < 0 || to - from <= step) continue;
        for (std::int64_t at = from; at < to; at += step)
          emit({domain_.on_side(side, at, n_), domain_.on_side(side, at + step, n_), t[(k + 2) % 3]});
        return;
      }
    add({vertex(t[0]), vertex(t[1]), vertex(t[2])});
  }

  // A triangle round its centre: l1 = l2 = 1/3.
  void fan() {
    if (!centres_)
      centres_ = std::make_unique<reference::StamEvaluator<double>>(control_, family(settings_.weights));
    std::vector<std::uint32_t> border;
    for (int side = 0; side < 3; ++side)
      for (std::int64_t at = 0, step = n_ >> sides_[static_cast<std::size_t>(side)]; at < n_; at += step)
        border.push_back(vertex(domain_.on_side(side, at, n_)));
    const auto third = reference::Parameter::fraction(1, 3);
    const auto face = static_cast<std::int32_t>(face_);
    const auto centre = centres_->evaluate(face, third, third, reference::Order::kFirst);
    const std::uint32_t middle = made.add_vertex(centre.position, centre.normal, {face, 1, 1, 3}, 0);
    for (std::size_t k = 0; k < border.size(); ++k) add({middle, border[k], border[(k + 1) % border.size()]});
  }

  void add(const std::array<std::uint32_t, 3>& triangle) {
    made.add_triangle(triangle, static_cast<std::int32_t>(face_));
  }

  std::uint32_t vertex(const Point& named) {
    const Point p = domain_.canonical(named, n_);
    const auto [known, is_new] =
        known_.try_emplace({p.part, p.i, p.j}, static_cast<std::uint32_t>(made.positions.size()));
    if (!is_new) return known->second;
    auto [position, normal] = level_.at(face_, {rules_.is("rows_of_7_bits") ? p.i & 127 : p.i, p.j, p.part});
    const auto begun_in_face = [&] { return rules_.limit(level_.ring(face_, p, face_), level_.depth()); };
    const bool has_ring = control_.sharpness.empty();
    if (has_ring && rules_.is("sums_begun_in_face")) position = begun_in_face().position;
    if (has_ring && rules_.is("normals_begun_in_face")) normal = begun_in_face().normal;
    return made.add_vertex(
        position, normal,
        {static_cast<std::int32_t>(face_), static_cast<std::uint32_t>(p.i), static_cast<std::uint32_t>(p.j),
         static_cast<std::uint32_t>(domain_.denominator(n_))},
        p.part);
  }

  const data::ControlMesh& control_;
  const reference::Topology& topology_;
  const Settings& settings_;
  const MutantRules& rules_;
  const std::span<const std::int32_t> depth_;
  const MutantLevel level_;
  const std::int64_t n_;  // steps to a side
  std::unique_ptr<reference::StamEvaluator<double>> centres_;
  // Of the face that is being shown.
  std::size_t face_ = 0;
  FaceDomain domain_ = FaceDomain::triangle();
  std::vector<int> sides_;  // depths
  std::map<std::array<std::int64_t, 3>, std::uint32_t> known_;
};

template <data::Scheme kScheme>
class ModelSubject {
 public:
  static constexpr bool kLoop = kScheme == data::Scheme::kLoop;
  static constexpr std::int32_t kSchemes = kLoop ? LC_DOES_LOOP : LC_DOES_CATMULL_CLARK;

  static lc_capabilities capabilities(Options& options, lc_scheme) {
    const Settings settings(options, kScheme);
    lc_capabilities c{settings.single ? LC_FLOAT32 : LC_FLOAT64,
                      settings.weights,
                      LC_BOUNDARY_SPLINE,
                      settings.refined ? LC_POINTS_REFINED : LC_POINTS_LIMIT,
                      kLoop ? 7 : 6,
                      settings.refined ? 0 : 1,
                      settings.refined ? 0 : 1,
                      1};
    if (!settings.refined && settings.weights == LC_WEIGHTS_LOOP)
      c.sharp = LC_SHARP_CREASES | LC_SHARP_SEMI | LC_SHARP_CHAIKIN | LC_SHARP_CORNERS |
                (kLoop ? 0 : LC_SHARP_SMOOTH_TRIANGLES);
    return c;
  }

  ModelSubject(const lc_mesh& mesh, Options& options)
      : settings_(options, kScheme), control_(control_mesh(mesh)), rules_(settings_.rules()) {
    if (control_.faces.empty()) throw SubjectError(LC_INVALID_INPUT, "the mesh has no faces");
    try {
      topology_.emplace(control_.positions.size(), control_.faces);
    } catch (const data::ArgumentError& error) {
      throw SubjectError(LC_INVALID_INPUT, error.what());
    }
  }

  void tessellate(const lc_request& request, lc_tessellation& out) {
    settings_.single ? run<float>(request, out) : run<double>(request, out);
  }

 private:
  template <class Real>
  void run(const lc_request& request, lc_tessellation& out) const {
    const std::span depth(request.face_depth, control_.faces.size());
    DeliveredArrays made;
    if (std::any_of(depth.begin(), depth.end(), [](std::int32_t d) { return d >= 0; }))
      made = Frame(control_, *topology_, settings_, *rules_, depth).made;
    made.hand_over<Real>(request, out, !settings_.refined, !kLoop);
  }

  const Settings settings_;
  const data::ControlMesh control_;
  const std::unique_ptr<MutantRules> rules_;
  std::optional<reference::Topology> topology_;
};

}  // namespace

extern "C" const lc_subject* lc_subject_model() {
  static const lc_subject subject = make_subject<ModelSubject<data::Scheme::kLoop>>(
      "model", "a plain tessellator that is right, or wrong in one stated way",
      "mutation=NAME (default none), precision=double|float (default double), weights=loop|warren "
      "(default loop), points=limit|refined (default limit)");
  return &subject;
}

extern "C" const lc_subject* lc_subject_quad_model() {
  static const lc_subject subject = make_subject<ModelSubject<data::Scheme::kCatmullClark>>(
      "quad-model",
      "a plain tessellator of Catmull-Clark's surfaces that is right, or wrong in one stated way",
      "mutation=NAME (default none)");
  return &subject;
}
