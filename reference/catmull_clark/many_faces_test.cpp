// SPDX-License-Identifier: MIT
// What a face costs does not grow with the faces around its vertex.
#include <gtest/gtest.h>

#include <memory>

#include "reference/catmull_clark/stam_impl.h"
#include "reference/surface/test_many_faces.h"

namespace limitcheck::reference::catmull_clark {
namespace {

TEST(CatmullClark_ManyFaces, CostNoMoreEachThanFewer) {
  test::expect_linear(test::quads(250), test::quads(1000), [](const data::ControlMesh& mesh) {
    return [e = std::make_shared<StamEvaluator<Counted>>(mesh.faces, test::positions<Counted>(mesh),
                                                         mesh.sharpness)](int f, double a, double b) {
      (void)e->evaluate(f, 0, a, b);
    };
  });
}

}  // namespace
}  // namespace limitcheck::reference::catmull_clark
