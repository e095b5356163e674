// SPDX-License-Identifier: MIT
// Wavefront OBJ: `v`, `f`, and what may be read over.
#include <fmt/core.h>

#include <algorithm>
#include <limits>

#include "data/error.h"
#include "data/io/polygon_soup.h"
#include "data/io/text_scanner.h"
#include "data/validate.h"

namespace limitcheck::data::io {
namespace {

constexpr std::string_view kReadOver[] = {"vt",        "g",      "o",        "s",        "mg",  "usemtl",
                                          "mtllib",    "usemap", "maplib",   "bevel",    "lod", "shadow_obj",
                                          "trace_obj", "p",      "c_interp", "d_interp", "l"};
constexpr std::string_view kFreeForm[] = {"vp",   "cstype", "deg",   "bmat", "step", "curv", "curv2",
                                          "surf", "parm",   "trim",  "hole", "scrv", "sp",   "end",
                                          "con",  "ctech",  "stech", "call", "fo"};

template <class List>
bool contains(const List& list, std::string_view word) {
  return std::find(std::begin(list), std::end(list), word) != std::end(list);
}

class ObjReader {
 public:
  ObjReader(std::string_view content, const std::string& name) : scanner_(content, name, '#', true) {}

  PolygonSoup read() {
    soup_.first = 1;
    while (scanner_.next_line()) {
      const std::string_view keyword = scanner_.word();
      if (keyword == "v") {
        read_vertex();
      } else if (keyword == "vn") {
        read_normal();
      } else if (keyword == "f") {
        read_face();
      } else if (contains(kFreeForm, keyword)) {
        scanner_.fail("FILE_UNSUPPORTED", fmt::format("free-form geometry is not read: {}", quoted(keyword)));
      } else if (!contains(kReadOver, keyword)) {
        scanner_.syntax_error(fmt::format("unknown keyword {}", quoted(keyword)));
      }
    }
    return std::move(soup_);
  }

 private:
  // x y z, then nothing, a weight (which polygons do not use), a colour, or both.
  void read_vertex() {
    const double x = scanner_.number("x"), y = scanner_.number("y"), z = scanner_.number("z");
    for (int more = 0;; ++more) {
      const std::string_view word = scanner_.word();
      if (word.empty()) break;
      if (more == 4 || !to_double(word)) scanner_.syntax_error(fmt::format("unexpected {}", quoted(word)));
    }
    soup_.positions.push_back({x, y, z});
    soup_.position_lines.push_back(scanner_.line());
  }

  // For those who ask; whatever is no number is no reason to refuse the file.
  void read_normal() {
    std::array<double, 3> normal{};
    for (double& x : normal) {
      x = to_double(scanner_.word()).value_or(std::numeric_limits<double>::quiet_NaN());
    }
    soup_.normals.push_back(normal);
  }

  // Three or more of v, v/vt, v//vn, v/vt/vn; indices from 1, or from the latest backwards if negative.
  void read_face() {
    for (std::string_view word = scanner_.word(); !word.empty(); word = scanner_.word()) {
      soup_.corners.push_back(vertex_of(word));
    }
    soup_.close_polygon(scanner_.line());
  }

  std::int64_t vertex_of(std::string_view word) {
    std::string_view parts = word;
    std::int64_t index = 0, normal = -1;
    for (int part = 0;; ++part) {
      const std::size_t slash = parts.find('/');
      const std::string_view text = parts.substr(0, slash);
      const auto value = to_integer(text);
      const bool may_be_absent = part == 1 && slash != std::string_view::npos;
      if (part > 2 || (!value && !(text.empty() && may_be_absent))) {
        scanner_.syntax_error(fmt::format("a corner is v, v/vt, v//vn or v/vt/vn, not {}", quoted(word)));
      }
      if (part == 0) index = *value;
      if (part == 2)
        normal = *value > 0 ? *value - 1 : static_cast<std::int64_t>(soup_.normals.size()) + *value;
      if (slash == std::string_view::npos) break;
      parts.remove_prefix(slash + 1);
    }
    soup_.corner_normals.push_back(normal);
    const auto latest = static_cast<std::int64_t>(soup_.positions.size());
    if (index == 0 || index < -latest) {
      scanner_.fail(std::string(code(MeshFault::kIndexOutOfRange)),
                    fmt::format("index {} where {} vertices precede; indices start at 1, or at -1 backwards",
                                index, latest));
    }
    return index > 0 ? index - 1 : latest + index;
  }

  TextScanner scanner_;
  PolygonSoup soup_;
};

}  // namespace

PolygonSoup read_obj(std::string_view content, const std::string& name) {
  return ObjReader(content, name).read();
}

}  // namespace limitcheck::data::io
