// SPDX-License-Identifier: MIT
// Tessellations as files would have them: of Loop's limit surface, of quads as Blender writes them, and of surfaces
// with sharp edges, which have a normal for each corner of a triangle. For tests of this folder.
#pragma once

#include <gtest/gtest.h>

#include <fmt/core.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "data/splitmix64.h"
#include "reference/catmull_clark/recursion.h"
#include "reference/loop/refine.h"
#include "reference/surface/surface.h"
#include "verify/files/audit_files.h"
#include "verify/files/checks/hausdorff.h"
#include "verify/files/read/tessellation_file.h"

namespace limitcheck::verify::test {

inline void add_triangle(FileTessellation& t, const std::array<std::int32_t, 3>& corners) {
  t.triangles.push_back(corners);
  t.polygon.push_back(t.polygons++);
}

// The limit surface at a depth, in float as engines deliver it.
inline FileTessellation exact(const data::ControlMesh& mesh, int depth, bool limit = true) {
  const auto refined = reference::refine<double>(mesh, depth);
  const auto limits = refined.limits();
  FileTessellation t{.name = "test.ply"};
  for (const auto& p : limit ? limits.positions : refined.positions())
    t.positions.push_back({float(p.x), float(p.y), float(p.z)});
  for (const auto& n : limits.normals)
    t.normals.push_back({static_cast<std::int32_t>(t.normals.size()), {float(n.x), float(n.y), float(n.z)}});
  for (const auto& corners : refined.triangles()) add_triangle(t, corners);
  t.used.assign(t.positions.size(), true);
  return t;
}

// As shuffled.ply would be: other numbers for the vertices, other order of the triangles, corners turned.
inline FileTessellation shuffled(const FileTessellation& from, std::uint64_t seed) {
  data::SplitMix64 random(seed);
  const auto permutation = [&](std::size_t n) {
    std::vector<std::int32_t> p(n);
    std::iota(p.begin(), p.end(), 0);
    for (std::size_t k = n; k > 1; --k) std::swap(p[k - 1], p[random.next() % k]);
    return p;
  };
  FileTessellation t = from;
  const auto to = permutation(t.positions.size());
  for (std::size_t v = 0; v < t.positions.size(); ++v) t.positions[to[v]] = from.positions[v];
  for (auto& n : t.normals) n.vertex = to[n.vertex];
  const auto order = permutation(t.triangles.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const auto& f = from.triangles[k];
    const auto turn = random.next() % 3;
    t.triangles[order[k]] = {to[f[turn]], to[f[(turn + 1) % 3]], to[f[(turn + 2) % 3]]};
  }
  return t;
}

inline FilesAudit audit(const data::ControlMesh& mesh, FileTessellation t, const FilesOptions& options = {},
                        const std::vector<ProvenanceRow>& provenance = {}) {
  return audit_files("mesh", mesh, std::move(t), provenance, options,
                     [](const std::string&, std::size_t, std::size_t) {});
}

inline const Result& row(const FilesAudit& a, const std::string& check) {
  for (const Result& r : a.results)
    if (r.check == check) return r;
  throw std::out_of_range(check);
}

inline std::string findings(const FilesAudit& a) {
  std::string list;
  for (const Result& r : a.results)
    if (is_bad(r)) list += (list.empty() ? "" : " ") + r.check;
  return list;
}

// Faults of one place each.
inline void turn_a_normal(FileTessellation& t) {  // by 0.3 degrees
  auto& n = t.normals[321].direction;
  const Vector aside = cross(n, std::abs(n[0]) < .5 ? Vector{1, 0, 0} : Vector{0, 1, 0});
  n = n + (5e-3 / norm(aside)) * aside;
}
inline void turn_a_triangle(FileTessellation& t) {
  std::swap(t.triangles[99][0], t.triangles[99][1]);
}
inline void repeat_a_triangle(FileTessellation& t) {
  t.triangles.push_back(t.triangles[40]);
}
inline void leave_out_a_triangle(FileTessellation& t) {
  t.triangles.erase(t.triangles.begin() + 40);
}
// A corner of one triangle only, one ulp of float or of double beside.
template <class Real>
void crack(FileTessellation& t, std::size_t triangle, std::size_t corner) {
  std::int32_t& vertex = t.triangles[triangle][corner];
  t.positions.push_back(t.positions[vertex]);
  t.positions.back()[0] = std::nextafter(static_cast<Real>(t.positions.back()[0]), Real{9});
  t.used.push_back(true);
  vertex = static_cast<std::int32_t>(t.positions.size()) - 1;
}

// The brackets hold dense samples of both sides: of the triangles, and of the surface, which are given; and are not
// much too wide. The points of the evidence are placed.
inline void expect_brackets(const FileEvidence& e, const std::vector<Vector>& samples) {
  const Hausdorff h = hausdorff(e);
  const FileTessellation& t = e.tessellation;
  double there = 0, back = 0;
  for (const auto& c : t.triangles)
    for (int i = 0; i <= 6; ++i)
      for (int j = 0; i + j <= 6; ++j) {
        const Vector& o = t.positions[c[0]];
        const Vector p = o + (i / 6.) * (t.positions[c[1]] - o) + (j / 6.) * (t.positions[c[2]] - o);
        there = std::max(there, e.surface.closest(p).distance);
      }
  for (const Vector& s : samples) {
    double least = 1e300;
    for (const auto& c : t.triangles)
      least = std::min(
          least, closest_on_triangle(s, {t.positions[c[0]], t.positions[c[1]], t.positions[c[2]]}).distance);
    back = std::max(back, least);
  }
  EXPECT_LE(there, h.from_triangles.at_most) << e.control_name;
  EXPECT_LE(back, h.from_surface.at_most) << e.control_name;
  EXPECT_GE(h.from_triangles.at_least, .9 * there) << e.control_name;
  EXPECT_GE(h.from_surface.at_least, .9 * back) << e.control_name;
  EXPECT_LE(h.from_triangles.at_most, 6 * h.from_triangles.at_least) << e.control_name;
  EXPECT_EQ(h.loose, 0) << e.control_name;
}

/// The mesh refined so many times, moved to the limit or not, as the text of an OBJ file of quads (at depth
/// 0: of the control faces) with the limit's normals.
inline std::string obj_of_quads(const data::ControlMesh& mesh, int depth, bool limit) {
  reference::catmull_clark::RefinedMesh<double> refined(mesh.faces, reference::positions_of<double>(mesh));
  for (int step = 0; step < depth; ++step) refined.refine();
  const auto limits = refined.limits();
  std::string text;
  for (const auto& p : limit ? limits.positions : refined.positions())
    text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
  for (const auto& n : limits.normals) text += fmt::format("vn {} {} {}\n", n.x, n.y, n.z);
  const data::Faces& faces = refined.topology().faces();
  for (std::size_t f = 0; f < faces.size(); ++f) {
    text += "f";
    for (const std::int32_t v : faces[f]) text += fmt::format(" {0}//{0}", v + 1);
    text += "\n";
  }
  return text;
}

/// As the door reads it.
inline FileTessellation read_obj(const std::string& text) {
  const auto file = std::filesystem::temp_directory_path() / fmt::format("limitcheck-quads-{}.obj", getpid());
  std::ofstream(file) << text;
  FileTessellation t = read_tessellation(file);
  std::filesystem::remove(file);
  return t;
}

inline FileTessellation quad_file(const data::ControlMesh& mesh, int depth, bool limit = true) {
  return read_obj(obj_of_quads(mesh, depth, limit));
}

/// A triangle of the lattice at a corner of a face, which has so many steps along a side.
struct CornersAt {
  std::size_t face, corner;
  int steps;
  std::array<std::array<int, 2>, 3> at;
};

/// The limit surface at a depth >= 1, holes left out, exact but for rounding; each corner of a triangle has the normal
/// of its side. `add` to the file of each triangle.
inline FileTessellation sharp_file(
    const data::ControlMesh& mesh, data::Scheme scheme, int depth,
    const std::function<void(FileTessellation&, const CornersAt&)>& add = [](auto&, auto&) {}) {
  const reference::Surface surface(mesh, scheme);
  const bool loop = scheme == data::Scheme::kLoop;
  FileTessellation t{.name = "sharp.obj"};
  const auto put = [&](auto&& vertex, std::size_t f, std::size_t corner, int steps,
                       std::array<std::array<int, 2>, 3> at) {
    auto& triangle = t.triangles.emplace_back();
    auto& normals = t.corner_normals.emplace_back();
    for (std::size_t c = 0; c < 3; ++c) {
      const double u = at[c][0] / static_cast<double>(steps), v = at[c][1] / static_cast<double>(steps);
      const auto s =
          surface.evaluate(static_cast<int>(f), static_cast<int>(corner), u, v, reference::Order::kFirst);
      triangle[c] = vertex(f, corner, at[c][0], at[c][1]);
      normals[c] = static_cast<std::int32_t>(t.normals.size());
      t.normals.push_back({triangle[c], vector_of(s.normal)});
      t.used[triangle[c]] = true;
    }
    t.polygon.push_back(t.polygons++);
    add(t, {f, corner, steps, at});
  };
  const auto fill = [&](auto refined, auto&& vertex) {
    for (int step = 0; step < depth; ++step) refined.refine();
    const auto named = [&](auto... place) { return vertex(refined, place...); };
    for (const auto& p : refined.limits().positions) t.positions.push_back(vector_of(p));
    t.used.assign(t.positions.size(), false);
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
      if (std::count(mesh.holes.begin(), mesh.holes.end(), static_cast<std::int32_t>(f)) > 0) continue;
      const bool whole = loop || mesh.faces[f].size() == 4;
      const int n = 1 << (whole ? depth : depth - 1);
      for (std::size_t k = 0; k < (whole ? 1 : mesh.faces[f].size()); ++k)
        for (int j = 0; j < n; ++j)
          for (int i = 0; i < (loop ? n - j : n); ++i) {
            put(named, f, k, n, {{{i, j}, {i + 1, j}, {loop ? i : i + 1, j + 1}}});
            if (!loop) put(named, f, k, n, {{{i, j}, {i + 1, j + 1}, {i, j + 1}}});
            if (loop && i + j + 1 < n) put(named, f, k, n, {{{i + 1, j}, {i + 1, j + 1}, {i, j + 1}}});
          }
    }
  };
  if (loop)
    fill(reference::RefinedMesh<double>(mesh),
         [](auto& refined, std::size_t f, std::size_t, int i, int j) { return refined.vertex(f, i, j); });
  else
    fill(reference::catmull_clark::RefinedMesh<double>(mesh.faces, reference::positions_of<double>(mesh),
                                                       mesh.sharpness),
         [](auto& refined, auto... place) { return refined.vertex(place...); });
  return t;
}

// As programs write coordinates: floats, with six decimals, with six digits, and as they are.
using Writing = double (*)(double);
inline const std::map<std::string, Writing> kWritings{
    {"float", [](double x) { return static_cast<double>(static_cast<float>(x)); }},
    {"decimals", [](double x) { return std::stod(fmt::format("{:.6f}", x)); }},
    {"four decimals", [](double x) { return std::stod(fmt::format("{:.4f}", x)); }},
    {"digits", [](double x) { return std::stod(fmt::format("{:.6g}", x)); }},
    {"float's nine digits", [](double x) { return std::stod(fmt::format("{:.9g}", static_cast<float>(x))); }},
    {"double", [](double x) { return x; }}};

// The points that some scheme makes, as a file without faces.
inline FileTessellation cloud_of(std::vector<Vector> points, Writing writing) {
  FileTessellation t{.name = "cloud", .positions = std::move(points)};
  for (Vector& p : t.positions)
    for (double& x : p) x = writing(x);
  t.used.assign(t.positions.size(), true);
  return t;
}

/// With one normal for each vertex, that of the first triangle that has it.
inline FileTessellation with_one_normal_each(FileTessellation t) {
  std::vector<FileTessellation::NormalAt> one(t.positions.size(), {-1, {}});
  for (const auto& n : t.normals)
    if (one[n.vertex].vertex < 0) one[n.vertex] = n;
  for (std::size_t v = 0; v < one.size(); ++v)
    if (one[v].vertex < 0) one[v] = {static_cast<std::int32_t>(v), {0, 0, 1}};
  t.normals = one;
  t.corner_normals.clear();
  return t;
}

}  // namespace limitcheck::verify::test
