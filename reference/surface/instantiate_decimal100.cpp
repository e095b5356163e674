// SPDX-License-Identifier: MIT
#include "reference/surface/instantiate.h"

LIMITCHECK_INSTANTIATE(limitcheck::reference::Decimal100)
