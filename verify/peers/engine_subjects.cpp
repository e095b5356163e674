// SPDX-License-Identifier: MIT
// Our two engines of both schemes, audited through the plug-in interface like every other subject. As strips and
// fans (the default) every face and pair delivers its border points itself, so that their bits can be compared;
// as an indexed mesh they are shared.
//
//   sliding-window   the paper's: pairing (of triangles; a quad is a grid by itself), sliding window, crack
//                    repair. Cracks are stitched: the paper's fans leave out the points inside a face beside a
//                    deeper one, which every face that asks for them must have.
//   row-stream       the quick one. As patches, which stay in their places as long as they are as they were,
//                    frames=N walks through N frames of other depths and control points before the one that is
//                    asked for. (Not with sticky pairs: what these deliver depends on the frames before, which
//                    the audit's check of state finds.) `target` forces one compiled variant.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "data/error.h"
#include "data/splitmix64.h"
#include "fast/frame/patch_mesh.h"
#include "fast/frame/sink.h"
#include "fast/plan/depth.h"
#include "fast/plan/printed_rules.h"
#include "fast/stream/stream_tessellator.h"
#include "fast/window/tessellator.h"
#include "verify/subject/adapter.h"
#include "verify/subject/control_mesh.h"
#include "verify/subject/registry.h"

namespace {

using namespace limitcheck;
using namespace limitcheck::verify;
namespace rs = limitcheck::fast::row_stream;

enum class Form { kStrips, kIndexed, kPatches };

// What the options of either engine say alike.
struct Settings {
  explicit Settings(Options& options, const std::vector<std::string_view>& forms)
      : form(static_cast<Form>(options.choice("output", forms))) {
    tessellator.provenance = true;
    constexpr std::array kRepairs{fast::Repair::kStitch, fast::Repair::kFan, fast::Repair::kNone};
    tessellator.cracks.repair = kRepairs[options.choice("repair", {"stitch", "fan", "none"})];
  }
  Form form;
  bool wide = false;
  int frames = 0;  // before the one that is asked for, as patches
  fast::TessellatorOptions tessellator;
};

struct WindowSettings : Settings {
  template <class Real>
  using Engine = fast::Tessellator<Real>;
  static constexpr int kMaxDepth = fast::kDeepest;
  static constexpr bool kDoubles = true;

  explicit WindowSettings(Options& options) : Settings(options, {"strips", "indexed"}) {
    wide = options.choice("precision", {"float", "double"}) == 1;
    constexpr std::array kCentres{fast::FanCentre::kLimit, fast::FanCentre::kFlatLimit,
                                  fast::FanCentre::kFlatControl};
    tessellator.cracks.centre = kCentres[options.choice("centre", {"limit", "flat", "flat-control"})];
    if (options.choice("pairing", {"corrected", "printed"}) == 1) rules.pairing = fast::PairingRule::kPrinted;
  }
  template <class Real>
  std::unique_ptr<Engine<Real>> engine(const data::ControlMesh& mesh) const {
    return std::make_unique<Engine<Real>>(mesh, tessellator, rules);
  }
  fast::PrintedRules rules;
};

struct StreamSettings : Settings {
  template <class>
  using Engine = rs::StreamTessellator;
  static constexpr int kMaxDepth = rs::kMaxDepth;
  static constexpr bool kDoubles = false;

  explicit StreamSettings(Options& options) : Settings(options, {"strips", "indexed", "patches"}) {
    frames = options.integer("frames", 0, 0, 1000);
    if (frames > 0) form = Form::kPatches;
    const std::string target = options.value("target", rs::kernels().front().name);
    kernel = rs::find_kernel(target.c_str());
    if (kernel == nullptr) {
      std::string known;
      for (const rs::Kernel& k : rs::kernels()) known += (known.empty() ? "" : ", ") + std::string(k.name);
      throw SubjectError(LC_INVALID_INPUT, "target=" + target + ": this machine has " + known);
    }
  }
  template <class Real>
  std::unique_ptr<rs::StreamTessellator> engine(const data::ControlMesh& mesh) const {
    return std::make_unique<rs::StreamTessellator>(mesh, tessellator, *kernel);
  }
  const rs::Kernel* kernel = nullptr;
};

// Refuses, before anything is allocated, frames with more vertices than 32-bit indices name: a pair of 2 k^2
// triangles has at least (k + 1)^2. Faces that become fans have fewer and are counted as if they did not.
void refuse_too_many_vertices(std::span<const std::int32_t> depth) {
  std::int64_t triangles = 0;
  for (const std::int32_t d : depth)
    if (d >= 0) triangles += std::int64_t{1} << std::min(2 * d, 40);
  if (triangles / 2 > std::int64_t{UINT32_MAX})
    throw SubjectError(LC_NOT_SUPPORTED, "more vertices at these depths than 32-bit indices can name");
}

// Allocates the output of a frame and copies it.
//   corners   the scheme is Catmull-Clark's, whose faces may be larger than quads
template <class Real>
void deliver(const lc_request& request, lc_tessellation& out,
             const std::vector<fast::SurfaceVertex<Real>>& vertices,
             const std::vector<fast::LatticePoint>& provenance, const std::vector<std::uint32_t>& triangles,
             const std::vector<std::int32_t>& faces, bool corners) {
  const auto output = allocate_output<Real>(request, out, static_cast<std::int64_t>(vertices.size()),
                                            static_cast<std::int64_t>(faces.size()), true, corners);
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const auto& [position, normal] = vertices[v];
    for (std::size_t i = 3 * v; const Real x : {position.x, position.y, position.z})
      output.positions[i++] = x;
    for (std::size_t i = 3 * v; const Real x : {normal.x, normal.y, normal.z}) output.normals[i++] = x;
    output.provenance[v] = {provenance[v].face, provenance[v].i, provenance[v].j, provenance[v].denominator};
    if (corners) output.corner[v] = provenance[v].corner;
  }
  std::copy(triangles.begin(), triangles.end(), output.triangles);
  std::copy(faces.begin(), faces.end(), output.triangle_face);
}

// So many frames at other depths, where every fourth face has another one by 1, or is gone, at random; the
// control points are at half their size in the first half of them.
template <class Engine, class Real>
void walk(Engine& engine, const data::ControlMesh& mesh, std::span<const std::int32_t> depth, int frames,
          fast::PatchMesh<Real>& patches) {
  data::SplitMix64 random(static_cast<std::uint64_t>(frames));
  if (frames > 1) {
    std::vector<std::array<double, 3>> halved = mesh.positions;
    for (auto& p : halved)
      for (double& x : p) x /= 2;
    engine.move_points(halved);
  }
  for (int frame = 0; frame < frames; ++frame) {
    if (frames > 1 && frame == frames / 2) engine.move_points(mesh.positions);
    std::vector<std::int32_t> other(depth.begin(), depth.end());
    for (std::int32_t& d : other) {
      const std::uint64_t what = random.next() % 16;
      if (what < 4)
        d = what == 0 ? -1 : std::clamp<std::int32_t>(d + (what < 3 ? 1 : -1), -1, fast::kDeepest);
    }
    engine.frame(other, patches);
  }
}

template <class Chosen>
class EngineSubject {
 public:
  static lc_capabilities capabilities(Options& options, lc_scheme scheme) {
    const Chosen chosen(options);
    const bool exact = chosen.tessellator.cracks.centre == fast::FanCentre::kLimit;
    lc_capabilities result{chosen.wide ? LC_FLOAT64 : LC_FLOAT32,
                           LC_WEIGHTS_LOOP,
                           LC_BOUNDARY_SPLINE,
                           LC_POINTS_LIMIT,
                           Chosen::kMaxDepth,
                           1,
                           1,
                           exact ? 1 : 0};
    result.sharp = LC_SHARP_CREASES | LC_SHARP_CORNERS;
    if (scheme == LC_SCHEME_CATMULL_CLARK)
      result.sharp |= LC_SHARP_SEMI | LC_SHARP_CHAIKIN | LC_SHARP_SMOOTH_TRIANGLES;
    return result;
  }

  EngineSubject(const lc_mesh& mesh, Options& options) : chosen_(options), mesh_(control_mesh(mesh)) {
    chosen_.tessellator.scheme = scheme_of(mesh.scheme);
    use_threads(1);
  }

  void tessellate(const lc_request& request, lc_tessellation& out) {
    if (request.threads != chosen_.tessellator.threads) use_threads(request.threads);
    const std::span<const std::int32_t> depth(request.face_depth, mesh_.faces.size());
    refuse_too_many_vertices(depth);
    if constexpr (Chosen::kDoubles)
      if (double_) return run<double>(*double_, depth, request, out);
    run<float>(*float_, depth, request, out);
  }

 private:
  void use_threads(int threads) {
    chosen_.tessellator.threads = threads;
    try {
      if (chosen_.wide)
        double_ = chosen_.template engine<double>(mesh_);
      else
        float_ = chosen_.template engine<float>(mesh_);
    } catch (const data::ArgumentError& error) {
      throw SubjectError(LC_INVALID_INPUT, error.what());
    }
  }

  template <class Real>
  void run(fast::Engine<Real>& engine, std::span<const std::int32_t> depth, const lc_request& request,
           lc_tessellation& out) {
    const bool corners = chosen_.tessellator.scheme == data::Scheme::kCatmullClark;
    std::vector<std::uint32_t> triangles;
    std::vector<std::int32_t> faces;
    if (chosen_.form == Form::kIndexed) {
      fast::IndexedMesh<Real> mesh;
      engine.frame(depth, mesh);
      for (const auto& t : mesh.triangles) triangles.insert(triangles.end(), t.begin(), t.end());
      return deliver(request, out, mesh.vertices, mesh.provenance, triangles, mesh.triangle_face, corners);
    }
    if (chosen_.form == Form::kStrips) {
      fast::DrawList<Real> list;
      engine.frame(depth, list);
      for (const fast::Draw& draw : list.draws)
        for (std::int32_t t = 0; t < draw.triangle_count(); ++t) {
          faces.push_back(draw.face_of(t));
          for (const std::int32_t v : draw.triangle(t))
            triangles.push_back(static_cast<std::uint32_t>(draw.first + v));
        }
      return deliver(request, out, list.vertices, list.provenance, triangles, faces, corners);
    }
    if constexpr (std::is_same_v<Real, float>) {
      walk(engine, mesh_, depth, chosen_.frames, patches_);
      engine.frame(depth, patches_);
      // Vertices that no triangle has, such as those of patches that are not shown, are left out.
      constexpr std::uint32_t kUnused = UINT32_MAX;
      std::vector<fast::SurfaceVertex<Real>> vertices;
      std::vector<fast::LatticePoint> provenance;
      std::vector<std::uint32_t> number;
      for (const fast::PatchDraw& draw : patches_.draws()) {
        number.assign(static_cast<std::size_t>(draw.vertex_count), kUnused);
        for (std::uint32_t i = 0; i < draw.index_count; ++i) {
          const std::uint32_t v = patches_.indices()[draw.first_index + i];
          if (number[v] == kUnused) {
            const auto at = static_cast<std::size_t>(draw.base_vertex) + v;
            number[v] = static_cast<std::uint32_t>(vertices.size());
            vertices.push_back(patches_.vertices()[at]);
            provenance.push_back(patches_.provenance()[at]);
          }
          triangles.push_back(number[v]);
        }
        for (std::int32_t t = 0; t < draw.triangles; ++t)
          faces.push_back(t < draw.split ? draw.face : draw.face_after);
      }
      deliver(request, out, vertices, provenance, triangles, faces, corners);
    }
  }

  Chosen chosen_;
  data::ControlMesh mesh_;
  std::unique_ptr<typename Chosen::template Engine<float>> float_;
  std::unique_ptr<typename Chosen::template Engine<double>> double_;
  fast::PatchMesh<float> patches_{fast::PatchOptions{.incremental = true}};
};

// Delivers nothing and says so: zero vertices, zero triangles. Every check of an audit must fail on it, none may crash,
// and none may report an empty delivery as correct.
class NullSubject {
 public:
  static lc_capabilities capabilities(Options&) {
    return {LC_FLOAT64, LC_WEIGHTS_LOOP, LC_BOUNDARY_SPLINE, LC_POINTS_LIMIT, 10, 1, 1, 1};
  }
  NullSubject(const lc_mesh&, Options&) {}
  void tessellate(const lc_request& request, lc_tessellation& out) {
    allocate_output<double>(request, out, 0, 0, true);
  }
};

}  // namespace

const lc_subject* lc_subject_sliding_window() {
  static const lc_subject subject = make_subject<EngineSubject<WindowSettings>>(
      "sliding-window",
      "limitcheck's sliding window: pairs, strips and fans (Mueller & Havemann 2000); both schemes",
      "precision=float|double, output=strips|indexed, repair=stitch|fan|none, "
      "centre=limit|flat|flat-control, pairing=corrected|printed");
  return &subject;
}

const lc_subject* lc_subject_row_stream() {
  static const lc_subject subject = make_subject<EngineSubject<StreamSettings>>(
      "row-stream",
      "limitcheck's row streaming: one grid per vector lane, shared points bit-identical; both schemes",
      "output=strips|indexed|patches, frames=N (patches, after a walk of N frames), repair=stitch|fan|none, "
      "target=avx512|avx2|avx2/4|sse4|scalar|...");
  return &subject;
}

const lc_subject* lc_subject_null() {
  static const lc_subject subject =
      make_subject<NullSubject>("null", "delivers nothing: what every check must fail on");
  return &subject;
}
