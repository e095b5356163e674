// SPDX-License-Identifier: MIT
// A subject of Catmull-Clark's in one file of C++: a mesh of quads, refined step by step in double. It
// delivers the vertices of the refined mesh, not points of the limit surface, and its capabilities say so.
// Faces that are no quads it refuses; examples/python/quads.py takes them.
#include <limitcheck/subject.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <map>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace {

using Vec = std::array<double, 3>;
using Edge = std::pair<int, int>;

Vec mean(const std::vector<Vec>& points) {
  Vec sum{};
  for (const Vec& p : points)
    for (std::size_t c = 0; c < 3; ++c) sum[c] += p[c] / static_cast<double>(points.size());
  return sum;
}

struct Quad {
  std::array<int, 4> v;
  int face;                                   // the control face that it is part of,
  std::array<std::array<unsigned, 2>, 4> at;  // and (i, j) of its corners there
};

struct Mesh {
  std::vector<Vec> positions;
  std::vector<Quad> quads;
  std::map<Edge, int> left;              // the quad to the left of each edge, in both directions
  std::map<int, std::vector<int>> ends;  // of a boundary vertex: its neighbours on the boundary

  /// Throws std::invalid_argument if the quads are no oriented manifold.
  void connect() {
    for (int q = 0; q < static_cast<int>(quads.size()); ++q)
      for (std::size_t k = 0; k < 4; ++k)
        if (!left.try_emplace({quads[q].v[k], quads[q].v[(k + 1) % 4]}, q).second)
          throw std::invalid_argument("two quads run along an edge in the same direction");
    for (const auto& [edge, quad] : left) {
      if (left.count({edge.second, edge.first}) != 0) continue;
      for (const auto& [v, other] : {edge, Edge(edge.second, edge.first)}) {
        ends[v].push_back(other);
        if (ends[v].size() > 2) throw std::invalid_argument("two fans of quads meet in a vertex");
      }
    }
  }

  Mesh refined() const {
    Mesh fine;
    std::vector<Vec> middle;
    for (const Quad& q : quads)
      middle.push_back(mean({positions[q.v[0]], positions[q.v[1]], positions[q.v[2]], positions[q.v[3]]}));
    // Of each vertex: the far ends of the edges that leave it, and the middles of its quads.
    std::vector<std::vector<Vec>> around(positions.size());
    for (const auto& [edge, quad] : left)
      around[edge.first].push_back(positions[edge.second]), around[edge.first].push_back(middle[quad]);
    for (int v = 0; v < static_cast<int>(positions.size()); ++v) {
      const Vec& p = positions[v];
      if (const auto e = ends.find(v); e != ends.end()) {
        fine.positions.push_back(mean({p, p, p, p, p, p, positions[e->second[0]], positions[e->second[1]]}));
      } else {
        Vec moved = p;
        const Vec m = mean(around[v]);
        const double n = static_cast<double>(around[v].size()) / 2;
        for (std::size_t c = 0; c < 3 && n > 0; ++c) moved[c] = ((n - 2) * p[c] + 2 * m[c]) / n;
        fine.positions.push_back(moved);
      }
    }
    std::map<Edge, int> of_edge;
    for (const auto& [edge, quad] : left) {
      const auto [place, is_new] =
          of_edge.try_emplace(std::minmax(edge.first, edge.second), static_cast<int>(fine.positions.size()));
      if (!is_new) continue;
      const auto other = left.find({edge.second, edge.first});
      std::vector<Vec> points{positions[edge.first], positions[edge.second]};
      if (other != left.end()) points.insert(points.end(), {middle[quad], middle[other->second]});
      fine.positions.push_back(mean(points));
    }
    const int first_middle = static_cast<int>(fine.positions.size());
    fine.positions.insert(fine.positions.end(), middle.begin(), middle.end());
    for (int q = 0; q < static_cast<int>(quads.size()); ++q) {
      const auto& [v, face, at] = quads[q];
      for (std::size_t k = 0; k < 4; ++k) {
        const std::size_t next = (k + 1) % 4, last = (k + 3) % 4;
        Quad child{{v[k], of_edge.at(std::minmax(v[k], v[next])), first_middle + q,
                    of_edge.at(std::minmax(v[last], v[k]))},
                   face,
                   {}};
        for (std::size_t c = 0; c < 4; ++c)
          for (std::size_t x = 0; x < 2; ++x) child.at[c][x] = at[k][x] + at[(k + c) % 4][x];
        fine.quads.push_back(child);
      }
    }
    fine.connect();
    return fine;
  }
};

Mesh control_mesh(const lc_mesh& control) {
  if (control.face_count == 0) throw std::invalid_argument("there are no quads");
  Mesh mesh;
  for (std::int64_t v = 0; v < control.vertex_count; ++v) {
    const double* p = control.positions + 3 * v;
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
      throw std::invalid_argument("a coordinate is not finite");
    mesh.positions.push_back({p[0], p[1], p[2]});
  }
  for (int f = 0; f < control.face_count; ++f) {
    const std::int32_t* v = control.corners + 4 * static_cast<std::ptrdiff_t>(f);
    for (int k = 0; k < 4; ++k)
      if (v[k] < 0 || v[k] >= control.vertex_count)
        throw std::invalid_argument("a quad names a vertex that does not exist");
    mesh.quads.push_back({{v[0], v[1], v[2], v[3]}, f, {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}});
  }
  mesh.connect();
  return mesh;
}

void deliver(const Mesh& mesh, const lc_request& request, lc_tessellation& out) {
  const auto get = [&](auto*& array, std::size_t count) {
    array = static_cast<std::remove_reference_t<decltype(array)>>(
        request.allocate(request.host, count * sizeof(*array)));
    if (array == nullptr) throw std::bad_alloc();
  };
  double* position = nullptr;
  get(position, 3 * mesh.positions.size());
  get(out.provenance, mesh.positions.size());
  get(out.triangles, 6 * mesh.quads.size());
  get(out.triangle_face, 2 * mesh.quads.size());
  out.positions = position;
  out.vertex_count = static_cast<std::int64_t>(mesh.positions.size());
  for (const Vec& p : mesh.positions) position = std::copy(p.begin(), p.end(), position);
  for (const auto& [v, face, at] : mesh.quads) {
    for (std::size_t k = 0; k < 4; ++k)
      out.provenance[v[k]] = {face, at[k][0], at[k][1], 1U << request.face_depth[0]};
    for (const auto& corners : {std::array{v[0], v[1], v[2]}, {v[0], v[2], v[3]}}) {
      std::copy(corners.begin(), corners.end(), out.triangles + 3 * out.triangle_count);
      out.triangle_face[out.triangle_count++] = face;
    }
  }
}

// Exceptions end here: the interface is C. The text is to stay until the next call.
lc_status refuse(lc_status status, const std::exception& error, const char** message) {
  static std::string text;
  text = error.what();
  *message = text.c_str();
  return status;
}

}  // namespace

extern "C" const lc_subject* lc_subject_get(std::uint32_t abi) {
  static lc_subject subject{};
  subject.abi = LC_SUBJECT_ABI;
  subject.name = "quads-in-c++";
  subject.description = "Catmull-Clark refinement of quads, in C++";
  subject.capabilities = [](const char*, lc_capabilities* out, const char**) {
    *out = {LC_FLOAT64, LC_WEIGHTS_LOOP, LC_BOUNDARY_SPLINE,      LC_POINTS_REFINED,    6, 0, 0,
            1,          sizeof *out,     LC_SCHEME_CATMULL_CLARK, LC_DOES_CATMULL_CLARK};
    return LC_OK;
  };
  subject.create = [](const lc_mesh* control, const char*, void** instance, const char** message) {
    try {
      for (std::int64_t f = 0; f < control->face_count; ++f)
        if (control->face_sizes[f] != 4) return *message = "a face is no quad", LC_NOT_SUPPORTED;
      *instance = new Mesh(control_mesh(*control));
      return LC_OK;
    } catch (const std::invalid_argument& refusal) {
      return refuse(LC_INVALID_INPUT, refusal, message);
    } catch (const std::exception& error) {
      return refuse(LC_FAILED, error, message);
    }
  };
  subject.tessellate = [](void* instance, const lc_request* request, lc_tessellation* out,
                          const char** message) {
    try {
      Mesh mesh = *static_cast<const Mesh*>(instance);
      for (int d = 0; d < request->face_depth[0]; ++d) mesh = mesh.refined();
      deliver(mesh, *request, *out);
      return LC_OK;
    } catch (const std::exception& error) {
      return refuse(LC_FAILED, error, message);
    }
  };
  subject.release = [](void*, lc_tessellation*) {};
  subject.destroy = [](void* instance) { delete static_cast<Mesh*>(instance); };
  return abi == LC_SUBJECT_ABI ? &subject : nullptr;
}
