// SPDX-License-Identifier: MIT
// Exact rationals. Loop's refinement, for meshes whose a(n) are rational, n = 3, 4, 6, and any boundary;
// Catmull-Clark's scheme is complete but for normals.
#include "reference/surface/instantiate.h"

namespace limitcheck::reference {

LIMITCHECK_INSTANTIATE_REFINE(Rational)
template catmull_clark::RefinedMesh<Rational>::RefinedMesh(data::Faces, std::vector<Vec3<Rational>>,
                                                           const SharpTags&);
template void catmull_clark::RefinedMesh<Rational>::refine();
template std::int32_t catmull_clark::RefinedMesh<Rational>::vertex(std::size_t, std::size_t, int, int) const;
template class catmull_clark::SubdivisionEvaluator<Rational>;

}  // namespace limitcheck::reference
