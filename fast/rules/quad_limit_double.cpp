// SPDX-License-Identifier: MIT
#include "fast/rules/quad_limit_impl.h"

namespace limitcheck::fast {

template StarWeights<double> star_weights(int, bool, VertexKind);

}  // namespace limitcheck::fast
