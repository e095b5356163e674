// SPDX-License-Identifier: MIT
// The row-streaming kernel of quads for any number type, one quad at a time, in namespace generic.
#pragma once

#include "fast/stream/kernel/kernel.h"
#include "fast/stream/kernel/quad_layout.h"

// As in kernel.h, whose own files are included by now.
#define HWY_NAMESPACE generic
#define HWY_BEFORE_NAMESPACE() static_assert(true)
#define HWY_AFTER_NAMESPACE() static_assert(true)
#define HWY_ATTR
#define HWY_INLINE inline
#define LIMITCHECK_FAST_STREAM_ROWS_INL_H_
#define LIMITCHECK_FAST_STREAM_RULES_INL_H_

#include "fast/stream/kernel/quad_patch-inl.h"
#include "fast/stream/kernel/quad_stream-inl.h"

#undef HWY_NAMESPACE
#undef HWY_BEFORE_NAMESPACE
#undef HWY_AFTER_NAMESPACE
#undef HWY_ATTR
#undef HWY_INLINE
#undef LIMITCHECK_FAST_STREAM_ROWS_INL_H_
#undef LIMITCHECK_FAST_STREAM_RULES_INL_H_
#undef LIMITCHECK_FAST_STREAM_QUAD_CORNER_INL_H_
#undef LIMITCHECK_FAST_STREAM_QUAD_CURVE_INL_H_
#undef LIMITCHECK_FAST_STREAM_QUAD_PATCH_INL_H_
#undef LIMITCHECK_FAST_STREAM_QUAD_ROWS_INL_H_
#undef LIMITCHECK_FAST_STREAM_QUAD_RULES_INL_H_
#undef LIMITCHECK_FAST_STREAM_QUAD_SIDE_INL_H_
#undef LIMITCHECK_FAST_STREAM_QUAD_STREAM_INL_H_
