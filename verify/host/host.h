// SPDX-License-Identifier: MIT
// The host's side of the plug-in interface (verify/subject/subject.h): hands a control mesh to a subject and
// takes back what it delivers, trusting nothing.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "data/control_mesh.h"
#include "verify/subject/face_domain.h"
#include "verify/subject/lent_mesh.h"
#include "verify/subject/subject.h"
#include "verify/subject/subject_error.h"

namespace limitcheck::verify {

/// Something is wrong with the arrays themselves, whatever is in them. One record per kind and array: how
/// many elements, and the first of them.
struct Defect {
  enum class Kind {
    kNegativeCount,      // vertex_count or triangle_count below 0
    kMissingArray,       // NULL although there are elements (normals: although the capabilities promise them)
    kForeignPointer,     // not inside memory from allocate(), or misaligned
    kArrayTooSmall,      // the counts do not fit in the memory behind the pointer
    kOverlappingArrays,  // two arrays share memory
    kIndexOutOfRange,    // a triangle names a vertex that does not exist
    kFaceOutOfRange,     // triangle_face names a control face that does not exist
    kNotTheMesh,  // without provenance: the triangles are not connected as those of the mesh at its depth
    kProvenanceOutOfRange,  // face or corner does not exist, denominator 0, or a point outside the face
    kMeshModified,          // the subject wrote to the control mesh
    kThrew,                 // release() let an exception through
  };
  Kind kind;
  std::string
      array;  // "positions", "normals", "provenance", "triangles", "triangle_face", "corner", "mesh", ""
  std::int64_t count = 0;   // elements concerned
  std::int64_t first = -1;  // the first of them, or -1
  std::string message;      // the whole in one sentence
};

/// A write outside an array, into the guard zone.
struct Overrun {
  std::string array;          // the array that begins in the block written around, or "block of N bytes"
  bool before = false;        // in front of the first byte, else behind the last
  std::int64_t distance = 0;  // bytes between the array and the farthest byte changed (1 = the neighbour)
};

namespace detail {
class Memory;
}
struct Bare;  // matching.h
struct Matching;
struct RefinedComplex;

/// What a subject delivered for one request. Owns its memory
/// and outlives the session. Thread-safe for reading.
///
/// If the arrays cannot be trusted as memory (negative count, missing, foreign, too small, overlapping), the
/// defect is recorded and vertex_count() = triangle_count() = 0: reading is always safe. Contents are handed
/// on as delivered: ask triangle_ok(t) before using the indices of t, provenance_ok(v) before using the
/// provenance of v.
class Tessellation {
 public:
  lc_precision precision() const { return precision_; }
  std::int64_t vertex_count() const { return out_.vertex_count; }
  std::int64_t triangle_count() const { return out_.triangle_count; }
  bool has_normals() const { return out_.normals != nullptr; }

  /// Position or unit normal of vertex v, 0 <= v < vertex_count(), whatever the precision (exact conversion).
  std::array<double, 3> position(std::int64_t v) const { return read(out_.positions, v); }
  std::array<double, 3> normal(std::int64_t v) const { return read(out_.normals, v); }

  /// Their bytes (12 or 24), to compare bits.
  std::span<const std::byte> position_bits(std::int64_t v) const { return bits(out_.positions, v); }
  std::span<const std::byte> normal_bits(std::int64_t v) const { return bits(out_.normals, v); }

  /// True if some coordinate still holds the 0xFF bytes it was handed out with. (A NaN that arithmetic makes
  /// has other bits.)
  bool position_unwritten(std::int64_t v) const { return unwritten(out_.positions, v); }
  bool normal_unwritten(std::int64_t v) const { return unwritten(out_.normals, v); }

  /// 3 * vertex_count() coordinates, x y z; empty if the subject's precision is the other one.
  std::span<const float> positions_f32() const { return array<float>(out_.positions, LC_FLOAT32); }
  std::span<const double> positions_f64() const { return array<double>(out_.positions, LC_FLOAT64); }
  std::span<const float> normals_f32() const { return array<float>(out_.normals, LC_FLOAT32); }
  std::span<const double> normals_f64() const { return array<double>(out_.normals, LC_FLOAT64); }

  std::span<const lc_provenance> provenance() const {
    return {out_.provenance, static_cast<std::size_t>(vertex_count())};
  }
  /// Of each vertex the corner whose quad its provenance is of; empty if none was delivered.
  std::span<const std::int32_t> corners() const {
    return {out_.corner, out_.corner == nullptr ? 0 : static_cast<std::size_t>(vertex_count())};
  }
  /// Both together.
  Place place(std::int64_t v) const {
    return place_of(out_.provenance[v], out_.corner == nullptr ? 0 : out_.corner[v]);
  }
  std::span<const std::array<std::uint32_t, 3>> triangles() const {
    return {reinterpret_cast<const std::array<std::uint32_t, 3>*>(out_.triangles),
            static_cast<std::size_t>(triangle_count())};
  }
  std::span<const std::int32_t> triangle_face() const {
    return {out_.triangle_face, static_cast<std::size_t>(triangle_count())};
  }

  /// Of the channels that the mesh was handed over with how many were delivered: all, or none.
  std::size_t channel_count() const {
    return out_.channel_values == nullptr ? 0 : channel_components_.size();
  }
  int components(std::size_t channel) const { return channel_components_[channel]; }
  /// A component of the value at corner k of triangle t, and the bytes of all of them.
  double channel_value(std::size_t channel, std::int64_t t, int k, int component) const {
    return number(out_.channel_values, channel_place(channel, t, k) + static_cast<std::size_t>(component));
  }
  std::span<const std::byte> channel_bits(std::size_t channel, std::int64_t t, int k) const;
  /// Numbers at the corners of triangle t, values and derivatives, that still hold the 0xFF bytes.
  std::int64_t channels_unwritten(std::int64_t t) const;
  /// The derivative of a component by a parameter, 0 or 1.
  bool has_channel_derivatives() const { return out_.channel_derivatives != nullptr; }
  double channel_derivative(std::size_t channel, std::int64_t t, int k, int component, int parameter) const;

  /// Indices and control face of triangle t are in range.
  bool triangle_ok(std::int64_t t) const { return face_ok(t) && indices_ok(t); }
  /// The control face exists and (i, j) / denominator lies in its domain.
  bool provenance_ok(std::int64_t v) const;

  /// Gives faces other numbers: face f of the request becomes to[f], one of `count` faces, or none (-1).
  void renumber_faces(std::span<const std::int32_t> to, std::int64_t count);

  /// How the places were found; null if they were delivered.
  const Matching* matching() const { return matching_.get(); }
  const std::vector<Defect>& defects() const { return defects_; }
  const std::vector<Overrun>& overruns() const { return overruns_; }

 private:
  friend class Session;
  std::size_t coordinate_size() const { return precision_ == LC_FLOAT32 ? sizeof(float) : sizeof(double); }
  std::array<double, 3> read(const void* array, std::int64_t v) const {
    const std::size_t k = 3 * static_cast<std::size_t>(v);
    return {number(array, k), number(array, k + 1), number(array, k + 2)};
  }
  std::span<const std::byte> bits(const void* array, std::int64_t v) const;
  bool unwritten(const void* array, std::int64_t v) const;
  template <class T>
  std::span<const T> array(const void* data, lc_precision precision) const {
    if (precision != precision_ || data == nullptr) return {};
    return {static_cast<const T*>(data), 3 * static_cast<std::size_t>(vertex_count())};
  }
  // The components at corner k of triangle t begin at so many times the numbers that a component has.
  std::size_t channel_place(std::size_t channel, std::int64_t t, int k) const;
  double number(const void* array, std::size_t at) const {
    return precision_ == LC_FLOAT64 ? static_cast<const double*>(array)[at]
                                    : static_cast<double>(static_cast<const float*>(array)[at]);
  }
  bool indices_ok(std::int64_t t) const;
  bool face_ok(std::int64_t t) const {
    return out_.triangle_face[t] >= 0 && out_.triangle_face[t] < std::ssize(face_sizes_);
  }
  // find_places: of a subject without provenance.
  void inspect(lc_tessellation out, const lc_capabilities& promised,
               const std::function<Matching(const Bare&)>& find_places);
  void take_places(const std::function<Matching(const Bare&)>& find_places);

  std::shared_ptr<detail::Memory> memory_;
  std::shared_ptr<Matching> matching_;
  lc_precision precision_ = LC_FLOAT32;
  data::Scheme scheme_ = data::Scheme::kLoop;
  std::vector<std::int32_t> face_sizes_;
  lc_tessellation out_{};
  std::vector<std::int32_t> channel_components_;  // of each channel of the mesh
  std::vector<Defect> defects_;
  std::vector<Overrun> overruns_;
};

/// The capabilities of a subject under these options for one scheme. Throws SubjectError; HostLacks; SubjectDied
/// (kProtocol) if it declares what means nothing.
lc_capabilities capabilities(const lc_subject& subject, const std::string& options = {},
                             data::Scheme scheme = data::Scheme::kLoop);

/// One control mesh in the hands of one subject: create() ... destroy().
class Session {
 public:
  /// What is handed over: valid meshes (data/validate.h), or whatever it is, to see the subject refuse it.
  enum class Input { kValid, kAsItIs };

  /// Rounds the positions to the subject's precision and calls create().
  /// Throws SubjectError: the subject refuses; of valid input, a coordinate is not finite, or
  /// out_of_range() refuses (NotAsked); NotAsked if the subject does not do the scheme, or is to see a
  /// mesh as it is and does not validate.
  ///   scheme  by default the one that the mesh is meant for
  Session(const lc_subject& subject, const data::ControlMesh& mesh, std::string options = {},
          Input input = Input::kValid, std::optional<data::Scheme> scheme = {});
  ~Session();
  /// destroy(), once. Throws SubjectError: the subject breaks down while it cleans up.
  void close();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  const lc_subject& subject() const { return subject_; }
  const lc_capabilities& capabilities() const { return capabilities_; }
  /// "name" or "name:options".
  std::string label() const { return subject_.name + (options_.empty() ? "" : ":" + options_); }
  /// The mesh as the subject got it: the reference takes these rounded positions as exact.
  const data::ControlMesh& mesh() const { return mesh_; }
  data::Scheme scheme() const { return lent_.scheme; }

  /// Tessellates.
  ///   face_depth   one per control face: 0..max_depth, or -1 (culled)
  ///   threads      at most so many, >= 1
  /// Throws SubjectError: the subject fails; NotAsked if the depths are beyond max_depth or differ although
  /// it cannot. Throws data::ArgumentError: wrong number of depths, depth <
  /// -1, threads < 1.
  Tessellation tessellate(std::span<const std::int32_t> face_depth, int threads = 1);
  /// The same depth for all faces.
  Tessellation tessellate(int depth, int threads = 1);

 private:
  const lc_subject& subject_;
  std::string options_;
  lc_capabilities capabilities_{};
  data::ControlMesh mesh_;
  // The subject's copy, so that a subject that writes to it is found out and does not spoil the reference's.
  LentMesh lent_;
  void* instance_ = nullptr;
  bool closed_ = false;
  // Of a subject without provenance: what it has to deliver at the depth that was asked for last.
  std::shared_ptr<const RefinedComplex> expected_;
};

/// What the system allows this program and those it starts less of than a subject may take (ulimit -v, -d, -n, -u),
/// in a sentence; empty: enough of everything. 4 GiB of addresses, 64 open files, 64 processes.
std::string host_shortage();

/// Empty if the largest coordinate is 0 or within 2^-100 and 2^100, 2^-240 and 2^240 with double_precision;
/// else a sentence that says so. Beyond, fourth powers of lengths (the square of a cross product of tangents)
/// overflow or vanish even if the tangents are scaled to their range first, which is no fault of a subject.
///   mesh  finite positions
std::string out_of_range(const data::ControlMesh& mesh, bool double_precision);

/// Throws data::ArgumentError with that sentence, after the mesh's name.
void require_range(const std::string& name, const data::ControlMesh& mesh, bool double_precision);

}  // namespace limitcheck::verify
