// SPDX-License-Identifier: MIT
#include "fast/stream/stream_tessellator.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "fast/frame/engine_state.h"
#include "fast/stream/host/quad_stream_state.h"
#include "fast/stream/host/stream_hooks.h"
#include "fast/stream/host/stream_worker.h"
#include "fast/stream/kernel/output_targets.h"

namespace limitcheck::fast::row_stream {

namespace {

static_assert(kMaxDepth == kDeepest);

// The variant of four lanes of the same instructions, or the kernel itself.
const Kernel& narrow_of(const Kernel& kernel) {
  const Kernel* narrow = kernel.lanes > 4 ? find_kernel((std::string(kernel.name) + "/4").c_str()) : nullptr;
  return narrow != nullptr ? *narrow : kernel;
}

}  // namespace

struct StreamTessellator::State final : EngineState<float>, StreamHooks {
  State(const data::ControlMesh& given, const TessellatorOptions& with, const Kernel& kernel)
      : EngineState<float>(given, with, PrintedRules{}),
        stream(triangles, kernel),
        narrow(narrow_of(kernel)) {}

  void points_moved() override {
    EngineState<float>::points_moved();
    stream.move_points(triangles);
    if (options.cracks.centre == FanCentre::kFlatLimit) control.reset();
    if (control) control->move_points(control_points());
    centres.clear();
  }

  void prepare() override {
    if (plan.fans > 0 && !control) {
      if (options.cracks.centre == FanCentre::kFlatLimit)
        control.emplace(adjacency, control_points(), triangles.kinds());
      else
        control.emplace(adjacency, control_points(), triangles.kinds(), PreparedMesh<float>::WithoutLimits());
    }
    if (plan.fans > 0) centres.resize(static_cast<std::size_t>(adjacency.face_count()));
    worker_bytes = 0;
  }

  // The centres of fans are no lattice points; they come from the sliding window's own rules.
  std::vector<Vec3<float>> control_points() const {
    std::vector<Vec3<float>> positions;
    positions.reserve(static_cast<std::size_t>(adjacency.vertex_count()));
    for (std::int32_t v = 0; v < adjacency.vertex_count(); ++v) {
      const auto& p = stream.rings().points()[v];
      positions.push_back({p[0], p[1], p[2]});
    }
    return positions;
  }

  void draw(std::size_t first, std::size_t last, DrawList<float>& out) override {
    stores = stores_of(out);
    const std::size_t count = last - first;
    run(std::span<const Grid>(pairing.grids).subspan(first, count),
        std::span<const Patch>(patches).subspan(first, count), [&](std::size_t i, StreamWorker& worker) {
          return draw_writer(first, first + i, out, worker.scratch());
        });
  }
  void index(const IndexLayout& layout, IndexedMesh<float>& out) override {
    stores = Stores::kOrdinary;
    run(pairing.grids, patches, [&](std::size_t i, StreamWorker&) { return index_writer(i, layout, out); });
  }
  void write_patches(std::span<const PatchPlace> places, const PatchTarget<float>& out) override {
    PatchTarget<float> target = out;
    target.compact_row = &compact;
    std::size_t bytes = 0;  // of patches that are placed
    fresh_grids.clear(), fresh_patches.clear(), firsts.clear();
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (!places[i].fresh) continue;
      fresh_grids.push_back(pairing.grids[i]);
      fresh_patches.push_back(patches[i]);
      firsts.push_back(places[i].first);
      if (patches[i].full())
        bytes += sizeof(Vertex) * static_cast<std::size_t>(GridBlock{1 << patches[i].depth}.size());
    }
    // Past the caches row by row is slower than through them.
    stores = stream.kernel().run_lines != nullptr ? stores_for(bytes) : Stores::kOrdinary;
    run(
        fresh_grids, fresh_patches,
        [&](std::size_t i, StreamWorker&) {
          return PatchWriter<float>(fresh_patches[i], plan, placement, target.from(firsts[i]));
        },
        target.takes_vertices() && placement.is_identity());
  }

  SurfaceVertex<float> limit(std::int32_t v) const override {
    return vertex_from(stream.rings().corner(v).head.data() + CornerBlock::kLimit);
  }

  std::int64_t zero_normals() const override { return stream.rings().degenerate_normals(); }

  // Evaluates patches in parallel, shown[i] into make_writer(i, worker); a writer must not care about the
  // order of patches. placed: it has a place for each patch of two displayed faces.
  template <class MakeWriter>
  void run(std::span<const Grid> grids, std::span<const Patch> shown, MakeWriter&& make_writer,
           bool placed = false) {
    const std::size_t total = shown.size();
    batches.make(shown, static_cast<std::size_t>(stream.kernel().lanes),
                 static_cast<std::size_t>(narrow.lanes), placed);
    const StreamFrame frame{adjacency,
                            stream,
                            narrow,
                            plan,
                            grids,
                            shown,
                            control ? &*control : nullptr,
                            centres,
                            options.cracks.centre,
                            stores};
    run_batches(arena, workers, batches.list().size(), total, [&](StreamWorker& worker, std::size_t b) {
      const Batch& batch = batches.list()[b];
      if (worker.scratch().stride < std::size_t{1} << max_depth) worker.scratch().reserve(max_depth);
      worker.run(frame, batch, make_writer);
      fence(stores);
      return batch.patches.size();
    });
  }

  RowStream stream;
  const Kernel& narrow;
  std::optional<PreparedMesh<float>> control;
  std::vector<CachedCentre> centres;
  std::vector<StreamWorker> workers;
  StreamBatches batches;
  // The patches of a frame that are to be evaluated, and where they go.
  std::vector<Grid> fresh_grids;
  std::vector<Patch> fresh_patches;
  std::vector<std::int64_t> firsts;
};

std::unique_ptr<FrameEngine<float>> StreamTessellator::make_state(const data::ControlMesh& mesh,
                                                                  const TessellatorOptions& options,
                                                                  const Kernel& kernel) {
  if (options.scheme == data::Scheme::kLoop) return std::make_unique<State>(mesh, options, kernel);
  const QuadKernel* quads = find_quad_kernel(kernel.name);
  return std::make_unique<QuadStreamState>(mesh, options, quads != nullptr ? *quads : quad_kernels().front());
}

StreamTessellator::StreamTessellator(const data::ControlMesh& mesh, const TessellatorOptions& options,
                                     const Kernel& kernel)
    : Engine<float>(make_state(mesh, options, kernel)) {}

std::size_t StreamTessellator::worker_bytes() const {
  return dynamic_cast<const StreamHooks&>(state()).worker_bytes;
}
void StreamTessellator::on_progress(std::function<void(std::size_t, std::size_t)> tell) {
  dynamic_cast<StreamHooks&>(state()).progress = std::move(tell);
}

}  // namespace limitcheck::fast::row_stream
