// SPDX-License-Identifier: MIT
#include <vector>

#include "bench/contenders/contender.h"
#include "verify/gl/context.h"
#include "verify/gl/resident_frame.h"

namespace limitcheck::bench {

namespace {

class OnGpu final : public Contender {
 public:
  OnGpu(const data::ControlMesh& mesh, int depth) : frame_(mesh, {.scheme = data::natural_scheme(mesh)}) {
    // Faces that are no quads are cut into quads a level less deep.
    const std::vector<std::int32_t> depths(mesh.faces.size(), depth);
    evaluated_ = static_cast<double>(frame_.plan(depths).limit_points);
  }

  void run() override { frame_.run(); }
  double evaluated() const override { return evaluated_; }

 private:
  verify::ResidentFrame frame_;
  double evaluated_;
};

}  // namespace

Route row_stream_by_gl() {
  { const verify::CurrentGl there_is_one; }
  const bool software = verify::gl_device().starts_with("llvmpipe");
  return {"row-stream/gl",
          "row streaming by " + verify::gl_device() + "; points stay in its memory",
          software ? 1000. : .1,
          24,
          false,
          maker<OnGpu>(),
          true};
}

}  // namespace limitcheck::bench
