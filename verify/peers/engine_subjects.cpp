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
//   row-stream-gl    the same, its points computed on a GPU (fast/gpu), by OpenGL.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "data/error.h"
#include "data/splitmix64.h"
#include "fast/frame/patch_mesh.h"
#include "fast/frame/sink.h"
#include "fast/plan/depth.h"
#include "fast/plan/printed_rules.h"
#include "fast/stream/stream_tessellator.h"
#include "fast/window/tessellator.h"
#include "verify/gl/context.h"
#include "verify/gl/recorded_points.h"
#include "verify/subject/adapter.h"
#include "verify/subject/devices.h"
#include "verify/subject/registry.h"

namespace {

using namespace limitcheck;
using namespace limitcheck::verify;
namespace rs = limitcheck::fast::row_stream;

enum class Kind { kWindow, kStream, kStreamGl };

enum class Form { kStrips, kIndexed, kPatches };

// What the options of an engine say.
struct Settings {
  Settings(Options& options, Kind kind) {
    std::vector<std::string_view> forms{"strips", "indexed", "patches"};
    if (kind == Kind::kWindow) forms.pop_back();
    form = static_cast<Form>(options.choice("output", forms));
    tessellator.provenance = true;
    constexpr std::array kRepairs{fast::Repair::kStitch, fast::Repair::kFan, fast::Repair::kNone};
    tessellator.cracks.repair = kRepairs[options.choice("repair", {"stitch", "fan", "none"})];
    kind == Kind::kWindow ? read_window(options) : read_stream(options, kind == Kind::kStreamGl);
  }

  Form form;
  fast::TessellatorOptions tessellator;
  // Of the sliding window.
  bool wide = false;
  fast::PrintedRules rules;
  // Of row streaming.
  int frames = 0;  // before the one that is asked for, as patches
  const rs::Kernel* kernel = nullptr;
  const rs::QuadKernel* quads = nullptr;  // null: that of the same name

 private:
  void read_window(Options& options) {
    wide = options.choice("precision", {"float", "double"}) == 1;
    constexpr std::array kCentres{fast::FanCentre::kLimit, fast::FanCentre::kFlatLimit,
                                  fast::FanCentre::kFlatControl};
    tessellator.cracks.centre = kCentres[options.choice("centre", {"limit", "flat", "flat-control"})];
    if (options.choice("pairing", {"corrected", "printed"}) == 1) rules.pairing = fast::PairingRule::kPrinted;
  }
  void read_stream(Options& options, bool by_gl) {
    frames = options.integer("frames", 0, 0, 1000);
    if (frames > 0) form = Form::kPatches;
    if (by_gl) {
      { const CurrentGl there_is_one; }
      kernel = &FrameRecorder::triangles(), quads = &FrameRecorder::quads();
      Devices::note("row-stream-gl", gl_device());
      return;
    }
    const std::string target = options.value("target", rs::kernels().front().name);
    kernel = rs::find_kernel(target.c_str());
    if (kernel != nullptr) return;
    std::string known;
    for (const rs::Kernel& k : rs::kernels()) known += (known.empty() ? "" : ", ") + std::string(k.name);
    throw SubjectError(LC_INVALID_INPUT, "target=" + target + ": this machine has " + known);
  }
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

template <class Real>
void add(DeliveredArrays& all, const fast::SurfaceVertex<Real>& vertex, const fast::LatticePoint& at) {
  all.add_vertex(vertex.position, vertex.normal, {at.face, at.i, at.j, at.denominator}, at.corner);
}

// So many frames at other depths, where every fourth face has another one by 1, or is gone, at random; the
// control points are at half their size in the first half of them.
//   show   makes a frame of the engine's at these depths, to `deepest`
void walk(fast::Engine<float>& engine, const data::ControlMesh& mesh, std::span<const std::int32_t> depth,
          int frames, int deepest, const auto& show) {
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
      if (what < 4) d = what == 0 ? -1 : std::clamp<std::int32_t>(d + (what < 3 ? 1 : -1), -1, deepest);
    }
    show(other);
  }
}

template <Kind kKind>
class EngineSubject {
  static constexpr bool kWindow = kKind == Kind::kWindow;
  static constexpr int kMaxDepth = kKind == Kind::kStreamGl ? fast::gpu::kMaxDepth : fast::kDeepest;

 public:
  static lc_capabilities capabilities(Options& options, lc_scheme scheme) {
    const Settings chosen(options, kKind);
    const bool exact = chosen.tessellator.cracks.centre == fast::FanCentre::kLimit;
    lc_capabilities result{chosen.wide ? LC_FLOAT64 : LC_FLOAT32,
                           LC_WEIGHTS_LOOP,
                           LC_BOUNDARY_SPLINE,
                           LC_POINTS_LIMIT,
                           kMaxDepth,
                           1,
                           1,
                           exact ? 1 : 0};
    result.sharp = LC_SHARP_CREASES | LC_SHARP_CORNERS;
    if (scheme == LC_SCHEME_CATMULL_CLARK)
      result.sharp |= LC_SHARP_SEMI | LC_SHARP_CHAIKIN | LC_SHARP_SMOOTH_TRIANGLES;
    return result;
  }

  EngineSubject(const lc_mesh& mesh, Options& options) : chosen_(options, kKind), mesh_(control_mesh(mesh)) {
    chosen_.tessellator.scheme = scheme_of(mesh.scheme);
    use_threads(1);
  }

  void tessellate(const lc_request& request, lc_tessellation& out) {
    if (request.threads != chosen_.tessellator.threads) use_threads(request.threads);
    const std::span<const std::int32_t> depth(request.face_depth, mesh_.faces.size());
    refuse_too_many_vertices(depth);
    const bool corners = chosen_.tessellator.scheme == data::Scheme::kCatmullClark;
    const DeliveredArrays made = double_                          ? frame(*double_, depth)
                                 : chosen_.form == Form::kPatches ? patches(depth)
                                                                  : frame(*float_, depth);
    double_ ? made.hand_over<double>(request, out, true, corners)
            : made.hand_over<float>(request, out, true, corners);
  }

 private:
  void use_threads(int threads) {
    chosen_.tessellator.threads = threads;
    const fast::TessellatorOptions& options = chosen_.tessellator;
    try {
      if (!kWindow)
        float_ = std::make_shared<rs::StreamTessellator>(mesh_, options, *chosen_.kernel, chosen_.quads);
      else if (chosen_.wide)
        double_ = std::make_shared<fast::Tessellator<double>>(mesh_, options, chosen_.rules);
      else
        float_ = std::make_shared<fast::Tessellator<float>>(mesh_, options, chosen_.rules);
    } catch (const data::ArgumentError& error) {
      throw SubjectError(LC_INVALID_INPUT, error.what());
    }
  }

  template <class Real, class Output>
  static void make(fast::Engine<Real>& engine, std::span<const std::int32_t> depth, Output& out) {
    if constexpr (kKind == Kind::kStreamGl && std::is_same_v<Real, float>)
      frame_by_gl(engine, out, depth);
    else
      engine.frame(depth, out);
  }

  template <class Real>
  DeliveredArrays frame(fast::Engine<Real>& engine, std::span<const std::int32_t> depth) const {
    DeliveredArrays all;
    const auto add_vertices = [&](const auto& of) {
      for (std::size_t v = 0; v < of.vertices.size(); ++v) add(all, of.vertices[v], of.provenance[v]);
    };
    if (chosen_.form == Form::kIndexed) {
      fast::IndexedMesh<Real> mesh;
      make(engine, depth, mesh);
      add_vertices(mesh);
      all.triangles = std::move(mesh.triangles);
      all.triangle_face = std::move(mesh.triangle_face);
      return all;
    }
    fast::DrawList<Real> list;
    make(engine, depth, list);
    add_vertices(list);
    for (const fast::Draw& draw : list.draws)
      for (std::int32_t t = 0; t < draw.triangle_count(); ++t) {
        const auto [a, b, c] = draw.triangle(t);
        const auto vertex = [&](std::int32_t v) { return static_cast<std::uint32_t>(draw.first + v); };
        all.add_triangle({vertex(a), vertex(b), vertex(c)}, draw.face_of(t));
      }
    return all;
  }

  // Vertices that no triangle has, such as those of patches that are not shown, are left out.
  DeliveredArrays patches(std::span<const std::int32_t> depth) {
    const auto show = [&](std::span<const std::int32_t> depths) { make(*float_, depths, patches_); };
    walk(*float_, mesh_, depth, chosen_.frames, kMaxDepth, show);
    show(depth);
    constexpr std::uint32_t kUnused = UINT32_MAX;
    DeliveredArrays all;
    std::vector<std::uint32_t> number;
    for (const fast::PatchDraw& draw : patches_.draws()) {
      number.assign(static_cast<std::size_t>(draw.vertex_count), kUnused);
      std::array<std::uint32_t, 3> triangle{};
      for (std::uint32_t i = 0; i < draw.index_count; ++i) {
        const std::uint32_t v = patches_.indices()[draw.first_index + i];
        if (number[v] == kUnused) {
          const auto at = static_cast<std::size_t>(draw.base_vertex) + v;
          number[v] = static_cast<std::uint32_t>(all.positions.size());
          add(all, patches_.vertices()[at], patches_.provenance()[at]);
        }
        triangle[i % 3] = number[v];
        const auto t = static_cast<std::int32_t>(i / 3);
        if (i % 3 == 2) all.add_triangle(triangle, t < draw.split ? draw.face : draw.face_after);
      }
    }
    return all;
  }

  Settings chosen_;
  data::ControlMesh mesh_;
  // The one that the settings ask for; shared because only its own type can be deleted.
  std::shared_ptr<fast::Engine<float>> float_;
  std::shared_ptr<fast::Engine<double>> double_;
  fast::PatchMesh<float> patches_{fast::PatchOptions{.incremental = true}};
};

// Delivers nothing and says so: zero vertices, zero triangles. Every check of an audit must fail on it, none may crash,
// and none may report an empty delivery as correct.
class NullSubject {
 public:
  static constexpr std::int32_t kSchemes = LC_DOES_LOOP;

  static lc_capabilities capabilities(Options&, lc_scheme) {
    return {LC_FLOAT64, LC_WEIGHTS_LOOP, LC_BOUNDARY_SPLINE, LC_POINTS_LIMIT, 10, 1, 1, 1};
  }
  NullSubject(const lc_mesh&, Options&) {}
  void tessellate(const lc_request& request, lc_tessellation& out) {
    allocate_output<double>(request, out, 0, 0, true);
  }
};

}  // namespace

const lc_subject* lc_subject_sliding_window() {
  static const lc_subject subject = make_subject<EngineSubject<Kind::kWindow>>(
      "sliding-window",
      "limitcheck's sliding window: pairs, strips and fans (Mueller & Havemann 2000); both schemes",
      "precision=float|double, output=strips|indexed, repair=stitch|fan|none, "
      "centre=limit|flat|flat-control, pairing=corrected|printed");
  return &subject;
}

const lc_subject* lc_subject_row_stream() {
  static const lc_subject subject = make_subject<EngineSubject<Kind::kStream>>(
      "row-stream",
      "limitcheck's row streaming: one grid per vector lane, shared points bit-identical; both schemes",
      "output=strips|indexed|patches, frames=N (patches, after a walk of N frames), repair=stitch|fan|none, "
      "target=avx512|avx2|avx2/4|sse4|scalar|...");
  return &subject;
}

const lc_subject* lc_subject_row_stream_gl() {
  static const lc_subject subject = make_subject<EngineSubject<Kind::kStreamGl>>(
      "row-stream-gl",
      "limitcheck's row streaming as compute shaders, by OpenGL: one grid per work group; both schemes",
      "output=strips|indexed|patches, frames=N (patches, after a walk of N frames), repair=stitch|fan|none");
  return lack_of_gl().empty() ? &subject : nullptr;
}

const lc_subject* lc_subject_null() {
  static const lc_subject subject =
      make_subject<NullSubject>("null", "delivers nothing: what every check must fail on");
  return &subject;
}
