// SPDX-License-Identifier: MIT
// The option of our own subjects that chooses the family of weights.
#pragma once

#include "reference/loop/masks.h"
#include "verify/subject/options.h"
#include "verify/subject/subject.h"

namespace limitcheck::verify {

/// weights=loop (the default) or weights=warren.
inline lc_weights weights_option(Options& options) {
  return options.choice("weights", {"loop", "warren"}) == 0 ? LC_WEIGHTS_LOOP : LC_WEIGHTS_WARREN;
}

/// The same in the words of the reference.
inline reference::Weights family(lc_weights weights) {
  return weights == LC_WEIGHTS_WARREN ? reference::Weights::kWarren : reference::Weights::kLoop;
}

}  // namespace limitcheck::verify
