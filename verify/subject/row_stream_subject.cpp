// SPDX-License-Identifier: MIT
// Row streaming as a subject, of both schemes. As strips and fans (the default) every face and pair delivers
// its border points itself, so that their bits can be compared; as an indexed mesh they are shared. `target`
// forces one compiled variant.
#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include "data/error.h"
#include "fast/stream/stream_tessellator.h"
#include "verify/subject/adapter.h"
#include "verify/subject/control_mesh.h"
#include "verify/subject/deliver_frame.h"
#include "verify/subject/registry.h"

namespace {

using namespace limitcheck;
using namespace limitcheck::verify;
namespace rs = limitcheck::fast::row_stream;

struct Settings {
  explicit Settings(Options& options) {
    indexed = options.choice("output", {"strips", "indexed"}) == 1;
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
  bool indexed = false;
  fast::TessellatorOptions tessellator;
  const rs::Kernel* kernel = nullptr;
};

class RowStreamSubject {
 public:
  static lc_capabilities capabilities(Options& options, lc_scheme scheme) {
    const Settings settings(options);
    lc_capabilities result{
        LC_FLOAT32, LC_WEIGHTS_LOOP, LC_BOUNDARY_SPLINE, LC_POINTS_LIMIT, rs::kMaxDepth, 1, 1, 1};
    if (scheme == LC_SCHEME_CATMULL_CLARK)
      result.sharp = LC_SHARP_CREASES | LC_SHARP_CORNERS | LC_SHARP_SMOOTH_TRIANGLES;
    return result;
  }

  RowStreamSubject(const lc_mesh& mesh, Options& options) : settings_(options), mesh_(control_mesh(mesh)) {
    settings_.tessellator.scheme = scheme_of(mesh.scheme);
    use_threads(1);
  }

  void tessellate(const lc_request& request, lc_tessellation& out) {
    if (request.threads != settings_.tessellator.threads) use_threads(request.threads);
    deliver_frame<float>(*tessellator_, {request.face_depth, mesh_.faces.size()}, settings_.indexed, request,
                         out, settings_.tessellator.scheme == data::Scheme::kCatmullClark);
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
};

}  // namespace

const lc_subject* lc_subject_row_stream() {
  static const lc_subject subject = make_subject<RowStreamSubject>(
      "row-stream",
      "limitcheck's row streaming: one grid per vector lane, shared points bit-identical; both schemes",
      "output=strips|indexed, repair=stitch|fan|none, target=avx512|avx2|avx2/4|sse4|scalar|...");
  return &subject;
}
