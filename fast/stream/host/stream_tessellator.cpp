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
#include "fast/stream/host/stream_worker.h"
#include "fast/stream/kernel/output_targets.h"

namespace limitcheck::fast::row_stream {

namespace {

static_assert(kMaxDepth == kDeepest);

// The variant of four lanes of the same instructions, or the kernel itself.
template <class Kernel>
const Kernel& with_few_lanes(const Kernel& kernel, std::span<const Kernel> all) {
  const Kernel* few = kernel.lanes > 4 ? find_variant(all, std::string(kernel.name) + "/4") : nullptr;
  return few != nullptr ? *few : kernel;
}

// The points of a patch that has a place each for all of them.
std::size_t placed_points(const LoopPatch& patch) {
  return patch.full() ? static_cast<std::size_t>(patch.block(LoopPatch::kWhole).size()) : 0;
}
std::size_t placed_points(const QuadPatch& patch) {
  const ShownFace& face = patch.face;
  return face.display == Display::kStrips ? static_cast<std::size_t>(face.parts * face.block().size()) : 0;
}

// What the tessellator asks of the frames of either scheme beyond those of other engines.
struct StreamHooks {
  std::function<void(std::size_t done, std::size_t total)> progress;
  std::size_t worker_bytes = 0;

 protected:
  ~StreamHooks() = default;
};

// Frames of a scheme, which its workers read: Frames::make_batches(first, last, skipped) sorts patches into `batches`.
template <class Frames, class Scheme, class Stream, class Worker>
struct StreamFrames : SchemeFrames<float, Scheme>, StreamHooks {
  using Base = SchemeFrames<float, Scheme>;
  using Kernel = typename Stream::Kernel;
  using Base::arena, Base::cut_mesh, Base::options, Base::patches, Base::placement, Base::stores;

  StreamFrames(const data::ControlMesh& given, const TessellatorOptions& with, const Kernel& kernel,
               std::span<const Kernel> all)
      : Base(given, with), stream(cut_mesh, kernel), few_lanes(with_few_lanes(kernel, all)) {}

  void points_moved() override {
    Base::points_moved();
    stream.move_points(cut_mesh);
  }
  SurfaceVertex<float> limit(std::int32_t v) const override { return stream.limit(v); }
  std::int64_t zero_normals() const override { return stream.rings().degenerate_normals(); }

  void prepare() override { worker_bytes = 0; }
  void draw(std::size_t first, std::size_t last, DrawList<float>& out) override {
    stores = this->stores_of(out), placed = false;
    run(first, last, [&](std::size_t i) { return this->draw_writer(first, i, out); });
  }
  void index(const IndexLayout& layout, IndexedMesh<float>& out) override {
    stores = Stores::kOrdinary, placed = false;
    run(0, patches.size(), [&](std::size_t i) { return this->index_writer(i, layout, out); });
  }
  void write_patches(std::span<const BlockOffset> places, const PatchTarget<float>& out) override {
    PatchTarget<float> target = out;
    target.compact_row = &compact;
    placed = target.takes_vertices() && placement.is_identity();
    std::size_t points = 0;  // of patches that are placed
    for (std::size_t i = 0; i < places.size() && placed; ++i)
      if (places[i].fresh) points += placed_points(patches[i]);
    // Past the caches row by row is slower than through them.
    stores = stream.has_lines() ? stores_for(sizeof(Vertex) * points) : Stores::kOrdinary;
    run(
        0, patches.size(),
        [&](std::size_t i) { return this->patch_writer(patches[i], places[i].first, target); }, places);
  }

  // Evaluates patches first .. last - 1, but those whose places are not fresh, in parallel, each into make_writer(i); a
  // writer must not care about the order of patches. Workers, one for each thread of the arena, are kept from frame to
  // frame.
  template <class MakeWriter>
  void run(std::size_t first, std::size_t last, MakeWriter&& make_writer,
           std::span<const BlockOffset> places = {}) {
    const auto skipped = [&](std::size_t i) { return !places.empty() && !places[i].fresh; };
    auto& frames = static_cast<Frames&>(*this);
    frames.make_batches(first, last, skipped);
    const auto& batches = frames.batches;
    std::size_t total = 0;
    for (const auto& batch : batches) total += batch.items.size();
    if (workers.empty()) workers.resize(static_cast<std::size_t>(arena.max_concurrency()));
    std::atomic<std::size_t> done = 0;
    std::mutex telling;
    arena.execute([&] {
      tbb::parallel_for(std::size_t{0}, batches.size(), [&](std::size_t b) {
        workers[static_cast<std::size_t>(tbb::this_task_arena::current_thread_index())].run(
            frames, batches[b], make_writer);
        fence(stores);
        const std::size_t finished = done += batches[b].items.size();
        if (progress && telling.try_lock()) {
          progress(finished, total);
          telling.unlock();
        }
      });
    });
    for (const Worker& worker : workers) worker_bytes = std::max(worker_bytes, worker.bytes());
  }

  Stream stream;
  const Kernel& few_lanes;  // for what has to be kept whole, and for single faces
  bool placed = false;      // a writer has a place for each part that goes together with others
  std::vector<Worker> workers;
};

struct LoopStreamFrames final
    : StreamFrames<LoopStreamFrames, LoopScheme, RowStream, LoopStreamWorker<LoopStreamFrames>> {
  LoopStreamFrames(const data::ControlMesh& given, const TessellatorOptions& with, const Kernel& kernel)
      : StreamFrames(given, with, kernel, kernels()) {}

  void points_moved() override {
    StreamFrames::points_moved();
    if (options.cracks.centre == FanCentre::kFlatLimit) control.reset();
    if (control) control->move_points(control_points());
    centres.clear();
  }

  void prepare() override {
    if (plan.fans > 0 && !control) {
      const bool limits = options.cracks.centre == FanCentre::kFlatLimit;
      control.emplace(adjacency, control_points(), cut_mesh.kinds(), limits);
    }
    if (plan.fans > 0) centres.resize(static_cast<std::size_t>(adjacency.face_count()));
    StreamFrames::prepare();
  }

  // The centres of fans are no lattice points; they come from the sliding window's own rules.
  std::vector<Vec3<float>> control_points() const {
    std::vector<Vec3<float>> positions;
    positions.reserve(static_cast<std::size_t>(adjacency.vertex_count()));
    for (std::int32_t v = 0; v < adjacency.vertex_count(); ++v) {
      const float* p = stream.rings().head(v) + CornerBlock::kCentre;
      positions.push_back({p[0], p[1], p[2]});
    }
    return positions;
  }

  template <class Skipped>
  void make_batches(std::size_t first, std::size_t last, Skipped&& skipped) {
    const auto rank = [&](std::size_t i) {
      const int depth = patches[i].depth;
      const bool local = !stream.rings().local().none(depth) && depth >= stream.local_from(pairing.grids[i]);
      return 2 * regularity_rank(regular_edges(stream.rings(), pairing.grids[i], depth)) + (local ? 1 : 0);
    };
    sorted.sort(patches, first, last, skipped, rank, static_cast<std::size_t>(stream.kernel().lanes),
                static_cast<std::size_t>(few_lanes.lanes), placed, batches);
  }

  std::optional<PreparedMesh<float>> control;  // for the centres of fans
  std::vector<CachedCentre> centres;           // per face, if there are fans
  SortedPatches sorted;
  std::vector<LoopBatch> batches;
};

struct QuadStreamFrames final
    : StreamFrames<QuadStreamFrames, QuadScheme, QuadRowStream, QuadStreamWorker<QuadStreamFrames>> {
  QuadStreamFrames(const data::ControlMesh& given, const TessellatorOptions& with, const QuadKernel& kernel)
      : StreamFrames(given, with, kernel, quad_kernels()) {
    std::vector<std::int32_t> all(static_cast<std::size_t>(cut_mesh.adjacency.face_count()));
    std::iota(all.begin(), all.end(), 0);
    rank.resize(all.size());
    std::int32_t place = 0;
    for (const std::int32_t quad : stream.sorted(all)) rank[quad] = place++;
  }

  // Quads of one depth and of like valences side by side, whatever faces they are parts of. In a fixed order.
  template <class Skipped>
  void make_batches(std::size_t first, std::size_t last, Skipped&& skipped) {
    const int cut = faces.cut() ? 1 : 0;
    const auto depth_of = [&](std::size_t i) {
      const bool strips = patches[i].face.display == Display::kStrips && !patches[i].corners_only();
      return strips ? patches[i].depth - cut : -1;
    };
    parts.clear();
    for (std::size_t i = first; i < last; ++i) {
      if (skipped(i)) continue;
      const int count = depth_of(i) < 0 ? 1 : patches[i].face.parts;
      for (int k = 0; k < count; ++k) parts.push_back({i, k});
    }
    const auto quad_of = [&](const QuadPart& p) { return faces.quad(patches[p.patch].face.face, p.part); };
    const auto key = [&](const QuadPart& p) { return std::tuple(depth_of(p.patch), rank[quad_of(p)]); };
    std::sort(parts.begin(), parts.end(),
              [&](const QuadPart& a, const QuadPart& b) { return key(a) < key(b); });
    const auto kind_of = [&](const QuadPart& p) { return stream.rings().kind(quad_of(p)); };
    batches.clear();
    const auto lanes = static_cast<std::size_t>(stream.kernel().lanes);
    for (std::size_t at = 0, end; at < parts.size(); at = end) {
      const int depth = depth_of(parts[at].patch);
      const QuadClass kind = kind_of(parts[at]);
      const std::size_t most = std::min(parts.size(), at + (depth < 0 ? 1 : lanes));
      end = at + 1;
      while (end < most && depth_of(parts[end].patch) == depth && kind_of(parts[end]) == kind) ++end;
      batches.push_back({depth, std::span<const QuadPart>(parts).subspan(at, end - at)});
    }
  }

  std::vector<std::int32_t> rank;  // of each quad, in the order that is best for the lanes
  std::vector<QuadPart> parts;
  std::vector<QuadFrameBatch> batches;
};

}  // namespace

std::unique_ptr<FrameEngine<float>> StreamTessellator::make_state(const data::ControlMesh& mesh,
                                                                  const TessellatorOptions& options,
                                                                  const Kernel& kernel,
                                                                  const QuadKernel* quads) {
  if (options.scheme == data::Scheme::kLoop) return std::make_unique<LoopStreamFrames>(mesh, options, kernel);
  if (quads == nullptr) quads = find_quad_kernel(kernel.name);
  return std::make_unique<QuadStreamFrames>(mesh, options,
                                            quads != nullptr ? *quads : quad_kernels().front());
}

StreamTessellator::StreamTessellator(const data::ControlMesh& mesh, const TessellatorOptions& options,
                                     const Kernel& kernel, const QuadKernel* quads)
    : Engine<float>(make_state(mesh, options, kernel, quads)) {}

std::size_t StreamTessellator::worker_bytes() const {
  return dynamic_cast<const StreamHooks&>(state()).worker_bytes;
}
void StreamTessellator::on_progress(std::function<void(std::size_t, std::size_t)> tell) {
  dynamic_cast<StreamHooks&>(state()).progress = std::move(tell);
}

}  // namespace limitcheck::fast::row_stream
