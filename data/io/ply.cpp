// SPDX-License-Identifier: MIT
// Stanford PLY, ascii and binary of both byte orders. An element "edge" with vertex1, vertex2 and a sharpness
// has the sharp edges.
//
// Our own reader because neither library at hand keeps the promises of read.h: Assimp keeps positions in
// float, takes truncated files for whole and loops on a missing end_header; CGAL allocates what a list count
// claims (16 GiB from a file of 300 bytes) and reports neither line nor reason.
#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "data/error.h"
#include "data/io/polygon_soup.h"
#include "data/io/text_scanner.h"

namespace limitcheck::data::io {
namespace {

enum class Encoding { kAscii, kLittleEndian, kBigEndian };

struct Type {
  std::size_t bytes = 0;
  enum class Kind { kSigned, kUnsigned, kFloat } kind = Kind::kSigned;
};

struct Property {
  std::string name;
  Type type;
  bool is_list = false;
  Type count_type;  // of a list
};

struct Element {
  std::string name;
  std::int64_t count = 0;
  std::vector<Property> properties;
};

std::optional<Type> type_named(std::string_view name) {
  using Kind = Type::Kind;
  struct Named {
    std::string_view word, other;
    Type type;
  };
  constexpr Named kTypes[] = {
      {"char", "int8", {1, Kind::kSigned}},    {"uchar", "uint8", {1, Kind::kUnsigned}},
      {"short", "int16", {2, Kind::kSigned}},  {"ushort", "uint16", {2, Kind::kUnsigned}},
      {"int", "int32", {4, Kind::kSigned}},    {"uint", "uint32", {4, Kind::kUnsigned}},
      {"float", "float32", {4, Kind::kFloat}}, {"double", "float64", {8, Kind::kFloat}}};
  for (const Named& t : kTypes)
    if (name == t.word || name == t.other) return t.type;
  return std::nullopt;
}

// The numbers of the body one after another, whatever the encoding.
class Body {
 public:
  Body(std::string_view content, std::size_t offset, const std::string& name, Encoding encoding,
       TextScanner& scanner)
      : content_(content), at_(offset), name_(name), encoding_(encoding), scanner_(scanner) {}

  // Before the numbers of an element: in ascii each has a line of its own.
  void begin(const Element& element, std::int64_t index) {
    element_ = &element;
    index_ = index;
    if (encoding_ == Encoding::kAscii && !scanner_.next_line()) {
      scanner_.truncated(
          fmt::format("ends after {} of {} elements \"{}\"", index, element.count, element.name));
    }
  }

  void end() {
    if (encoding_ == Encoding::kAscii) scanner_.end_of_line();
  }

  double real(const Property& property, const Type& type) {
    if (type.kind != Type::Kind::kFloat) return static_cast<double>(integer(property, type));
    if (encoding_ == Encoding::kAscii) {
      const double value = scanner_.number(property.name);
      return type.bytes == 4 ? static_cast<double>(static_cast<float>(value)) : value;
    }
    const std::uint64_t bits = raw(type.bytes);
    return type.bytes == 4 ? std::bit_cast<float>(static_cast<std::uint32_t>(bits))
                           : std::bit_cast<double>(bits);
  }

  std::int64_t integer(const Property& property, const Type& type) {
    if (encoding_ == Encoding::kAscii) {
      const std::int64_t value = scanner_.integer(property.name);
      const bool is_signed = type.kind == Type::Kind::kSigned;
      const std::int64_t most = (std::int64_t{1} << (8 * type.bytes - (is_signed ? 1 : 0))) - 1;
      if (value > most || value < (is_signed ? -most - 1 : 0)) {
        scanner_.syntax_error(fmt::format("{} does not fit its type: {}", property.name, value));
      }
      return value;
    }
    const std::uint64_t bits = raw(type.bytes);
    if (type.kind == Type::Kind::kUnsigned) return static_cast<std::int64_t>(bits);
    // NOLINTNEXTLINE(clang-analyzer-core.UndefinedBinaryOperatorResult): every type has 1 to 8 bytes
    const std::uint64_t sign = std::uint64_t{1} << (8 * type.bytes - 1);
    return static_cast<std::int64_t>((bits ^ sign) - sign);
  }

  // How many numbers a list has; there are at least as many bytes left, so that a claim allocates nothing.
  std::int64_t list_size(const Property& property) {
    const std::int64_t size = integer(property, property.count_type);
    if (size < 0) fail("FILE_SYNTAX", fmt::format("a list of {} entries", size));
    const std::size_t left = encoding_ == Encoding::kAscii ? content_.size() : content_.size() - at_;
    const std::size_t bytes = encoding_ == Encoding::kAscii ? 1 : property.type.bytes;
    if (static_cast<std::size_t>(size) > left / bytes) {
      fail("FILE_TRUNCATED",
           fmt::format("a list of {} entries, {} bytes before the end of the file", size, left));
    }
    return size;
  }

  void skip(const Property& property) {
    const auto size = static_cast<std::size_t>(property.is_list ? list_size(property) : 1);
    if (encoding_ == Encoding::kAscii) {
      for (std::size_t i = 0; i < size; ++i) scanner_.number(property.name);
    } else {
      need(size * property.type.bytes);
      at_ += size * property.type.bytes;
    }
  }

  // After the last element: nothing but white space.
  void finish() {
    if (encoding_ == Encoding::kAscii) {
      if (scanner_.next_line()) scanner_.syntax_error("more lines than the header announces");
      return;
    }
    const std::string_view rest = content_.substr(at_);
    if (rest.find_first_not_of(" \t\r\n") != std::string_view::npos) {
      throw InputError("FILE_SYNTAX", name_, 0,
                       fmt::format("{} bytes more than the header announces", rest.size()));
    }
  }

  std::int64_t line() const { return encoding_ == Encoding::kAscii ? scanner_.line() : 0; }

  [[noreturn]] void fail(const std::string& code, const std::string& message) const {
    throw InputError(code, name_, line(),
                     fmt::format("{} (element \"{}\" {})", message, element_->name, index_));
  }

 private:
  void need(std::size_t bytes) const {
    if (content_.size() - at_ < bytes) {
      throw InputError(
          "FILE_TRUNCATED", name_, 0,
          fmt::format("ends within {} of {} elements \"{}\"", index_, element_->count, element_->name));
    }
  }

  std::uint64_t raw(std::size_t bytes) {
    need(bytes);
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < bytes; ++i) {
      const auto byte = static_cast<unsigned char>(content_[at_ + i]);
      bits |= std::uint64_t{byte} << 8 * (encoding_ == Encoding::kLittleEndian ? i : bytes - 1 - i);
    }
    at_ += bytes;
    return bits;
  }

  std::string_view content_;
  std::size_t at_;
  const std::string& name_;
  Encoding encoding_;
  TextScanner& scanner_;
  const Element* element_ = nullptr;
  std::int64_t index_ = 0;
};

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
    std::array<std::size_t, 3> place{}, normal_place{};
    bool has_normals = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      place[axis] = property_named(element, {std::string(1, "xyz"[axis])}, false);
      const auto& all = element.properties;
      const auto it = std::find_if(all.begin(), all.end(), [&](const Property& p) {
        return p.name == std::string("n") + "xyz"[axis] && !p.is_list;
      });
      has_normals = has_normals && it != all.end();
      normal_place[axis] = static_cast<std::size_t>(it - all.begin());
    }
    std::array<double, 3> position{}, normal{};
    const auto take = [&](std::size_t k, const Property& property) {
      const auto axis = std::find(place.begin(), place.end(), k) - place.begin();
      const auto normal_axis = std::find(normal_place.begin(), normal_place.end(), k) - normal_place.begin();
      if (axis < 3)
        position[axis] = body.real(property, property.type);
      else if (has_normals && normal_axis < 3)
        normal[normal_axis] = body.real(property, property.type);
      return axis < 3 || (has_normals && normal_axis < 3);
    };
    read_all(element, body, take, [&] {
      soup_.positions.push_back(position);
      if (has_normals) soup_.normals.push_back(normal);
      if (body.line() > 0) soup_.position_lines.push_back(body.line());
    });
  }

  void read_faces(const Element& element, Body& body) {
    const std::size_t place = property_named(element, {"vertex_indices", "vertex_index"}, true);
    if (element.properties[place].type.kind == Type::Kind::kFloat) {
      throw InputError("FILE_SYNTAX", name_, 0, "vertex indices are integers");
    }
    const auto take = [&](std::size_t k, const Property& property) {
      if (k != place) return false;
      for (std::int64_t left = body.list_size(property); left > 0; --left)
        soup_.corners.push_back(body.integer(property, property.type));
      return true;
    };
    read_all(element, body, take, [&] { soup_.close_polygon(body.line()); });
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
