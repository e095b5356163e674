// SPDX-License-Identifier: MIT
// The JSON line before a payload. Private to the protocol: it shows nlohmann's headers.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "verify/host/isolation/protocol.h"

namespace limitcheck::verify::protocol {

/// Dumped on one line. Text that is not UTF-8 is replaced; it never throws.
std::string to_line(const nlohmann::json& json);

/// An object; every member function throws Error, which names the key, if the value is missing or of another
/// type.
class Header {
 public:
  explicit Header(const std::string& line);
  bool has(const char* key) const { return json_.contains(key); }
  std::int64_t integer(const char* key, std::int64_t least, std::int64_t most) const;
  bool flag(const char* key) const;
  std::string text(const char* key) const;
  /// The index of the value among `choices`.
  int choice(const char* key, std::initializer_list<std::string_view> choices) const;
  const nlohmann::json& at(const char* key) const;
  /// "status": "ok" returns; "not-supported", "invalid-input"
  /// and "failed" become SubjectErrors with "message".
  void refuse_unless_ok() const;

 private:
  nlohmann::json json_;
};

Header read_header(Source& source);

}  // namespace limitcheck::verify::protocol
