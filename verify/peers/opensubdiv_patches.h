// SPDX-License-Identifier: MIT
// OpenSubdiv's patches of a mesh, which are evaluated by Far or by a GPU. Private to the adapters.
#pragma once

#include <opensubdiv/far/patchMap.h>
#include <opensubdiv/far/patchTable.h>
#include <opensubdiv/far/patchTableFactory.h>
#include <opensubdiv/far/ptexIndices.h>
#include <opensubdiv/far/stencilTableFactory.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "verify/peers/opensubdiv_mesh.h"

namespace limitcheck::verify {

/// The options `level` and `end-cap`; all else is the library's default.
inline OpenSubdiv::Far::PatchTableFactory::Options patch_options(Options& options) {
  using Result = OpenSubdiv::Far::PatchTableFactory::Options;
  Result result(static_cast<unsigned>(options.integer("level", 2, 1, 10)));
  result.SetEndCapType(options.choice("end-cap", {"gregory", "bspline"}) == 1 ? Result::ENDCAP_BSPLINE_BASIS
                                                                              : Result::ENDCAP_GREGORY_BASIS);
  return result;
}

/// The mesh refined where it is irregular, or its channel is, and the patches of both.
struct OpenSubdivPatches {
  std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> refiner;
  std::unique_ptr<OpenSubdiv::Far::PatchTable> table;
  std::unique_ptr<OpenSubdiv::Far::PatchMap> map;
  std::unique_ptr<OpenSubdiv::Far::PtexIndices> ptex;

  OpenSubdivPatches(const lc_mesh& mesh, OpenSubdiv::Sdc::Options::VtxBoundaryInterpolation boundary,
                    OpenSubdiv::Far::PatchTableFactory::Options options)
      : refiner(make_refiner(mesh, opensubdiv_scheme(mesh), boundary)) {
    using namespace OpenSubdiv;
    const OpenSubdivErrors errors;
    options.generateFVarTables = mesh.channel_count > 0;
    refiner->RefineAdaptive(options.GetRefineAdaptiveOptions());
    table.reset(Far::PatchTableFactory::Create(*refiner, options));
    errors.check();
    if (table == nullptr) throw SubjectError(LC_FAILED, "OpenSubdiv makes no patches of this mesh");
    map = std::make_unique<Far::PatchMap>(*table);
    ptex = std::make_unique<Far::PtexIndices>(*refiner);
  }

  /// The patch at a point of a part of a face. The parts are its ptex faces.
  template <class Real>
  const OpenSubdiv::Far::PatchTable::PatchHandle& patch(std::int32_t face, std::int32_t part,
                                                        const Real* uv) const {
    const auto* const found =
        map->FindPatch(ptex->GetFaceId(face) + part, static_cast<double>(uv[0]), static_cast<double>(uv[1]));
    if (found == nullptr)
      throw SubjectError(LC_NOT_SUPPORTED, "Far has no patch on face " + std::to_string(face));
    return *found;
  }

  /// A stencil for each point of the patterns, of the surface or of the channel, in their order: the table orders
  /// its stencils as it is given them, ptex face by ptex face.
  template <class Real>
  std::unique_ptr<const OpenSubdiv::Far::LimitStencilTableReal<Real>> limit_stencils(
      const FacePatterns& patterns, bool of_channel = false) const {
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
    typename Factory::Options options;
    if (of_channel) options.interpolationMode = Factory::INTERPOLATE_FACE_VARYING;
    const OpenSubdivErrors errors;
    std::unique_ptr<const OpenSubdiv::Far::LimitStencilTableReal<Real>> stencils(
        Factory::Create(*refiner, locations, nullptr, table.get(), options));
    errors.check();
    // It leaves out, without a word, locations that no patch covers.
    if (stencils == nullptr || static_cast<std::size_t>(stencils->GetNumStencils()) != count)
      throw SubjectError(LC_NOT_SUPPORTED, "Far makes no limit stencil of some points of this mesh");
    return stencils;
  }
};

}  // namespace limitcheck::verify
