// SPDX-License-Identifier: MIT
// What a face costs does not grow with the faces around its vertex.
#include <gtest/gtest.h>

#include <memory>

#include "reference/loop/refine_impl.h"
#include "reference/loop/stam_impl.h"
#include "reference/surface/test_many_faces.h"

namespace limitcheck::reference {
namespace {

TEST(Loop_ManyFaces, CostNoMoreEachThanFewer) {
  test::expect_linear(test::triangles(250), test::triangles(1000), [](const data::ControlMesh& mesh) {
    return [e = std::make_shared<StamEvaluator<Counted>>(mesh)](int f, double a, double b) {
      (void)e->evaluate(f, a, b);
    };
  });
}

}  // namespace
}  // namespace limitcheck::reference
