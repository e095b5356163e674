// SPDX-License-Identifier: MIT
// Provenance that is found is the provenance that was delivered, whatever the order of vertices and triangles.
#include "verify/host/matching.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "data/generators/named_mesh.h"
#include "data/shapes.h"
#include "data/splitmix64.h"
#include "verify/host/host.h"
#include "verify/subject/lent_mesh.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

using Vector = std::array<double, 3>;

struct Delivery {
  std::vector<Vector> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Place> places;        // as they were delivered
  std::vector<std::int32_t> faces;  // of the triangles

  Bare bare() const {
    return {std::ssize(positions), triangles, [this](std::int64_t v) { return positions[v]; }};
  }
};

Delivery delivered(const data::ControlMesh& mesh, data::Scheme scheme, int depth) {
  Session session(*lc_subject_naive(), mesh, "", Session::Input::kValid, scheme);
  const Tessellation t = session.tessellate(depth);
  Delivery d;
  std::map<Vector, std::uint32_t> number;  // it delivers a vertex once for each face
  for (auto triangle : t.triangles()) {
    for (std::uint32_t& v : triangle) {
      const auto [at, is_new] = number.try_emplace(t.position(v), static_cast<std::uint32_t>(number.size()));
      if (is_new) d.positions.push_back(t.position(v)), d.places.push_back(t.place(v));
      v = at->second;
    }
    d.triangles.push_back(triangle);
  }
  d.faces.assign(t.triangle_face().begin(), t.triangle_face().end());
  return d;
}

// Two quads or triangles as one, `group` triangles each, in another order, each begun at another corner; the vertices in
// another order, too.
Delivery shuffled(Delivery d, std::uint64_t seed, std::size_t group) {
  data::SplitMix64 random(seed);
  const auto shuffle = [&](auto& list) {
    for (std::size_t k = list.size(); k > 1; --k) std::swap(list[k - 1], list[random.next() % k]);
  };
  std::vector<std::uint32_t> to(d.positions.size());
  std::iota(to.begin(), to.end(), 0U);
  shuffle(to);
  Delivery other = d;
  for (std::size_t v = 0; v < to.size(); ++v) {
    other.positions[to[v]] = d.positions[v];
    other.places[to[v]] = d.places[v];
  }
  std::vector<std::size_t> groups(d.triangles.size() / group);
  std::iota(groups.begin(), groups.end(), 0U);
  shuffle(groups);
  other.triangles.clear();
  other.faces.clear();
  for (const std::size_t g : groups)
    for (std::size_t k = 0; k < group; ++k) {
      auto t = d.triangles[g * group + k];
      for (auto& v : t) v = to[v];
      std::rotate(t.begin(), t.begin() + static_cast<std::ptrdiff_t>(random.next() % 3), t.end());
      other.triangles.push_back(t);
      other.faces.push_back(d.faces[g * group + k]);
    }
  return other;
}

// Each triangle with vertices of its own.
Delivery soup(const Delivery& d) {
  Delivery other;
  other.faces = d.faces;
  for (const auto& t : d.triangles) {
    const auto first = static_cast<std::uint32_t>(other.positions.size());
    for (const std::uint32_t v : t) {
      other.positions.push_back(d.positions[v]);
      other.places.push_back(d.places[v]);
    }
    other.triangles.push_back({first, first + 1, first + 2});
  }
  return other;
}

// Where a place is on the control mesh, by its first face; exact enough to tell places apart.
Vector about(const data::ControlMesh& mesh, data::Scheme scheme, const Place& p) {
  const auto face = mesh.faces[p.face];
  const auto size = static_cast<int>(face.size());
  const double u = double(p.i) / p.denominator, v = double(p.j) / p.denominator;
  Vector sum{};
  const auto add = [&](std::int32_t vertex, double weight) {
    for (int k = 0; k < 3; ++k) sum[k] += weight * mesh.positions[vertex][k];
  };
  if (scheme == data::Scheme::kLoop) {
    add(face[0], 1 - u - v), add(face[1], u), add(face[2], v);
  } else if (size == 4) {
    add(face[0], (1 - u) * (1 - v)), add(face[1], u * (1 - v)), add(face[2], u * v),
        add(face[3], (1 - u) * v);
  } else {
    const int own = p.corner, after = (own + 1) % size, before = (own + size - 1) % size;
    add(face[own], (1 - u) * (1 - v) + u * (1 - v) / 2 + (1 - u) * v / 2);
    add(face[after], u * (1 - v) / 2), add(face[before], (1 - u) * v / 2);
    for (const std::int32_t c : face) add(c, u * v / size);
  }
  return sum;
}

// No two places of it are alike.
data::ControlMesh unlike(data::ControlMesh mesh) {
  data::SplitMix64 random(7);
  for (auto& p : mesh.positions)
    for (double& x : p) x += .05 * random.unit();
  return mesh;
}

void expect_found(const data::ControlMesh& mesh, data::Scheme scheme, int depth, const Delivery& d) {
  const Matching found = match(RefinedComplex(mesh, scheme, depth), d.bare());
  ASSERT_EQ(found.failure, "");
  ASSERT_EQ(found.provenance.size(), d.positions.size());
  for (std::size_t v = 0; v < d.positions.size(); ++v) {
    const Vector a = about(mesh, scheme, place_of(found.provenance[v], found.corner[v])),
                 b = about(mesh, scheme, d.places[v]);
    for (int k = 0; k < 3; ++k) ASSERT_NEAR(a[k], b[k], 1e-12) << v;
  }
  EXPECT_EQ(found.triangle_face, d.faces);
}

struct Case {
  const char* mesh;
  data::Scheme scheme;
  int depth;
};
class Found : public testing::TestWithParam<Case> {};

TEST_P(Found, IsWhatWasDelivered) {
  const auto& [name, scheme, depth] = GetParam();
  const data::ControlMesh mesh = unlike(data::named_mesh(name));
  const Delivery d = delivered(mesh, scheme, depth);
  const std::size_t group = scheme == data::Scheme::kLoop ? 1 : 2;
  {
    SCOPED_TRACE("as delivered");
    expect_found(mesh, scheme, depth, d);
  }
  if (scheme == data::Scheme::kLoop || depth > 0) {
    expect_found(mesh, scheme, depth, shuffled(d, 1, group));
    expect_found(mesh, scheme, depth, soup(shuffled(d, 2, group)));
  }
  // A wrong vertex stays that vertex, and triangles that are clockwise are found all the same.
  Delivery wrong = shuffled(d, 3, scheme == data::Scheme::kLoop || depth > 0 ? group : d.triangles.size());
  wrong.positions[wrong.positions.size() / 2] = {5, 5, 5};
  expect_found(mesh, scheme, depth, wrong);
  for (auto& t : wrong.triangles) std::swap(t[0], t[1]);
  expect_found(mesh, scheme, depth, wrong);
}

constexpr auto kLoop = data::Scheme::kLoop, kQuads = data::Scheme::kCatmullClark;
INSTANTIATE_TEST_SUITE_P(Meshes, Found,
                         testing::Values(Case{"icosahedron", kLoop, 0}, Case{"icosahedron", kLoop, 3},
                                         Case{"bumpy:60", kLoop, 2}, Case{"torus:6:5", kLoop, 2},
                                         Case{"fan:7", kLoop, 2}, Case{"wheel:5", kLoop, 3},
                                         Case{"quad-cube", kQuads, 0}, Case{"quad-cube", kQuads, 3},
                                         Case{"quad-torus:6:5", kQuads, 2}, Case{"icosahedron", kQuads, 2},
                                         Case{"dual:icosahedron", kQuads, 0},
                                         Case{"dual:icosahedron", kQuads, 1},
                                         Case{"dual:icosahedron", kQuads, 2}));

// Two parts alike, and a hole in one place: the parts are told apart by where they are.
TEST(Matching, TellsPartsThatAreAlikeApartByTheirPlace) {
  data::ControlMesh two = unlike(data::named_mesh("icosahedron"));
  const data::ControlMesh one = two;
  for (std::size_t f = 0; f < one.faces.size(); ++f) {
    std::vector<std::int32_t> moved(one.faces[f].begin(), one.faces[f].end());
    for (auto& v : moved) v += static_cast<std::int32_t>(one.positions.size());
    two.faces.push_back(moved);
  }
  for (auto p : one.positions) two.positions.push_back({p[0] + 9, p[1], p[2]});
  expect_found(two, kLoop, 2, shuffled(delivered(two, kLoop, 2), 4, 1));
}

TEST(Matching, SaysWhyThereIsNone) {
  const data::ControlMesh mesh = unlike(data::named_mesh("icosahedron"));
  const auto failure = [&](Delivery d, int depth = 2) {
    return match(RefinedComplex(mesh, kLoop, depth), d.bare()).failure;
  };
  const Delivery good = delivered(mesh, kLoop, 2);
  EXPECT_EQ(failure(good), "");
  EXPECT_EQ(failure(good, 1), "320 triangles were delivered; the mesh has 80 at depth 1");
  Delivery bad = good;
  bad.positions.push_back({});
  EXPECT_EQ(failure(bad), "163 vertices were delivered, at 163 places; the mesh has 162 at depth 2");
  bad = good;  // an edge turned in the quad of two triangles
  for (std::size_t t = 1; t < bad.triangles.size(); ++t) {
    auto &a = bad.triangles[0], &b = bad.triangles[t];
    for (int k = 0; k < 3; ++k) {
      const auto at = std::find(b.begin(), b.end(), a[(k + 1) % 3]) - b.begin();
      if (at == 3 || b[(at + 1) % 3] != a[k]) continue;
      const auto far = b[(at + 2) % 3], apex = a[(k + 2) % 3], from = a[k], to = a[(k + 1) % 3];
      a = {apex, from, far};
      b = {far, to, apex};
      t = bad.triangles.size();
      break;
    }
  }
  EXPECT_EQ(failure(bad), "the triangles are not connected as those of the mesh at depth 2");
  bad = good;
  bad.triangles[3] = bad.triangles[4];
  EXPECT_EQ(failure(bad), "the triangles are no oriented manifold");
}

// Through the whole host: a subject that delivers no provenance is judged as if it had.
TEST(Matching, ASubjectWithoutProvenanceHasPlaces) {
  const data::ControlMesh mesh = unlike(data::named_mesh("bumpy:60"));
  Session bare(*lc_subject_bare(), mesh, "bare=naive"), full(*lc_subject_naive(), mesh);
  const Tessellation a = bare.tessellate(2), b = full.tessellate(2);
  ASSERT_TRUE(a.defects().empty());
  ASSERT_NE(a.matching(), nullptr);
  EXPECT_EQ(b.matching(), nullptr);
  ASSERT_EQ(a.vertex_count(), b.vertex_count());
  for (std::int64_t v = 0; v < a.vertex_count(); ++v) {
    const Vector p = about(mesh, kLoop, a.place(v)), q = about(mesh, kLoop, b.place(v));
    for (int k = 0; k < 3; ++k) ASSERT_NEAR(p[k], q[k], 1e-12);
  }
  std::vector<std::int32_t> depths(mesh.faces.size(), 1);
  depths[0] = 2;
  EXPECT_THROW(bare.tessellate(depths), SubjectError);
}

// A subject that takes a mesh which is none, to see whether it refuses it: nothing is laid on that.
TEST(Matching, IsNotTriedOnAMeshThatIsNoManifold) {
  data::ControlMesh mesh = data::named_mesh("icosahedron");
  mesh.faces.push_back({0, 1, 40});
  mesh.faces.push_back({0, 0, 1});
  static lc_subject takes_all = *lc_subject_bare();
  takes_all.create = [](const lc_mesh*, const char* options, void** instance, const char** message) {
    static LentMesh other(data::named_mesh("icosahedron"), kLoop);
    return lc_subject_bare()->create(&other.lend(), options, instance, message);
  };
  Session session(takes_all, mesh, "bare=naive", Session::Input::kAsItIs, kLoop);
  const Tessellation t = session.tessellate(1);
  ASSERT_GT(t.vertex_count(), 0);
  EXPECT_FALSE(t.provenance_ok(0));
  EXPECT_FALSE(t.triangle_ok(0));
}

}  // namespace
}  // namespace limitcheck::verify
