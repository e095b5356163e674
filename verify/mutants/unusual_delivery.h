// SPDX-License-Identifier: MIT
// The habits in which the subject `unusual` delivers a correct tessellation. Private to it.
#pragma once

#include <string_view>

#include "data/control_mesh.h"
#include "verify/mutants/delivered_copy.h"

namespace limitcheck::verify {

/// Changes nothing for a habit that is not one of delivery. Instantiated for float and double.
template <class Real>
void rearrange(std::string_view habit, const data::ControlMesh& mesh, DeliveredCopy<Real>& out);

}  // namespace limitcheck::verify
