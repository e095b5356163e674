// SPDX-License-Identifier: MIT
// What a face costs does not grow with the faces around its vertex.
#include <gtest/gtest.h>

#include <memory>

#include "reference/catmull_clark/stam_impl.h"
#include "reference/loop/refine_impl.h"
#include "reference/loop/stam_impl.h"
#include "reference/surface/test_many_faces.h"

namespace limitcheck::reference {
namespace {

TEST(ManyFacesOfLoop, CostNoMoreEachThanFewer) {
  test::expect_linear(test::triangles(250), test::triangles(1000), [](const data::ControlMesh& mesh) {
    return [e = std::make_shared<StamEvaluator<Counted>>(mesh)](int f, double a, double b) {
      (void)e->evaluate(f, a, b);
    };
  });
}

TEST(ManyFacesOfCatmullClark, CostNoMoreEachThanFewer) {
  test::expect_linear(test::quads(250), test::quads(1000), [](const data::ControlMesh& mesh) {
    return [e = std::make_shared<catmull_clark::StamEvaluator<Counted>>(
                mesh.faces, test::positions<Counted>(mesh), mesh.sharpness)](int f, double a, double b) {
      (void)e->evaluate(f, 0, a, b);
    };
  });
}

}  // namespace
}  // namespace limitcheck::reference
