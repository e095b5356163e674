// SPDX-License-Identifier: MIT
// A subject in C++: Loop subdivision of the whole mesh, step by step, then every vertex moved to its limit;
// delivered in float. Exceptions stay on this side of the door.
#include <limitcheck/subject.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <exception>
#include <map>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace {

using Vec = std::array<double, 3>;
struct Triangle {
  std::array<int, 3> v;
  int face;
  std::array<std::array<unsigned, 2>, 3> at;  // (i, j) of each corner
};

const double kPi = std::acos(-1.0);

void add(Vec& to, double w, const Vec& p) {
  for (std::size_t k = 0; k < 3; ++k) to[k] += w * p[k];
}

struct Mesh {
  std::vector<Vec> positions;
  std::vector<Triangle> triangles;
  std::map<std::pair<int, int>, int> after{};  // (v, a) -> b for each triangle (v, a, b)
  std::map<int, int> start{};                  // a neighbour; the first, counter-clockwise, at a boundary

  void connect() {
    for (const Triangle& t : triangles)
      for (std::size_t k = 0; k < 3; ++k) after[{t.v[k], t.v[(k + 1) % 3]}] = t.v[(k + 2) % 3];
    for (const auto& [edge, next] : after)
      if (after.count({edge.second, edge.first}) == 0 || start.count(edge.first) == 0)
        start[edge.first] = edge.second;
  }

  std::vector<int> ring(int v, bool& boundary) const {
    std::vector<int> r{start.at(v)};
    boundary = after.count({r[0], v}) == 0;
    for (auto next = after.find({v, r[0]}); next != after.end(); next = after.find({v, next->second})) {
      if (next->second == r[0]) break;
      r.push_back(next->second);
    }
    return r;
  }

  /// Vertex v after one step (normal == nullptr), or its limit position and normal.
  Vec moved(int v, Vec* normal) const {
    bool boundary = false;
    const std::vector<int> r = ring(v, boundary);
    const auto n = static_cast<double>(r.size());
    const double faces = n - 1, c = std::cos(kPi / faces), s = std::sin(kPi / faces);
    Vec p = positions[v], sum{}, t{}, u{};
    for (std::size_t i = 0; i < r.size(); ++i) {
      const bool end = boundary && (i == 0 || i + 1 == r.size());
      const auto x = static_cast<double>(i);
      Vec d = positions[r[i]];
      add(d, -1, p);
      if (!boundary || end) add(sum, 1, d);
      const double across = faces == 1 ? 1
                            : end      ? -c * (1 + c) / ((1 + 2 * c) * s)
                                       : std::sin(x * kPi / faces);
      add(t, boundary ? (i == 0 ? 1 : end ? -1 : 0) : std::cos(2 * kPi * x / n), d);
      add(u, boundary ? across : std::sin(2 * kPi * x / n), d);
    }
    const double b = 3 + 2 * std::cos(2 * kPi / n), a = 5.0 / 8 - b * b / 64;
    add(p,
        normal == nullptr ? (boundary ? 1.0 / 8 : a / n) : (boundary ? 1.0 / 6 : 8 * a / (n * (3 + 8 * a))),
        sum);
    if (normal == nullptr) return p;
    *normal = {t[1] * u[2] - t[2] * u[1], t[2] * u[0] - t[0] * u[2], t[0] * u[1] - t[1] * u[0]};
    const double length = std::hypot((*normal)[0], (*normal)[1], (*normal)[2]);
    if (length > 0) {
      for (double& x : *normal) x /= length;
    } else {
      *normal = {0, 0, 1};
    }
    return p;
  }

  Mesh refined() const {
    Mesh fine{{}, {}};
    for (int v = 0; v < static_cast<int>(positions.size()); ++v) fine.positions.push_back(moved(v, nullptr));
    std::map<std::pair<int, int>, int> middle;
    for (const Triangle& old : triangles) {
      Triangle inner = old;
      for (std::size_t k = 0; k < 3; ++k) {
        const int a = old.v[k], b = old.v[(k + 1) % 3];
        const auto [place, is_new] =
            middle.try_emplace(std::minmax(a, b), static_cast<int>(fine.positions.size()));
        inner.v[k] = place->second;
        for (std::size_t x = 0; x < 2; ++x) inner.at[k][x] = old.at[k][x] + old.at[(k + 1) % 3][x];
        if (!is_new) continue;
        const auto other = after.find({b, a});
        Vec p{};
        for (const int end : {a, b}) add(p, other == after.end() ? 1.0 / 2 : 3.0 / 8, positions[end]);
        if (other != after.end())
          for (const int side : {old.v[(k + 2) % 3], other->second}) add(p, 1.0 / 8, positions[side]);
        fine.positions.push_back(p);
      }
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t last = (k + 2) % 3;
        fine.triangles.push_back({{old.v[k], inner.v[k], inner.v[last]},
                                  old.face,
                                  {{{2 * old.at[k][0], 2 * old.at[k][1]}, inner.at[k], inner.at[last]}}});
      }
      fine.triangles.push_back(inner);
    }
    fine.connect();
    return fine;
  }
};

void deliver(const Mesh& mesh, const lc_request& request, lc_tessellation& out) {
  const auto get = [&](auto*& array, std::size_t count) {
    array = static_cast<std::remove_reference_t<decltype(array)>>(
        request.allocate(request.host, count * sizeof(*array)));
    if (array == nullptr) throw std::bad_alloc();
  };
  float *position = nullptr, *normal = nullptr;
  get(position, 3 * mesh.positions.size());
  get(normal, 3 * mesh.positions.size());
  get(out.provenance, mesh.positions.size());
  get(out.triangles, 3 * mesh.triangles.size());
  get(out.triangle_face, mesh.triangles.size());
  out.positions = position;
  out.normals = normal;
  for (; out.vertex_count < static_cast<std::int64_t>(mesh.positions.size()); ++out.vertex_count) {
    Vec n{};
    for (const double x : mesh.moved(static_cast<int>(out.vertex_count), &n))
      *position++ = static_cast<float>(x);
    for (const double x : n) *normal++ = static_cast<float>(x);
  }
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      out.triangles[3 * out.triangle_count + static_cast<std::int64_t>(k)] = static_cast<unsigned>(t.v[k]);
      out.provenance[t.v[k]] = {t.face, t.at[k][0], t.at[k][1], 1U << request.face_depth[0]};
    }
    out.triangle_face[out.triangle_count++] = t.face;
  }
}

}  // namespace

extern "C" const lc_subject* lc_subject_get(std::uint32_t abi) {
  static lc_subject subject{};
  subject.abi = LC_SUBJECT_ABI;
  subject.name = "loop-in-c++";
  subject.description = "Loop subdivision step by step, in C++";
  subject.capabilities = [](const char*, lc_capabilities* out, const char**) {
    *out = {LC_FLOAT32, LC_WEIGHTS_LOOP, LC_BOUNDARY_SPLINE, LC_POINTS_LIMIT, 6, 1, 0, 1};
    return LC_OK;
  };
  subject.create = [](const lc_mesh* control, const char*, void** instance, const char** message) {
    try {
      auto mesh = std::make_unique<Mesh>();
      for (std::int64_t v = 0; v < control->vertex_count; ++v) {
        const double* p = control->positions + 3 * v;
        mesh->positions.push_back({p[0], p[1], p[2]});
      }
      for (int f = 0; f < control->triangle_count; ++f) {
        const std::int32_t* t = control->triangles + 3 * f;
        mesh->triangles.push_back({{t[0], t[1], t[2]}, f, {{{0, 0}, {1, 0}, {0, 1}}}});
      }
      mesh->connect();
      *instance = mesh.release();
      return LC_OK;
    } catch (const std::exception&) {
      *message = "out of memory";
      return LC_FAILED;
    }
  };
  subject.tessellate = [](void* instance, const lc_request* request, lc_tessellation* out,
                          const char** message) {
    try {
      Mesh mesh = *static_cast<const Mesh*>(instance);
      for (int d = 0; d < request->face_depth[0]; ++d) mesh = mesh.refined();
      deliver(mesh, *request, *out);
      return LC_OK;
    } catch (const std::exception&) {
      *message = "out of memory";
      return LC_FAILED;
    }
  };
  subject.release = [](void*, lc_tessellation*) {};
  subject.destroy = [](void* instance) { delete static_cast<Mesh*>(instance); };
  return abi == LC_SUBJECT_ABI ? &subject : nullptr;
}
