// SPDX-License-Identifier: MIT
// OpenSubdiv's patches of a mesh, which are evaluated by Far or by a GPU. Private to the adapters.
#pragma once

#include <opensubdiv/far/patchMap.h>
#include <opensubdiv/far/patchTable.h>
#include <opensubdiv/far/patchTableFactory.h>
#include <opensubdiv/far/ptexIndices.h>
#include <opensubdiv/far/stencilTableFactory.h>

#include <memory>
#include <utility>
#include <vector>

#include "verify/peers/opensubdiv_mesh.h"

namespace limitcheck::verify {

/// The mesh refined where it is irregular, and the patches made of what results.
struct OpenSubdivPatches {
  std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> refiner;
  std::unique_ptr<OpenSubdiv::Far::PatchTable> table;
  std::unique_ptr<OpenSubdiv::Far::PatchMap> map;
  std::unique_ptr<OpenSubdiv::Far::PtexIndices> ptex;

  /// The refiner is as it was made.
  OpenSubdivPatches(std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> made,
                    const OpenSubdiv::Far::PatchTableFactory::Options& options)
      : refiner(std::move(made)) {
    using namespace OpenSubdiv;
    const OpenSubdivErrors errors;
    refiner->RefineAdaptive(options.GetRefineAdaptiveOptions());
    table.reset(Far::PatchTableFactory::Create(*refiner, options));
    errors.check();
    if (table == nullptr) throw SubjectError(LC_FAILED, "OpenSubdiv makes no patches of this mesh");
    map = std::make_unique<Far::PatchMap>(*table);
    ptex = std::make_unique<Far::PtexIndices>(*refiner);
  }

  /// The patch at (u, v) of a part of a face. The parts are its ptex faces.
  const OpenSubdiv::Far::PatchTable::PatchHandle& patch(std::int32_t face, std::int32_t part, double u,
                                                        double v) const {
    const auto* const found = map->FindPatch(ptex->GetFaceId(face) + part, u, v);
    if (found == nullptr)
      throw SubjectError(LC_NOT_SUPPORTED, "Far has no patch on face " + std::to_string(face));
    return *found;
  }

  /// A stencil for each point of the patterns, in their order: the table orders its stencils as it is given them, ptex
  /// face by ptex face.
  template <class Real>
  std::unique_ptr<const OpenSubdiv::Far::LimitStencilTableReal<Real>> limit_stencils(
      const FacePatterns& patterns) const {
    using Factory = OpenSubdiv::Far::LimitStencilTableFactoryReal<Real>;
    const auto count = static_cast<std::size_t>(patterns.vertices());
    std::vector<Real> s(count), t(count);
    typename Factory::LocationArrayVec locations;
    std::size_t at = 0;
    for (std::int64_t f = 0; f < patterns.faces(); ++f) {
      const FacePattern* const pattern = patterns.of(f).pattern;
      if (pattern == nullptr) continue;
      for (const FaceDomain::Point& p : pattern->points) {
        s[at] = static_cast<Real>(p.i) / static_cast<Real>(pattern->denominator);
        t[at] = static_cast<Real>(p.j) / static_cast<Real>(pattern->denominator);
        auto& location = locations.emplace_back();
        location.ptexIdx = ptex->GetFaceId(static_cast<int>(f)) + p.part;
        location.numLocations = 1;
        location.s = &s[at];
        location.t = &t[at++];
      }
    }
    const OpenSubdivErrors errors;
    std::unique_ptr<const OpenSubdiv::Far::LimitStencilTableReal<Real>> stencils(
        Factory::Create(*refiner, locations, nullptr, table.get()));
    errors.check();
    // It leaves out, without a word, locations that no patch covers.
    if (stencils == nullptr || static_cast<std::size_t>(stencils->GetNumStencils()) != count)
      throw SubjectError(LC_NOT_SUPPORTED, "Far makes no limit stencil of some points of this mesh");
    return stencils;
  }
};

}  // namespace limitcheck::verify
