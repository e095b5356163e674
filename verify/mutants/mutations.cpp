// SPDX-License-Identifier: MIT
// The faults of rules that the model can be told to have, each of a kind that a real tessellator could have.
#include <vector>

#include "verify/mutants/mutant_rules.h"

namespace limitcheck::verify {
namespace {

using Rows = std::vector<Mutation>;

Rows loop() {
  constexpr const char* kP = "positions";
  return {
      // Subdivision.
      {"warren_weights", "a(n) = 3/8 for n > 3, as Warren has it", kP},
      {"warren_declared", "declares Warren's weights and has Loop's", kP},
      {"warren_limit_of_loop", "Warren's weights, declared, but the limit mask of Loop's", kP},
      {"weight_1e-6_at_valence_5", "a(5) is 1e-6 too large, and nothing else", kP},
      {"square_forgotten", "a(n) = 5/8 - (3 + 2 cos)/64", kP},
      {"half_angle", "a(n) with cos(pi/n)", kP},
      {"valence_one_less", "a(n - 1) at valence n > 3", kP},
      {"vertices_stay", "control vertices are not moved by a step", kP},
      {"ring_off_by_one", "the last neighbour is left out, the first counted twice", kP},
      {"midpoints", "edge points half and half", kP},
      {"edge_weight_1e-6", "edge weights 3/8 + 1e-6 and 3/8 - 1e-6", kP},
      {"one_flap", "edge points 3/8, 3/8, 1/4, 0", kP},
      {"indices_modulo_n", "indices taken modulo n: v_n is the centre", kP, "C13"},
      {"one_step_missing", "one step less than asked for at the vertices", kP},
      {"lower_end", "edge points lean by 1e-9 to the end with the lower number", "vertex-order"},
      {"left_flap", "edge points lean by 1e-9 to the left of the face that came first", "face-order"},
      // Valences.
      {"weights_of_16", "a(n) from a table that ends at n = 16: beyond it, its last entry", kP},
      {"weights_of_32", "the same, ending at 32", kP},
      {"weights_below_64", "a table of 64 entries whose last is never filled", kP},
      {"weight_at_infinity", "a(n) = 15/64, its limit, from valence 20 on", kP},
      {"valence_in_8_bits", "a valence of 256 is 0 in 8 bits: the vertex stays", kP},
      {"valence_3_pairs", "a vertex of valence 3 counts neighbours of valence 3 twice", kP},
      // Depths.
      {"midpoints_at_depth_1", "depth 1, done by a shortcut, has edge points half and half", kP, "", true},
      {"odd_depths", "at odd depths vertices are those of the step before: the wrong one of two buffers", kP,
       "", true},
      {"no_limit_at_depth_0", "depth 0 is the control mesh itself", kP, "", true},
      {"no_limit_from_depth_5", "from depth 5 on refined points are taken for limit points", kP, "", true},
      {"rows_of_7_bits", "places in a row of 128 steps counted in 7 bits: the last point is the first", kP,
       "", true},
      // Boundary.
      {"boundary_edge_flap", "boundary edge points 3/8, 3/8, 1/4", kP},
      {"boundary_vertex_5_8", "boundary vertices 3/16, 5/8, 3/16", kP},
      {"boundary_limit_hoppe", "boundary limit (3 v + ends) / 5", kP},
      {"biermann_edges", "Biermann's rule on edges at irregular boundary vertices", kP},
      {"boundary_tangent_trap", "the tangent mask of another boundary rule from four faces on", "normals"},
      {"boundary_tangent_mean", "across the boundary: towards the mean of the neighbours", "normals"},
      // Limit.
      {"no_limit", "points of the refined mesh instead of the limit", kP},
      {"limit_weight_at_valence_3", "the limit weight at valence 3 is 10 % off", kP, "", true},
      {"limit_weights_1e-4", "all limit weights are 1e-4 off", kP, "", true},
      {"corners_stay", "boundary vertices of one face stay where they are", kP},
      {"limits_in_float", "limit points summed in float, in the order in which the faces came", "face-order"},
      {"limits_smoothed", "one step of smoothing, of weight 1e-3, over the limit points", kP, "", true},
      {"limit_mask_of_six", "the limit mask of valence 6 at all valences", kP},
      {"limit_weight_misread", "limit weight (3n/8) a(n) instead of 3n/(8 a(n))", kP, "C14"},
      {"divided_tangents", "tangents divided by the sums of their weights, as printed", "normals", "C16"},
      {"affine_tangents", "tangents taken as affine combinations: points, not directions", "normals", "C15"},
      {"tangents_exchanged", "second tangent x first: normals point inside", "normals", "C17"},
      {"sines_of_n_plus_1", "tangent masks with n + 1 in place of n", "normals"},
      {"mean_facet_normals", "mean normals of the refined facets instead of limit normals", "normals"},
      {"first_facet_normal", "the normal of one facet at the vertex", "normals-against-positions"},
      {"quick_root", "1 / sqrt by the bits of a float and one step of Newton's", "normal-length", "", true},
      {"fixed_epsilon", "tangents whose cross product is below 1e-15 count as none", "scaling"},
      {"epsilon_of_coordinates",
       "tangents below 1e-4 of their point's distance from the origin count as none", "normals"},
      {"thin_is_none", "tangents at less than 1e-3 rad count as none", "normals"},
      {"squares_underflow", "squared lengths of tangents in float: zero counts as none", "normals"},
      {"squares_overflow", "squared lengths of tangents in float: infinite counts as none", "normals"},
      {"zero_where_tangents_vanish", "the zero vector where the tangents vanish", "degenerate-geometry"},
      {"nan_where_tangents_vanish", "no substitute where the tangents vanish", "degenerate-geometry"},
      {"float_squares", "squared lengths of normals in float: overflow far from size 1", "scaling"},
      // Frames.
      {"no_repair", "faces of different depths meet without repair", "t-vertices", "C56"},
      {"fan_needs_two", "fans only where two or more neighbours are deeper", "t-vertices", "C57"},
      {"exchanged_depths", "fan borders take the neighbour's depth, fans among themselves too", "watertight",
       "C58"},
      {"one_inner_point", "faces beside deeper ones become fans with one point inside, whatever their depth",
       "coverage"},
      {"sums_begun_in_face", "limit points summed from the face that asks: other bits in each",
       "shared-positions"},
      {"normals_begun_in_face", "normals summed from the face that asks: other bits in each",
       "shared-normals"},
  };
}

Rows quads() {
  constexpr const char* kP = "positions";
  return {
      // Subdivision.
      {"face_weight_1e-6", "face points lean by 1e-6 to the first corner", kP},
      {"polygons_as_quads", "the face point of any face is the mean of its first four corners", kP},
      {"centroid_by_area", "face points are centroids by area", kP},
      {"six_corners_at_most", "a face point counts six corners and no more", kP},
      {"edge_points_without_ends", "edge points are the means of two face points", kP},
      {"midpoints", "edge points half and half", kP},
      {"smooth_triangles", "OpenSubdiv's weights beside triangles, in the first step", kP},
      {"ends_for_midpoints", "the vertex rule takes edge points in place of the neighbours", kP},
      {"weights_of_valence_4", "the vertex rule of valence 4 at every valence", kP},
      {"weights_of_valence_8", "a table of weights that ends at valence 8", kP},
      {"weight_1e-6_at_valence_5", "a vertex of valence 5 is moved by 1e-6 of its step too far", kP},
      {"vertices_stay", "vertices are not moved by a step", kP},
      {"one_step_missing", "one step less than asked for at the vertices", kP},
      // Boundary.
      {"boundary_two_thirds", "boundary vertices 1/6, 2/3, 1/6: the limit mask taken for the rule", kP},
      {"boundary_vertices_stay", "boundary vertices stay where they are", kP},
      {"boundary_as_inside", "boundary vertices by the rule of those inside", kP},
      {"corners_stay", "boundary vertices of one face stay where they are", kP},
      {"boundary_edge_flap", "boundary edge points take an eighth of the face point", kP},
      {"boundary_limit_3_5", "boundary limits 1/5, 3/5, 1/5", kP},
      {"boundary_tangent_trap", "the tangent mask of another boundary rule from three faces on", "normals"},
      {"boundary_tangent_mean", "across the boundary: towards the mean of the neighbours", "normals"},
      // Limit.
      {"no_limit", "points of the refined mesh instead of the limit", kP},
      {"limit_of_valence_4", "the limit mask of valence 4 at every valence", kP},
      {"limit_at_valence_3", "at valence 3 the limit is the mean of the faces around", kP},
      {"limit_weights_1e-5", "all limit weights are 1e-5 off", kP},
      {"tangents_of_valence_4", "tangents take f_i with the weight of valence 4", "normals"},
      {"tangents_without_faces", "tangents of the neighbours alone", "normals"},
      {"mean_of_facets", "normals are means of the facets around", "normals"},
      // Places and frames.
      {"quarter_turn", "the inside of a quad leans by 1e-9 to its first corner", "corner-rotation"},
      {"lower_corner", "face points lean by 1e-9 to the corner with the lowest number", "vertex-order"},
      {"unstitched", "faces beside deeper ones are not stitched to them", "watertight"},
      {"stitched_on_side_0", "faces are stitched to deeper ones on their first side only", "t-vertices"},
  };
}

}  // namespace

std::span<const Mutation> mutations(data::Scheme scheme) {
  const auto list = [](const Rows& own) {
    Rows all{{"none", "nothing: right in every check", ""}};
    all.insert(all.end(), own.begin(), own.end());
    return all;
  };
  static const Rows of_loop = list(loop()), of_quads = list(quads());
  return scheme == data::Scheme::kLoop ? of_loop : of_quads;
}

}  // namespace limitcheck::verify
