// SPDX-License-Identifier: MIT
// The faults that the quad model can be told to have, each of a kind that a real tessellator could have.
#include "verify/mutants/quad_models/quad_kernel_model.h"
#include "verify/mutants/quad_models/quad_model_rules.h"

namespace limitcheck::verify {

std::span<const Mutation> quad_mutations() {
  static const std::vector<Mutation> own{
      {"none", "nothing: right in every check", ""},
      // Subdivision.
      {"face_weight_1e-6", "face points lean by 1e-6 to the first corner", "positions"},
      {"polygons_as_quads", "the face point of any face is the mean of its first four corners", "positions"},
      {"centroid_by_area", "face points are centroids by area", "positions"},
      {"six_corners_at_most", "a face point counts six corners and no more", "positions"},
      {"edge_points_without_ends", "edge points are the means of two face points", "positions"},
      {"midpoints", "edge points half and half", "positions"},
      {"smooth_triangles", "OpenSubdiv's weights beside triangles, in the first step", "positions"},
      {"ends_for_midpoints", "the vertex rule takes edge points in place of the neighbours", "positions"},
      {"weights_of_valence_4", "the vertex rule of valence 4 at every valence", "positions"},
      {"weights_of_valence_8", "a table of weights that ends at valence 8", "positions"},
      {"weight_1e-6_at_valence_5", "a vertex of valence 5 is moved by 1e-6 of its step too far", "positions"},
      {"vertices_stay", "vertices are not moved by a step", "positions"},
      {"one_step_missing", "one step less than asked for at the vertices", "positions"},
      // Boundary.
      {"boundary_two_thirds", "boundary vertices 1/6, 2/3, 1/6: the limit mask taken for the rule",
       "positions"},
      {"boundary_vertices_stay", "boundary vertices stay where they are", "positions"},
      {"boundary_as_inside", "boundary vertices by the rule of those inside", "positions"},
      {"corners_stay", "boundary vertices of one face stay where they are", "positions"},
      {"boundary_edge_flap", "boundary edge points take an eighth of the face point", "positions"},
      {"boundary_limit_3_5", "boundary limits 1/5, 3/5, 1/5", "positions"},
      {"boundary_tangent_trap", "the tangent mask of another boundary rule from three faces on", "normals"},
      {"boundary_tangent_mean", "across the boundary: towards the mean of the neighbours", "normals"},
      // Limit.
      {"no_limit", "points of the refined mesh instead of the limit", "positions"},
      {"limit_of_valence_4", "the limit mask of valence 4 at every valence", "positions"},
      {"limit_at_valence_3", "at valence 3 the limit is the mean of the faces around", "positions"},
      {"limit_weights_1e-5", "all limit weights are 1e-5 off", "positions"},
      {"tangents_of_valence_4", "tangents take f_i with the weight of valence 4", "normals"},
      {"tangents_without_faces", "tangents of the neighbours alone", "normals"},
      {"mean_of_facets", "normals are means of the facets around", "normals"},
      {"flipped_on_polygons", "normals inside faces that are no quads point inward", "normals"},
      // Places.
      {"quarter_turn", "the inside of a quad leans by 1e-9 to its first corner", "corner-rotation"},
      {"lower_corner", "face points lean by 1e-9 to the corner with the lowest number", "vertex-order"},
      {"next_corner", "points of the quad at a corner are said to be of the next corner's", "positions"},
      {"u_for_v", "u and v are exchanged", "orientation"},
      {"one_level_more_in_polygons", "faces that are no quads are one level finer than asked for",
       "coverage"},
      {"middle_left_out", "faces that are no quads have a hole in the middle", "coverage"},
      {"corner_is_null", "the corner of no point is delivered", "positions"},
      {"clockwise_polygons", "triangles of faces that are no quads run clockwise", "orientation"},
      // Frames.
      {"unstitched", "faces beside deeper ones are not stitched to them", "watertight"},
      {"stitched_on_side_0", "faces are stitched to deeper ones on their first side only", "t-vertices"},
      {"ulp_on_polygons", "points of faces that are no quads are one ulp off", "shared-positions"},
      {"culled_are_holes", "culled faces are left out before the first step", "positions"},
      {"cache_by_count", "a mesh of as many vertices and faces is taken for the one before", "state"},
      {"every_other_time", "every other frame has a point one ulp off", "determinism"},
      // Sharp edges: what only polygons or meshes of quads bring out.
      {"infinite_is_9", "edges that stay sharp are sharp for 9 steps", "cut-by-hand", "", false, true},
      {"sharpness_in_halves", "a sharpness is rounded to halves", "fractional-sharpness", "", false, true},
      {"triangles_not_smooth", "the smooth rule for triangles is ignored", "positions", "", false, true},
      {"smooth_rule_for_all", "the smooth rule for triangles in all faces", "positions", "", false, true},
      {"smooth_rule_in_every_step", "the smooth rule for triangles in later steps, too", "positions", "",
       false, true},
  };
  static const std::vector<Mutation> list = [] {
    std::vector<Mutation> all = own;
    all.insert(all.end(), quad_kernel_mutations().begin(), quad_kernel_mutations().end());
    all.insert(all.end(), sharp_mutations().begin(), sharp_mutations().end());
    return all;
  }();
  return list;
}

}  // namespace limitcheck::verify
