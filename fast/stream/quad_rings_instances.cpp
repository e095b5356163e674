// SPDX-License-Identifier: MIT
#include "fast/stream/quad_rings_impl.h"

namespace limitcheck::fast::row_stream {

template class BasicQuadRings<float>;
template class BasicQuadRings<double>;

}  // namespace limitcheck::fast::row_stream
