// SPDX-License-Identifier: MIT
#include "verify/evidence/face_depths.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <sstream>
#include <system_error>

#include "data/error.h"
#include "data/io/whole_content.h"
#include "data/splitmix64.h"
#include "verify/evidence/vector.h"

namespace limitcheck::verify {
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
