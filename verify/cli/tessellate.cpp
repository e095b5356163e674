// SPDX-License-Identifier: MIT
// limitcheck tessellate: the engine of fast/ as a program, from a control mesh to a file of triangles with
// normals.
#include <tbb/info.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>

#include "data/numeral.h"
#include "fast/stream/stream_tessellator.h"
#include "fast/window/tessellator.h"
#include "verify/cli/commands.h"
#include "verify/cli/mesh_options.h"
#include "verify/cli/screen.h"
#include "verify/gl/context.h"
#include "verify/gl/recorded_points.h"
#include "verify/host/host.h"
#include "verify/mesh_output/mesh_output.h"

namespace limitcheck::cli {
namespace {

struct TessellateArguments {
  data::ReadOptions scheme;
  std::string mesh, output, camera, viewport = "1024x768", colour;
  std::vector<double> angles{30};
  std::optional<fast::Strategy> strategy;
  std::optional<int> max_depth;
  fast::DepthOptions depths;
  fast::TessellatorOptions engine;
  fast::Camera view;
  bool sliding_window = false, json = false, view_given = false, cull = false, gpu = false;
};

const Words<std::optional<fast::Strategy>> kStrategies{{"uniform", fast::Strategy::kUniform},
                                                       {"random", fast::Strategy::kRandom},
                                                       {"project-sphere", fast::Strategy::kProjectSphere},
                                                       {"curvature", fast::Strategy::kCurvature},
                                                       {"combined", fast::Strategy::kCombined}};
const Words<bool> kEngines{{"row-stream", false}, {"sliding-window", true}};

fast::Camera camera(const TessellateArguments& a) {
  const auto refuse = [](const char* option, const std::string& text) {
    throw CLI::ValidationError(option, fmt::format("cannot read '{}'", text));
  };
  fast::Camera result = a.view;
  fast::Point3* const points[] = {&result.eye, &result.target, &result.up};
  const std::vector<std::string> given = CLI::detail::split(a.camera, ':');
  if (given.size() > std::size(points) || a.camera.ends_with(':')) refuse("--camera", a.camera);
  for (std::size_t k = 0; !a.camera.empty() && k < given.size(); ++k) {
    const std::vector<std::string> numbers = CLI::detail::split(given[k], ',');
    if (numbers.size() != 3 || given[k].ends_with(',')) refuse("--camera", given[k]);
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (!CLI::detail::lexical_cast(numbers[axis], (*points[k])[axis])) refuse("--camera", given[k]);
  }
  if (data::read_numbers(a.viewport, 'x', result.width, result.height) != 2 ||
      std::max(result.width, result.height) > 1'000'000)
    refuse("--viewport", a.viewport);
  return result;
}

fast::DepthOptions depth_options(const TessellateArguments& a) {
  fast::DepthOptions options = a.depths;
  options.strategy = a.strategy.value_or(a.view_given ? fast::Strategy::kCombined : fast::Strategy::kUniform);
  options.angle_front = a.angles.front();
  options.angle_silhouette = a.angles.size() > 1 ? a.angles[1] : a.angles[0];
  options.angle_back = a.angles.size() > 2 ? a.angles[2] : a.angles[0];
  return options;
}

struct Timings {
  double read = 0, prepare = 0, write = 0;
};

nlohmann::ordered_json report(const TessellateArguments& a, const MeshScheme& chosen,
                              const fast::FrameStats& s, const fast::DepthOptions& options,
                              const Timings& t) {
  return {{"mesh", a.mesh},
          {"scheme", name_of(chosen.scheme)},
          {"faces_cut", chosen.cut},
          {"output", a.output.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(a.output)},
          {"engine", word_of(kEngines, a.sliding_window)},
          {"device", a.gpu ? nlohmann::ordered_json(verify::gl_device()) : nlohmann::ordered_json(nullptr)},
          {"strategy", std::string(fast::name(options.strategy))},
          {"seed", options.seed},
          {"faces", s.faces},
          {"pairs", s.pairs},
          {"singletons", s.singletons},
          {"fans", s.fans},
          {"stitched", s.stitched},
          {"culled", s.culled},
          {"triangles", s.triangles},
          {"vertices", s.vertices},
          {"limit_points", s.limit_points},
          {"zero_normals", s.zero_normals},
          {"seconds",
           {{"read", t.read},
            {"prepare", t.prepare},
            {"heuristics", s.seconds_heuristics},
            {"pairing", s.seconds_pairing},
            {"planning", s.seconds_planning},
            {"evaluation", s.seconds_evaluation},
            {"frame", s.seconds_total},
            {"write", t.write}}}};
}

std::string summary(const TessellateArguments& a, const fast::FrameStats& s, const Timings& t) {
  return fmt::format(
      "{}{}: {} faces: {} pairs, {} singletons, {} fans, {} culled; {} triangles, {} vertices{}\n"
      "milliseconds: read {:.1f}, prepare {:.1f}, heuristics {:.1f}, pairing {:.1f}, planning {:.1f}, "
      "evaluation {:.1f}, write {:.1f}\n",
      a.mesh, a.output.empty() ? "" : " -> " + a.output, s.faces, s.pairs, s.singletons, s.fans, s.culled,
      s.triangles, s.vertices,
      s.zero_normals > 0 ? fmt::format(", {} substitute normals", s.zero_normals) : "", 1e3 * t.read,
      1e3 * t.prepare, 1e3 * s.seconds_heuristics, 1e3 * s.seconds_pairing, 1e3 * s.seconds_planning,
      1e3 * s.seconds_evaluation, 1e3 * t.write);
}

struct Outcome {
  fast::FrameStats stats;
  fast::IndexedMesh<float> mesh;
  std::vector<std::int32_t> depth;  // per face, as shown
};

/// Seconds since it was last asked.
class Lap {
 public:
  double operator()() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

// Throws data::ArgumentError where there is none.
void require_gl() try { const verify::CurrentGl there_is_one; } catch (const std::runtime_error& error) {
  throw data::ArgumentError(fmt::format("--gpu: {}", error.what()));
}

Outcome run(const TessellateArguments& a, const OpenedMesh& opened, const fast::DepthOptions& options,
            const fast::Camera& view, Progress& progress, Lap& lap, Timings& timings) {
  const data::ControlMesh& mesh = opened.mesh;
  fast::TessellatorOptions engine = a.engine;
  engine.scheme = opened.chosen.scheme;
  engine.threads = std::min(engine.threads, tbb::info::default_concurrency());
  engine.max_depth = a.max_depth.value_or(std::max(engine.max_depth, a.depths.depth));
  Outcome out;
  const auto frame = [&](auto&& tessellator) {
    timings.prepare = lap();
    out.stats = a.gpu ? verify::frame_by_gl(tessellator, out.mesh, options, view)
                      : tessellator.frame(options, view, out.mesh);
    out.depth = tessellator.last_pairing().depth;
    lap();
    return std::move(out);
  };
  if (a.sliding_window) return frame(fast::Tessellator<float>(mesh, engine));
  namespace rs = fast::row_stream;
  if (a.gpu) require_gl();
  rs::StreamTessellator stream(mesh, engine,
                               a.gpu ? verify::FrameRecorder::triangles() : rs::kernels().front(),
                               a.gpu ? &verify::FrameRecorder::quads() : nullptr);
  const std::string text = fmt::format("tessellating {} faces", mesh.faces.size());
  stream.on_progress(
      [&](std::size_t done, std::size_t total) { progress.show(total + done, 3 * total, text); });
  return frame(stream);
}

int tessellate(const TessellateArguments& a) {
  Lap lap;
  const fast::DepthOptions options = depth_options(a);
  const fast::Camera view = camera(a);
  view.validate();
  if (!a.output.empty()) verify::check_extension(a.output);  // before any work

  Progress progress;
  Timings timings;
  progress.show(0, 3, "reading " + a.mesh);
  const OpenedMesh opened = open_control_mesh(a.mesh, a.scheme);
  const data::ControlMesh& mesh = opened.mesh;
  verify::require_range(a.mesh, mesh, false);
  timings.read = lap();

  progress.clear();
  progress.show(1, 3, fmt::format("tessellating {} faces", mesh.faces.size()));
  const Outcome outcome = run(a, opened, options, view, progress, lap, timings);
  const fast::FrameStats& stats = outcome.stats;

  if (!a.output.empty()) {
    progress.clear();
    progress.show(2, 3, fmt::format("writing {} triangles to {}", stats.triangles, a.output));
    verify::Colouring colouring;
    if (a.colour == "depth") colouring = verify::colour_by_depth(outcome.mesh, outcome.depth);
    if (a.colour == "kind") colouring = verify::colour_by_kind(outcome.mesh);
    verify::write_tessellation(a.output, outcome.mesh, colouring);
    timings.write = lap();
  }
  progress.clear();
  if (!a.output.empty() && !mesh.channels.empty())
    say(stderr, "note: channels are not tessellated: {} has none\n", a.output);

  if (stats.culled == stats.faces) {
    say(stderr, "limitcheck: nothing to show: all {} faces are seen from behind (is the camera inside?)\n",
        stats.faces);
  }
  if (a.json) {
    say("{}", dumped(report(a, opened.chosen, stats, options, timings), 2));
  } else {
    say("{}\n{}", scheme_line({opened.chosen}, a.scheme), summary(a, stats, timings));
  }
  return kHeld;
}

}  // namespace

void add_tessellate(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand(
      "tessellate",
      "Tessellate a control mesh: limitcheck tessellate bumpy:800 -o out.glb --camera 0,0,4:0,0,0");
  auto a = std::make_shared<TessellateArguments>();
  command
      ->add_option("MESH", a->mesh,
                   "A file (OBJ, OFF, PLY, STL, USD, glTF) or a name (see limitcheck generate --list)")
      ->required();
  add_mesh_options(*command, a->scheme);
  add_value(*command, "-o,--output", a->output, "FILE",
            "The file: .ply, .obj or .glb; without it, only the statistics");
  add_number(*command, "--depth", a->depths.depth, 0, fast::kDeepest,
             "Subdivision depth; the largest one of random");
  add_words(*command, "--strategy", a->strategy, kStrategies,
            "uniform, random, project-sphere, curvature, combined; default uniform, or combined if a view is "
            "given");
  add_words(*command, "--engine", a->sliding_window, kEngines,
            "row-stream, or sliding-window: the paper's engine, one pair or quad after the other");
  command
      ->add_flag(
          "--gpu", a->gpu,
          "Compute the points on a graphics card, by OpenGL, to depth 8; edges between unequal depths, too. "
          "Faces at sharp edges inside a surface of triangles, or at semi-sharp ones, stay on the processor")
      ->excludes("--engine");
  auto* eye =
      command->add_option("--camera", a->camera, "EYE[:TARGET[:UP]], as in 0,0,4:0,0,0:0,1,0 (the default)")
          ->check(kNotEmpty);
  auto* pixels = add_number(*command, "--pixels", a->depths.target_pixels, 1e-6, 1e6,
                            "project-sphere: largest size of a triangle on the screen");
  auto* angles =
      command->add_option("--angle", a->angles, "curvature: degrees tolerated, FRONT[,SILHOUETTE[,BACK]]")
          ->delimiter(',')
          ->expected(1, 3)
          ->check(CLI::Range(1e-6, 180.));
  command->add_option("--viewport", a->viewport, "WIDTHxHEIGHT in pixels")->capture_default_str();
  add_number(*command, "--fov", a->view.field_of_view, 1e-3, 179.999, "Vertical field of view, degrees");
  command
      ->add_option("--max-depth", a->max_depth,
                   "No face gets a larger depth; default 5, or --depth if that is larger")
      ->check(CLI::Range(0, fast::kDeepest));
  auto* cull = command->add_flag(
      "--cull,!--no-cull", a->cull,
      "Leave out faces whose corners all face away; default: if the strategy depends on the view");
  using fast::FanCentre, fast::Repair;
  fast::CrackOptions& cracks = a->engine.cracks;
  add_words(*command, "--centre", cracks.centre,
            {{"limit", FanCentre::kLimit}, {"flat", FanCentre::kFlatControl}},
            "Centre of a fan: on the limit surface, or the mean of the face's corners");
  add_words(*command, "--repair", cracks.repair, {{"fan", Repair::kFan}, {"stitch", Repair::kStitch}},
            "Where depths differ: the paper's fan, or stitch the outer ring only");
  add_number(*command, "--threads", a->engine.threads, 0, 4096,
             "At most so many, 0: all; the result is the same");
  command->add_option("--seed", a->depths.seed, "Seed of the random strategy")
      ->check(kSeed)
      ->capture_default_str();
  command
      ->add_option("--colour,--color", a->colour,
                   "Colour the triangles by depth or by kind (pair or quad, singleton, fan)")
      ->check(CLI::IsMember({"depth", "kind"}));
  command->add_flag("--json", a->json, "Print counts and seconds as one JSON document");
  command->callback([=, &exit_code] {
    if (cull->count() > 0) a->depths.cull = a->cull;
    a->view_given = eye->count() + pixels->count() + angles->count() > 0;
    exit_code = tessellate(*a);
  });
}

}  // namespace limitcheck::cli
