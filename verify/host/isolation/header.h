// SPDX-License-Identifier: MIT
// The JSON line before a payload. Private to the protocol: it shows nlohmann's headers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "verify/host/isolation/protocol.h"

namespace limitcheck::verify::protocol {

/// Words by their number: of lc_status, and of the bits 1, 2, 4 .. of lc_capabilities (of channel rules data::kChannelRules).
using Names = std::span<const std::string_view>;
inline constexpr std::string_view kStatusWords[]{"ok", "not-supported", "invalid-input", "failed"};
inline constexpr std::string_view kSchemes[]{"loop", "catmull-clark"};
inline constexpr std::string_view kSharpKinds[]{"creases", "semi-sharp",       "chaikin",
                                                "corners", "smooth-triangles", "no-darts"};
nlohmann::json names_of(std::int32_t bits, Names names);

/// The arrays of a mesh as bytes, in the order in which they are sent. Write to the bytes only if the arrays of the
/// mesh are a copy that was made for that.
std::vector<std::span<std::byte>> arrays_of(const lc_mesh& mesh);

/// Dumped on one line. Text that is not UTF-8 is replaced; it never throws.
std::string to_line(const nlohmann::json& json);

/// What the question `create` says of a channel.
struct ChannelHeader {
  std::int32_t components;
  lc_channel_rule rule;
  std::int64_t values;
};

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
  int choice(const char* key, Names choices) const;
  int choice(const char* key, std::initializer_list<std::string_view> choices) const {
    return choice(key, Names(choices.begin(), choices.size()));
  }
  /// Of a mesh; none if there is no such key.
  std::vector<ChannelHeader> channels() const;
  /// Of a list of names the bits; names that are not known are left out.
  std::int32_t bits(const char* key, Names names) const;
  const nlohmann::json& at(const char* key) const;
  /// "status": "ok" returns; "not-supported", "invalid-input"
  /// and "failed" become SubjectErrors with "message".
  void refuse_unless_ok() const;

 private:
  nlohmann::json json_;
};

Header read_header(Source& source);

}  // namespace limitcheck::verify::protocol
