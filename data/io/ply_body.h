// SPDX-License-Identifier: MIT
// The elements of a PLY file and the numbers of its body. Private to ply.cpp.
#pragma once

#include <fmt/core.h>

#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "data/error.h"
#include "data/io/text_scanner.h"

namespace limitcheck::data::io {

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

inline std::optional<Type> type_named(std::string_view name) {
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

}  // namespace limitcheck::data::io
