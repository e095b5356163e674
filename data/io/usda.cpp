// SPDX-License-Identifier: MIT
// USD as text: the points, faces, creases, corners and holes of its Mesh prims, and what they say of scheme, boundary and
// triangles; all meshes of a file are one. What USD means where a mesh says nothing is taken: Catmull-Clark's
// scheme, and boundary vertices of one face held. A primvar of numbers by corner or by vertex is a channel; one that
// says no interpolation is taken by the number of its values. Transformations are not applied; what moves no point is
// read over; anything else is named in a note. Binary USD, animated points and what other files hold are refused.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <utility>

#include "data/io/polygon_soup.h"
#include "data/io/usda_words.h"

namespace limitcheck::data::io {
namespace {

constexpr int kDeepest = 128;  // prims and brackets within each other

// A property of a mesh: its numbers, tuples and lists flat, or its word.
struct UsdValue {
  std::vector<double> numbers;
  std::string word;
  std::int64_t line = 0;
  int components = 1;         // of an element, as the type says
  std::string interpolation;  // of a primvar, if it says one
};

// The components of an element of an array of numbers; 0 of any other type.
int components_of(std::string_view type) {
  if (!type.ends_with("[]")) return 0;
  type.remove_suffix(2);
  const auto components = [&](std::string_view name, std::size_t digit_and_more) {
    if (!type.starts_with(name) || type.size() != name.size() + digit_and_more) return 0;
    const char digit = type[name.size()];
    return digit >= '2' && digit <= '4' ? digit - '0' : 0;
  };
  for (const std::string_view number :
       {"half", "float", "double", "int", "uint", "int64", "uint64", "uchar"}) {
    if (type == number) return 1;
    if (const int count = components(number, 1)) return count;
  }
  for (const std::string_view role : {"texCoord", "color", "point", "normal", "vector"})
    if (const int count = components(role, 2)) return count;  // texCoord2f
  return 0;
}

constexpr std::string_view kRead[] = {"points",
                                      "faceVertexCounts",
                                      "faceVertexIndices",
                                      "subdivisionScheme",
                                      "interpolateBoundary",
                                      "triangleSubdivisionRule",
                                      "orientation",
                                      "creaseIndices",
                                      "creaseLengths",
                                      "creaseSharpnesses",
                                      "cornerIndices",
                                      "cornerSharpnesses",
                                      "holeIndices",
                                      "faceVaryingLinearInterpolation"};
constexpr std::string_view kMovesNoPoint[] = {"normals", "extent",     "doubleSided",  "visibility",
                                              "purpose", "velocities", "accelerations"};

class UsdReader {
 public:
  UsdReader(std::string_view content, const std::string& name) : words_(content, name) {}

  PolygonSoup read() {
    if (words_.next().is("(")) pass_value(0);
    while (words_.next().kind != UsdToken::Kind::kEnd) read_prim(0);
    if (meshes_ == 0) words_.fail("FILE_UNSUPPORTED", "there is no Mesh in it");
    return std::move(soup_);
  }

 private:
  void note(std::int64_t line, const std::string& what) {
    soup_.notes.push_back(fmt::format("line {}: {}", line, what));
  }

  static bool begins_prim(const UsdToken& token) {
    return token.kind == UsdToken::Kind::kWord &&
           (token.text == "def" || token.text == "over" || token.text == "class");
  }

  // def TYPE "name" (metadata) { properties and prims }
  void read_prim(int depth) {
    if (depth > kDeepest)
      words_.fail("FILE_UNSUPPORTED", fmt::format("more than {} prims within each other", kDeepest));
    if (!begins_prim(words_.next()))
      words_.syntax_error(
          fmt::format("a prim begins with def, over or class, not with {}", UsdWords::said(words_.next())));
    const bool defines = words_.take().text == "def";
    std::string_view type;
    if (words_.next().kind == UsdToken::Kind::kWord) type = words_.take().text;
    if (words_.next().kind != UsdToken::Kind::kText) words_.syntax_error("a prim has a name in quotes");
    const UsdToken name = words_.take();
    if (words_.next().is("(")) pass_value(0);
    words_.need("{");
    const bool is_mesh = defines && type == "Mesh";
    std::map<std::string_view, UsdValue> values;
    while (!words_.take_if("}")) {
      if (words_.next().kind == UsdToken::Kind::kEnd)
        words_.fail("FILE_TRUNCATED", "the file ends within a prim");
      if (words_.take_if(";")) continue;
      if (begins_prim(words_.next()))
        read_prim(depth + 1);
      else
        read_property(is_mesh, values);
    }
    if (is_mesh) add(name, values);
  }

  // custom uniform TYPE name = value (metadata), and less: what stands on the line of its first word.
  void read_property(bool of_mesh, std::map<std::string_view, UsdValue>& values) {
    const std::int64_t line = words_.next().line;
    std::string_view name, type;
    bool is_relation = false, is_variant = false;
    while (!words_.next().is("=") && !words_.next().is("(") && words_.next().line == line &&
           !words_.next().is("}") && words_.next().kind != UsdToken::Kind::kEnd) {
      const UsdToken token = words_.take();
      if (token.kind == UsdToken::Kind::kMark) {
        if (token.is(";")) return;
        words_.fail("FILE_SYNTAX", fmt::format("a property cannot have {} here", io::quoted(token.text)),
                    line);
      }
      is_relation = is_relation || token.text == "rel" || token.text == "nameChildren";
      is_variant = is_variant || token.text == "variantSet";
      type = std::exchange(name, token.text);
    }
    if (is_variant) note(line, fmt::format("the variants of {} are read over", io::quoted(name)));
    if (name.starts_with("xformOp:"))
      note(line, fmt::format("{} is not applied: points are as their mesh has them", io::quoted(name)));
    const bool is_primvar =
        of_mesh && name.starts_with("primvars:") && components_of(type) > 0 && name.find('.') == name.npos;
    const bool is_read = of_mesh && (contains(kRead, name) || is_primvar);
    if (of_mesh && name.starts_with("points."))
      words_.fail("FILE_UNSUPPORTED", "the points move with time", line);
    if (of_mesh && !is_read && !is_relation && !is_variant && !contains(kMovesNoPoint, name) &&
        !name.starts_with("primvars:") && !name.starts_with("xformOp") && !name.starts_with("normals"))
      note(line, fmt::format("{} is read over", io::quoted(name)));
    UsdValue* value = nullptr;
    if (words_.take_if("=")) {
      if (is_read && (words_.next().kind != UsdToken::Kind::kWord || words_.next().text != "None")) {
        const auto [at, is_new] = values.emplace(name, UsdValue{{}, "", line});
        if (!is_new) words_.fail("FILE_SYNTAX", fmt::format("{} is there twice", name), line);
        value = &at->second;
        if (is_primvar) value->components = components_of(type);
        read_value(*value, 0);
      } else {
        pass_value(0);
      }
    }
    if (!words_.next().is("(")) return;
    if (value != nullptr)
      read_metadata(*value);
    else
      pass_value(0);
  }

  // (interpolation = "faceVarying", and what is passed)
  void read_metadata(UsdValue& value) {
    words_.need("(");
    while (!words_.take_if(")")) {
      const bool is_interpolation = words_.next().text == "interpolation";
      pass_value(0);
      if (is_interpolation && words_.take_if("=") && words_.next().kind == UsdToken::Kind::kText)
        value.interpolation = words_.take().text;
    }
  }

  void pass_value(int depth) {
    if (depth > kDeepest) words_.fail("FILE_UNSUPPORTED", "brackets nest too deep");
    const UsdToken token = words_.take();
    if (token.kind == UsdToken::Kind::kEnd) words_.fail("FILE_TRUNCATED", "the file ends within a value");
    const std::string_view close = token.is("(") ? ")" : token.is("[") ? "]" : token.is("{") ? "}" : "";
    while (!close.empty() && !words_.take_if(close)) pass_value(depth + 1);
  }

  void read_value(UsdValue& value, int depth) {
    const UsdToken token = words_.take();
    const std::string_view close = token.is("(") ? ")" : token.is("[") ? "]" : "";
    if (!close.empty() && depth < 2) {
      while (!words_.take_if(close)) {
        if (words_.next().kind == UsdToken::Kind::kEnd)
          words_.fail("FILE_TRUNCATED", "the file ends within a list");
        if (!words_.take_if(",")) read_value(value, depth + 1);
      }
    } else if (token.kind == UsdToken::Kind::kText && depth == 0) {
      value.word = token.text;
    } else if (const auto number =
                   token.kind == UsdToken::Kind::kWord ? to_double(token.text) : std::nullopt) {
      value.numbers.push_back(*number);
    } else {
      words_.fail("FILE_SYNTAX", fmt::format("{} is no number", UsdWords::said(token)), token.line);
    }
  }

  static std::vector<std::int64_t> integers(const UsdValue& value, const UsdWords& words,
                                            std::string_view what) {
    std::vector<std::int64_t> list;
    for (const double x : value.numbers) {
      constexpr double kMost = 1e15;
      if (!(x >= -kMost && x <= kMost) || x != static_cast<double>(static_cast<std::int64_t>(x)))
        words.fail("FILE_SYNTAX", fmt::format("{} has {}, which is no whole number", what, x), value.line);
      list.push_back(static_cast<std::int64_t>(x));
    }
    return list;
  }

  // One mesh, behind those before it.
  void add(const UsdToken& prim, const std::map<std::string_view, UsdValue>& values) {
    const UsdValue absent{{}, "", prim.line};
    const auto value = [&](std::string_view name) -> const UsdValue& {
      const auto found = values.find(name);
      return found == values.end() ? absent : found->second;
    };
    const auto whole = [&](std::string_view name) { return integers(value(name), words_, name); };
    const auto refuse = [&](std::string_view name, const std::string& why) {
      words_.fail("FILE_SYNTAX", fmt::format("Mesh {}: {}", io::quoted(prim.text), why), value(name).line);
    };
    const std::vector<double>& points = value("points").numbers;
    if (points.empty())
      words_.fail("FILE_UNSUPPORTED",
                  fmt::format("Mesh {} has no points: they may be in another file", io::quoted(prim.text)),
                  prim.line);
    if (points.size() % 3 != 0) refuse("points", "points are three numbers each");
    const auto first_vertex = static_cast<std::int64_t>(soup_.positions.size());
    const auto first_face = static_cast<std::int64_t>(soup_.polygon_end.size());
    for (std::size_t k = 0; k < points.size(); k += 3) {
      soup_.positions.push_back({points[k], points[k + 1], points[k + 2]});
      soup_.position_lines.push_back(value("points").line);
    }
    // Of another mesh of the file no index is taken for one of this.
    const auto moved = [&](std::string_view name, const char* code, std::int64_t first, std::size_t count) {
      std::vector<std::int64_t> list = whole(name);
      for (std::int64_t& i : list) {
        if (i < 0 || static_cast<std::uint64_t>(i) >= count)
          words_.fail(code, fmt::format("Mesh {}: {} has {}, of {}", io::quoted(prim.text), name, i, count),
                      value(name).line);
        i += first;
      }
      return list;
    };
    const std::size_t vertices = points.size() / 3;
    const std::vector<std::int64_t> corners =
        moved("faceVertexIndices", "MESH_INDEX_OUT_OF_RANGE", first_vertex, vertices);
    const std::string orientation = value("orientation").word;
    const bool left = orientation == "leftHanded";
    if (!left && !orientation.empty() && orientation != "rightHanded")
      refuse("orientation", fmt::format("the orientation {} is unknown", io::quoted(orientation)));
    std::size_t at = 0;
    for (const std::int64_t count : whole("faceVertexCounts")) {
      if (count < 0 || static_cast<std::uint64_t>(count) > corners.size() - at)
        refuse("faceVertexCounts",
               fmt::format("its faces have more corners than the {} there are", corners.size()));
      const auto size = static_cast<std::size_t>(count);
      for (std::size_t k = 0; k < size; ++k)
        soup_.corners.push_back(corners[at + (left && k > 0 ? size - k : k)]);
      at += size;
      soup_.close_polygon(value("faceVertexCounts").line);
    }
    if (at != corners.size())
      refuse("faceVertexCounts", fmt::format("its faces have {} corners, there are {}", at, corners.size()));
    add_channels(values, first_vertex, corners.size(), left);
    const auto vertices_of = [&](const char* name) {
      return moved(name, "MESH_SHARPNESS", first_vertex, vertices);
    };
    add_sharp(value, whole, refuse, vertices_of("creaseIndices"), vertices_of("cornerIndices"));
    for (const std::int64_t face :
         moved("holeIndices", "MESH_HOLE", first_face, soup_.polygon_end.size() - first_face))
      soup_.holes.push_back({face, value("holeIndices").line});
    choose(prim, value);
  }

  template <class Value, class Whole, class Refuse>
  void add_sharp(const Value& value, const Whole& whole, const Refuse& refuse,
                 const std::vector<std::int64_t>& chain, const std::vector<std::int64_t>& held) {
    const std::vector<std::int64_t> lengths = whole("creaseLengths");
    const std::vector<double>& sharpnesses = value("creaseSharpnesses").numbers;
    std::int64_t edges = 0, vertices = 0;
    for (const std::int64_t length : lengths) {
      if (length < 2) refuse("creaseLengths", "a crease has two vertices and more");
      edges += length - 1, vertices += length;
    }
    const bool by_edge = sharpnesses.size() == static_cast<std::size_t>(edges);
    if (vertices != static_cast<std::int64_t>(chain.size()) ||
        (!by_edge && sharpnesses.size() != lengths.size()))
      refuse(
          "creaseLengths",
          fmt::format("{} creases of {} vertices in all, {} vertices and {} sharpnesses do not go together",
                      lengths.size(), vertices, chain.size(), sharpnesses.size()));
    std::size_t at = 0, edge = 0;
    for (std::size_t k = 0; k < lengths.size(); ++k, ++at)
      for (std::int64_t j = 1; j < lengths[k]; ++j, ++at, ++edge)
        soup_.sharp.push_back(
            {chain[at], chain[at + 1], sharpnesses[by_edge ? edge : k], value("creaseIndices").line});
    const std::vector<double>& how = value("cornerSharpnesses").numbers;
    if (held.size() != how.size())
      refuse("cornerIndices", fmt::format("{} corners and {} sharpnesses", held.size(), how.size()));
    for (std::size_t k = 0; k < held.size(); ++k)
      soup_.sharp.push_back({held[k], -1, how[k], value("cornerIndices").line});
  }

  // The primvars of a mesh that has so many corners, the last of the soup.
  void add_channels(const std::map<std::string_view, UsdValue>& values, std::int64_t first_vertex,
                    std::size_t corners, bool left_handed) {
    constexpr std::string_view kRules[] = {"none",         "cornersOnly", "cornersPlus1",
                                           "cornersPlus2", "boundaries",  "all"};
    const auto said = values.find("faceVaryingLinearInterpolation");
    const auto rule = said == values.end()
                          ? std::end(kRules)
                          : std::find(std::begin(kRules), std::end(kRules), said->second.word);
    if (said != values.end() && rule == std::end(kRules))
      note(said->second.line,
           fmt::format("faceVaryingLinearInterpolation {} is none of its rules, and is read over",
                       io::quoted(said->second.word)));
    const std::size_t vertices = soup_.positions.size() - static_cast<std::size_t>(first_vertex);
    for (const auto& [name, value] : values) {
      if (!name.starts_with("primvars:") || name.ends_with(":indices")) continue;
      const std::string indices = std::string(name) + ":indices";
      const bool is_indexed = values.contains(indices);
      std::vector<std::int64_t> list(value.numbers.size() / static_cast<std::size_t>(value.components));
      if (is_indexed)
        list = integers(values.find(indices)->second, words_, indices);
      else
        std::iota(list.begin(), list.end(), std::int64_t{0});
      const std::string& by = value.interpolation;
      const bool by_vertex = (by.empty() || by == "vertex" || by == "varying") && list.size() == vertices;
      if (!by_vertex && (!(by.empty() || by == "faceVarying") || list.size() != corners)) {
        if (!by.empty() && by != "uniform" && by != "constant")
          note(value.line, fmt::format("{} is read over: it has {} values, for {} vertices and {} corners",
                                       io::quoted(name), list.size(), vertices, corners));
        continue;  // constant, or one for each face
      }
      if (by.empty())
        note(value.line, fmt::format("{} says no interpolation: it has as many values as there are {}",
                                     io::quoted(name), by_vertex ? "vertices" : "corners"));
      PolygonSoup::SoupChannel* const to =
          channel_of(name.substr(std::string_view("primvars:").size()), value, !is_indexed);
      if (to == nullptr) continue;
      if (by_vertex)  // as positions are, or linear
        to->rule = by == "varying" ? ChannelRule::kAll : ChannelRule::kNone;
      else if (rule != std::end(kRules))
        to->rule = static_cast<ChannelRule>(rule - std::begin(kRules));
      add_corners(*to, value, list, by_vertex ? first_vertex : -1, corners, left_handed);
    }
  }

  // The channel of that name, a new one if no mesh before had it; none if it has other components.
  PolygonSoup::SoupChannel* channel_of(std::string_view name, const UsdValue& value, bool by_value) {
    auto to = std::find_if(soup_.channels.begin(), soup_.channels.end(),
                           [&](const auto& channel) { return channel.name == name; });
    if (to == soup_.channels.end())
      to = soup_.channels.insert(
          to, {.name = std::string(name), .components = value.components, .by_value = by_value});
    if (to->components == value.components) return &*to;
    note(value.line, fmt::format("{}: another mesh of the file has it with {} components, not {}",
                                 io::quoted(name), to->components, value.components));
    return nullptr;
  }

  // The values of the last corners of the soup, a list of indices by corner; by vertex if a first vertex is given.
  void add_corners(PolygonSoup::SoupChannel& to, const UsdValue& value, const std::vector<std::int64_t>& list,
                   std::int64_t first_vertex, std::size_t corners, bool left_handed) const {
    const std::size_t begin = soup_.corners.size() - corners;
    const auto offset = static_cast<std::int64_t>(to.values.size()) / to.components,
               count = static_cast<std::int64_t>(value.numbers.size()) / to.components;
    to.values.insert(to.values.end(), value.numbers.begin(), value.numbers.end());
    to.corners.resize(begin, -1);
    std::size_t at = 0;
    for (auto end = std::upper_bound(soup_.polygon_end.begin(), soup_.polygon_end.end(), begin);
         end != soup_.polygon_end.end(); ++end) {
      const std::size_t size = *end - begin - at;
      for (std::size_t k = 0; k < size; ++k) {
        const std::size_t place =
            first_vertex < 0 ? at + (left_handed && k > 0 ? size - k : k)
                             : static_cast<std::size_t>(soup_.corners[begin + at + k] - first_vertex);
        to.corners.push_back(list[place] < 0 || list[place] >= count ? -2 : list[place] + offset);
      }
      at += size;
    }
  }

  // Scheme, boundary and rule for triangles, which all meshes of a file must agree on.
  template <class Value>
  void choose(const UsdToken& prim, const Value& value) {
    const auto one_of = [&](std::string_view name, const std::vector<std::string_view>& known) {
      const UsdValue& said = value(name);
      const auto found = std::find(known.begin(), known.end(), said.word);
      if (!said.word.empty() && found == known.end())
        words_.fail("FILE_UNSUPPORTED",
                    fmt::format("{} is {}, which is not read", name, io::quoted(said.word)), said.line);
      return said.word.empty() ? std::size_t{0} : static_cast<std::size_t>(found - known.begin());
    };
    const std::array<std::size_t, 3> chosen{
        one_of("subdivisionScheme", {"catmullClark", "loop", "none"}),
        one_of("interpolateBoundary", {"edgeAndCorner", "edgeOnly", "none"}),
        one_of("triangleSubdivisionRule", {"catmullClark", "smooth"})};
    if (meshes_++ > 0 && chosen != chosen_)
      words_.fail("FILE_UNSUPPORTED",
                  fmt::format("Mesh {} has another subdivisionScheme, interpolateBoundary or "
                              "triangleSubdivisionRule than those before it",
                              io::quoted(prim.text)),
                  prim.line);
    chosen_ = chosen;
    if (chosen[0] < 2) soup_.scheme = chosen[0] == 0 ? Scheme::kCatmullClark : Scheme::kLoop;
    if (chosen[0] == 2 && meshes_ == 1)
      note(prim.line, "subdivisionScheme is \"none\": the scheme is chosen by the faces");
    soup_.choices.boundary = chosen[1] == 0 ? Boundary::kEdgeAndCorner : Boundary::kEdge;
    soup_.hides_boundary = chosen[1] == 2;
    soup_.choices.triangles = chosen[2] == 0 ? TriangleRule::kCatmark : TriangleRule::kSmooth;
  }

  UsdWords words_;
  PolygonSoup soup_;
  int meshes_ = 0;
  std::array<std::size_t, 3> chosen_{};
};

}  // namespace

PolygonSoup read_usda(std::string_view content, const std::string& name) {
  return UsdReader(content, name).read();
}

}  // namespace limitcheck::data::io
