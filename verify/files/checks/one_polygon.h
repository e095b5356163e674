// SPDX-License-Identifier: MIT
// How far the limit surface lies from the coarsest tessellation that files have.
#pragma once

#include "verify/files/checks/file_evidence.h"

namespace limitcheck::verify {

/// The largest distance, at most, from the surface over a control face, holes left out, to one flat polygon of
/// the limits of that face's corners; in the mesh's unit.
double from_one_polygon_each(const FileEvidence& evidence);

}  // namespace limitcheck::verify
