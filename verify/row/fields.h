// SPDX-License-Identifier: MIT
// The fields of a row and of what it holds, each under its name and in the order of the report: described once for
// all that is written and read.
#pragma once

#include <concepts>
#include <cstddef>
#include <type_traits>

#include "verify/row/result.h"

namespace limitcheck::verify {

template <class T, class Of>
concept Is = std::same_as<std::remove_const_t<T>, Of>;

template <class Visit, class... Member>
void visit_each(Visit& visit, const char* const (&names)[sizeof...(Member)], Member&... members) {
  std::size_t k = 0;
  (visit(names[k++], members), ...);
}

/// Calls visit(name, member) for each. A structured binding names all members: with a new one this does not
/// compile until it is visited, too. Fields without a name are of no use to who reads a report: only the parts
/// have them of which a report is made.
template <class Visit>
void visit_fields(Is<IllConditioned> auto& row, Visit&& visit) {
  auto& [count, bound, worst] = row;
  visit_each(visit, {"count", "bound", "worst"}, count, bound, worst);
}
template <class Visit>
void visit_fields(Is<PlaceCount> auto& row, Visit&& visit) {
  auto& [kind, faces, bad, of] = row;
  visit_each(visit, {"where", "faces", "count", "of"}, kind, faces, bad, of);
}
template <class Visit>
void visit_fields(Is<Recognised> auto& row, Visit&& visit) {
  auto& [what, scheme, steps, limit, tags] = row;
  visit_each(visit, {"what", "scheme", "steps", "limit", "tags"}, what, scheme, steps, limit, tags);
}
template <class Visit>
void visit_fields(Is<Witness> auto& row, Visit&& visit) {
  auto& [face, l1, l2, vertex, triangle, expected, got, digits, corner] = row;
  visit_each(visit,
             {"face", "corner", "l1", "l2", "vertex", "triangle", "expected", "got", "expected_digits"}, face,
             corner, l1, l2, vertex, triangle, expected, got, digits);
}
template <class Visit>
void visit_fields(Is<Report::Mesh> auto& row, Visit&& visit) {
  auto& [name, vertices, faces, scheme, triangulated, diagonal] = row;
  visit_each(visit, {"name", "vertices", "faces", "diagonal", "scheme", "triangulated"}, name, vertices,
             faces, diagonal, scheme, triangulated);
}
template <class Visit>
void visit_fields(Is<Result> auto& row, Visit&& visit) {
  auto& [subject, mesh, check, depth, depths, sample, precision, scheme, cut, weights, status, bad, of, worst,
         bound, rms, p99, unit, absolute, ulps, ill, witness, message, accepted, not_finite, waiver, places,
         decades, seconds, recognised, origin] = row;
  visit_each(
      visit,
      {"subject",    "mesh",    "depth",   "depths",         "sample",     "scheme",          "triangulated",
       "precision",  "check",   "status",  "count",          "of",         "worst",           "bound",
       "unit",       "rms",     "p99",     "worst_absolute", "worst_ulps", "ill_conditioned", "places",
       "recognised", "seconds", "message", "witness",        "origin"},
      subject, mesh, depth, depths, sample, scheme, cut, precision, check, status, bad, of, worst, bound,
      unit, rms, p99, absolute, ulps, ill, places, recognised, seconds, message, witness, origin);
  visit_each(visit, {"", "", "", "", ""}, weights, decades, accepted, not_finite, waiver);
}

}  // namespace limitcheck::verify
