// SPDX-License-Identifier: MIT
// The faults that the subject `faulty` plants. Private to it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "data/control_mesh.h"
#include "verify/mutants/delivered_copy.h"
#include "verify/mutants/faulty_subjects.h"

namespace limitcheck::verify {

/// What a subject delivered, so that vertices and triangles can be added and removed.
template <class Real>
struct Copy : DeliveredCopy<Real> {
  std::vector<std::int32_t> face_depth = {};  // that was asked for
  // Faults of the memory: planted when it is handed over.
  std::optional<std::int64_t> announced_vertices = std::nullopt;
  bool foreign_normals = false, overlap = false, overrun = false, underrun = false, modify_mesh = false;
};

template <class Real>
struct PlantedFault {
  Fault fault;
  void (*plant)(const data::ControlMesh&, Copy<Real>&);
  void (*take)(data::ControlMesh&) = nullptr;  // what the subject makes of the mesh before it begins
};

/// Throws SubjectError(LC_NOT_SUPPORTED) from plant() where there is nothing to plant the fault in.
/// Instantiated for float and double.
template <class Real>
const std::vector<PlantedFault<Real>>& planted_faults();

/// Those among them that only some control meshes bring out. On all others plant() does nothing.
template <class Real>
std::vector<PlantedFault<Real>> mesh_faults();
/// Likewise: those that show in rare neighbourhoods.
template <class Real>
std::vector<PlantedFault<Real>> rare_faults();

/// The control vertex that a vertex lies at, or -1.
std::int32_t control_vertex(const data::ControlMesh& mesh, const lc_provenance& place);

}  // namespace limitcheck::verify
