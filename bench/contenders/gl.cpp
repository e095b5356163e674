// SPDX-License-Identifier: MIT
#include <numeric>
#include <vector>

#include "bench/contenders/contender.h"
#include "fast/stream/row_stream.h"
#include "verify/gl/context.h"
#include "verify/gl/resident_points.h"

namespace limitcheck::bench {

namespace {

namespace rs = fast::row_stream;

class OnGpu final : public Contender {
 public:
  template <class Stream, class Item>
  OnGpu(const Stream& stream, const std::vector<Item>& items, int depth)
      : points_(stream.rings(), items, depth),
        evaluated_(static_cast<double>(items.size()) * rs::side(depth) * rs::side(depth)) {}

  void run() override { points_.run(); }
  double evaluated() const override { return evaluated_; }

 private:
  verify::ResidentPoints points_;
  double evaluated_;
};

std::unique_ptr<Contender> made(const data::ControlMesh& mesh, int depth) {
  if (data::natural_scheme(mesh) == data::Scheme::kCatmullClark) {
    const fast::QuadMesh quads(mesh);
    const rs::QuadRowStream stream(quads);
    std::vector<std::int32_t> faces(mesh.faces.size());
    std::iota(faces.begin(), faces.end(), 0);
    return std::make_unique<OnGpu>(stream, stream.sorted(faces), depth);
  }
  const fast::Adjacency adjacency(mesh);
  const std::vector<std::int32_t> depths(mesh.faces.size(), depth);
  return std::make_unique<OnGpu>(rs::RowStream(mesh, adjacency), fast::pair_faces(adjacency, depths).grids,
                                 depth);
}

}  // namespace

Route row_stream_by_gl() {
  { const verify::CurrentGl there_is_one; }
  const bool software = verify::gl_device().starts_with("llvmpipe");
  return {"row-stream/gl",
          "row streaming by " + verify::gl_device() + "; points stay in its memory",
          software ? 1000. : .1,
          24,
          false,
          [](const auto& mesh, int depth, int) { return made(mesh, depth); },
          true};
}

}  // namespace limitcheck::bench
