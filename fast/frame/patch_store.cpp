// SPDX-License-Identifier: MIT
#include "fast/frame/patch_store.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace limitcheck::fast {

void PatchStore::clear() {
  kept_.clear();
  free_.clear();
  end = 0;
}

void PatchStore::place(std::size_t faces, bool reuse) {
  ++frame_;
  places.assign(list.size(), {});
  if (!reuse || kept_.size() != faces) {
    clear();
    kept_.resize(faces);
    return place_all_anew();
  }
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
  if (end <= 3 * shown + PatchMesh<float>::kSlack) return;
  clear();
  kept_.resize(faces);
  place_all_anew();
}

void PatchStore::place_all_anew() {
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

}  // namespace limitcheck::fast
