// SPDX-License-Identifier: MIT
// The row-streaming kernels of both schemes for any number type, one grid or quad at a time, in namespace generic.
#pragma once

#include "fast/stream/kernel/layout.h"
#include "fast/stream/kernel/number.h"

// The kernels' text is shared with the vector targets. Here it is compiled for a target without Highway.
#if defined(HWY_NAMESPACE) || defined(HWY_INLINE)
#error "fast/stream/kernel/kernel.h comes before Highway's headers"
#endif
#define HWY_NAMESPACE generic
#define HWY_BEFORE_NAMESPACE() static_assert(true)
#define HWY_AFTER_NAMESPACE() static_assert(true)
#define HWY_ATTR
#define HWY_INLINE inline
#define HWY_FLATTEN

#include "fast/stream/kernel/quad_patch-inl.h"
#include "fast/stream/kernel/quad_stream-inl.h"
#include "fast/stream/kernel/stream-inl.h"
#include "fast/stream/kernel/triangle_patch-inl.h"

#undef HWY_NAMESPACE
#undef HWY_BEFORE_NAMESPACE
#undef HWY_AFTER_NAMESPACE
#undef HWY_ATTR
#undef HWY_INLINE
#undef HWY_FLATTEN
// The vector targets include the same files anew.
#undef LIMITCHECK_FAST_STREAM_STREAM_INL_H_
#undef LIMITCHECK_FAST_STREAM_REGULAR_EDGE_INL_H_
#undef LIMITCHECK_FAST_STREAM_STRIP_INL_H_
#undef LIMITCHECK_FAST_STREAM_TRIANGLE_PATCH_INL_H_
#undef LIMITCHECK_FAST_STREAM_VERTEX_INL_H_
#undef LIMITCHECK_FAST_STREAM_QUAD_PATCH_INL_H_
#undef LIMITCHECK_FAST_STREAM_QUAD_ROWS_INL_H_
#undef LIMITCHECK_FAST_STREAM_QUAD_RULES_INL_H_
#undef LIMITCHECK_FAST_STREAM_QUAD_SIDE_INL_H_
#undef LIMITCHECK_FAST_STREAM_QUAD_STREAM_INL_H_
