// SPDX-License-Identifier: MIT
#include "verify/cli/audit_plan.h"

#include <fmt/core.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string_view>
#include <system_error>
#include <utility>

#include "verify/report/result_json.h"

namespace limitcheck::cli {
namespace {

namespace fs = std::filesystem;

std::uint64_t fnv1a(std::string_view bytes, std::uint64_t hash) {
  for (const char c : bytes) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  return hash;
}

template <class List>
std::string_view bytes(const List& list) {
  return {reinterpret_cast<const char*>(list.data()), list.size() * sizeof(*list.data())};
}

// A hash, which differs for another mesh of the same name.
std::string content(const verify::AuditMesh& m) {
  std::uint64_t hash = fnv1a(bytes(m.mesh.positions), 0xcbf29ce484222325ULL);
  hash = fnv1a(bytes(m.face_depth), fnv1a(bytes(m.mesh.faces.corners()), hash));
  for (std::size_t f = 0; f < m.mesh.faces.size(); ++f) {
    const std::size_t end = m.mesh.faces.first_corner(f + 1);
    hash = fnv1a({reinterpret_cast<const char*>(&end), sizeof end}, hash);
  }
  return fmt::format("{:016x}", hash);
}

// A library that was built again is another subject.
std::string stamp(const lc_subject& subject) {
  std::error_code error;
  const auto time = fs::last_write_time(subject.name, error);
  return error ? std::string(subject.description != nullptr ? subject.description : "")
               : fmt::format("{} {}", fs::file_size(subject.name, error), time.time_since_epoch().count());
}

}  // namespace

verify::Plan audit_plan(const std::vector<verify::AuditSubject>& subjects,
                        const std::vector<verify::AuditMesh>& meshes, const verify::Report& report,
                        const verify::CoverageQuestion& coverage, const std::string& level) {
  nlohmann::json what{{"report", verify::header_json(report)},
                      {"coverage", verify::coverage_json(coverage)},
                      {"level", level}};
  for (const auto& s : subjects) what["stamps"].push_back(stamp(*s.subject));
  bool polygons = false;
  for (const auto& m : meshes) {
    what["meshes"].push_back({m.name, content(m), m.depth, m.depths, name_of(m.scheme())});
    polygons = polygons || !m.mesh.faces.are_triangles();
  }
  what["polygons"] = polygons;
  return {"limitcheck audit", std::move(what), subjects.size() * meshes.size(), subjects.size()};
}

}  // namespace limitcheck::cli
