// SPDX-License-Identifier: MIT
// Row streaming as a subject, of both schemes. As strips and fans (the default) every face and pair delivers
// its border points itself, so that their bits can be compared; as an indexed mesh they are shared. As
// patches, which stay in their places as long as they are as they were, frames=N walks through N frames of
// other depths and control points before the one that is asked for. (Not with sticky pairs: what these deliver depends on the
// frames before, which the audit's check of state finds.) `target` forces one compiled variant.
#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "data/error.h"
#include "fast/stream/stream_tessellator.h"
#include "verify/peers/deliver_frame.h"
#include "verify/peers/frame_walk.h"
#include "verify/subject/adapter.h"
#include "verify/subject/control_mesh.h"
#include "verify/subject/registry.h"

namespace {

using namespace limitcheck;
using namespace limitcheck::verify;
namespace rs = limitcheck::fast::row_stream;

struct Settings {
  explicit Settings(Options& options) {
    output = static_cast<Output>(options.choice("output", {"strips", "indexed", "patches"}));
    frames = options.integer("frames", 0, 0, 1000);
    if (frames > 0) output = Output::kPatches;
    tessellator.provenance = true;
    constexpr std::array kRepairs{fast::Repair::kStitch, fast::Repair::kFan, fast::Repair::kNone};
    tessellator.cracks.repair = kRepairs[options.choice("repair", {"stitch", "fan", "none"})];
    const std::string target = options.value("target", rs::kernels().front().name);
    kernel = rs::find_kernel(target.c_str());
    if (kernel == nullptr) {
      std::string known;
      for (const rs::Kernel& k : rs::kernels()) known += (known.empty() ? "" : ", ") + std::string(k.name);
      throw SubjectError(LC_INVALID_INPUT, "target=" + target + ": this machine has " + known);
    }
  }
  enum class Output { kStrips, kIndexed, kPatches };
  Output output = Output::kStrips;
  int frames = 0;
  fast::TessellatorOptions tessellator;
  const rs::Kernel* kernel = nullptr;
};

class RowStreamSubject {
 public:
  static lc_capabilities capabilities(Options& options, lc_scheme scheme) {
    const Settings settings(options);
    lc_capabilities result{
        LC_FLOAT32, LC_WEIGHTS_LOOP, LC_BOUNDARY_SPLINE, LC_POINTS_LIMIT, rs::kMaxDepth, 1, 1, 1};
    result.sharp = LC_SHARP_CREASES | LC_SHARP_CORNERS;
    if (scheme == LC_SCHEME_CATMULL_CLARK)
      result.sharp |= LC_SHARP_SEMI | LC_SHARP_CHAIKIN | LC_SHARP_SMOOTH_TRIANGLES;
    return result;
  }

  RowStreamSubject(const lc_mesh& mesh, Options& options) : settings_(options), mesh_(control_mesh(mesh)) {
    settings_.tessellator.scheme = scheme_of(mesh.scheme);
    use_threads(1);
  }

  void tessellate(const lc_request& request, lc_tessellation& out) {
    if (request.threads != settings_.tessellator.threads) use_threads(request.threads);
    const std::span<const std::int32_t> depth(request.face_depth, mesh_.faces.size());
    const bool quads = settings_.tessellator.scheme == data::Scheme::kCatmullClark;
    if (settings_.output != Settings::Output::kPatches)
      return deliver_frame<float>(*tessellator_, depth, settings_.output == Settings::Output::kIndexed,
                                  request, out, quads);
    refuse_too_many_vertices(depth);
    walk(*tessellator_, mesh_, depth, settings_.frames, patches_);
    tessellator_->frame(depth, patches_);
    deliver_patches(PatchView<float>::of(patches_), request, out, quads);
  }

 private:
  void use_threads(int threads) {
    settings_.tessellator.threads = threads;
    try {
      tessellator_ = std::make_unique<rs::StreamTessellator>(mesh_, settings_.tessellator, *settings_.kernel);
    } catch (const data::ArgumentError& error) {
      throw SubjectError(LC_INVALID_INPUT, error.what());
    }
  }

  Settings settings_;
  data::ControlMesh mesh_;
  std::unique_ptr<rs::StreamTessellator> tessellator_;
  fast::PatchMesh<float> patches_{fast::PatchOptions{.incremental = true}};
};

}  // namespace

const lc_subject* lc_subject_row_stream() {
  static const lc_subject subject = make_subject<RowStreamSubject>(
      "row-stream",
      "limitcheck's row streaming: one grid per vector lane, shared points bit-identical; both schemes",
      "output=strips|indexed|patches, frames=N (patches, after a walk of N frames), repair=stitch|fan|none, "
      "target=avx512|avx2|avx2/4|sse4|scalar|...");
  return &subject;
}
