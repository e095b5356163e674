// SPDX-License-Identifier: MIT
// Stanford PLY, ascii and binary of both byte orders. An element "edge" with vertex1, vertex2 and a sharpness
// has the sharp edges.
//
// Our own reader because neither library at hand keeps the promises of read.h: Assimp keeps positions in
// float, takes truncated files for whole and loops on a missing end_header; CGAL allocates what a list count
// claims (16 GiB from a file of 300 bytes) and reports neither line nor reason.
#include <fmt/core.h>

#include <algorithm>

#include "data/error.h"
#include "data/io/ply_body.h"
#include "data/io/polygon_soup.h"
#include "data/io/text_scanner.h"

namespace limitcheck::data::io {
namespace {

using namespace ply;

class PlyReader {
 public:
  PlyReader(std::string_view content, const std::string& name)
      : content_(content), name_(name), scanner_(content, name, 0) {}

  PolygonSoup read() {
    read_header();
    Body body(content_, scanner_.offset(), name_, encoding_, scanner_);
    for (const Element& element : elements_) {
      if (element.name == "vertex") {
        read_vertices(element, body);
      } else if (element.name == "face") {
        read_faces(element, body);
      } else if (element.name == "edge" && std::any_of(element.properties.begin(), element.properties.end(),
                                                       [](auto& p) { return p.name == "sharpness"; })) {
        read_edges(element, body);
      } else if (!element.properties.empty()) {
        for (std::int64_t i = 0; i < element.count; ++i) {
          body.begin(element, i);
          for (const Property& property : element.properties) body.skip(property);
          body.end();
        }
      }
    }
    body.finish();
    return std::move(soup_);
  }

 private:
  void read_header() {
    if (!scanner_.next_line()) scanner_.truncated("has no lines");
    if (scanner_.word() != "ply") scanner_.syntax_error("does not begin with \"ply\"");
    scanner_.end_of_line();
    bool has_format = false;
    for (;;) {
      if (!scanner_.next_line()) scanner_.truncated("ends within the header");
      const std::string_view keyword = scanner_.word();
      if (keyword == "comment" || keyword == "obj_info") continue;
      if (keyword == "format") {
        read_format();
        has_format = true;
      } else if (keyword == "element") {
        read_element();
      } else if (keyword == "property") {
        read_property();
      } else if (keyword == "end_header") {
        break;
      } else {
        scanner_.syntax_error(fmt::format("unknown keyword {} in the header", quoted(keyword)));
      }
      scanner_.end_of_line();
    }
    scanner_.end_of_line();
    if (!has_format) scanner_.syntax_error("the header has no format");
    for (const std::string_view needed : {"vertex", "face"}) {
      const auto named =
          std::count_if(elements_.begin(), elements_.end(), [&](auto& e) { return e.name == needed; });
      if (named != 1)
        scanner_.syntax_error(fmt::format("{} elements are called \"{}\", not one", named, needed));
    }
  }

  void read_format() {
    const std::string_view format = scanner_.word();
    if (format == "ascii") {
      encoding_ = Encoding::kAscii;
    } else if (format == "binary_little_endian") {
      encoding_ = Encoding::kLittleEndian;
    } else if (format == "binary_big_endian") {
      encoding_ = Encoding::kBigEndian;
    } else {
      scanner_.syntax_error(fmt::format("unknown format {}", quoted(format)));
    }
    const std::string_view version = scanner_.word();
    if (version != "1.0")
      scanner_.fail("FILE_UNSUPPORTED", fmt::format("version {}, not 1.0", quoted(version)));
  }

  void read_element() {
    Element element;
    element.name = scanner_.word();
    element.count = scanner_.integer("the number of elements");
    if (element.count < 0) scanner_.syntax_error(fmt::format("{} elements", element.count));
    if (element.name == "tristrips") scanner_.fail("FILE_UNSUPPORTED", "triangle strips are not read");
    elements_.push_back(std::move(element));
  }

  void read_property() {
    if (elements_.empty()) scanner_.syntax_error("a property before the first element");
    Property property;
    const auto type = [&](std::string_view name) {
      const auto known = type_named(name);
      if (!known) scanner_.syntax_error(fmt::format("unknown type {}", quoted(name)));
      return *known;
    };
    std::string_view word = scanner_.word();
    if (word == "list") {
      property.is_list = true;
      property.count_type = type(scanner_.word());
      if (property.count_type.kind == Type::Kind::kFloat)
        scanner_.syntax_error("a list is counted by an integer");
      word = scanner_.word();
    }
    property.type = type(word);
    property.name = scanner_.word();
    if (property.name.empty()) scanner_.syntax_error("a property without a name");
    elements_.back().properties.push_back(std::move(property));
  }

  void read_vertices(const Element& element, Body& body) {
    std::array<std::size_t, 3> place{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      place[axis] = property_named(element, {std::string(1, "xyz"[axis])}, false);
    }
    std::array<std::size_t, 3> normal_place{};
    bool has_normals = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto& all = element.properties;
      const auto it = std::find_if(all.begin(), all.end(), [&](const Property& p) {
        return p.name == std::string("n") + "xyz"[axis] && !p.is_list;
      });
      has_normals = has_normals && it != all.end();
      normal_place[axis] = it - all.begin();
    }
    for (std::int64_t i = 0; i < element.count; ++i) {
      body.begin(element, i);
      std::array<double, 3> position{}, normal{};
      for (std::size_t k = 0; k < element.properties.size(); ++k) {
        const Property& property = element.properties[k];
        const auto axis = std::find(place.begin(), place.end(), k) - place.begin();
        const auto normal_axis =
            std::find(normal_place.begin(), normal_place.end(), k) - normal_place.begin();
        if (axis < 3) {
          position[axis] = body.real(property, property.type);
        } else if (has_normals && normal_axis < 3) {
          normal[normal_axis] = body.real(property, property.type);
        } else {
          body.skip(property);
        }
      }
      body.end();
      soup_.positions.push_back(position);
      if (has_normals) soup_.normals.push_back(normal);
      if (body.line() > 0) soup_.position_lines.push_back(body.line());
    }
  }

  void read_faces(const Element& element, Body& body) {
    const std::size_t place = property_named(element, {"vertex_indices", "vertex_index"}, true);
    if (element.properties[place].type.kind == Type::Kind::kFloat) {
      throw InputError("FILE_SYNTAX", name_, 0, "vertex indices are integers");
    }
    for (std::int64_t i = 0; i < element.count; ++i) {
      body.begin(element, i);
      for (std::size_t k = 0; k < element.properties.size(); ++k) {
        const Property& property = element.properties[k];
        if (k != place) {
          body.skip(property);
          continue;
        }
        const std::int64_t corners = body.list_size(property);
        for (std::int64_t c = 0; c < corners; ++c)
          soup_.corners.push_back(body.integer(property, property.type));
      }
      body.end();
      soup_.close_polygon(body.line());
    }
  }

  void read_edges(const Element& element, Body& body) {
    const std::size_t first = property_named(element, {"vertex1"}, false),
                      second = property_named(element, {"vertex2"}, false),
                      sharpness = property_named(element, {"sharpness"}, false);
    for (std::int64_t i = 0; i < element.count; ++i) {
      body.begin(element, i);
      PolygonSoup::SharpTag tag{};
      for (std::size_t k = 0; k < element.properties.size(); ++k) {
        const Property& property = element.properties[k];
        if (k == sharpness)
          tag.sharpness = body.real(property, property.type);
        else if ((k == first || k == second) && property.type.kind != Type::Kind::kFloat)
          (k == first ? tag.a : tag.b) = body.integer(property, property.type);
        else
          body.skip(property);
      }
      body.end();
      if (tag.a < 0 || tag.b < 0) body.fail("FILE_SYNTAX", "a vertex below 0");
      tag.line = body.line();
      soup_.sharp.push_back(tag);
    }
  }

  std::size_t property_named(const Element& element, const std::vector<std::string>& names,
                             bool is_list) const {
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
      const Property& property = element.properties[k];
      if (std::find(names.begin(), names.end(), property.name) == names.end()) continue;
      if (property.is_list != is_list) {
        throw InputError("FILE_SYNTAX", name_, 0,
                         fmt::format("property \"{}\" is {}a list", property.name, is_list ? "not " : ""));
      }
      return k;
    }
    throw InputError("FILE_SYNTAX", name_, 0,
                     fmt::format("element \"{}\" has no property \"{}\"", element.name, names[0]));
  }

  std::string_view content_;
  const std::string& name_;
  TextScanner scanner_;
  Encoding encoding_ = Encoding::kAscii;
  std::vector<Element> elements_;
  PolygonSoup soup_;
};

}  // namespace

PolygonSoup read_ply(std::string_view content, const std::string& name) {
  return PlyReader(content, name).read();
}

}  // namespace limitcheck::data::io
