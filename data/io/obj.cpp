// SPDX-License-Identifier: MIT
// Wavefront OBJ: `v`, `vt`, `f`, and what may be read over; and OpenSubdiv's tags, which count from 0:
//   t crease 2/1/0 A B SHARPNESS         one edge; or several: 4/2/0 A B C D S T; or 4/1/0 A B C D S
//   t corner 1/1/0 V SHARPNESS           likewise
//   t interpolateboundary 1/0/0 0|1|2    1: vertices of one face are held, 2: they are not, as without it; 0:
//                                        nor are faces beside the boundary shown (PolygonSoup)
//   t creasemethod 0/0/1 normal|chaikin
//   t smoothtriangles 0/0/1 catmark|smooth
//   t hole 2/0/0 F G                     faces that are not shown
//   t facevaryinginterpolateboundary 1/0/0 0..5   the rule of the texture coordinates, as data/channel.h counts them
//   t facevaryingpropagatecorners 1/0/0 0|1       1 makes corners-plus2 of corners-plus1
// A sharpness is a decimal number or a fraction, 23/10. Hierarchical edits are refused.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <limits>
#include <utility>
#include <vector>

#include "data/error.h"
#include "data/io/polygon_soup.h"
#include "data/io/text_scanner.h"
#include "data/validate.h"

namespace limitcheck::data::io {
namespace {

constexpr std::string_view kReadOver[] = {"g",      "o",        "s",        "mg",  "usemtl",     "mtllib",
                                          "usemap", "maplib",   "bevel",    "lod", "shadow_obj", "trace_obj",
                                          "p",      "c_interp", "d_interp", "l"};
constexpr std::string_view kFreeForm[] = {"vp",   "cstype", "deg",   "bmat", "step", "curv", "curv2",
                                          "surf", "parm",   "trim",  "hole", "scrv", "sp",   "end",
                                          "con",  "ctech",  "stech", "call", "fo"};
constexpr std::string_view kEdits[] = {"vertexedit", "edgeedit", "faceedit"};

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
      } else if (keyword == "vt") {
        read_texture();
      } else if (keyword == "f") {
        read_face();
      } else if (keyword == "t") {
        read_tag();
      } else if (contains(kFreeForm, keyword)) {
        scanner_.fail("FILE_UNSUPPORTED", fmt::format("free-form geometry is not read: {}", quoted(keyword)));
      } else if (!contains(kReadOver, keyword)) {
        scanner_.syntax_error(fmt::format("unknown keyword {}", quoted(keyword)));
      }
    }
    if (propagates_corners_ && uv_.rule.value_or(kUsualChannelRule) == ChannelRule::kCornersPlus1)
      uv_.rule = ChannelRule::kCornersPlus2;
    pack_texture();
    if (std::any_of(uv_.corners.begin(), uv_.corners.end(), [](std::int64_t i) { return i != -1; }))
      soup_.channels.push_back(std::move(uv_));
    return std::move(soup_);
  }

 private:
  // x y z, then nothing, a weight (which polygons do not use), a colour, or both.
  void read_vertex() {
    const double x = scanner_.number("x"), y = scanner_.number("y"), z = scanner_.number("z");
    scanner_.pass_numbers(4);
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

  // u, or u v, or u v w; components that are not said are 0. What is no number, or one of four and more, makes the
  // coordinates unusable, not the mesh.
  void read_texture() {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> value;
    for (std::string_view word = scanner_.word(); !word.empty(); word = scanner_.word())
      value.push_back(to_double(word).value_or(kNone));
    uv_.components = std::max(uv_.components, static_cast<int>(std::min(value.size(), kTexture)));
    if (value.empty() || value.size() > kTexture) {
      soup_.notes.push_back(
          fmt::format("line {}: {} numbers are no texture coordinates", scanner_.line(), value.size()));
      value = {kNone};
    }
    value.resize(kTexture, 0);
    uv_.values.insert(uv_.values.end(), value.begin(), value.end());
  }

  // As many components as the longest line has.
  void pack_texture() {
    std::vector<double> packed;
    for (std::size_t i = 0; i < uv_.values.size(); i += kTexture)
      packed.insert(packed.end(), uv_.values.begin() + static_cast<std::ptrdiff_t>(i),
                    uv_.values.begin() + static_cast<std::ptrdiff_t>(i) + uv_.components);
    uv_.values = std::move(packed);
  }

  // Three or more of v, v/vt, v//vn, v/vt/vn; indices from 1, or from the latest backwards if negative.
  void read_face() {
    for (std::string_view word = scanner_.word(); !word.empty(); word = scanner_.word()) {
      soup_.corners.push_back(vertex_of(word));
    }
    soup_.close_polygon(scanner_.line());
  }

  struct Tag {
    std::vector<std::int64_t> integers;
    std::vector<double> numbers;
    std::vector<std::string_view> words;
  };

  // NAME I/N/W, then so many integers, numbers and words.
  Tag read_tag_arguments(std::string_view name) {
    const std::string_view counts = scanner_.word();
    std::array<std::int64_t, 3> count{};
    std::string_view rest = counts;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t slash = rest.find('/');
      const auto value = to_integer(rest.substr(0, slash));
      if (!value || *value < 0 || (slash == std::string_view::npos) != (i == 2))
        scanner_.syntax_error(fmt::format("a tag has counts like 2/1/0, not {}", quoted(counts)));
      count[i] = *value;
      rest.remove_prefix(i == 2 ? 0 : slash + 1);
    }
    Tag tag;
    for (std::int64_t i = 0; i < count[0]; ++i) tag.integers.push_back(scanner_.integer("an index"));
    for (std::int64_t i = 0; i < count[1]; ++i) tag.numbers.push_back(sharpness());
    for (std::int64_t i = 0; i < count[2]; ++i) {
      tag.words.push_back(scanner_.word());
      if (tag.words.back().empty()) scanner_.syntax_error(fmt::format("tag {} ends too early", quoted(name)));
    }
    scanner_.end_of_line();
    return tag;
  }

  // The quotient of two doubles is rounded once, as a decimal number is.
  double sharpness() {
    const std::string_view word = scanner_.word();
    const std::size_t slash = word.find('/');
    const auto above = to_double(word.substr(0, slash));
    const auto below = slash == std::string_view::npos ? 1.0 : to_double(word.substr(slash + 1));
    if (!above || !below || !(*below > 0))
      scanner_.syntax_error(fmt::format("a sharpness is a number or a fraction, not {}", quoted(word)));
    return *above / *below;
  }

  void read_tag() {
    const std::string_view name = scanner_.word();
    if (contains(kEdits, name))
      scanner_.fail("FILE_UNSUPPORTED",
                    fmt::format("tag {} is a hierarchical edit, which moves points of a refined mesh and is "
                                "not read",
                                quoted(name)));
    const Tag tag = read_tag_arguments(name);
    if (name == "crease" || name == "corner") {
      const std::size_t each = name == "crease" ? 2 : 1, count = tag.integers.size() / each;
      if (tag.integers.size() % each != 0 || (tag.numbers.size() != 1 && tag.numbers.size() != count))
        scanner_.syntax_error(fmt::format("tag {} has {} indices and {} sharpnesses", quoted(name),
                                          tag.integers.size(), tag.numbers.size()));
      for (std::size_t i = 0; i < count; ++i) {
        const std::int64_t a = tag.integers[each * i], b = each == 2 ? tag.integers[2 * i + 1] : -1;
        if (a < 0 || (each == 2 && b < 0)) scanner_.syntax_error("tags have indices from 0");
        soup_.sharp.push_back({a, b, tag.numbers[tag.numbers.size() == 1 ? 0 : i], scanner_.line()});
      }
      return;
    }
    if (name == "hole") {
      for (const std::int64_t f : tag.integers) soup_.holes.push_back({f, scanner_.line()});
      return;
    }
    const auto value = tag.words.size() == 1      ? std::string(tag.words[0])
                       : tag.integers.size() == 1 ? std::to_string(tag.integers[0])
                                                  : std::string();
    const auto choose = [&]<class Choice>(Choice& choice,
                                          std::initializer_list<std::pair<std::string_view, Choice>> all) {
      std::string known;
      for (const auto& [word, meaning] : all) {
        if (value == word) {
          choice = meaning;
          return;
        }
        known += (known.empty() ? "" : " or ") + std::string(word);
      }
      scanner_.fail("FILE_UNSUPPORTED",
                    fmt::format("tag {} is {}, not {}", quoted(name), known, io::quoted(value)));
    };
    Sharpness& choices = soup_.choices;
    if (name == "interpolateboundary") {
      choose(choices.boundary,
             {{"0", Boundary::kEdge}, {"1", Boundary::kEdgeAndCorner}, {"2", Boundary::kEdge}});
      soup_.hides_boundary = value == "0";
    } else if (name == "creasemethod") {
      choose(choices.creasing, {{"normal", Creasing::kUniform}, {"chaikin", Creasing::kChaikin}});
    } else if (name == "smoothtriangles") {
      choose(choices.triangles, {{"catmark", TriangleRule::kCatmark}, {"smooth", TriangleRule::kSmooth}});
    } else if (name == "facevaryinginterpolateboundary" && tag.integers.size() == 1 && tag.integers[0] >= 0 &&
               tag.integers[0] < static_cast<std::int64_t>(std::size(kChannelRules))) {
      uv_.rule = static_cast<ChannelRule>(tag.integers[0]);
    } else if (name == "facevaryingpropagatecorners" && tag.integers.size() == 1) {
      propagates_corners_ = tag.integers[0] != 0;
    } else if (name.starts_with("facevarying")) {
      soup_.notes.push_back(fmt::format("line {}: tag {} says no rule of a channel, and is read over",
                                        scanner_.line(), quoted(name)));
    } else {
      scanner_.fail("FILE_UNSUPPORTED", fmt::format("tag {} is not read", quoted(name)));
    }
  }

  // From 1, or backwards from the latest of `count`: -2 is none of them.
  static std::int64_t from_zero(std::int64_t index, std::size_t count) {
    const auto n = static_cast<std::int64_t>(count);
    return index > 0 ? index - 1 : index < 0 && index >= -n ? n + index : -2;
  }

  std::int64_t vertex_of(std::string_view word) {
    std::string_view parts = word;
    std::int64_t index = 0, normal = -1, texture = -1;
    for (int part = 0;; ++part) {
      const std::size_t slash = parts.find('/');
      const std::string_view text = parts.substr(0, slash);
      const auto value = to_integer(text);
      const bool may_be_absent = part == 1 && slash != std::string_view::npos;
      if (part > 2 || (!value && !(text.empty() && may_be_absent))) {
        scanner_.syntax_error(fmt::format("a corner is v, v/vt, v//vn or v/vt/vn, not {}", quoted(word)));
      }
      if (part == 0) index = *value;
      if (part == 1 && value) texture = from_zero(*value, uv_.values.size() / kTexture);
      if (part == 2) normal = from_zero(*value, soup_.normals.size());
      if (slash == std::string_view::npos) break;
      parts.remove_prefix(slash + 1);
    }
    soup_.corner_normals.push_back(normal);
    uv_.corners.push_back(texture);
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
  static constexpr std::size_t kTexture = 3;  // components of a texture coordinate, at most
  PolygonSoup::SoupChannel uv_{.name = "uv", .components = 1};
  bool propagates_corners_ = false;
};

}  // namespace

PolygonSoup read_obj(std::string_view content, const std::string& name) {
  return ObjReader(content, name).read();
}

}  // namespace limitcheck::data::io
