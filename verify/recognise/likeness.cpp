// SPDX-License-Identifier: MIT
#include "verify/recognise/likeness.h"

#include <fmt/core.h>

namespace limitcheck::verify {

void say_recognised(Result& row, const Recognised& recognised, const Statistics& distances, double rounding,
                    const std::optional<Witness>& worst) {
  row.recognised = recognised;
  row.unit = "diagonal";
  row.bound = rounding;
  take(row, distances);
  row.message = recognised.what;
  if (row.bad == 0) return;
  row.witness = worst;
  row.message += fmt::format(", but {} of {} vertices are not", row.bad, row.of);
  if (row.worst) row.message += fmt::format(": up to {:.2g} diagonals off", *row.worst);
  if (worst && worst->face >= 0)
    row.message += fmt::format(", most at vertex {} in face {} at ({}, {})", worst->vertex, worst->where(),
                               worst->l1, worst->l2);
}

}  // namespace limitcheck::verify
