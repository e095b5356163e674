// SPDX-License-Identifier: MIT
#include "fast/stream/host/quad_stream_state.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <tuple>

#include "fast/stream/kernel/output_targets.h"

namespace limitcheck::fast::row_stream {

namespace {

// The variant of four lanes of the same instructions, or the kernel itself.
const QuadKernel& narrow_of(const QuadKernel& kernel) {
  const QuadKernel* narrow =
      kernel.lanes > 4 ? find_quad_kernel((std::string(kernel.name) + "/4").c_str()) : nullptr;
  return narrow != nullptr ? *narrow : kernel;
}

constexpr auto none = [](std::size_t) { return false; };

}  // namespace

QuadStreamState::QuadStreamState(const data::ControlMesh& given, const TessellatorOptions& with,
                                 const QuadKernel& kernel)
    : QuadEngineState<float>(given, with), stream_(std::in_place, quads, kernel), narrow_(narrow_of(kernel)) {
  std::vector<std::int32_t> all(static_cast<std::size_t>(quads.adjacency.face_count()));
  std::iota(all.begin(), all.end(), 0);
  rank_.resize(all.size());
  std::int32_t place = 0;
  for (const std::int32_t quad : stream_->sorted(all)) rank_[quad] = place++;
}

void QuadStreamState::points_moved() {
  QuadEngineState<float>::points_moved();
  stream_.emplace(quads, stream_->kernel());
}

void QuadStreamState::draw(std::size_t first, std::size_t last, DrawList<float>& out) {
  stores = stores_of(out);
  run(
      first, last, [&](std::size_t i) { return draw_writer(first, i, out); }, none);
}
void QuadStreamState::index(const QuadIndexLayout& layout, IndexedMesh<float>& out) {
  stores = Stores::kOrdinary;
  run(
      0, patches.size(), [&](std::size_t i) { return index_writer(i, layout, out); }, none);
}
void QuadStreamState::write_patches(std::span<const PatchPlace> places, const PatchTarget<float>& out) {
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
  stores = stream_->kernel().quad_lines != nullptr ? stores_for(sizeof(Vertex) * points) : Stores::kOrdinary;
  run(
      0, patches.size(),
      [&](std::size_t i) {
        return QuadPatchWriter<float>(patches[i], faces, plan, placement, target.from(places[i].first));
      },
      [&](std::size_t i) { return !places[i].fresh; }, placed);
}

// Quads of the patches that are not skipped, of one depth and of like valences side by side, whatever faces they are parts of. In a fixed order.
template <class Skip>
void QuadStreamState::make_batches(std::size_t first, std::size_t last, Skip&& skip) {
  const int cut = faces.cut() ? 1 : 0;
  const auto depth_of = [&](std::size_t i) {
    return patches[i].display == Display::kStrips && !corners_only(patches[i], faces) ? patches[i].depth - cut
                                                                                      : -1;
  };
  parts_.clear();
  for (std::size_t i = first; i < last; ++i) {
    if (skip(i)) continue;
    const int count = depth_of(i) < 0 ? 1 : faces.parts(patches[i].face);
    for (int k = 0; k < count; ++k) parts_.push_back({i, k});
  }
  const auto key = [&](const QuadPart& p) {
    return std::tuple(depth_of(p.patch), rank_[faces.quad(patches[p.patch].face, p.part)]);
  };
  std::sort(parts_.begin(), parts_.end(),
            [&](const QuadPart& a, const QuadPart& b) { return key(a) < key(b); });
  const auto kind_of = [&](const QuadPart& p) {
    return stream_->rings().kind(faces.quad(patches[p.patch].face, p.part));
  };
  batches_.clear();
  const auto lanes = static_cast<std::size_t>(stream_->kernel().lanes);
  for (std::size_t at = 0, end; at < parts_.size(); at = end) {
    const int depth = depth_of(parts_[at].patch);
    const QuadClass kind = kind_of(parts_[at]);
    const std::size_t most = std::min(parts_.size(), at + (depth < 0 ? 1 : lanes));
    end = at + 1;
    while (end < most && depth_of(parts_[end].patch) == depth && kind_of(parts_[end]) == kind) ++end;
    batches_.push_back({depth, std::span<const QuadPart>(parts_).subspan(at, end - at)});
  }
}

// Evaluates patches first .. last - 1 but those skipped in parallel, each into make_writer(i); a writer must not care about the
// order of patches. placed: it has a place for each quad.
template <class MakeWriter, class Skip>
void QuadStreamState::run(std::size_t first, std::size_t last, MakeWriter&& make_writer, Skip&& skip,
                          bool placed) {
  make_batches(first, last, skip);
  const QuadStreamFrame frame{*stream_, narrow_, faces, plan, patches, options.cracks.centre, placed, stores};
  run_batches(arena, workers_, batches_.size(), parts_.size(), [&](QuadStreamWorker& worker, std::size_t b) {
    worker.run(frame, batches_[b], make_writer);
    fence(stores);
    return batches_[b].parts.size();
  });
}

}  // namespace limitcheck::fast::row_stream
