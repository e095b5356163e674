// SPDX-License-Identifier: MIT
#include "verify/hunt/hunt_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <tuple>
#include <vector>

#include "data/numeral.h"
#include "verify/evidence/cells.h"
#include "verify/relations/relations.h"

namespace limitcheck::verify {
namespace {

// Classes of valence: what tables and special cases of programs tell apart.
std::string valence_class(std::size_t faces) {
  if (faces < 8) return fmt::format("{}", faces);
  return faces <= 40 ? "8 to 40" : "more than 40";
}
int rank_of(std::size_t faces, std::size_t regular) {
  if (faces == regular) return 0;
  return faces > 40 ? 3 : faces > 7 || faces + 2 < regular ? 2 : 1;
}

// What a vertex is, from the least to the most that a program has to mind.
enum class Kind { kInner, kBoundary, kCrease, kDart, kCorner };
constexpr std::array kWords{"inner vertex", "boundary vertex", "crease", "dart", "corner"};

Kind kind_of(const ControlVertex& at) {
  const int sharp = at.infinite + at.semi;
  if (at.own > 0 || sharp > 2 || (at.boundary && sharp > 0)) return Kind::kCorner;
  if (at.boundary) return Kind::kBoundary;
  return sharp == 0 ? Kind::kInner : sharp == 1 ? Kind::kDart : Kind::kCrease;
}

// How near the place is to each corner, 0 to 1; with the middle of a face that is cut into quads behind them.
// All alike if the finding names no place.
std::vector<double> nearness(const Result& finding, std::size_t corners, bool loop) {
  const bool cut = !loop && corners != 4;
  std::vector<double> near(corners + (cut ? 1 : 0), 0);
  const Witness& w = *finding.witness;
  if (w.l1.empty() || w.l2.empty()) return near;
  const double u = data::parse<double>(w.l1), v = data::parse<double>(w.l2);
  if (loop) return {1 - u - v, u, v};
  if (!cut) return {(1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v};
  near[static_cast<std::size_t>(std::max(w.corner, 0)) % corners] = (1 - u) * (1 - v);
  near.back() = u * v;
  return near;
}

int depth_difference(const AuditMesh& audited, std::size_t face, const std::vector<ControlVertex>& vertices) {
  int difference = 0;
  if (audited.face_depth.empty()) return 0;
  for (const std::int32_t v : audited.mesh.faces[face])
    for (const std::int32_t f : vertices[static_cast<std::size_t>(v)].faces) {
      const int other = audited.face_depth[static_cast<std::size_t>(f)];
      if (other >= 0) difference = std::max(difference, std::abs(other - audited.face_depth[face]));
    }
  return difference;
}

}  // namespace

std::string LikelyCause::words() const {
  if (kind.empty()) return "";
  std::string words = kind;
  if (kind != "regular")
    words += fmt::format(" of {} {}{}", valence,
                         kind == "face"   ? "corners"
                         : valence == "1" ? "face"
                                          : "faces",
                         beside ? ", beside another extraordinary one" : "");
  if (difference > 3) return words + "; depths differ by more than 3";
  return difference > 0 ? words + fmt::format("; depths differ by {}", difference) : words;
}

bool LikelyCause::covers(const LikelyCause& other) const {
  if (*this == other || kind.empty() || other.kind.empty() || difference > other.difference) return false;
  if (kind == "regular") return true;
  return kind == other.kind && (valence == other.valence || rank < other.rank) && beside <= other.beside;
}

LikelyCause likely_cause(const Result& finding, const AuditMesh& audited) {
  const data::ControlMesh& mesh = audited.mesh;
  // Another order, place or size is that of the whole mesh.
  const auto& relations = relation_rows();
  if (std::find(relations.begin(), relations.end(), finding.check) != relations.end()) return {};
  if (!finding.witness || finding.witness->face < 0 ||
      finding.witness->face >= static_cast<std::int64_t>(mesh.faces.size()))
    return {};
  const auto face = static_cast<std::size_t>(finding.witness->face);
  const auto corners = mesh.faces[face];
  const std::vector<ControlVertex> vertices = ControlVertices(Lattice(mesh, audited.scheme(), 0)).all;
  const bool loop = finding.scheme == data::Scheme::kLoop;
  const std::size_t regular = loop ? 6 : 4;

  const std::vector<double> near = nearness(finding, corners.size(), loop);
  std::optional<std::tuple<double, Kind, std::size_t>> cause;
  bool middle = false;
  int extraordinary = 0;
  for (std::size_t k = 0; k < near.size(); ++k) {
    const bool of_face = k == corners.size();
    const ControlVertex* const at = of_face ? nullptr : &vertices[static_cast<std::size_t>(corners[k])];
    const std::tuple here{near[k], at == nullptr ? Kind::kInner : kind_of(*at),
                          at == nullptr ? corners.size() : at->faces.size()};
    if (std::get<Kind>(here) == Kind::kInner && std::get<std::size_t>(here) == regular) continue;
    ++extraordinary;
    if (!cause || here > *cause) cause = here, middle = of_face;
  }
  LikelyCause where;
  where.difference = std::min(4, depth_difference(audited, face, vertices));
  where.kind = "regular";
  if (!cause) return where;
  const auto [nearness, kind, faces] = *cause;
  where.kind = middle ? "face" : kWords[static_cast<std::size_t>(kind)];
  where.valence = valence_class(faces);
  where.rank = rank_of(faces, kind == Kind::kBoundary ? regular / 2 : regular);
  where.beside = extraordinary > 1;
  return where;
}

std::string signature(const Result& finding, const LikelyCause& where) {
  return fmt::format("{}{}{}{}{}",
                     finding.scheme == data::Scheme::kLoop ? "" : "catmull-clark: ", finding.check,
                     finding.status == Status::kFinding ? "" : fmt::format(" ({})", word(finding.status)),
                     where.kind.empty() ? "" : ": ", where.words());
}

}  // namespace limitcheck::verify
