// SPDX-License-Identifier: MIT
// The figures of a claim's test: its finding in the register and the report's tables name them.
#pragma once

#include <fmt/core.h>
#include <gtest/gtest.h>

namespace limitcheck::verify {

///   format   of the value: "{:.1f}"
///   name     with a place for each of `parts`: "percent_culled_{}"
template <class Value, class... Parts>
void record(const char* format, const Value& value, const char* name, const Parts&... parts) {
  testing::Test::RecordProperty(fmt::format(fmt::runtime(name), parts...),
                                fmt::format(fmt::runtime(format), value));
}

}  // namespace limitcheck::verify
