// SPDX-License-Identifier: MIT
#include "fast/stream/gather/batch.h"

namespace limitcheck::fast::row_stream {

using Float = ScalarNumber<float>;
template void gather<Float>(const Adjacency&, const Rings&, std::span<const Grid>, int, int, float*, Order);
template void gather_edges<Float>(const Adjacency&, const Rings&, std::span<const std::int32_t>, int, int,
                                  float*);

}  // namespace limitcheck::fast::row_stream
