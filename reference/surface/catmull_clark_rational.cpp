// SPDX-License-Identifier: MIT
// Catmull-Clark in exact rationals: complete but for normals.
#include "reference/catmull_clark/refined_mesh_impl.h"
#include "reference/catmull_clark/subdivision_evaluator_impl.h"

namespace limitcheck::reference::catmull_clark {

template RefinedMesh<Rational>::RefinedMesh(data::Faces, std::vector<Vec3<Rational>>, const SharpTags&);
template void RefinedMesh<Rational>::refine();
template std::int32_t RefinedMesh<Rational>::vertex(std::size_t, std::size_t, int, int) const;
template class SubdivisionEvaluator<Rational>;

}  // namespace limitcheck::reference::catmull_clark
