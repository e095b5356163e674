// SPDX-License-Identifier: MIT
#include "verify/host/isolation/header.h"

#include <fmt/format.h>

#include <algorithm>
#include <type_traits>

#include "data/channel.h"
#include "data/error.h"
#include "data/untrusted_json.h"
#include "verify/subject/subject_error.h"

namespace limitcheck::verify::protocol {

std::string to_line(const nlohmann::json& json) {
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

nlohmann::json names_of(std::int32_t bits, Names names) {
  nlohmann::json list = nlohmann::json::array();
  for (std::size_t k = 0; k < names.size(); ++k)
    if ((bits >> k & 1) != 0) list.push_back(names[k]);
  return list;
}

std::vector<std::span<std::byte>> arrays_of(const lc_mesh& mesh) {
  const auto bytes = [](const auto* data, std::int64_t count) {
    using Element = std::remove_cv_t<std::remove_pointer_t<decltype(data)>>;
    return std::as_writable_bytes(std::span(const_cast<Element*>(data), static_cast<std::size_t>(count)));
  };
  std::vector<std::span<std::byte>> arrays{
      bytes(mesh.positions, 3 * mesh.vertex_count), bytes(mesh.face_sizes, mesh.face_count),
      bytes(mesh.corners, mesh.corner_count), bytes(mesh.sharp_edges, mesh.sharp_edge_count),
      bytes(mesh.sharp_vertices, mesh.sharp_vertex_count)};
  for (const lc_channel& c : std::span(mesh.channels, static_cast<std::size_t>(mesh.channel_count)))
    arrays.insert(arrays.end(),
                  {bytes(c.values, c.components * c.value_count), bytes(c.corners, mesh.corner_count)});
  return arrays;
}

Header::Header(const std::string& line) try : json_(data::parse_untrusted(line)) {
  if (!json_.is_object())
    throw Error(fmt::format("where a line with a JSON object belongs it wrote \"{}\"", printable(line, 80)));
} catch (const data::ArgumentError& error) {
  throw Error(error.what());
}

const nlohmann::json& Header::at(const char* key) const {
  const auto found = json_.find(key);
  if (found == json_.end()) throw Error(fmt::format("its answer has no \"{}\"", key));
  return *found;
}

std::int64_t Header::integer(const char* key, std::int64_t least, std::int64_t most) const {
  const nlohmann::json& value = at(key);
  const bool beyond = value.is_number_unsigned() && value.get<std::uint64_t>() > std::uint64_t{INT64_MAX};
  if (!value.is_number_integer() || beyond || value.get<std::int64_t>() < least ||
      value.get<std::int64_t>() > most) {
    throw Error(fmt::format(
        "\"{}\": {} is not an integer from {} to {}", key,
        printable(value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace), 80), least, most));
  }
  return value.get<std::int64_t>();
}

bool Header::flag(const char* key) const {
  const nlohmann::json& value = at(key);
  if (!value.is_boolean()) throw Error(fmt::format("\"{}\" is neither true nor false", key));
  return value.get<bool>();
}

std::string Header::text(const char* key) const {
  const nlohmann::json& value = at(key);
  if (!value.is_string()) throw Error(fmt::format("\"{}\" is not a text", key));
  return value.get<std::string>();
}

int Header::choice(const char* key, Names choices) const {
  const std::string value = text(key);
  const auto found = std::find(choices.begin(), choices.end(), value);
  if (found == choices.end()) {
    throw Error(fmt::format("\"{}\": \"{}\" is none of {}", key, printable(value, 40),
                            fmt::join(choices.begin(), choices.end(), ", ")));
  }
  return static_cast<int>(found - choices.begin());
}

std::int32_t Header::bits(const char* key, Names names) const {
  const nlohmann::json& list = at(key);
  if (!list.is_array()) throw Error(fmt::format("\"{}\" is no list", key));
  std::int32_t bits = 0;
  for (std::size_t k = 0; k < names.size(); ++k)
    if (std::find(list.begin(), list.end(), names[k]) != list.end()) bits |= 1 << k;
  return bits;
}

std::vector<ChannelHeader> Header::channels() const {
  std::vector<ChannelHeader> result;
  if (!has("channels")) return result;
  for (const nlohmann::json& channel : at("channels")) {
    const Header c(channel.dump());
    const int rule = c.choice("rule", data::kChannelRules);
    result.push_back({static_cast<std::int32_t>(c.integer("components", 1, data::kMostComponents)),
                      static_cast<lc_channel_rule>(rule), c.integer("values", 0, INT32_MAX)});
  }
  return result;
}

void Header::refuse_unless_ok() const {
  const auto status = static_cast<lc_status>(choice("status", kStatusWords));
  if (status == LC_OK) return;
  const std::string message = has("message") ? text("message") : "";
  throw SubjectError(status, message.empty() ? "no reason was given" : printable(message, 1000));
}

Header read_header(Source& source) {
  return Header(source.line(kLongestHeader));
}

}  // namespace limitcheck::verify::protocol
