// SPDX-License-Identifier: MIT
// The model: a plain, correct tessellator that can be told to be wrong in one way. Uniform refinement to the
// deepest level asked for, every point once; faces beside deeper ones are stitched to them or, below depth 2,
// become fans round their centre. Computes in double.
//
//   options   mutation=NAME (default none)
//             precision=double|float (default double; of what is delivered)
//             weights=loop|warren (default loop)
//             points=limit|refined (default limit); refined points come without normals, at one depth for all
//             faces
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "verify/mutants/models/model_frame.h"
#include "verify/mutants/models/model_tags.h"
#include "verify/subject/adapter.h"
#include "verify/subject/control_mesh.h"
#include "verify/subject/registry.h"
#include "verify/subject/weights_option.h"

namespace {

using namespace limitcheck;
using namespace limitcheck::verify;

constexpr int kDeepest = 7;

std::vector<std::string_view> names() {
  std::vector<std::string_view> list;
  for (const Mutation& m : mutations()) list.push_back(m.name);
  return list;
}

struct Settings {
  explicit Settings(Options& options)
      : mutation(names()[options.choice("mutation", names())]),
        single(options.choice("precision", {"double", "float"}) == 1),
        weights(weights_option(options)),
        refined(options.choice("points", {"limit", "refined"}) == 1) {
    if (mutation == "warren_declared" || mutation == "warren_limit_of_loop") weights = LC_WEIGHTS_WARREN;
  }
  std::string_view mutation;
  bool single;
  lc_weights weights;
  bool refined;
};

double one_ulp_up(double x) {
  return std::nextafter(x, std::numeric_limits<double>::infinity());
}

class ModelSubject {
 public:
  static lc_capabilities capabilities(Options& options) {
    const Settings settings(options);
    lc_capabilities c{settings.single ? LC_FLOAT32 : LC_FLOAT64,
                      settings.weights,
                      LC_BOUNDARY_SPLINE,
                      LC_POINTS_LIMIT,
                      kDeepest,
                      1,
                      1,
                      1};
    if (settings.refined) {
      c.points = LC_POINTS_REFINED;
      c.normals = c.per_face_depth = 0;
    }
    if (!settings.refined && settings.weights == LC_WEIGHTS_LOOP) c.sharp = declared_kinds(settings.mutation);
    // A subject in C may store values that C++ does not let an enumeration hold.
    const auto set = [&](std::string_view mutation, auto& value, std::int32_t number) {
      if (settings.mutation == mutation) std::memcpy(&value, &number, sizeof value);
    };
    set("weights_9", c.weights, 9);
    set("boundary_of_minus_1", c.boundary, -1);
    set("points_of_no_kind", c.points, 2);
    set("no_depth_at_all", c.max_depth, -1);
    set("normals_true", c.normals, -1);
    return c;
  }

  ModelSubject(const lc_mesh& mesh, Options& options) : ModelSubject(mesh, Settings(options)) {}

  void tessellate(const lc_request& request, lc_tessellation& out) {
    ++calls_of_mine_;
    if (mesh_ && (!rules_.is("first_depth_again") || calls_of_mine_ == 1)) {
      frame_.reset();
      depth_ = depths(request);
      if (*std::max_element(depth_.begin(), depth_.end()) >= 0) show(request.threads);
    }
    if (settings_.single)
      deliver<float>(request, out);
    else
      deliver<double>(request, out);
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

  ModelSubject(const lc_mesh& mesh, const Settings& settings)
      : settings_(settings), rules_(settings.mutation, family(settings.weights), settings.refined) {
    try {
      data::ControlMesh control = control_mesh(mesh);
      refuse_tags(settings.mutation, control.sharpness);
      if (!rules_.is("accepts_nan") && !rules_.is("accepts_wild_indices")) refuse_unusable(mesh);
      if (!rules_.is("accepts_bad_tags")) refuse_unusable_tags(mesh);
      remember(control);
      mesh_ = std::make_unique<ModelMesh>(control);
    } catch (const data::ArgumentError& error) {
      if (!rules_.is("accepts_anything") && !rules_.is("accepts_wild_indices"))
        throw SubjectError(LC_INVALID_INPUT, error.what());
      return;
    }
    if (mesh_->size == 0 && rules_.is("fails_on_a_point")) throw std::runtime_error("the box has no size");
    for (const auto& e : mesh_->topology.edges()) {
      if (!e.on_boundary()) continue;
      if (rules_.is("refuses_boundaries")) throw SubjectError(LC_INVALID_INPUT, "the mesh has a boundary");
      if (rules_.is("boundaries_not_supported"))
        throw SubjectError(LC_NOT_SUPPORTED, "meshes with a boundary are not supported");
    }
    for (std::size_t v = 0; v < mesh_->control.positions.size(); ++v)
      if (mesh_->topology.ring(static_cast<std::int32_t>(v)).size() > 50 && rules_.is("valence_50_at_most"))
        throw SubjectError(LC_INVALID_INPUT, "more than 50 neighbours");
  }

  // The state that mutants keep from one mesh to the next.
  void remember(data::ControlMesh& control) const {
    if (rules_.is("cache_by_count")) {
      control = cache_.try_emplace({control.positions.size(), control.faces.size()}, control).first->second;
    }
    if (rules_.is("tags_by_count")) {
      control.sharpness =
          tags_.try_emplace({control.positions.size(), control.faces.size()}, control.sharpness)
              .first->second;
    }
    if (rules_.is("one_buffer")) {
      buffer_.resize(std::max(buffer_.size(), control.positions.size()));
      std::copy(control.positions.begin(), control.positions.end(), buffer_.begin());
    }
  }

  std::vector<std::int32_t> depths(const lc_request& request) const {
    std::vector<std::int32_t> depth(request.face_depth, request.face_depth + mesh_->control.faces.size());
    const std::int32_t first = depth[0];
    for (std::int32_t& d : depth) {
      if (d != first && rules_.is("depths_not_supported"))
        throw SubjectError(LC_NOT_SUPPORTED, "all faces must have one depth");
      if (rules_.is("printed_cone_depth") && d > 0) d = 0;
      if (rules_.is("one_level_short") && d > 1) --d;
      if (rules_.is("culled_shown") && d < 0) d = 0;
      if (rules_.is("depth_of_the_first") || (rules_.is("first_culled_all_culled") && first < 0)) d = first;
    }
    if (rules_.is("fails_if_all_culled") &&
        std::all_of(depth.begin(), depth.end(), [](auto d) { return d < 0; }))
      throw std::runtime_error("there is nothing to show");
    return depth;
  }

  void show(int threads) {
    auto& positions = mesh_->control.positions;
    if (rules_.is("one_buffer")) std::copy_n(buffer_.begin(), positions.size(), positions.begin());
    frame_ = std::make_unique<ModelFrame>(*mesh_, rules_, depth_);
    double& x = frame_->vertices.front().position.x;
    if ((rules_.is("every_other_time") && calls_++ % 2 == 1) || (rules_.is("by_threads") && threads > 1) ||
        (rules_.is("beyond_4_threads") && threads > 4) || (rules_.is("fifth_call") && calls_of_mine_ == 5))
      x = one_ulp_up(x);
  }

  template <class Real>
  void deliver(const lc_request& request, lc_tessellation& out) const {
    const bool normals = !settings_.refined && !rules_.is("normals_forgotten");
    const std::size_t vertices = frame_ ? frame_->vertices.size() : 0;
    const std::size_t triangles = frame_ ? frame_->triangles.size() : 0;
    const auto output = allocate_output<Real>(request, out, static_cast<std::int64_t>(vertices),
                                              static_cast<std::int64_t>(triangles), normals);
    for (std::size_t v = 0; v < vertices; ++v) {
      const auto& [p, n, place] = frame_->vertices[v];
      std::size_t at = 3 * v;
      for (const double x : {p.x, p.y, p.z}) output.positions[at++] = static_cast<Real>(x);
      at = 3 * v;
      for (const double x : {n.x, n.y, n.z})
        if (normals) output.normals[at++] = static_cast<Real>(x);
      output.provenance[v] = place;
    }
    for (std::size_t t = 0; t < triangles; ++t) {
      std::copy(frame_->triangles[t].begin(), frame_->triangles[t].end(), output.triangles + 3 * t);
      output.triangle_face[t] = frame_->faces[t];
    }
    // Writes as many vectors as the true sum counts, into memory for those that the printed sum counts.
    if (rules_.is("buffer_as_printed")) out.vertex_count += 5 + 6 * 50;
  }

  const Settings settings_;
  const ModelRules rules_;
  std::unique_ptr<ModelMesh> mesh_;
  std::vector<std::int32_t> depth_;
  std::unique_ptr<ModelFrame> frame_;
  int calls_of_mine_ = 0;
  const Alive alive_;
  // Shared by all instances, as what is forgotten in a static variable would be. A process that audits more
  // than one subject begins each with an empty cache.
  inline static int calls_ = 0;
  inline static std::map<std::pair<std::size_t, std::size_t>, data::ControlMesh> cache_;
  inline static std::map<std::pair<std::size_t, std::size_t>, data::Sharpness> tags_;
  inline static std::vector<std::array<double, 3>> buffer_;
};

}  // namespace

extern "C" const lc_subject* lc_subject_model() {
  static const lc_subject subject = [] {
    lc_subject model = make_subject<ModelSubject>(
        "model", "a plain tessellator that is right, or wrong in one stated way",
        "mutation=NAME (default none), precision=double|float (default double), weights=loop|warren "
        "(default loop), points=limit|refined (default limit)");
    // ModelMesh refuses meshes that it cannot use; some mutants do not.
    model.create = [](const lc_mesh* mesh, const char* text, void** instance, const char** message) {
      return detail::guarded(message, [&] {
        Options options(text);
        auto made = std::make_unique<ModelSubject>(*mesh, options);
        options.finish();
        *instance = made.release();
      });
    };
    return model;
  }();
  return &subject;
}
