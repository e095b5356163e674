// SPDX-License-Identifier: MIT
#include "verify/mutants/planted_faults.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "verify/subject/face_domain.h"
#include "verify/subject/subject_error.h"

namespace limitcheck::verify {
namespace {

[[noreturn]] void nowhere(const char* what) {
  throw SubjectError(LC_NOT_SUPPORTED, fmt::format("there is no {} to plant this fault in", what));
}

template <class Real>
std::size_t some_vertex(const Copy<Real>& out) {
  if (out.positions.empty()) nowhere("vertex");
  return out.positions.size() / 2;
}

template <class Real>
std::size_t some_triangle(const Copy<Real>& out) {
  if (out.triangles.empty()) nowhere("triangle");
  return out.triangles.size() / 2;
}

// The three triangles of one control face round a lattice point inside one of its edges, in order: together
// they have the corners a, x, y, b and m lies between a and b.
struct HalfFan {
  std::array<std::size_t, 3> triangles;
  std::uint32_t m, a, x, y, b;
};

template <class Real>
HalfFan half_fan(const Copy<Real>& out) {
  for (std::size_t begin = 0; begin < out.triangles.size();) {
    std::size_t end = begin;
    while (end < out.triangles.size() && out.triangle_face[end] == out.triangle_face[begin]) ++end;
    for (std::size_t t = begin; t < end; ++t) {
      for (int k = 0; k < 3; ++k) {
        // (m, a, x), (m, x, y), (m, y, b): each begins where the one before ends.
        const std::uint32_t m = out.triangles[t][k], a = out.triangles[t][(k + 1) % 3];
        HalfFan fan{{t, t, t}, m, a, out.triangles[t][(k + 2) % 3], 0, 0};
        std::uint32_t last = fan.x;
        std::size_t incident = 0, found = 1;
        for (std::size_t round = 0; round < 2; ++round) {
          for (std::size_t s = begin; s < end; ++s) {
            for (int c = 0; c < 3; ++c) {
              if (out.triangles[s][c] != m) continue;
              incident += round == 0;
              if (out.triangles[s][(c + 1) % 3] != last || found == 3) continue;
              last = out.triangles[s][(c + 2) % 3];
              fan.triangles[found++] = s;
              (found == 2 ? fan.y : fan.b) = last;
            }
          }
        }
        if (incident == 3 && found == 3) return fan;
      }
    }
    begin = end;
  }
  nowhere("point inside an edge");
}

// Gives the half fan a vertex of its own in place of m, a copy. Returns it.
template <class Real>
std::size_t split_off(Copy<Real>& out, const HalfFan& fan) {
  const std::size_t v = out.positions.size();
  const auto position = out.positions[fan.m];
  out.positions.push_back(position);
  if (!out.normals.empty()) {
    const auto normal = out.normals[fan.m];
    out.normals.push_back(normal);
  }
  const auto provenance = out.provenance[fan.m];
  out.provenance.push_back(provenance);
  for (const auto t : fan.triangles) {
    std::replace(out.triangles[t].begin(), out.triangles[t].end(), fan.m, static_cast<std::uint32_t>(v));
  }
  return v;
}

}  // namespace

std::int32_t control_vertex(const data::ControlMesh& mesh, const lc_provenance& p) {
  const auto corner = FaceDomain::triangle().corner_at(point_of(p), p.denominator);
  if (!corner || p.face < 0 || static_cast<std::size_t>(p.face) >= mesh.faces.size()) return -1;
  return triangles_of(mesh)[p.face][*corner];
}

template <class Real>
const std::vector<PlantedFault<Real>>& planted_faults() {
  using Mesh = const data::ControlMesh&;
  using Out = Copy<Real>&;
  static const Real unwritten = [] {
    Real value;
    std::fill_n(reinterpret_cast<unsigned char*>(&value), sizeof value, 0xFF);
    return value;
  }();
  static const std::vector<PlantedFault<Real>> in_what_is_delivered{
      {{"none", "nothing: the subject as it is"}, [](Mesh, Out) {}},

      // Values.
      {{"nan_position", "one position is NaN"},
       [](Mesh, Out out) { out.positions[some_vertex(out)][1] = std::numeric_limits<Real>::quiet_NaN(); }},
      {{"infinite_position", "one position is infinite"},
       [](Mesh, Out out) { out.positions[some_vertex(out)][1] = std::numeric_limits<Real>::infinity(); }},
      {{"nan_normal", "one normal is NaN"},
       [](Mesh, Out out) {
         if (out.normals.empty()) nowhere("normal");
         out.normals[some_vertex(out)][1] = std::numeric_limits<Real>::quiet_NaN();
       }},
      {{"unwritten_position", "one position is left unwritten"},
       [](Mesh, Out out) { out.positions[some_vertex(out)].fill(unwritten); }},
      {{"unwritten_normal", "one normal is left unwritten"},
       [](Mesh, Out out) {
         if (out.normals.empty()) nowhere("normal");
         out.normals[some_vertex(out)].fill(unwritten);
       }},
      {{"unwritten_triangle", "the corners of one triangle are left unwritten"},
       [](Mesh, Out out) { out.triangles[some_triangle(out)].fill(0xFFFFFFFFu); }},
      {{"unwritten_provenance", "the place of one vertex is left unwritten"},
       [](Mesh, Out out) {
         out.provenance[some_vertex(out)] = {-1, 0xFFFFFFFFu, 0xFFFFFFFFu, 0xFFFFFFFFu};
       }},
      {{"unwritten_triangle_face", "the control face of one triangle is left unwritten"},
       [](Mesh, Out out) { out.triangle_face[some_triangle(out)] = -1; }},
      {{"wrong_limit_mask", "points at control vertices lie a hundredth of the way to the control vertex"},
       [](Mesh mesh, Out out) {
         for (std::size_t v = 0; v < out.positions.size(); ++v) {
           const std::int32_t at = control_vertex(mesh, out.provenance[v]);
           if (at < 0) continue;
           const auto& control = mesh.positions[at];
           for (std::size_t c = 0; c < 3; ++c) {
             out.positions[v][c] +=
                 static_cast<Real>(0.01 * (control[c] - static_cast<double>(out.positions[v][c])));
           }
         }
       }},
      {{"wrong_edge_mask", "points that are not control vertices are 1e-5 too far from the origin"},
       [](Mesh mesh, Out out) {
         for (std::size_t v = 0; v < out.positions.size(); ++v) {
           if (control_vertex(mesh, out.provenance[v]) >= 0) continue;
           for (Real& x : out.positions[v]) x *= Real(1.00001);
         }
       }},
      {{"unmoved_vertices", "points at control vertices are the control vertices"},
       [](Mesh mesh, Out out) {
         for (std::size_t v = 0; v < out.positions.size(); ++v)
           if (const std::int32_t at = control_vertex(mesh, out.provenance[v]); at >= 0)
             for (std::size_t c = 0; c < 3; ++c)
               out.positions[v][c] = static_cast<Real>(mesh.positions[at][c]);
       }},
      {{"snapped_positions", "positions are multiples of a fiftieth: small triangles collapse"},
       [](Mesh, Out out) {
         for (auto& p : out.positions)
           for (Real& x : p) x = std::round(x * 50) / 50;
       }},
      {{"flipped_normals", "all normals point inside"},
       [](Mesh, Out out) {
         if (out.normals.empty()) nowhere("normal");
         for (auto& n : out.normals) n = {-n[0], -n[1], -n[2]};
       }},
      {{"one_flipped_normal", "one normal points inside"},
       [](Mesh, Out out) {
         if (out.normals.empty()) nowhere("normal");
         auto& n = out.normals[some_vertex(out)];
         n = {-n[0], -n[1], -n[2]};
       }},
      {{"long_normals", "normals have length 2"},
       [](Mesh, Out out) {
         if (out.normals.empty()) nowhere("normal");
         for (auto& n : out.normals) n = {2 * n[0], 2 * n[1], 2 * n[2]};
       }},

      // Which point is which.
      {{"shifted_provenance", "each vertex has the provenance of the next"},
       [](Mesh, Out out) {
         some_vertex(out);
         std::rotate(out.provenance.begin(), out.provenance.begin() + 1, out.provenance.end());
       }},
      {{"mirrored_provenance", "l1 and l2 are exchanged"},
       [](Mesh, Out out) {
         for (auto& p : out.provenance) std::swap(p.i, p.j);
       }},
      {{"swapped_points", "two vertices have each other's position and normal"},
       [](Mesh, Out out) {
         const auto [a, b, c] = out.triangles[some_triangle(out)];
         std::swap(out.positions[a], out.positions[b]);
         if (!out.normals.empty()) std::swap(out.normals[a], out.normals[b]);
       }},
      {{"provenance_out_of_range", "one vertex lies outside its face"},
       [](Mesh, Out out) {
         out.provenance[some_vertex(out)].i = out.provenance[some_vertex(out)].denominator + 1;
       }},

      // Triangles.
      {{"flipped_orientation", "all triangles are clockwise"},
       [](Mesh, Out out) {
         for (auto& t : out.triangles) std::swap(t[1], t[2]);
       }},
      {{"one_flipped_triangle", "one triangle is clockwise"},
       [](Mesh, Out out) {
         auto& t = out.triangles[some_triangle(out)];
         std::swap(t[1], t[2]);
       }},
      {{"missing_triangle", "one triangle is missing"},
       [](Mesh, Out out) {
         const auto t = static_cast<std::ptrdiff_t>(some_triangle(out));
         out.triangles.erase(out.triangles.begin() + t);
         out.triangle_face.erase(out.triangle_face.begin() + t);
       }},
      {{"duplicated_triangle", "one triangle is there twice"},
       [](Mesh, Out out) {
         const auto t = some_triangle(out);
         const auto copy = out.triangles[t];
         out.triangles.push_back(copy);
         out.triangle_face.push_back(out.triangle_face[t]);
       }},
      {{"face_twice", "the triangles of the last control face are there twice"},
       [](Mesh, Out out) {
         const std::size_t count = out.triangles.size();
         some_triangle(out);
         const std::int32_t face = out.triangle_face.back();
         for (std::size_t t = 0; t < count; ++t) {
           if (out.triangle_face[t] != face) continue;
           const auto copy = out.triangles[t];
           out.triangles.push_back(copy);
           out.triangle_face.push_back(face);
         }
       }},
      {{"wrong_triangle_face", "one triangle names another control face"},
       [](Mesh mesh, Out out) {
         auto& face = out.triangle_face[some_triangle(out)];
         face = (face + 1) % static_cast<std::int32_t>(mesh.faces.size());
       }},
      {{"index_out_of_range", "one triangle names a vertex that does not exist"},
       [](Mesh, Out out) {
         out.triangles[some_triangle(out)][2] = static_cast<std::uint32_t>(out.positions.size());
       }},
      {{"t_vertex", "a point inside a control edge is left out on one side of it"},
       [](Mesh, Out out) {
         const HalfFan fan = half_fan(out);
         out.triangles[fan.triangles[0]] = {fan.b, fan.a, fan.x};
         out.triangles[fan.triangles[1]] = {fan.b, fan.x, fan.y};
         const auto last = static_cast<std::ptrdiff_t>(fan.triangles[2]);
         out.triangles.erase(out.triangles.begin() + last);
         out.triangle_face.erase(out.triangle_face.begin() + last);
       }},
      {{"one_ulp_crack", "a point inside a control edge is one ulp off on one side of it"},
       [](Mesh, Out out) {
         const HalfFan fan = half_fan(out);
         const auto v = split_off(out, fan);
         out.positions[v][0] = std::nextafter(out.positions[v][0], std::numeric_limits<Real>::infinity());
       }},
      {{"one_ulp_normal", "a normal inside a control edge is one ulp off on one side of it"},
       [](Mesh, Out out) {
         if (out.normals.empty()) nowhere("normal");
         const HalfFan fan = half_fan(out);
         const auto v = split_off(out, fan);
         out.normals[v][0] = std::nextafter(out.normals[v][0], Real(2));
       }},

      // Memory.
      {{"negative_count", "vertex_count is -1"}, [](Mesh, Out out) { out.announced_vertices = -1; }},
      {{"count_too_large", "vertex_count is one more than there is memory for"},
       [](Mesh, Out out) { out.announced_vertices = static_cast<std::int64_t>(out.positions.size()) + 1; }},
      {{"foreign_memory", "the normals are not in the host's memory"},
       [](Mesh, Out out) { out.foreign_normals = true; }},
      {{"write_behind", "one coordinate is written behind the end of the positions"},
       [](Mesh, Out out) { out.overrun = true; }},
      {{"write_before", "one coordinate is written in front of the positions"},
       [](Mesh, Out out) { out.underrun = true; }},
      {{"modified_mesh", "the control mesh is written to"}, [](Mesh, Out out) { out.modify_mesh = true; }},
      {{"overlapping_arrays", "positions and normals are one array"},
       [](Mesh, Out out) { out.overlap = true; }},
  };
  static const std::vector<PlantedFault<Real>> all = [] {
    std::vector<PlantedFault<Real>> list = in_what_is_delivered, more = mesh_faults<Real>();
    std::ranges::copy(rare_faults<Real>(), std::back_inserter(more));
    for (PlantedFault<Real>& fault : more) {
      fault.fault.on_some_meshes = true;
      list.push_back(fault);
    }
    return list;
  }();
  return all;
}

template const std::vector<PlantedFault<float>>& planted_faults();
template const std::vector<PlantedFault<double>>& planted_faults();

}  // namespace limitcheck::verify
