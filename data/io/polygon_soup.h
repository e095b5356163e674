// SPDX-License-Identifier: MIT
// Vertices and polygons as a file has them, each with its line: the result of every reader.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "data/control_mesh.h"
#include "data/io/read.h"

namespace limitcheck::data::io {

struct PolygonSoup {
  std::vector<std::array<double, 3>> positions;
  std::vector<std::int64_t> corners;         // of all polygons, one after another, from 0, unchecked
  std::vector<std::size_t> polygon_end;      // where each polygon ends in `corners`
  std::vector<std::int64_t> position_lines;  // empty in formats without lines
  std::vector<std::int64_t> polygon_lines;
  std::int64_t first = 0;  // the number that the format gives to its first vertex: 1 in OBJ
  // Normals as the file has them, for those who ask (PLY, OBJ); any length, unchecked.
  std::vector<std::array<double, 3>> normals;
  // OBJ: for each corner the index of its normal, -1 for none. Empty: normals[i] is that of position i.
  std::vector<std::int64_t> corner_normals;

  // Face-varying values, and for each corner the index of its own, -1 for none; unchecked. Where `by_value`, two corners at
  // one vertex have the same value if it has the same numbers, whatever their indices are.
  struct SoupChannel {
    std::string name;
    int components = 2;
    std::vector<double> values = {};
    std::vector<std::int64_t> corners = {};
    std::optional<ChannelRule> rule = {};
    bool by_value = false;
  };
  std::vector<SoupChannel> channels;

  // Sharp edges, and sharp vertices (b is -1); boundary, creasing and rule for triangles are in `choices`.
  struct SharpTag {
    std::int64_t a, b;
    double sharpness;
    std::int64_t line;
  };
  std::vector<SharpTag> sharp;
  Sharpness choices;
  std::optional<Scheme> scheme;  // that the file says it is meant for
  // Polygons that are not shown.
  struct Hole {
    std::int64_t polygon, line;
  };
  std::vector<Hole> holes;
  // Nor are faces at a boundary vertex one of whose boundary edges is not sharp for good by a tag: what
  // OpenSubdiv (VTX_BOUNDARY_NONE) and USD (interpolateBoundary = none) do.
  bool hides_boundary = false;
  std::vector<std::string> notes;  // what was read over and nobody would expect, a sentence each

  void close_polygon(std::int64_t line = 0) {
    polygon_end.push_back(corners.size());
    if (line > 0) polygon_lines.push_back(line);
  }
};

PolygonSoup read_obj(std::string_view content, const std::string& name);
PolygonSoup read_off(std::string_view content, const std::string& name);
PolygonSoup read_ply(std::string_view content, const std::string& name);
PolygonSoup read_stl(std::string_view content, const std::string& name);
PolygonSoup read_usda(std::string_view content, const std::string& name);

/// A file as it is, with nothing checked but its syntax. The extension says the format. Throws InputError
/// with a FILE_ code.
PolygonSoup read_soup(const std::filesystem::path& file);

/// Makes one vertex of those at equal positions (-0 is 0), in the order in which they come. Normals stay as they are.
void join_equal_positions(PolygonSoup& soup);

/// One thing that is wrong with the mesh of a file.
struct SoupFault {
  std::string code;     // as in data/validate.h
  std::int64_t line;    // 0 where the format has no lines
  std::string message;  // numbers its elements as the format does
  std::int64_t vertex;  // from 0, if the fault is that of one vertex; else -1
};

/// The mesh of a file, and everything that is wrong with it.
struct Examination {
  ControlMesh mesh;           // without the polygons that are at fault by themselves
  std::int64_t cut = 0;       // so many polygons became triangles
  std::int64_t left_out = 0;  // so many vertices that no face names, if the options say so
  // What the mesh was validated for: as asked; else as the file says; else as data/scheme.h chooses, by all polygons.
  Scheme scheme = Scheme::kLoop;
  std::vector<SoupFault> faults;   // polygons in file order, then as data/validate.h orders them
  std::vector<std::string> notes;  // what was read otherwise than one may expect, a sentence each
};

/// A vertex that no face names: it shapes nothing, and can be left out.
bool is_unused(const SoupFault& fault);

/// Its tags as a mesh has them; -1 for a vertex that 32 bits do not name.
Sharpness sharpness_of(const PolygonSoup& soup);

/// Finds all faults. Where a polygon is left out, its vertices may fall into two fans or have no faces: that
/// is no fault of its own.
Examination examine(const PolygonSoup& soup, const ReadOptions& options);

/// The same for a mesh without faults; unused vertices are left out if the options say so.
/// Throws InputError: the first fault that `examine` finds.
Examination require_valid(const PolygonSoup& soup, const std::string& name, const ReadOptions& options);

}  // namespace limitcheck::data::io
