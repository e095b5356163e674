// SPDX-License-Identifier: MIT
#include "verify/hunt/neighbourhood.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <utility>
#include <vector>

#include "verify/audit/faces_around.h"

namespace limitcheck::verify {
namespace {

// Classes of valence: what tables and special cases of programs tell apart.
std::string valence_class(std::size_t faces) {
  if (faces < 7) return fmt::format("{}", faces);
  return faces <= 12 ? "7-12" : faces <= 40 ? "13-40" : "41 and more";
}

}  // namespace

std::string neighbourhood(const Result& finding, const AuditMesh& audited) {
  const data::ControlMesh& mesh = audited.mesh;
  if (!finding.witness || finding.witness->face < 0 ||
      finding.witness->face >= static_cast<std::int64_t>(mesh.faces.size()))
    return "";
  const auto face = static_cast<std::size_t>(finding.witness->face);
  const auto corners = mesh.faces[face];
  const FacesAround around(mesh.faces, mesh.positions.size());
  const bool loop = finding.scheme == data::Scheme::kLoop;
  const std::size_t regular = loop ? 6 : 4;

  bool boundary = false, sharp = false;
  std::size_t most = 0, extraordinary = 0;
  bool adjacent = false, last = false, first = false;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const std::int32_t v = corners[k];
    std::multiset<std::int32_t> beside;  // neighbours of v in faces at v: twice inside the mesh
    for (const std::int32_t f : around.of(v)) {
      const auto its = mesh.faces[static_cast<std::size_t>(f)];
      for (std::size_t j = 0; j < its.size(); ++j)
        if (its[j] == v)
          beside.insert(its[(j + 1) % its.size()]), beside.insert(its[(j + its.size() - 1) % its.size()]);
    }
    const bool border =
        std::any_of(beside.begin(), beside.end(), [&](auto n) { return beside.count(n) == 1; });
    boundary = boundary || border;
    const bool odd = !border && around.of(v).size() != regular;
    if (odd) ++extraordinary, most = std::max(most, around.of(v).size());
    adjacent = adjacent || (odd && last) || (odd && first && k + 1 == corners.size() && corners.size() > 2);
    if (k == 0) first = odd;
    last = odd;
    for (const data::SharpVertex& s : mesh.sharpness.vertices) sharp = sharp || s.vertex == v;
    for (const data::SharpEdge& s : mesh.sharpness.edges) sharp = sharp || s.a == v || s.b == v;
  }
  int difference = 0;
  if (!audited.face_depth.empty())
    for (const std::int32_t v : corners)
      for (const std::int32_t f : around.of(v)) {
        const int other = audited.face_depth[static_cast<std::size_t>(f)];
        if (other >= 0) difference = std::max(difference, std::abs(other - audited.face_depth[face]));
      }

  std::string words;
  const auto add = [&](const std::string& what) { words += (words.empty() ? "" : "; ") + what; };
  if (!loop && corners.size() != 4) add("no quad");
  if (boundary) add("boundary");
  if (extraordinary > 0)
    add(fmt::format("{} of {} faces{}", extraordinary == 1 ? "a vertex" : "vertices", valence_class(most),
                    adjacent ? ", extraordinary ones side by side" : ""));
  if (sharp) add("sharp edges");
  if (difference > 0) add(fmt::format("depths differ by {}", difference));
  return words.empty() ? "regular face" : words;
}

std::string signature(const Result& finding, const AuditMesh& mesh) {
  const std::string where = neighbourhood(finding, mesh);
  return fmt::format("{}{}{}{}{}",
                     finding.scheme == data::Scheme::kLoop ? "" : "catmull-clark: ", finding.check,
                     finding.status == Status::kFinding ? "" : fmt::format(" ({})", word(finding.status)),
                     where.empty() ? "" : ": ", where);
}

}  // namespace limitcheck::verify
