// SPDX-License-Identifier: MIT
// What is compiled of the reference for a number type: users of the headers compile none of the templates. Each
// number type has a .cpp file of its own, since each takes half a minute.
#pragma once

#include "reference/catmull_clark/recursion_impl.h"
#include "reference/catmull_clark/stam_impl.h"
#include "reference/loop/recursion_impl.h"
#include "reference/loop/refine_impl.h"
#include "reference/loop/stam_impl.h"

/// All of loop/refine.h but `limits`, which needs square roots.
#define LIMITCHECK_INSTANTIATE_REFINE(N)                                                           \
  template std::vector<Vec3<N>> refine_once(const Topology&, const std::vector<Vec3<N>>&, Weights, \
                                            std::span<const VertexState>, const Valences&);        \
  template std::vector<Vec3<N>> positions_of(const data::ControlMesh&);                            \
  template RefinedMesh<N>::RefinedMesh(const data::ControlMesh&, Weights);                         \
  template RefinedMesh<N>::RefinedMesh(std::vector<Vec3<N>>, std::vector<Triangle>, Weights,       \
                                       const SharpTags&);                                          \
  template void RefinedMesh<N>::refine();

/// All of both schemes.
#define LIMITCHECK_INSTANTIATE(N)                          \
  namespace limitcheck::reference {                        \
  LIMITCHECK_INSTANTIATE_REFINE(N)                         \
  template VertexLimits<N> RefinedMesh<N>::limits() const; \
  template class NaiveSubdivider<N>;                       \
  template class StamEvaluator<N>;                         \
  template class SubdivisionEvaluator<N>;                  \
  template class catmull_clark::NaiveSubdivider<N>;        \
  template class catmull_clark::RefinedMesh<N>;            \
  template class catmull_clark::StamEvaluator<N>;          \
  template class catmull_clark::SubdivisionEvaluator<N>;   \
  }
