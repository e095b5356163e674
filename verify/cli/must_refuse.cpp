// SPDX-License-Identifier: MIT
#include "verify/cli/must_refuse.h"

#include <fmt/core.h>

#include <stdexcept>
#include <utility>

#include "data/error.h"
#include "data/io/polygon_soup.h"
#include "data/validate.h"
#include "verify/audit/refusal.h"

namespace limitcheck::cli {

data::ControlMesh open_broken_mesh(const std::string& file) {
  const data::io::PolygonSoup soup = data::io::read_soup(file);
  data::ControlMesh mesh;
  mesh.positions = soup.positions;
  std::size_t begin = 0;
  for (const std::size_t end : soup.polygon_end) {
    const auto corner = [&](std::size_t k) {
      if (!std::in_range<std::int32_t>(soup.corners[k]))
        throw data::InputError(
            "MESH_INDEX_OUT_OF_RANGE", file, 0,
            fmt::format("a face names vertex {}: 32 bits do not name it", soup.corners[k]));
      return static_cast<std::int32_t>(soup.corners[k]);
    };
    for (std::size_t k = begin + 1; k + 1 < end; ++k)
      mesh.triangles.push_back({corner(begin), corner(k), corner(k + 1)});
    begin = end;
  }
  if (data::validate(mesh).empty())
    throw std::invalid_argument(
        fmt::format("--must-refuse: nothing is wrong with {}, so nobody must refuse it", file));
  return mesh;
}

std::vector<verify::Result> must_refuse(const std::vector<verify::AuditSubject>& subjects,
                                        const std::vector<verify::AuditMesh>& meshes, int threads) {
  std::vector<verify::Result> results;
  for (const verify::AuditSubject& s : subjects)
    for (const verify::AuditMesh& m : meshes) {
      verify::Refusal refusal = verify::ask_for_refusal(s, m.mesh, threads);
      verify::Result r;
      r.subject = s.options.empty() ? s.subject->name : fmt::format("{}:{}", s.subject->name, s.options);
      r.mesh = m.name;
      r.check = "rejected-inputs";
      r.status = refusal.status;
      r.unit = "meshes";
      r.of = 1;
      r.bad = verify::is_bad(r);
      r.bound = 0;
      r.message = std::move(refusal.message);
      results.push_back(std::move(r));
    }
  return results;
}

}  // namespace limitcheck::cli
