// SPDX-License-Identifier: MIT
// Our own engine, audited through the plug-in interface like every other subject: pairing (of triangles; a
// quad is a grid by itself), sliding window, crack repair. As strips and fans (the default) every face and
// pair delivers its border points itself, so that their bits can be compared; as an indexed mesh they are
// shared. Cracks are stitched: the paper's fans leave out the points inside a face beside a deeper one, which
// every face that asks for them must have.
#include <cstdint>
#include <memory>
#include <span>
#include <variant>

#include "data/error.h"
#include "fast/plan/printed_rules.h"
#include "fast/window/tessellator.h"
#include "verify/peers/deliver_frame.h"
#include "verify/subject/adapter.h"
#include "verify/subject/control_mesh.h"
#include "verify/subject/registry.h"

namespace {

using namespace limitcheck;
using namespace limitcheck::verify;

struct Settings {
  explicit Settings(Options& options) {
    wide = options.choice("precision", {"float", "double"}) == 1;
    indexed = options.choice("output", {"strips", "indexed"}) == 1;
    tessellator.provenance = true;
    tessellator.cracks.repair =
        std::array{fast::Repair::kStitch, fast::Repair::kFan,
                   fast::Repair::kNone}[options.choice("repair", {"stitch", "fan", "none"})];
    tessellator.cracks.centre = std::array{
        fast::FanCentre::kLimit, fast::FanCentre::kFlatLimit,
        fast::FanCentre::kFlatControl}[options.choice("centre", {"limit", "flat", "flat-control"})];
    rules.pairing = options.choice("pairing", {"corrected", "printed"}) == 1 ? fast::PairingRule::kPrinted
                                                                             : fast::PairingRule::kCorrected;
  }
  bool wide = false, indexed = false;
  fast::TessellatorOptions tessellator;
  fast::PrintedRules rules;
};

class SlidingWindowSubject {
 public:
  static lc_capabilities capabilities(Options& options, lc_scheme scheme) {
    const Settings settings(options);
    lc_capabilities result{settings.wide ? LC_FLOAT64 : LC_FLOAT32,
                           LC_WEIGHTS_LOOP,
                           LC_BOUNDARY_SPLINE,
                           LC_POINTS_LIMIT,
                           fast::kDeepest,
                           1,
                           1,
                           settings.tessellator.cracks.centre == fast::FanCentre::kLimit ? 1 : 0};
    result.sharp = LC_SHARP_CREASES | LC_SHARP_CORNERS;
    if (scheme == LC_SCHEME_CATMULL_CLARK)
      result.sharp |= LC_SHARP_SEMI | LC_SHARP_CHAIKIN | LC_SHARP_SMOOTH_TRIANGLES;
    return result;
  }

  SlidingWindowSubject(const lc_mesh& mesh, Options& options)
      : settings_(options), mesh_(control_mesh(mesh)) {
    settings_.tessellator.scheme = scheme_of(mesh.scheme);
    use_threads(1);
  }

  void tessellate(const lc_request& request, lc_tessellation& out) {
    if (request.threads != settings_.tessellator.threads) use_threads(request.threads);
    const std::span<const std::int32_t> depth(request.face_depth, mesh_.faces.size());
    const bool corners = settings_.tessellator.scheme == data::Scheme::kCatmullClark;
    if (settings_.wide)
      deliver_frame<double>(*double_, depth, settings_.indexed, request, out, corners);
    else
      deliver_frame<float>(*float_, depth, settings_.indexed, request, out, corners);
  }

 private:
  void use_threads(int threads) {
    settings_.tessellator.threads = threads;
    try {
      if (settings_.wide)
        double_ = std::make_unique<fast::Tessellator<double>>(mesh_, settings_.tessellator, settings_.rules);
      else
        float_ = std::make_unique<fast::Tessellator<float>>(mesh_, settings_.tessellator, settings_.rules);
    } catch (const data::ArgumentError& error) {
      throw SubjectError(LC_INVALID_INPUT, error.what());
    }
  }

  Settings settings_;
  data::ControlMesh mesh_;
  std::unique_ptr<fast::Tessellator<float>> float_;
  std::unique_ptr<fast::Tessellator<double>> double_;
};

}  // namespace

const lc_subject* lc_subject_sliding_window() {
  static const lc_subject subject = make_subject<SlidingWindowSubject>(
      "sliding-window",
      "limitcheck's sliding window: pairs, strips and fans (Mueller & Havemann 2000); both schemes",
      "precision=float|double, output=strips|indexed, repair=stitch|fan|none, "
      "centre=limit|flat|flat-control, pairing=corrected|printed");
  return &subject;
}
