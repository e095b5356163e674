// SPDX-License-Identifier: MIT
// The faults of sharp edges and vertices that the models can be told to have.
#include "verify/mutants/models/model_tags.h"
#include "verify/subject/subject_error.h"

namespace limitcheck::verify {

std::span<const Mutation> sharp_mutations() {
  static const std::vector<Mutation> list = [] {
    std::vector<Mutation> all{
        // Rules of vertices and edges.
        {"crease_as_corner", "a vertex with two sharp edges stays where it is", "positions"},
        {"dart_as_corner", "a vertex at which one sharp edge ends stays where it is", "positions"},
        {"three_edges_are_a_crease", "of three sharp edges at a vertex the first two are a crease",
         "positions"},
        {"boundary_not_counted", "a sharp edge that runs into the boundary makes no corner there",
         "positions"},
        {"boundary_tags_hold", "the ends of a boundary edge that is tagged as sharp stay where they are",
         "boundary-crease"},
        {"vertices_not_sharp", "the sharpness of vertices is ignored", "positions"},
        {"vertices_never_fall", "sharp vertices stay sharp", "positions"},
        {"corners_not_held", "boundary vertices of one face are not held, although they should be",
         "positions"},
        {"corners_always_held", "boundary vertices of one face are held by default", "positions"},
        // Sharpness.
        {"semi_as_infinite", "declares semi-sharp edges and keeps them sharp for ever", "positions"},
        {"infinite_is_4", "edges that stay sharp are sharp for 4 steps", "positions"},
        {"infinite_ends_after_10", "edges that stay sharp are smooth after 10 steps", "positions"},
        {"ten_is_finite", "a sharpness of 10 ends after 10 steps, only more than that is infinite",
         "infinite-sharpness"},
        {"infinite_from_3", "a sharpness of 3 is taken for infinite", "positions"},
        {"sharpness_rounded_down", "the fraction of a sharpness is dropped", "positions"},
        {"sharpness_rounded_up", "a sharpness is rounded up to a whole number", "positions"},
        {"below_1_is_smooth", "edges of a sharpness below 1 are smooth", "positions"},
        {"falls_by_2", "sharpness falls by 2 in a step", "positions"},
        {"last_sharp_step_missing", "the last step of sharp edges is left out", "positions"},
        {"no_blend", "a vertex whose rule changes takes the new one at once", "positions"},
        {"blend_reversed", "the two rules of a vertex are blended the wrong way round", "positions"},
        {"blend_by_the_sharpest", "blended by the largest sharpness that ends, not by the mean", "positions"},
        // Chaikin's creasing.
        {"chaikin_as_uniform", "Chaikin's way of falling is not done", "positions"},
        {"uniform_as_chaikin", "Chaikin's way of falling is done unasked", "positions"},
        {"chaikin_ends_exchanged", "each half of an edge gets the sharpness of the other one", "positions"},
        {"chaikin_without_clamp", "an edge above 1 of which one half ends is blended with its sharpness",
         "positions"},
        {"chaikin_takes_infinite", "edges that stay sharp are part of Chaikin's means", "positions"},
        {"chaikin_takes_half", "Chaikin's weights 1/2 and 1/2 for 3/4 and 1/4", "positions"},
        {"chaikin_by_maximum", "Chaikin's mean is the largest of the other sharpnesses", "positions"},
        {"chaikin_by_sum", "Chaikin's mean is the sum of the other sharpnesses", "positions"},
        // Tags.
        {"first_tag_only", "only the first sharp edge is looked at", "positions"},
        {"tags_by_direction", "an edge given as (a, b) is not found from the face that has it as (b, a)",
         "crease-order"},
        {"tags_lost_at_corner_0", "an edge from the last corner of its face to the first loses its tag",
         "corner-rotation"},
        {"tags_of_the_lower_end", "a half of an edge has its tag only at the lower end", "vertex-order"},
        {"tags_for_one_step", "the halves of a sharp edge are smooth", "positions"},
        {"tags_by_count", "a mesh of as many vertices and faces has the tags of the one before", "state"},
        {"tags_refused", "declares sharp edges, and calls a mesh that has some invalid", "tessellates"},
        {"tags_not_supported", "declares sharp edges, and does not support them", "tessellates"},
        {"kinds_of_64", "declares a kind of sharp edge that there is not", "tessellates"},
        // Limits.
        {"dart_limit_smooth", "the limit of a dart by the smooth mask", "positions"},
        {"dart_normal_smooth", "the normal of a dart by the smooth masks", "normals"},
        {"corner_limit_moved", "the limit mask of a crease at vertices that are held", "positions"},
        {"normal_of_the_other_side", "sides of a crease have each other's normal", "normals"},
        {"one_normal_for_all_sides", "all sides of a crease have the normal of the first", "normals"},
        {"mean_of_all_sides", "all sides of a crease have the mean of their normals", "normals"},
        {"sides_apart_by_an_ulp", "one ulp between the two sides of a crease", "shared-positions"},
    };
    for (Mutation& m : all) m.sharp = true;
    return all;
  }();
  return list;
}

std::int32_t declared_kinds(std::string_view mutation) {
  if (mutation == "kinds_of_64") return 64;
  return LC_SHARP_CREASES | LC_SHARP_SEMI | LC_SHARP_CHAIKIN | LC_SHARP_CORNERS;
}

void refuse_tags(std::string_view mutation, const data::Sharpness& sharpness) {
  if (sharpness.empty()) return;
  if (mutation == "tags_refused") throw SubjectError(LC_INVALID_INPUT, "the mesh has sharp edges");
  if (mutation == "tags_not_supported") throw SubjectError(LC_NOT_SUPPORTED, "sharp edges are not supported");
}

}  // namespace limitcheck::verify
