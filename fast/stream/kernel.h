// SPDX-License-Identifier: MIT
// The row-streaming kernel for any number type, one grid at a time.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "fast/stream/layout.h"
#include "fast/stream/number.h"

// The kernel's text is shared with the vector targets, which need an attribute on every function.
#ifndef HWY_ATTR
#define HWY_ATTR
#define HWY_INLINE inline
#define LIMITCHECK_UNDEF_HWY_ATTR
#endif

namespace limitcheck::fast::row_stream::generic {

#include "fast/stream/rules-inl.h"
// rows use the rules
#include "fast/stream/rows-inl.h"
// strips along edges use their rules
#include "fast/stream/edge-inl.h"
// the stream uses all of them
#include "fast/stream/stream-inl.h"

}  // namespace limitcheck::fast::row_stream::generic

#ifdef LIMITCHECK_UNDEF_HWY_ATTR
#undef HWY_ATTR
#undef HWY_INLINE
#undef LIMITCHECK_UNDEF_HWY_ATTR
#endif
