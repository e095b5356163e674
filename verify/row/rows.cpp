// SPDX-License-Identifier: MIT
#include "verify/row/rows.h"

#include <algorithm>

namespace limitcheck::verify {

std::string_view word(CauseKind kind) {
  constexpr std::string_view kWords[] = {"breakdown", "refuses", "unwritten", "not-finite", "surface",
                                         "tiling",    "seams",   "order",     "accepts",    "other"};
  return kWords[static_cast<std::size_t>(kind)];
}

const std::vector<RowKind>& row_kinds() {
  using enum CauseKind;
  constexpr std::string_view kTwice =
      "Twice what one result may be off from the exact one: sqrt(3) 8 (depth + 2) u M of the diagonal in "
      "position (u unit roundoff, M largest coordinate; at least 1e-14), in the normal 1e-3 rad in float and "
      "1e-9 rad in double, doubling with each level beyond 5. `worst` is in these bounds, so the limit is 1.";
  constexpr std::string_view kRelation = "verify/relations/relations.h; needs no exact surface";
  constexpr std::string_view kOracle = "verify/checks/check_oracle.h; needs no other truth";
  constexpr std::string_view kNone = "None wrong.";
  constexpr std::string_view kFile =
      "verify/files, verify/projection: Newton's iteration on Stam's evaluator";
  static const std::vector<RowKind> all{
      {"tessellates", "delivers", kRefuses, "The subject takes a valid control mesh and delivers.",
       "It must, unless its capabilities exclude what was asked. What they say must mean something.",
       "verify/subject/subject.h"},
      {"written", "delivers", kUnwritten,
       "The arrays lie in the host's memory, are as long as announced, overlap nowhere, were filled to the "
       "last byte and not beyond; indices are in range; the control mesh was left alone.",
       kNone, "guard zones and 0xFF fill of the host (verify/host/host.h)"},
      {"finite", "finite", kNotFinite,
       "No position or normal is NaN or infinite. Such points are left out of every other row, which says "
       "so.",
       kNone, "IEEE 754"},
      {"positions", "positions", kSurface,
       "Distance of each vertex from the exact limit point that its provenance names.",
       "sqrt(3) 8 (depth + 2) u M, in bounding-box diagonals; at least 1e-14 in double. At a vertex whose "
       "mask adds n > 33 points, n + 1 in place of 8.",
       "each of depth + 2 steps is a convex combination that adds a few roundings (verify/row/bounds.h); "
       "truth: Stam's evaluator in double, itself held against 50 digits"},
      {"refined-positions", "positions", kSurface,
       "For subjects that deliver no limit points: distance from the vertex of the refined control mesh.",
       "As for positions.", "verify/row/bounds.h; truth: the textbook refinement in double"},
      {"recognised", "positions", kOther,
       "Only where most points are something else than was expected, as refined control points in place of "
       "limit points: which points are not that.",
       "That of positions.", "verify/recognise; the reference refines and moves to the limit in double"},
      {"normals", "normals", kSurface,
       "Angle between each normal and the exact one, where the surface has one. A finding is confirmed in "
       "certified arithmetic.",
       "1e-3 rad in float, 1e-9 rad in double; doubling with each level beyond 5. More where the tangents "
       "t1, t2 are so short or so nearly parallel that rounding alone turns the normal farther, by asin(5 u "
       "M (|t1| + |t2|) / |t1 x t2|): the row says at how many points.",
       "differences of points 2^-depth apart lose a bit with each level; measured on float engines "
       "(verify/row/bounds.h)"},
      {"normal-length", "normals", kOther, "Distance of the normals' length from 1.", "8 unit roundoffs.",
       "rounding of three components, a root and a division"},
      {"normals-against-positions", "normals", kOther,
       "Whether each normal fits the delivered facets round it as well as the exact normal fits the exact "
       "facets.",
       "That of normals, and the turn that the bound s of the positions can give the facets: 4 s times the "
       "sum of their sides over the length of the sum of their area vectors.",
       "differences of the delivered positions against the same differences of the exact ones"},
      {"orientation", "tiling", kTiling,
       "Triangles run counter-clockwise on their control face and face as the exact facet does.", kNone,
       "signed areas in exact lattice coordinates; exact facets"},
      {"coverage", "tiling", kTiling,
       "Each control face is tiled exactly once, by any triangles whose corners are lattice points, and "
       "every lattice point of its depth is a corner. Culled faces are not there. Where points may lie "
       "anywhere, the corners are at any fractions.",
       kNone, "integer arithmetic on the lattice of the control face"},
      {"shared-positions", "seams", kSeams,
       "A point on a control edge or vertex that is delivered more than once has the same bits each time.",
       "No bit.", "watertight display needs it: renderers do not weld"},
      {"shared-normals", "seams", kSeams, "The same of normals.", "No bit.", "otherwise shading shows seams"},
      {"continuity", "seams", kSeams,
       "What the faces at a control edge or vertex deliver there differs by no more than two results' "
       "errors.",
       kTwice, "the surface is continuous, and so is its tangent plane"},
      {"watertight", "seams", kSeams,
       "Merging vertices of one lattice point whose positions are equal, and nothing else, the triangles "
       "form a manifold whose boundary is that of the control mesh, with as many loops. What is apart in the "
       "control mesh stays apart, also where it lies in one place: seams, parts that touch, triangles "
       "without area.",
       kNone, "counted twice, by our own code and by CGAL"},
      {"t-vertices", "tiling", kSeams, "No vertex lies inside an edge of another triangle.", kNone,
       "exact predicates on the delivered coordinates"},
      {"determinism", "order", kOrder,
       "The same request again, with 1, 2 and 4 threads, gives the same bits, and so does one of up to 8192 "
       "triangles with 1 and 4.",
       "No bit.", kRelation},
      {"face-order", "order", kOrder, "Faces handed over in another order.", kTwice, kRelation},
      {"vertex-order", "order", kOrder, "Control vertices numbered otherwise.", kTwice, kRelation},
      {"corner-rotation", "order", kOrder,
       "Some faces, drawn at random, begin at another corner. What faces share has equal bits then, too, if "
       "it had before: a mesh written evenly hides sums whose order depends on the face that asks.",
       kTwice, kRelation},
      {"mirror", "order", kOrder, "The mirror image gives the mirror image.", kTwice, kRelation},
      {"rotation", "order", kOrder, "Axes exchanged with signs, an exact rotation.", kTwice, kRelation},
      {"scaling", "tiny,huge", kOrder,
       "Sizes times 2^10, 2^-10, 2^40 and 2^-40, which rounds nothing; at the last two squares overflow or "
       "vanish in float.",
       kTwice, kRelation},
      {"translation", "order", kOrder,
       "The mesh moved by a few diagonals, and by 2^20 times as many, in float 2^10. Positions only: "
       "rounding the input turns normals.",
       "As for the others, with the larger coordinates.", kRelation},
      {"crease-order", "order", kOrder,
       "Sharp edges and vertices handed over in another order, edges from their other end.", kTwice,
       kRelation},
      {"infinite-sharpness", "order", kOrder,
       "A sharpness of 10 and more is infinite: 10 and 100 are the same.", kTwice, kRelation},
      {"boundary-crease", "order", kOrder, "The boundary is sharp: a tag there that says so changes nothing.",
       kTwice, kRelation},
      {"cut-by-hand", "order", kOrder,
       "An edge that stays sharp is a boundary of both of its sides: the mesh cut there is the same surface.",
       kTwice, kRelation},
      {"fractional-sharpness", "order", kOrder,
       "One sharpness for all semi-sharp edges and vertices: with 2.3, 0.7 of the surface with 2 and 0.3 of "
       "that with 3; likewise with 1/1024 and the numbers next below and above 1 and 2. From 9 to the number "
       "next below 10, and from that to 10, no more than four times what there is between 8 and 9.",
       kTwice, kRelation},
      {"state", "order", kOrder,
       "Asked eight times, between other meshes and other depths, made again, beside another mesh of as many "
       "vertices, with 8 threads: the bits of a process that was asked for nothing else.",
       "No bit.", "verify/host/in_turns.h; a program is given each mesh in a process of its own"},
      {"degenerate-geometry", "degenerate", kNotFinite,
       "All control points on a line, or all the same: positions finite, normals finite and of unit length.",
       kNone, "the surface has no normal there, a renderer needs one all the same"},
      {"rejected-inputs", "bad input", kAccepts,
       "An edge with three faces, faces of opposite orientation, fans that meet in a vertex, faces without "
       "vertices, a vertex that does not exist, a coordinate that is no number, and, of a subject that "
       "declares sharp edges and vertices, tags of none and sharpness that is no number or below 0: refused "
       "with a message. A subject that says that it does not validate is not asked.",
       "None accepted.", "the scheme is defined on oriented manifolds only"},

      // Of the subject `oracle`, in place of all others.
      {"oracle-faces", "", kOrder,
       "A point of a vertex or edge, asked from each of its faces: the certified balls of its position meet, "
       "and on one side of edges that stay sharp those of normal and Gaussian curvature.",
       "They meet: `worst` is the distance of the centres over the sum of the radii.", kOracle},
      {"oracle-double", "", kOrder,
       "Position and first derivatives in double against the certificate; both know of the same derivatives.",
       "What rounding may do: (steps + 2) (2 n + 8) u M, n faces at a vertex or corners of a face.", kOracle},
      {"oracle-parts", "", kOrder,
       "A certificate against that of the few faces which it depends on, and against the whole mesh, uncut, "
       "in 50 decimals.",
       "They meet.", kOracle},

      // Of meshes with channels.
      {"channel-positions", "channels", kOther,
       "At each corner of each triangle the values of the mesh's face-varying channels, on the side of a "
       "seam on which the triangle lies.",
       "As of positions, with the size of the channel.",
       "Stam's evaluator in double on the mesh that is cut along the seams"},
      {"channel-derivatives", "channels", kOther,
       "Only where the subject delivers them: the derivatives of channels by the parameters of the control "
       "face, at each corner of each triangle on its side of a seam, where the limit has any.",
       "2^(steps + 2) times that of channel-positions.",
       "a difference of points 2^-steps apart (verify/row/bounds.h); as for channel-positions, and "
       "certified"},
      {"channel-shared", "channels", kOther,
       "A point on one side of a seam has the same bits in all triangles that have it.", kNone,
       "the bytes delivered"},

      // Of finished tessellations (--tessellation).
      {"file-finite", "finite", kNotFinite,
       "No position, normal or texture coordinate in the file is NaN or infinite.", kNone, "IEEE 754"},
      {"file-unused", "delivers", kOther,
       "Vertices that no face names: a warning. Only whether they are finite is looked at.", kNone,
       "the faces of the file"},
      {"file-distance", "positions", kSurface,
       "Distance of each vertex from the closest point of the exact limit surface.",
       "--tolerance, in diagonals of the control mesh.", kFile},
      {"file-positions", "positions", kSurface,
       "With --provenance: distance of each vertex from the exact point that its row names.",
       "--tolerance, in diagonals of the control mesh.", "verify/files; truth: Stam's evaluator in double"},
      {"file-recognised", "positions", kOther,
       "Only where most vertices are something else than points of the limit surface, as those of the "
       "refined control mesh: which are not that.",
       "As of positions, in float or double as the coordinates say, and half of their last digit.",
       "the nearest of the points that the reference makes by the rule that was recognised"},
      {"file-normals", "normals", kSurface,
       "Angle between each normal of the file and the surface's at the closest point.",
       "1e-3 rad, as of a float engine at depth 5.", kFile},
      {"file-normal-length", "normals", kOther, "Distance of the length of the file's normals from 1.",
       "1e-3: the vector is then no farther from the exact one than a direction that is off by the bound of "
       "file-normals.",
       "shading scales with the length; four decimals round to 9e-5"},
      {"file-channel", "channels", kOther,
       "Only where the control mesh has texture coordinates: those of the file against the exact channel, at "
       "each corner of a triangle on the side of the seam where the triangle lies. Rule: --channel-rule, "
       "else as the control mesh says, else corners-plus1.",
       "--tolerance, in diagonals of the channel, and what the channel changes within the tolerance of a "
       "position.",
       kFile},
      {"file-orientation", "tiling", kTiling,
       "Triangles face outwards, and run counter-clockwise on their control face.", kNone, kFile},
      {"file-coverage", "tiling", kTiling,
       "The triangles over each control face have its area: nothing is missing, nothing is there twice.",
       "1e-4 of a face, or of a quad at its corner if the control mesh has other polygons; 1e-2 of all where "
       "triangles cross their borders.",
       "areas in the domain of the control faces, from the closest points of the corners"},
      {"file-degenerate", "tiling", kOther,
       "Triangles without area that the control mesh does not cause. Triangles that name a vertex twice, as "
       "joints of strips do, are a warning.",
       "No area: lower than four roundings of the coordinates in double. The control mesh causes it where "
       "the exact surface, at the file's resolution, is thinner than the tolerance.",
       "the positions in the file; Stam's evaluator"},
      {"file-watertight", "seams", kSeams,
       "Merging equal positions, every edge inside has two triangles, and the boundary is that of the "
       "control mesh: of its limit surface, or refined a number of times.",
       kNone, "counted by our own code and by CGAL"},
      {"file-hausdorff", "deviation", kOther,
       "The larger of the distances from the triangles to the surface and from the surface to the triangles.",
       "--max-deviation; without it, what one triangle for each control face would have, of Catmull-Clark's "
       "scheme one polygon, and the tolerance. Quads of the file are two triangles each.",
       "bracketed: exact distances below, proved bounds above (verify/files/checks/hausdorff.h)"},
  };
  return all;
}

const RowKind* row_kind(std::string_view check) {
  const auto& all = row_kinds();
  const auto found = std::ranges::find_if(all, [&](const RowKind& k) { return k.check == check; });
  return found == all.end() ? nullptr : &*found;
}

std::string_view words_of_tables() {
  return "held           looked at, nothing wrong\n"
         "FINDING        looked at, something wrong\n"
         "warning        within the bound, but not as good as it could be: worth a look, no fault\n"
         "waived         a finding that --waivers accepts; STALE WAIVER: it expects one and there is none\n"
         "not supported  the subject does not offer it: no fault\n"
         "not run        could not be looked at: nothing is confirmed\n"
         "-              nothing to count or to measure, or nothing was looked at\n"
         "bad/looked at  points, triangles or whatever the unit says, over all meshes\n"
         "worst, bound   of the worst mesh; 99 %: what 99 of 100 there do not exceed\n"
         "diagonal       of the bounding box of the control mesh\n";
}

std::string_view current_name(std::string_view check) {
  return check == "extreme-scale" ? "scaling" : check;
}

}  // namespace limitcheck::verify
