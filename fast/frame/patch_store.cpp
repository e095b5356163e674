// SPDX-License-Identifier: MIT
#include "fast/frame/patch_store.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <new>
#include <string>

#include "data/error.h"
#include "fast/frame/quad_patch.h"
#include "fast/frame/scheme_frames.h"

namespace limitcheck::fast {

namespace {

// The triangles between the rows of a block; at(row, column) is the index of a point.
template <class At>
void add_rows(const RowBlock& block, IndexForm form, At&& at, std::vector<std::uint32_t>& out) {
  for (int row = 0; row < block.k; ++row) {
    const int last = block.last(row), below = block.last(row + 1);
    if (form == IndexForm::kStrips) {
      for (int c = 0; c <= below; ++c) out.insert(out.end(), {at(row, c), at(row + 1, c)});
      if (below < last) out.push_back(at(row, last));
      out.push_back(kRestartIndex);
      continue;
    }
    for (int c = 0; c < last; ++c) {
      out.insert(out.end(), {at(row, c), at(row + 1, c), at(row, c + 1)});
      if (c < below) out.insert(out.end(), {at(row, c + 1), at(row + 1, c), at(row + 1, c + 1)});
    }
  }
}

// Appends a pattern unless it is known: make() returns the number of its triangles.
template <class Make>
const IndexPattern& once(IndexPattern& pattern, std::vector<std::uint32_t>& out, Make&& make) {
  if (pattern.count > 0) return pattern;
  pattern.first = static_cast<std::uint32_t>(out.size());
  pattern.triangles = make();
  pattern.count = static_cast<std::uint32_t>(out.size()) - pattern.first;
  return pattern;
}

IndexPattern& at_least(std::vector<IndexPattern>& list, int number) {
  const auto n = static_cast<std::size_t>(number);
  if (list.size() <= n) list.resize(n + 1);
  return list[n];
}

// The outer ring of a face whose border points begin with number `border`: inner(side, t) is the index of point t of the
// row next to a side. Returns the number of its triangles.
template <class Faces, class Inner>
std::int32_t add_ring(const FaceInRepair<Faces>& face, int depth, std::int32_t border, Inner&& inner,
                      std::vector<std::uint32_t>& out) {
  std::int64_t first = 0;
  for (int side = 0; side < face.sides(); ++side) {
    const auto point = [&](StitchPoint p) {
      if (p.inner) return inner(side, static_cast<int>(p.t));
      return static_cast<std::uint32_t>(border + (first + p.t) % face.border());
    };
    face.stitch(1 << depth, side, [&](StitchPoint a, StitchPoint b, StitchPoint c) {
      out.insert(out.end(), {point(a), point(b), point(c)});
    });
    first += face.points(side);
  }
  return static_cast<std::int32_t>(face.ring_triangles(std::int64_t{1} << depth));
}

}  // namespace

IndexPattern PatchIndices::strips(const ShownFace& shown, int depth, IndexForm form,
                                  std::vector<std::uint32_t>& out) {
  const RowBlock block = shown.block();
  const auto of_form = static_cast<std::size_t>(form);
  const auto add = [&](const RowBlock& rows, auto&& at) {
    add_rows(rows, form, at, out);
    return static_cast<std::int32_t>(rows.strips().triangles);
  };
  if (shown.both_halves) {
    return once(grids_[depth][of_form], out, [&] {
      const int k = block.k;
      return add({k, true}, [&](int r, int c) { return block.at(r, c); }) +
             add({k, true}, [&](int r, int c) { return block.at(k - r, k - c); });
    });
  }
  auto& known =
      block.triangle ? halves_[depth][of_form] : quads_[{shown.parts, block.k, static_cast<int>(form)}];
  return once(known, out, [&] {
    std::int32_t triangles = 0;
    for (int part = 0; part < shown.parts; ++part)
      triangles += add(block, [&](int r, int c) { return part * block.size() + block.at(r, c); });
    return triangles;
  });
}

IndexPattern PatchIndices::fan(int border, std::vector<std::uint32_t>& out) {
  return once(at_least(fans_, border), out, [&] {
    const auto n = static_cast<std::uint32_t>(border);
    for (std::uint32_t t = 1; t <= n; ++t) out.insert(out.end(), {0, t, t == n ? 1 : t + 1});
    return border;
  });
}

IndexPattern PatchIndices::corners(int sides, std::vector<std::uint32_t>& out) {
  return once(at_least(corners_, sides), out, [&] {
    for (std::uint32_t k = 1; k + 1 < static_cast<std::uint32_t>(sides); ++k)
      out.insert(out.end(), {0, k, k + 1});
    return sides - 2;
  });
}

template <class Patch, class Faces>
IndexPattern PatchIndices::stitched(const Patch& patch, int s, const Faces& faces, const CrackPlan& plan,
                                    std::vector<std::uint32_t>& out) {
  const ShownFace shown = patch.shown(s);
  const FaceInRepair<Faces> face{faces, plan, shown.face};
  std::vector<int> key{patch.depth, patch.edge_of(s)};
  for (int side = 0; side < face.sides(); ++side) key.push_back(face.depth(side));
  return once(stitched_[key], out, [&] {
    const auto index = [&](PatchPoint p) {
      return (p.part - Patch::first_part(s)) * shown.block().size() + shown.block().at(p.row, p.column);
    };
    const PatchPoint first = shown.first_inner(0);
    for (int part = Patch::first_part(s), k = 0; k < shown.parts; ++part, ++k)
      add_rows(
          shown.inner(), IndexForm::kTriangles,
          [&](int r, int c) {
            return index({part, first.row + r, first.column + c});
          },
          out);
    const auto inner = [&](int side, int t) { return index(patch.beside(faces, s, side, t)); };
    return static_cast<std::int32_t>(shown.parts * shown.inner().strips().triangles) +
           add_ring(face, patch.depth, shown.parts * shown.block().size(), inner, out);
  });
}

template IndexPattern PatchIndices::stitched(const LoopPatch&, int, const LoopFaces&, const CrackPlan&,
                                             std::vector<std::uint32_t>&);
template IndexPattern PatchIndices::stitched(const QuadPatch&, int, const QuadFaces&, const CrackPlan&,
                                             std::vector<std::uint32_t>&);

void PatchStore::clear() {
  kept_.clear();
  free_.clear();
  end = 0;
}

void PatchStore::place(std::size_t faces, bool reuse) {
  ++frame_;
  places.assign(list.size(), {});
  if (!reuse || kept_.size() != faces) return place_all_anew(faces);
  std::int64_t shown = 0;
  // What is as it was stays; then what has changed gives its place back, so that others find it.
  for (std::size_t i = 0; i < list.size(); ++i) {
    const PatchWanted& patch = list[i];
    Kept& kept = kept_[patch.key.grid.face0];
    shown += patch.size;
    kept.shown = frame_;
    if (kept.first >= 0 && patch.comparable && kept.key == patch.key) {
      places[i] = {kept.first, false};
    } else {
      give_back(kept);
    }
  }
  evict(shown);
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (!places[i].fresh) continue;
    const PatchWanted& patch = list[i];
    places[i].first = take(patch.size);
    kept_[patch.key.grid.face0] = {patch.key, places[i].first, patch.size, frame_};
  }
  if (end > 3 * shown + PatchMesh<float>::kSlack) place_all_anew(faces);
}

void PatchStore::place_all_anew(std::size_t faces) {
  clear();
  kept_.resize(faces);
  for (std::size_t i = 0; i < list.size(); ++i) {
    places[i] = {end, true};
    kept_[list[i].key.grid.face0] = {list[i].key, end, list[i].size, frame_};
    end += list[i].size;
  }
}

std::int64_t PatchStore::take(std::int32_t size) {
  if (const auto at = free_.find(size); at != free_.end() && !at->second.empty()) {
    const std::int64_t first = at->second.back();
    at->second.pop_back();
    return first;
  }
  return std::exchange(end, end + size);
}

void PatchStore::give_back(Kept& kept) {
  if (kept.first >= 0) free_[kept.size].push_back(kept.first);
  kept.first = -1;
}

// Of the patches that are not shown those stay that were shown last, of at most so many vertices.
void PatchStore::evict(std::int64_t most) {
  hidden_.clear();
  std::int64_t size = 0;
  for (std::size_t f = 0; f < kept_.size(); ++f) {
    if (kept_[f].first < 0 || kept_[f].shown == frame_) continue;
    hidden_.emplace_back(frame_ - kept_[f].shown, f);
    size += kept_[f].size;
  }
  if (size <= most) return;
  std::sort(hidden_.begin(), hidden_.end());
  while (size > most) {
    Kept& kept = kept_[hidden_.back().second];
    size -= kept.size;
    give_back(kept);
    hidden_.pop_back();
  }
}

namespace {

// Memory on the heap, which grows by half.
class HeapMemory final : public VertexMemory {
 public:
  std::byte* reserve(std::size_t bytes, std::size_t keep) override {
    if (bytes > size_) {
      const std::size_t size = (std::max(bytes, size_ + size_ / 2) + kLine - 1) / kLine * kLine;
      std::unique_ptr<std::byte, Free> larger(static_cast<std::byte*>(std::aligned_alloc(kLine, size)));
      if (!larger) throw std::bad_alloc();
      if (keep > 0) std::memcpy(larger.get(), memory_.get(), keep);
      memory_ = std::move(larger);
      size_ = size;
    }
    return memory_.get();
  }

 private:
  static constexpr std::size_t kLine = 64;
  struct Free {
    void operator()(std::byte* p) const { std::free(p); }
  };
  std::unique_ptr<std::byte, Free> memory_;
  std::size_t size_ = 0;
};

}  // namespace

template <class Real>
PatchMesh<Real>::PatchMesh(const PatchOptions& options, VertexMemory* memory)
    : options_(options),
      memory_(memory),
      own_(memory == nullptr ? std::make_unique<HeapMemory>() : nullptr),
      store_(std::make_shared<PatchStore>()) {
  if (memory_ == nullptr) memory_ = own_.get();
}

template <class Real>
void PatchMesh<Real>::clear() {
  *store_ = PatchStore();  // not {}: clang 14 then leaves the destructor out of a template
  draws_.clear(), changed_.clear();
  indices_.clear(), indices16_.clear();
  vertices_ = {}, compact_ = {};
  provenance_.clear();
  first_new_index_ = 0;
}

template <class Real>
bool PatchFrame<Real>::continues() const {
  return out_.options_.incremental && out_.store_->writer == engine_.version;
}

template <class Real>
std::vector<Grid> PatchFrame<Real>::pairs_to_keep(std::span<const std::int32_t> depth) const {
  const PatchStore& store = *out_.store_;
  std::vector<Grid> pairs;
  if (!out_.options_.sticky || store.mesh != engine_.id || store.depths.size() != depth.size()) return pairs;
  const auto stays = [&](std::int32_t f) { return depth[f] >= 0 && depth[f] == store.depths[f]; };
  for (const Grid& grid : store.pairs)
    if (!grid.singleton() && stays(grid.face0) && stays(grid.face1)) pairs.push_back(grid);
  return pairs;
}

template <class Real>
std::int64_t PatchFrame<Real>::write(std::span<const std::int32_t> depth) {
  if (out_.options_.compact && !std::is_same_v<Real, float>)
    throw data::ArgumentError("frame: compact vertices are made of floats only");
  PatchStore& store = *out_.store_;
  engine_.list_patches(store.list);
  std::int64_t vertices = 0;
  for (const PatchWanted& patch : store.list) {
    vertices += patch.size;
    if (out_.options_.narrow && patch.size > std::numeric_limits<std::uint16_t>::max())
      throw data::ArgumentError("frame: " + std::to_string(patch.size) +
                                " vertices of a patch are more than 16-bit indices reach");
  }
  if (store.mesh != engine_.id) {
    store.indices = PatchIndices();
    out_.indices_.clear(), out_.indices16_.clear();
  }
  const bool reuse = continues();
  store.writer = 0;  // until all is well
  const std::int64_t before = store.end;
  store.place(static_cast<std::size_t>(engine_.face_count()), reuse);
  make_room(reuse ? static_cast<std::size_t>(before) : 0);
  engine_.write_patches(store.places, {out_.vertices_.data(), out_.compact_.data(),
                                       out_.provenance_.empty() ? nullptr : out_.provenance_.data()});
  add_draws();
  list_changes();
  store.pairs = engine_.pairing.grids;
  store.depths.assign(depth.begin(), depth.end());
  store.writer = engine_.version;
  store.mesh = engine_.id;
  return vertices;
}

template <class Real>
void PatchFrame<Real>::make_room(std::size_t keep) {
  const auto count = static_cast<std::size_t>(out_.store_->end);
  const std::size_t size = out_.options_.compact ? sizeof(CompactVertex) : sizeof(SurfaceVertex<Real>);
  std::byte* memory = out_.memory_->reserve(count * size, std::min(keep, count) * size);
  if (out_.options_.compact)
    out_.compact_ = {reinterpret_cast<CompactVertex*>(memory), count};
  else
    out_.vertices_ = {reinterpret_cast<SurfaceVertex<Real>*>(memory), count};
  out_.provenance_.resize(engine_.options.provenance ? count : 0);
}

template <class Real>
void PatchFrame<Real>::add_draws() {
  PatchStore& store = *out_.store_;
  out_.draws_.clear();
  out_.first_new_index_ = out_.indices_.size();
  engine_.add_patch_draws(store.places, out_.options_.form, store.indices, out_.indices_, out_.draws_);
  if (!out_.options_.narrow) return;
  for (std::size_t i = out_.indices16_.size(); i < out_.indices_.size(); ++i)
    out_.indices16_.push_back(static_cast<std::uint16_t>(out_.indices_[i]));
}

template <class Real>
void PatchFrame<Real>::list_changes() {
  auto& changed = out_.changed_;
  changed.clear();
  const PatchStore& store = *out_.store_;
  for (std::size_t i = 0; i < store.list.size(); ++i)
    if (store.places[i].fresh) changed.push_back({store.places[i].first, store.list[i].size});
  std::sort(changed.begin(), changed.end(),
            [](const VertexRange& a, const VertexRange& b) { return a.first < b.first; });
  std::size_t last = 0;
  for (std::size_t i = 1; i < changed.size(); ++i) {
    if (changed[last].first + changed[last].count == changed[i].first)
      changed[last].count += changed[i].count;
    else
      changed[++last] = changed[i];
  }
  if (!changed.empty()) changed.resize(last + 1);
}

template class PatchMesh<float>;
template class PatchMesh<double>;
template class PatchFrame<float>;
template class PatchFrame<double>;

}  // namespace limitcheck::fast
