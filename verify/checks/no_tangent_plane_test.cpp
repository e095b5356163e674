// SPDX-License-Identifier: MIT
// At spikes, at corners of sectors of two faces and more, and at creases and boundaries of four faces and
// more the surface has no tangent plane, or takes it on like 1/k only: subjects that are right everywhere
// else are not blamed for any normal there, and the row says how many there are.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "data/cut_out.h"
#include "data/generators/polygon_meshes.h"
#include "data/generators/sharp_meshes.h"
#include "data/shapes.h"
#include "verify/audit/audit.h"
#include "verify/row/test_rows.h"
#include "verify/subject/registry.h"

namespace limitcheck::verify {
namespace {

struct Shape {
  std::string name;
  data::ControlMesh mesh;
  std::int64_t sectors, faces;  // without a tangent plane: how many, and how many faces they have in all
  bool creased = false;         // edges inside stay sharp
};

Shape fan(int faces, bool held) {
  data::ControlMesh mesh = data::quad_fan(faces, 3);
  mesh.sharpness.boundary = data::Boundary::kEdgeAndCorner;
  if (held) mesh.sharpness.vertices.push_back({0, data::kInfiniteSharpness});
  return {(held ? "held corner of " : "boundary of ") + std::to_string(faces), mesh, 1, faces};
}

Shape spike(int valence) {
  data::ControlMesh mesh = data::quad_wheel(valence, 3);
  mesh.sharpness.boundary = data::Boundary::kEdgeAndCorner;
  mesh.sharpness.vertices.push_back({0, data::kInfiniteSharpness});
  return {"spike of " + std::to_string(valence), mesh, 1, valence};
}

// One ring of faces, between whose sectors edges stay sharp up to the boundary.
Shape creases(int sectors, int faces) {
  data::ControlMesh mesh = data::corner(sectors * faces / 2, false);
  std::vector<data::SharpEdge> every_second = std::move(mesh.sharpness.edges);
  mesh.sharpness.edges.clear();
  for (std::size_t k = 0; k < every_second.size(); k += static_cast<std::size_t>(faces) / 2)
    mesh.sharpness.edges.push_back(every_second[k]);
  std::vector<std::int32_t> around;
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    if (std::find(mesh.faces[f].begin(), mesh.faces[f].end(), 0) != mesh.faces[f].end())
      around.push_back(static_cast<std::int32_t>(f));
  data::CutOut cut = data::cut_out(mesh.faces, around);
  data::ControlMesh ring{cut.of(mesh.positions), {}, cut.of(mesh.sharpness)};
  ring.faces = std::move(cut.faces);
  ring.sharpness.boundary = data::Boundary::kEdgeAndCorner;
  return {std::to_string(sectors) + " sectors of " + std::to_string(faces), ring, sectors, sectors * faces,
          true};
}

// A square of 4 x 4 quads, flat but for one vertex, without its first quarter: a held corner of three faces,
// where the surface folds over.
Shape reentrant() {
  data::ControlMesh mesh;
  for (int j = 0; j <= 4; ++j)
    for (int i = 0; i <= 4; ++i)
      if (i >= 2 || j >= 2)
        mesh.positions.push_back(
            {static_cast<double>(i), static_cast<double>(j), i == 3 && j == 3 ? .5 : 0.});
  const auto at = [](int i, int j) { return j < 2 ? 3 * j + i - 2 : 6 + 5 * (j - 2) + i; };
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i)
      if (i >= 2 || j >= 2) mesh.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
  mesh.sharpness.boundary = data::Boundary::kEdgeAndCorner;
  mesh.sharpness.vertices.push_back({at(2, 2), data::kInfiniteSharpness});
  return {"reentrant corner", mesh, 1, 3};
}

std::vector<Shape> shapes() {
  std::vector<Shape> all{reentrant(), creases(2, 4), creases(3, 2), creases(4, 2), creases(3, 4)};
  for (int k = 4; k <= 7; ++k) all.push_back(fan(k, false));
  for (int k = 2; k <= 6; ++k) all.push_back(fan(k, true));
  for (const int n : {3, 4, 5, 6, 8, 12}) all.push_back(spike(n));
  return all;
}

// Loop's: sectors of six faces at the boundary, of three at a held corner.
std::vector<Shape> triangle_shapes() {
  std::vector<Shape> all;
  for (int k = 3; k <= 8; ++k)
    for (const bool held : {false, true}) {
      if (k < 6 && !held) continue;
      data::ControlMesh mesh = data::fan(k);
      mesh.sharpness.boundary = data::Boundary::kEdgeAndCorner;
      if (held) mesh.sharpness.vertices.push_back({0, data::kInfiniteSharpness});
      all.push_back(
          {(held ? "held corner of triangles " : "boundary of triangles ") + std::to_string(k), mesh, 1, k});
    }
  for (const int n : {3, 6, 8}) {
    data::ControlMesh mesh = data::wheel(n);
    mesh.sharpness.boundary = data::Boundary::kEdgeAndCorner;
    mesh.sharpness.vertices.push_back({0, data::kInfiniteSharpness});
    all.push_back({"spike of triangles " + std::to_string(n), mesh, 1, n});
  }
  return all;
}

struct Sound {
  const char *name, *options;
  bool creases;    // right on edges that stay sharp
  bool face_wise;  // each face has vertices of its own
};

void expect_no_blame(const Sound& s, const Shape& shape, int depth) {
  const std::string what = std::string(s.name) + " on " + shape.name + " at depth " + std::to_string(depth);
  Auditor auditor(depth, 1, {}, Level::kQuick);
  const auto results = auditor.run({find_subject(s.name), s.options}, {shape.name, shape.mesh});
  for (const char* check :
       {"finite", "positions", "normal-length", "normals-against-positions", "orientation"})
    EXPECT_EQ(row(results, check).status, Status::kHeld) << what << ", " << check;
  const Result& normals = row(results, "normals");
  EXPECT_EQ(normals.status, Status::kHeld) << what << ": " << normals.worst.value_or(-1) << " at "
                                           << (normals.witness ? normals.witness->where() : "");
  const std::string count = std::to_string(s.face_wise ? shape.faces : shape.sectors);
  EXPECT_EQ(normals.message.find(count + " more where the surface has no normal"), 0U)
      << what << ": " << normals.message;
}

TEST(NoTangentPlane, BlamesNoSoundSubject) {
  const std::vector<Sound> subjects{
      {"quad-model", "", true, true},
      {"opensubdiv-far", "precision=double", false, false},
      {"opensubdiv-bfr", "precision=double,approx-level=5", true, true},
      {"opensubdiv-far-patches", "precision=double,level=5,inf-sharp=on", true, true},
      {"embree", "", false, true}};
  int judged = 0;
  for (const Shape& shape : shapes())
    for (const Sound& subject : subjects) {
      if (shape.creased && !subject.creases) continue;
      for (const int depth : {0, 3}) expect_no_blame(subject, shape, depth), ++judged;
    }
  EXPECT_GT(judged, 100);
}

TEST(NoTangentPlane, BlamesNoSoundSubjectOfLoopsScheme) {
  const Sound far{"opensubdiv-far", "precision=double", false, false};
  for (const Shape& shape : triangle_shapes())
    for (const int depth : {0, 3}) expect_no_blame(far, shape, depth);
}

}  // namespace
}  // namespace limitcheck::verify
