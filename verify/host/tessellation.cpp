// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>
#include <limits>

#include "verify/host/host.h"
#include "verify/host/host_memory.h"
#include "verify/host/matching.h"
#include "verify/subject/face_domain.h"

namespace limitcheck::verify {
namespace {

struct Array {
  const char* name;
  const void* data;
  std::int64_t elements;
  std::size_t numbers, size;  // of each element; and the bytes of a number, to which the array is aligned
  bool required;
  bool dispensable = false;  // the other arrays are judged without it
  const std::byte* begin() const { return static_cast<const std::byte*>(data); }
  std::size_t bytes() const { return static_cast<std::size_t>(elements) * numbers * size; }
};

// How many elements fail `ok`, and the first.
template <class Ok>
void count_bad(std::vector<Defect>& defects, Defect::Kind kind, const char* array, std::int64_t elements,
               Ok ok, const char* what) {
  std::int64_t count = 0, first = -1;
  for (std::int64_t k = 0; k < elements; ++k) {
    if (ok(k)) continue;
    if (count++ == 0) first = k;
  }
  if (count > 0) {
    defects.push_back({kind, array, count, first,
                       fmt::format("{} of {} {}, the first is {}", count, elements, what, first)});
  }
}

using Arrays = std::array<Array, 8>;
using Kind = Defect::Kind;

void note(std::vector<Defect>& defects, Kind kind, const char* array, std::string message) {
  defects.push_back({kind, array, 1, -1, std::move(message)});
}

// Finds writes to the guard zones of each block; a block is named by the array that begins in it.
void find_overruns(const detail::Memory& memory, const Arrays& arrays, std::vector<Overrun>& overruns) {
  for (const auto& block : memory.blocks()) {
    const auto owner =
        std::find_if(arrays.begin(), arrays.end(), [&](const Array& a) { return a.data == block.data; });
    const std::string name =
        owner != arrays.end() ? owner->name : fmt::format("block of {} bytes", block.size);
    if (const auto far = memory.written_before(block)) overruns.push_back({name, true, far});
    if (const auto far = memory.written_behind(block)) overruns.push_back({name, false, far});
  }
}

// Neither negative nor so large that a size in bytes overflows.
bool counts_usable(const lc_tessellation& out, std::vector<Defect>& defects) {
  constexpr std::int64_t kMany = std::numeric_limits<std::int64_t>::max() / 64;
  bool usable = true;
  for (const auto& [name, count] :
       {std::pair{"vertex_count", out.vertex_count}, {"triangle_count", out.triangle_count}}) {
    if (count >= 0 && count <= kMany) continue;
    note(defects, count < 0 ? Kind::kNegativeCount : Kind::kArrayTooSmall, "",
         fmt::format("{} is {}", name, count));
    usable = false;
  }
  return usable;
}

// Each array lies, aligned, in a block of the host's, as long as the counts say. Only normals, corners and channels may
// be missing.
bool memory_usable(const detail::Memory& memory, const Arrays& arrays, std::vector<Defect>& defects) {
  bool usable = true;
  for (const Array& a : arrays) {
    if (a.data == nullptr) {
      if (!a.required || a.elements <= 0) continue;
      note(defects, Kind::kMissingArray, a.name,
           fmt::format("{} is NULL, {} elements were announced", a.name, a.elements));
      usable = usable && a.dispensable;
      continue;
    }
    const auto* block = memory.find(a.data);
    const bool aligned = reinterpret_cast<std::uintptr_t>(a.data) % a.size == 0;
    if (block == nullptr || !aligned) {
      note(
          defects, Kind::kForeignPointer, a.name,
          fmt::format("{} {}", a.name, block == nullptr ? "is not memory from allocate()" : "is misaligned"));
      usable = false;
    } else if (a.bytes() > static_cast<std::size_t>(block->data + block->size - a.begin())) {
      note(defects, Kind::kArrayTooSmall, a.name,
           fmt::format("{}: {} elements need {} bytes, {} were allocated", a.name, a.elements, a.bytes(),
                       block->data + block->size - a.begin()));
      usable = false;
    }
  }
  return usable;
}

bool overlapping(const Arrays& arrays, std::vector<Defect>& defects) {
  bool any = false;
  for (const Array& a : arrays)
    for (const Array& b : arrays)
      if (&a < &b && a.bytes() > 0 && b.bytes() > 0 && a.data != nullptr && b.data != nullptr &&
          a.begin() < b.begin() + b.bytes() && b.begin() < a.begin() + a.bytes()) {
        note(defects, Kind::kOverlappingArrays, b.name,
             fmt::format("{} and {} share memory", a.name, b.name));
        any = true;
      }
  return any;
}

// What a number holds that was not written.
bool all_0xff(const std::byte* number, std::size_t size) {
  return std::all_of(number, number + size, [](std::byte b) { return b == std::byte{0xFF}; });
}

}  // namespace

std::span<const std::byte> Tessellation::bits(const void* array, std::int64_t v) const {
  const std::size_t size = 3 * coordinate_size();
  return {static_cast<const std::byte*>(array) + static_cast<std::size_t>(v) * size, size};
}

bool Tessellation::unwritten(const void* array, std::int64_t v) const {
  const std::byte* its = bits(array, v).data();
  const std::size_t size = coordinate_size();
  return all_0xff(its, size) || all_0xff(its + size, size) || all_0xff(its + 2 * size, size);
}

bool Tessellation::indices_ok(std::int64_t t) const {
  const auto& corners = triangles()[t];
  return std::all_of(corners.begin(), corners.end(), [this](std::uint32_t v) { return v < vertex_count(); });
}

std::size_t Tessellation::channel_place(std::size_t channel, std::int64_t t, int k) const {
  std::int64_t before = 0;  // components of earlier channels
  for (std::size_t c = 0; c < channel; ++c) before += channel_components_[c];
  return static_cast<std::size_t>(3 * triangle_count() * before + (3 * t + k) * channel_components_[channel]);
}

std::span<const std::byte> Tessellation::channel_bits(std::size_t channel, std::int64_t t, int k) const {
  return {
      static_cast<const std::byte*>(out_.channel_values) + channel_place(channel, t, k) * coordinate_size(),
      static_cast<std::size_t>(channel_components_[channel]) * coordinate_size()};
}

std::int64_t Tessellation::channels_unwritten(std::int64_t t) const {
  std::int64_t count = 0;
  const std::size_t size = coordinate_size();
  for (std::size_t c = 0; c < channel_count(); ++c)
    for (const auto& [array, each] : {std::pair{out_.channel_values, 1}, {out_.channel_derivatives, 2}}) {
      if (array == nullptr) continue;
      const auto numbers = static_cast<std::size_t>(3 * each * channel_components_[c]);
      const auto* from = static_cast<const std::byte*>(array) +
                         static_cast<std::size_t>(each) * channel_place(c, t, 0) * size;
      for (std::size_t n = 0; n < numbers; ++n, from += size) count += all_0xff(from, size);
    }
  return count;
}

double Tessellation::channel_derivative(std::size_t channel, std::int64_t t, int k, int component,
                                        int parameter) const {
  return number(out_.channel_derivatives,
                2 * channel_place(channel, t, k) +
                    static_cast<std::size_t>(parameter * channel_components_[channel] + component));
}

void Tessellation::renumber_faces(std::span<const std::int32_t> to, std::int64_t count) {
  const auto renumber = [&](std::int32_t& face) {
    face = face >= 0 && static_cast<std::size_t>(face) < to.size() ? to[face] : -1;
  };
  for (std::int64_t v = 0; v < out_.vertex_count; ++v) renumber(out_.provenance[v].face);
  for (std::int64_t t = 0; t < out_.triangle_count; ++t) renumber(out_.triangle_face[t]);
  std::vector<std::int32_t> sizes(static_cast<std::size_t>(count));
  for (std::size_t f = 0; f < to.size(); ++f)
    if (to[f] >= 0) sizes[to[f]] = face_sizes_[f];
  face_sizes_ = std::move(sizes);
}

bool Tessellation::provenance_ok(std::int64_t v) const {
  const Place p = place(v);
  if (p.face < 0 || p.face >= std::ssize(face_sizes_) || p.denominator == 0) return false;
  const FaceDomain domain(scheme_, face_sizes_[p.face]);
  return domain.contains(point_of(p), domain.steps(p.denominator));
}

void Tessellation::inspect(lc_tessellation out, const lc_capabilities& promised,
                           const std::function<Matching(const Bare&)>& find_places) {
  const bool delivered = !find_places;
  const std::size_t real = coordinate_size();
  std::size_t components = 0;  // of all channels
  for (const std::int32_t c : channel_components_) components += static_cast<std::size_t>(c);
  const bool channels = components > 0, derivatives = channels && promised.channel_derivatives != 0;
  if (!channels) out.channel_values = nullptr;
  if (!derivatives) out.channel_derivatives = nullptr;
  const Arrays arrays{{
      {"positions", out.positions, out.vertex_count, 3, real, true},
      {"normals", out.normals, out.vertex_count, 3, real, promised.normals != 0, true},
      {"provenance", out.provenance, out.vertex_count, 4, 4, delivered},
      {"triangles", out.triangles, out.triangle_count, 3, 4, true},
      {"triangle_face", out.triangle_face, out.triangle_count, 1, 4, delivered},
      {"corner", out.corner, out.vertex_count, 1, 4, false},
      {"channel_values", out.channel_values, out.triangle_count, 3 * components, real, channels, true},
      {"channel_derivatives", out.channel_derivatives, out.triangle_count, 6 * components, real, derivatives,
       true},
  }};
  find_overruns(*memory_, arrays, overruns_);  // they are meaningful whatever else is wrong
  if (!counts_usable(out, defects_) || !memory_usable(*memory_, arrays, defects_) ||
      overlapping(arrays, defects_))
    return;

  out_ = out;
  count_bad(
      defects_, Kind::kIndexOutOfRange, "triangles", triangle_count(),
      [&](std::int64_t t) { return indices_ok(t); }, "triangles name a vertex that does not exist");
  if (!delivered) return take_places(find_places);
  count_bad(
      defects_, Kind::kFaceOutOfRange, "triangle_face", triangle_count(),
      [&](std::int64_t t) { return face_ok(t); }, "triangles name a control face that does not exist");
  count_bad(
      defects_, Kind::kProvenanceOutOfRange, "provenance", vertex_count(),
      [&](std::int64_t v) { return provenance_ok(v); }, "vertices name a place outside the control mesh");
}

void Tessellation::take_places(const std::function<Matching(const Bare&)>& find_places) {
  if (defects_.empty()) {
    matching_ = std::make_shared<Matching>(
        find_places({vertex_count(), triangles(), [this](std::int64_t v) { return position(v); }}));
    if (matching_->not_judged) throw NotAsked("without provenance: " + matching_->failure);
    if (!matching_->failure.empty()) note(defects_, Kind::kNotTheMesh, "triangles", matching_->failure);
  }
  if (!defects_.empty()) {
    out_.vertex_count = out_.triangle_count = 0;
    return;
  }
  out_.provenance = matching_->provenance.data();
  out_.corner = matching_->corner.data();
  out_.triangle_face = matching_->triangle_face.data();
}

}  // namespace limitcheck::verify
