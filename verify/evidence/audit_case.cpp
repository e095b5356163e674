// SPDX-License-Identifier: MIT
#include "verify/evidence/audit_case.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <map>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

#include "data/channel.h"
#include "data/cut_out.h"
#include "data/error.h"
#include "data/io/whole_content.h"
#include "data/splitmix64.h"
#include "reference/mesh/support.h"
#include "verify/evidence/faces_around.h"
#include "verify/evidence/vector.h"

namespace limitcheck::verify {

using data::ControlMesh;

namespace {

// How many faces, edges of a sharpness that ends and of one that does not, the vertex's own, and whether its
// index has more than 15 and 16 bits.
using Kind = std::array<float, 5>;
using Kinds = std::map<Kind, std::vector<std::int32_t>>;

Kinds kinds_of_vertices(const ControlMesh& mesh, const FacesAround& around) {
  std::vector<Kind> kind(mesh.positions.size());
  for (const data::SharpEdge& e : mesh.sharpness.edges)
    for (const std::int32_t v : {e.a, e.b})
      if (e.sharpness > 0) ++kind[v][e.sharpness < data::kInfiniteSharpness ? 1 : 2];
  for (const data::SharpVertex& s : mesh.sharpness.vertices) kind[s.vertex][3] = s.sharpness;
  Kinds all;
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(kind.size()); ++v) {
    kind[v][0] = static_cast<float>(around.of(v).size());
    kind[v][4] = static_cast<float>(std::min(v >> 15, 2));
    all[kind[v]].push_back(v);
  }
  return all;
}

}  // namespace

MeshSample::MeshSample(const ControlMesh& whole, std::size_t faces, std::uint64_t seed)
    : text_(fmt::format("{}:{}", faces, seed)),
      part_of_(whole.faces.size(), -1),
      in_patch_(whole.faces.size(), false) {
  const FacesAround around(whole.faces, whole.positions.size());
  data::SplitMix64 random(seed);
  faces = std::min(faces, whole.faces.size());
  Kinds kinds = kinds_of_vertices(whole, around);
  for (std::size_t chosen = 0; chosen < faces;)
    for (auto& [kind, left] : kinds) {
      if (left.empty() || chosen >= faces) continue;
      std::swap(left[random.next() % left.size()], left.back());
      for (const std::int32_t f : around.of(left.back())) {
        chosen += !in_patch_[f];
        in_patch_[f] = true;
      }
      left.pop_back();
    }

  for (std::size_t f = 0; f < in_patch_.size(); ++f)
    if (in_patch_[f]) faces_.push_back(static_cast<std::int32_t>(f));
  faces_ = reference::support_of(
      std::move(faces_), whole.faces, [&](std::int32_t v) { return around.of(v); }, whole.sharpness.creasing);
  std::sort(faces_.begin(), faces_.end());
  for (std::size_t p = 0; p < faces_.size(); ++p) part_of_[faces_[p]] = static_cast<std::int32_t>(p);
  data::CutOut cut = data::cut_out(whole.faces, faces_);
  part_ = {cut.of(whole.positions), {}, cut.of(whole.sharpness)};
  part_.faces = std::move(cut.faces);
  part_.channels = data::channels_of(whole.channels, whole.faces, faces_);
  vertices_ = std::move(cut.vertices);
}

std::vector<std::int32_t> MeshSample::cull(std::vector<std::int32_t> depth) const {
  for (std::size_t f = 0; f < depth.size(); ++f)
    if (!in_patch_[f]) depth[f] = -1;
  return depth;
}

std::vector<std::int32_t> MeshSample::depths_of_part(std::span<const std::int32_t> depth_of_whole) const {
  std::vector<std::int32_t> depth(faces_.size());
  for (std::size_t p = 0; p < faces_.size(); ++p) depth[p] = depth_of_whole[faces_[p]];
  return depth;
}

ControlMesh MeshSample::part_with(const ControlMesh& positions) const {
  ControlMesh mesh;
  mesh.faces = part_.faces;
  mesh.sharpness = part_.sharpness;
  mesh.channels = data::channels_of(positions.channels, positions.faces, faces_);
  mesh.positions.reserve(vertices_.size());
  for (const std::int32_t v : vertices_) mesh.positions.push_back(positions.positions[v]);
  return mesh;
}

namespace {

using FaceDepths = std::vector<std::int32_t>;

// Seen from twice the size of the mesh away, slanting: half of a closed mesh is culled, a flat one is seen.
// An edge of a triangle on the screen is shorter than this times its distance, so that a mesh of a few
// hundred faces shows more than one depth.
FaceDepths view_depths(const data::ControlMesh& mesh, int deepest) {
  constexpr double kEdge = 0.03;
  Vector low = mesh.positions.at(0), high = low;
  for (const Vector& p : mesh.positions)
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  const double away = 2 * norm(high - low) / norm(Vector{1, 2, 3});
  const Vector eye = 0.5 * (low + high) + away * Vector{1, 2, 3};
  FaceDepths depths;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const auto corners = mesh.faces[f];
    const auto p = [&](std::size_t k) -> const Vector& {
      return mesh.positions.at(corners[k % corners.size()]);
    };
    Vector sum{}, area{};
    double edge = 0;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      sum = sum + p(k);
      area = area + cross(p(k) - p(0), p(k + 1) - p(0));
      edge = std::max(edge, norm(p(k + 1) - p(k)));
    }
    const Vector to_eye = eye - (1. / static_cast<double>(corners.size())) * sum;
    if (dot(area, to_eye) <= 0) {
      depths.push_back(-1);
      continue;
    }
    int depth = 0;
    for (; depth < deepest && edge > kEdge * norm(to_eye); ++depth) edge /= 2;
    depths.push_back(depth);
  }
  return depths;
}

FaceDepths read_depths(const std::string& file, std::size_t faces, int deepest) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored))
    throw data::ArgumentError(fmt::format("--depths: cannot read {}", file));
  std::istringstream in(data::io::whole_content(file));
  FaceDepths depths;
  for (std::string word; in >> word;) {
    std::int32_t depth = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), depth);
    if (error != std::errc{} || end != word.data() + word.size() || depth < -1 || depth > deepest)
      throw data::ArgumentError(
          fmt::format("--depths: {}: '{}' is no depth from -1 to {} (--depth)", file, word, deepest));
    depths.push_back(depth);
  }
  if (depths.size() != faces)
    throw data::ArgumentError(
        fmt::format("--depths: {}: {} depths for {} faces", file, depths.size(), faces));
  return depths;
}

}  // namespace

std::vector<std::int32_t> random_depths(std::size_t faces, int least, int most, std::uint64_t seed) {
  data::SplitMix64 random(seed);
  FaceDepths out(faces);
  for (std::int32_t& d : out)
    d = least + static_cast<std::int32_t>(random.next() % static_cast<std::uint64_t>(most - least + 1));
  return out;
}

std::string Depths::text() const {
  const std::string before = after ? fmt::format("after:{}:", *after) : "";
  if (kind == "random")
    return fmt::format("{}random:{}{}", before, seed.value_or(1), visible ? ":visible" : "");
  return before + (kind == "file" ? "file:" + file : kind);
}

std::string after_of(const std::string& depths) {
  constexpr std::string_view kAfter = "after:";
  if (!depths.starts_with(kAfter)) return "";
  return depths.substr(0, std::min(depths.find(':', kAfter.size()), depths.size() - 1) + 1);
}

std::vector<FaceDepths> earlier_depths(const std::string& depths, std::size_t faces, int deepest, bool each) {
  std::vector<FaceDepths> requests;
  if (after_of(depths).empty()) return requests;
  data::SplitMix64 random(*parse_depths(depths).after);
  for (std::uint64_t left = 1 + random.next() % 3; left > 0; --left) {
    const std::uint64_t kind = random.next() % 3, seed = random.next();
    const auto one = static_cast<std::int32_t>(seed % (static_cast<std::uint64_t>(deepest) + 1));
    if (kind == 0 || !each)
      requests.emplace_back(faces, one);
    else
      requests.push_back(random_depths(faces, kind == 1 ? 0 : -1, deepest, seed));
  }
  return requests;
}

Depths parse_depths(const std::string& text) {
  const auto seed_in = [](std::string_view word) {
    std::uint64_t seed = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), seed);
    return error == std::errc{} && end == word.data() + word.size() ? std::optional(seed) : std::nullopt;
  };
  const std::string_view view(text);
  if (const std::string before = after_of(text); before.size() > 7 && before.ends_with(':')) {
    const auto seed = seed_in(view.substr(6, before.size() - 7));
    const std::string rest = text.substr(before.size());
    if (seed && after_of(rest).empty()) {
      Depths depths = parse_depths(rest);
      depths.after = seed;
      return depths;
    }
  }
  for (const char* word : {"uniform", "view", "face0-culled", "all-culled"})
    if (text == word) return {.kind = text};
  if (text.starts_with("file:")) return {.kind = "file", .file = text.substr(5)};
  if (text == "random") return {.kind = text, .seed = 1};
  if (text.starts_with("random:")) {
    const bool visible = text.ends_with(":visible");
    if (const auto seed = seed_in(view.substr(7, text.size() - 7 - (visible ? 8 : 0))))
      return {.kind = "random", .seed = seed, .visible = visible};
  }
  throw data::ArgumentError(fmt::format(
      "--depths {}: uniform, random[:SEED[:visible]], view, face0-culled, all-culled or file:FILE, and "
      "after:SEED: before one of them",
      text));
}

std::vector<std::int32_t> face_depths(const Depths& depths, const data::ControlMesh& mesh, int deepest) {
  const std::size_t faces = mesh.faces.size();
  if (depths.kind == "view") return view_depths(mesh, deepest);
  if (depths.kind == "random") return random_depths(faces, depths.visible ? 0 : -1, deepest, *depths.seed);
  if (depths.kind == "file") return read_depths(depths.file, faces, deepest);
  if (depths.kind == "all-culled") return FaceDepths(faces, -1);
  if (depths.kind == "face0-culled") {
    FaceDepths all(faces, deepest);
    if (faces > 0) all[0] = -1;
    return all;
  }
  return {};
}

}  // namespace limitcheck::verify
