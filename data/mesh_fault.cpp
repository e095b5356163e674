// SPDX-License-Identifier: MIT
// The stable names of what can be wrong with a mesh.
#include "data/validate.h"

namespace limitcheck::data {

std::string_view code(MeshFault fault) {
  switch (fault) {
    case MeshFault::kEmpty:
      return "MESH_EMPTY";
    case MeshFault::kTooLarge:
      return "MESH_TOO_LARGE";
    case MeshFault::kIndexOutOfRange:
      return "MESH_INDEX_OUT_OF_RANGE";
    case MeshFault::kNotFinite:
      return "MESH_NOT_FINITE";
    case MeshFault::kDegenerateFace:
      return "MESH_DEGENERATE_FACE";
    case MeshFault::kDuplicateFace:
      return "MESH_DUPLICATE_FACE";
    case MeshFault::kNonmanifoldEdge:
      return "MESH_NONMANIFOLD_EDGE";
    case MeshFault::kOrientationClash:
      return "MESH_ORIENTATION_CLASH";
    case MeshFault::kBowtieVertex:
      return "MESH_BOWTIE_VERTEX";
    case MeshFault::kLowValence:
      return "MESH_LOW_VALENCE";
    case MeshFault::kPolygon:
      return "MESH_POLYGON";
    case MeshFault::kIsolatedVertex:
      return "MESH_ISOLATED_VERTEX";
    case MeshFault::kSharpness:
      return "MESH_SHARPNESS";
    case MeshFault::kHole:
      return "MESH_HOLE";
  }
  return "MESH_UNKNOWN";
}

}  // namespace limitcheck::data
