// SPDX-License-Identifier: MIT
#include "fast/stream/stream_tessellator.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <numeric>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "fast/frame/scheme_frames.h"
#include "fast/stream/host/quad_stream_worker.h"
#include "fast/stream/host/stream_worker.h"
#include "fast/stream/kernel/output_targets.h"

namespace limitcheck::fast::row_stream {

namespace {

static_assert(kMaxDepth == kDeepest);

constexpr auto none = [](std::size_t) { return false; };  // is skipped

// The variant of four lanes of the same instructions, or the kernel itself.
template <class Kernel>
const Kernel& with_few_lanes(const Kernel& kernel, const Kernel* (*find)(const char*)) {
  const Kernel* few = kernel.lanes > 4 ? find((std::string(kernel.name) + "/4").c_str()) : nullptr;
  return few != nullptr ? *few : kernel;
}

// What the frames of both schemes have in common beyond those of other engines.
struct StreamHooks {
  std::function<void(std::size_t done, std::size_t total)> progress;
  std::size_t worker_bytes = 0;

  // Evaluates batches 0 .. count - 1 in parallel, by one of the workers for each thread of the arena, which
  // are kept from frame to frame: run(worker, b) returns how many of `total` it has done.
  template <class Worker, class Run>
  void run_batches(tbb::task_arena& arena, std::vector<Worker>& workers, std::size_t count, std::size_t total,
                   Run&& run) {
    if (workers.empty()) workers.resize(static_cast<std::size_t>(arena.max_concurrency()));
    std::atomic<std::size_t> done = 0;
    std::mutex telling;
    arena.execute([&] {
      tbb::parallel_for(std::size_t{0}, count, [&](std::size_t b) {
        const auto thread = static_cast<std::size_t>(tbb::this_task_arena::current_thread_index());
        const std::size_t here = run(workers[thread], b);
        const std::size_t finished = done += here;
        if (progress && telling.try_lock()) {
          progress(finished, total);
          telling.unlock();
        }
      });
    });
    for (const Worker& worker : workers) worker_bytes = std::max(worker_bytes, worker.bytes());
  }

 protected:
  ~StreamHooks() = default;
};

struct LoopStreamFrames final : SchemeFrames<float, LoopScheme>, StreamHooks {
  LoopStreamFrames(const data::ControlMesh& given, const TessellatorOptions& with, const Kernel& kernel)
      : SchemeFrames(given, with),
        stream(triangles, kernel),
        few_lanes(with_few_lanes(kernel, &find_kernel)) {}

  void points_moved() override {
    SchemeFrames::points_moved();
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
    run(
        first, last,
        [&](std::size_t i, LoopStreamWorker& worker) { return draw_writer(first, i, out, worker.scratch()); },
        none);
  }
  void index(const IndexLayout& layout, IndexedMesh<float>& out) override {
    stores = Stores::kOrdinary;
    run(
        0, patches.size(), [&](std::size_t i, LoopStreamWorker&) { return index_writer(i, layout, out); },
        none);
  }
  void write_patches(std::span<const BlockOffset> places, const PatchTarget<float>& out) override {
    PatchTarget<float> target = out;
    target.compact_row = &compact;
    std::size_t points = 0;  // of patches that are placed
    for (std::size_t i = 0; i < places.size(); ++i)
      if (places[i].fresh && patches[i].full())
        points += static_cast<std::size_t>(GridBlock{1 << patches[i].depth}.size());
    // Past the caches row by row is slower than through them.
    stores = stream.kernel().run_lines != nullptr ? stores_for(sizeof(Vertex) * points) : Stores::kOrdinary;
    run(
        0, patches.size(),
        [&](std::size_t i, LoopStreamWorker&) { return patch_writer(patches[i], places[i].first, target); },
        [&](std::size_t i) { return !places[i].fresh; }, target.takes_vertices() && placement.is_identity());
  }

  SurfaceVertex<float> limit(std::int32_t v) const override {
    return vertex_from(stream.rings().corner(v).head.data() + CornerBlock::kLimit);
  }
  std::int64_t zero_normals() const override { return stream.rings().degenerate_normals(); }

  // Evaluates patches first .. last - 1 but those skipped in parallel, each into make_writer(i, worker); a writer
  // must not care about the order of patches. placed: it has a place for each patch of two displayed faces.
  template <class MakeWriter, class Skip>
  void run(std::size_t first, std::size_t last, MakeWriter&& make_writer, Skip&& skip, bool placed = false) {
    batches.make(patches, first, last, skip, static_cast<std::size_t>(stream.kernel().lanes),
                 static_cast<std::size_t>(few_lanes.lanes), placed);
    const PreparedMesh<float>* const prepared = control ? &*control : nullptr;
    const LoopStreamFrame frame{
        adjacency, stream, few_lanes, plan, pairing.grids, patches, prepared, centres, options.cracks.centre,
        stores};
    run_batches(arena, workers, batches.list().size(), batches.count(),
                [&](LoopStreamWorker& worker, std::size_t b) {
                  const LoopBatch& batch = batches.list()[b];
                  if (worker.scratch().stride < std::size_t{1} << max_depth)
                    worker.scratch().reserve(max_depth);
                  worker.run(frame, batch, make_writer);
                  fence(stores);
                  return batch.patches.size();
                });
  }

  RowStream stream;
  const Kernel& few_lanes;
  std::optional<PreparedMesh<float>> control;
  std::vector<CachedCentre> centres;
  std::vector<LoopStreamWorker> workers;
  LoopBatches batches;
};

struct QuadStreamFrames final : SchemeFrames<float, QuadScheme>, StreamHooks {
  QuadStreamFrames(const data::ControlMesh& given, const TessellatorOptions& with, const QuadKernel& kernel)
      : SchemeFrames(given, with),
        stream(std::in_place, quads, kernel),
        few_lanes(with_few_lanes(kernel, &find_quad_kernel)) {
    std::vector<std::int32_t> all(static_cast<std::size_t>(quads.adjacency.face_count()));
    std::iota(all.begin(), all.end(), 0);
    rank.resize(all.size());
    std::int32_t place = 0;
    for (const std::int32_t quad : stream->sorted(all)) rank[quad] = place++;
  }

  void points_moved() override {
    SchemeFrames::points_moved();
    stream.emplace(quads, stream->kernel());
  }
  void prepare() override { worker_bytes = 0; }

  void draw(std::size_t first, std::size_t last, DrawList<float>& out) override {
    stores = stores_of(out);
    run(
        first, last,
        [&](std::size_t i) { return draw_writer(first, i, out, QuadDrawWriter<float>::Scratch()); }, none);
  }
  void index(const IndexLayout& layout, IndexedMesh<float>& out) override {
    stores = Stores::kOrdinary;
    run(
        0, patches.size(), [&](std::size_t i) { return index_writer(i, layout, out); }, none);
  }
  void write_patches(std::span<const BlockOffset> places, const PatchTarget<float>& out) override {
    PatchTarget<float> target = out;
    target.compact_row = &compact;
    const bool placed = target.takes_vertices() && placement.is_identity();
    std::size_t points = 0;  // of quads that are placed
    for (std::size_t i = 0; i < places.size() && placed; ++i) {
      if (!places[i].fresh || patches[i].display != Display::kStrips) continue;
      const int size = PartBlock{faces.part_size(patches[i].depth)}.size();
      points += static_cast<std::size_t>(faces.parts(patches[i].face) * size);
    }
    // Past the caches row by row is slower than through them.
    stores = stream->kernel().quad_lines != nullptr ? stores_for(sizeof(Vertex) * points) : Stores::kOrdinary;
    run(
        0, patches.size(), [&](std::size_t i) { return patch_writer(patches[i], places[i].first, target); },
        [&](std::size_t i) { return !places[i].fresh; }, placed);
  }

  SurfaceVertex<float> limit(std::int32_t v) const override { return stream->limit(v); }
  std::int64_t zero_normals() const override { return stream->rings().degenerate_normals(); }

  // Quads of the patches that are not skipped, of one depth and of like valences side by side, whatever faces
  // they are parts of. In a fixed order.
  template <class Skip>
  void make_batches(std::size_t first, std::size_t last, Skip&& skip) {
    const int cut = faces.cut() ? 1 : 0;
    const auto depth_of = [&](std::size_t i) {
      const bool strips = patches[i].display == Display::kStrips && !corners_only(patches[i], faces);
      return strips ? patches[i].depth - cut : -1;
    };
    parts.clear();
    for (std::size_t i = first; i < last; ++i) {
      if (skip(i)) continue;
      const int count = depth_of(i) < 0 ? 1 : faces.parts(patches[i].face);
      for (int k = 0; k < count; ++k) parts.push_back({i, k});
    }
    const auto quad_of = [&](const QuadPart& p) { return faces.quad(patches[p.patch].face, p.part); };
    const auto key = [&](const QuadPart& p) { return std::tuple(depth_of(p.patch), rank[quad_of(p)]); };
    std::sort(parts.begin(), parts.end(),
              [&](const QuadPart& a, const QuadPart& b) { return key(a) < key(b); });
    const auto kind_of = [&](const QuadPart& p) { return stream->rings().kind(quad_of(p)); };
    batches.clear();
    const auto lanes = static_cast<std::size_t>(stream->kernel().lanes);
    for (std::size_t at = 0, end; at < parts.size(); at = end) {
      const int depth = depth_of(parts[at].patch);
      const QuadClass kind = kind_of(parts[at]);
      const std::size_t most = std::min(parts.size(), at + (depth < 0 ? 1 : lanes));
      end = at + 1;
      while (end < most && depth_of(parts[end].patch) == depth && kind_of(parts[end]) == kind) ++end;
      batches.push_back({depth, std::span<const QuadPart>(parts).subspan(at, end - at)});
    }
  }

  // Evaluates patches first .. last - 1 but those skipped in parallel, each into make_writer(i); a writer must
  // not care about the order of patches. placed: it has a place for each quad.
  template <class MakeWriter, class Skip>
  void run(std::size_t first, std::size_t last, MakeWriter&& make_writer, Skip&& skip, bool placed = false) {
    make_batches(first, last, skip);
    const QuadStreamFrame frame{*stream, few_lanes, faces, plan, patches, options.cracks.centre,
                                placed,  stores};
    run_batches(arena, workers, batches.size(), parts.size(), [&](QuadStreamWorker& worker, std::size_t b) {
      worker.run(frame, batches[b], make_writer);
      fence(stores);
      return batches[b].parts.size();
    });
  }

  std::optional<QuadRowStream> stream;
  const QuadKernel& few_lanes;
  std::vector<std::int32_t> rank;  // of each quad, in the order that is best for the lanes
  std::vector<QuadStreamWorker> workers;
  std::vector<QuadPart> parts;
  std::vector<QuadFrameBatch> batches;
};

}  // namespace

std::unique_ptr<FrameEngine<float>> StreamTessellator::make_state(const data::ControlMesh& mesh,
                                                                  const TessellatorOptions& options,
                                                                  const Kernel& kernel) {
  if (options.scheme == data::Scheme::kLoop) return std::make_unique<LoopStreamFrames>(mesh, options, kernel);
  const QuadKernel* quads = find_quad_kernel(kernel.name);
  return std::make_unique<QuadStreamFrames>(mesh, options,
                                            quads != nullptr ? *quads : quad_kernels().front());
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
