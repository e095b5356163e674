// SPDX-License-Identifier: MIT
// Stanford PLY, ascii and binary of both byte orders. An element "edge" with vertex1, vertex2 and a sharpness
// has the sharp edges. Texture coordinates are the channel "uv": those of vertices (s t, u v, texture_u texture_v), or a list
// "texcoord" of two for each corner of a face.
//
// Our own reader because neither library at hand keeps the promises of read.h: Assimp keeps positions in
// float, takes truncated files for whole and loops on a missing end_header; CGAL allocates what a list count
// claims (16 GiB from a file of 300 bytes) and reports neither line nor reason.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

#include "data/error.h"
#include "data/io/ply_body.h"
#include "data/io/polygon_soup.h"

namespace limitcheck::data::io {
namespace {

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
        read_all(
            element, body, [](std::size_t, const Property&) { return false; }, [] {});
      }
    }
    body.finish();
    if (!uv_.name.empty()) {
      uv_.corners = soup_.corners;
      if (uv_.by_value) std::iota(uv_.corners.begin(), uv_.corners.end(), std::int64_t{0});
      soup_.channels.push_back(std::move(uv_));
    }
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
      if (named == 0 && needed == "face") continue;  // a cloud of points
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

  // Hands every property of every element to `take`, which says whether it has read it, or passes it; then calls `done`.
  template <class Take, class Done>
  void read_all(const Element& element, Body& body, Take take, Done done) {
    for (std::int64_t i = 0; i < element.count; ++i) {
      body.begin(element, i);
      for (std::size_t k = 0; k < element.properties.size(); ++k)
        if (!take(k, element.properties[k])) body.skip(element.properties[k]);
      body.end();
      done();
    }
  }

  void read_vertices(const Element& element, Body& body) {
    // Where the numbers of a vertex are among its properties: the position, then what else is read if it is there.
    struct Part {
      std::vector<std::size_t> place;
      std::vector<double> value;
    };
    std::vector<Part> parts(3);
    for (const char* const axis : {"x", "y", "z"})
      parts[0].place.push_back(property_named(element, {axis}, false));
    parts[1].place = places_of(element, {"nx", "ny", "nz"});
    for (const auto& names : {std::array{"s", "t"}, {"u", "v"}, {"texture_u", "texture_v"}})
      if (parts[2].place.empty()) parts[2].place = places_of(element, {names[0], names[1]});
    for (Part& part : parts) part.value.resize(part.place.size());
    const auto take = [&](std::size_t k, const Property& property) {
      for (Part& part : parts) {
        const auto at = std::find(part.place.begin(), part.place.end(), k);
        if (at == part.place.end()) continue;
        part.value[static_cast<std::size_t>(at - part.place.begin())] = body.real(property, property.type);
        return true;
      }
      return false;
    };
    const auto vector = [](const Part& part) {
      return std::array{part.value[0], part.value[1], part.value[2]};
    };
    if (!parts[2].place.empty()) uv_.name = "uv";
    read_all(element, body, take, [&] {
      soup_.positions.push_back(vector(parts[0]));
      if (!parts[1].place.empty()) soup_.normals.push_back(vector(parts[1]));
      uv_.values.insert(uv_.values.end(), parts[2].value.begin(), parts[2].value.end());
      if (body.line() > 0) soup_.position_lines.push_back(body.line());
    });
  }

  void read_faces(const Element& element, Body& body) {
    const std::size_t place = property_named(element, {"vertex_indices", "vertex_index"}, true);
    if (element.properties[place].type.kind == Type::Kind::kFloat) {
      throw InputError("FILE_SYNTAX", name_, 0, "vertex indices are integers");
    }
    // Values of corners take the place of those of vertices.
    const std::vector<std::size_t> texture = places_of(element, {"texcoord"}, true);
    if (!texture.empty()) uv_ = {.name = "uv", .by_value = true};
    std::int64_t numbers = 0;  // of a face's texture coordinates
    std::int64_t unlike = -1;  // the first face that has not two for each corner
    const auto take = [&](std::size_t k, const Property& property) {
      if (!texture.empty() && k == texture[0]) {
        numbers = body.list_size(property);
        for (std::int64_t left = numbers; left > 0; --left)
          uv_.values.push_back(body.real(property, property.type));
        return true;
      }
      if (k != place) return false;
      for (std::int64_t left = body.list_size(property); left > 0; --left)
        soup_.corners.push_back(body.integer(property, property.type));
      return true;
    };
    read_all(element, body, take, [&] {
      const auto face = static_cast<std::int64_t>(soup_.polygon_end.size());
      const std::size_t first = face == 0 ? 0 : soup_.polygon_end.back();
      if (unlike < 0 && static_cast<std::size_t>(numbers) != 2 * (soup_.corners.size() - first))
        unlike = face;
      soup_.close_polygon(body.line());
    });
    if (texture.empty() || unlike < 0) return;
    uv_ = {};
    soup_.notes.push_back(
        fmt::format("the channel uv is left out: not two for each corner of face {}", unlike));
  }

  void read_edges(const Element& element, Body& body) {
    const std::size_t first = property_named(element, {"vertex1"}, false),
                      second = property_named(element, {"vertex2"}, false),
                      sharpness = property_named(element, {"sharpness"}, false);
    PolygonSoup::SharpTag tag{};
    const auto take = [&](std::size_t k, const Property& property) {
      if (k == sharpness) {
        tag.sharpness = body.real(property, property.type);
        return true;
      }
      if ((k != first && k != second) || property.type.kind == Type::Kind::kFloat) return false;
      (k == first ? tag.a : tag.b) = body.integer(property, property.type);
      return true;
    };
    read_all(element, body, take, [&] {
      if (tag.a < 0 || tag.b < 0) body.fail("FILE_SYNTAX", "a vertex below 0");
      tag.line = body.line();
      soup_.sharp.push_back(tag);
    });
  }

  // All of these properties; none if one is missing.
  static std::vector<std::size_t> places_of(const Element& element, const std::vector<std::string>& names,
                                            bool is_list = false) {
    std::vector<std::size_t> places;
    for (const std::string& name : names)
      for (std::size_t k = 0; k < element.properties.size(); ++k)
        if (element.properties[k].name == name && element.properties[k].is_list == is_list)
          places.push_back(k);
    return places.size() == names.size() ? places : std::vector<std::size_t>{};
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
  PolygonSoup::SoupChannel uv_;
};

}  // namespace

PolygonSoup read_ply(std::string_view content, const std::string& name) {
  return PlyReader(content, name).read();
}

}  // namespace limitcheck::data::io
