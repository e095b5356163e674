// SPDX-License-Identifier: MIT
// Tables of the cosines and sines of pi i / m.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "reference/number/number.h"

namespace limitcheck::reference {

/// The cosines and sines of the masks, computed once per thread and m; again when the number type's
/// `precision()` has changed.
template <class N>
struct CircleTable {
  std::vector<N> cosine, sine;  ///< of pi i / m, i = 0..2m-1
};
/// The table of m, made at its first use by a thread.
template <class N>
const CircleTable<N>& circle_table(long m) {
  thread_local std::vector<std::unique_ptr<CircleTable<N>>> tables;
  thread_local long precision = 0;
  if (precision != NumberTraits<N>::precision()) {
    tables.clear();
    precision = NumberTraits<N>::precision();
  }
  const std::size_t index = m;
  if (tables.size() <= index) tables.resize(index + 1);
  if (!tables[index]) {
    auto table = std::make_unique<CircleTable<N>>();
    for (long i = 0; i < 2 * m; ++i) {
      table->cosine.push_back(NumberTraits<N>::cos_pi(i, m));
      table->sine.push_back(sin_pi<N>(i, m));
    }
    tables[index] = std::move(table);
  }
  return *tables[index];
}

}  // namespace limitcheck::reference
