// SPDX-License-Identifier: MIT
#include "verify/shard/seal.h"

#include <fmt/core.h>
#include <sha2.h>

#include <array>

#include "data/error.h"
#include "data/untrusted_json.h"

namespace limitcheck::verify {
namespace {

std::string digest_of(const nlohmann::json& object) {
  return digest(object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

}  // namespace

std::string digest(std::string_view bytes) {
  SHA2_CTX context;
  SHA256Init(&context);
  SHA256Update(&context, reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  std::array<char, SHA256_DIGEST_STRING_LENGTH> text{};
  SHA256End(&context, text.data());
  return text.data();
}

std::string sealed(const std::string& object_text) {
  return fmt::format("{{\"digest\":\"{}\",{}\n", digest_of(data::parse_untrusted(object_text)),
                     std::string_view(object_text).substr(1));
}

nlohmann::json unsealed(std::string_view text, bool digest_may_lack) {
  return unsealed_object(data::parse_untrusted(text), digest_may_lack);
}

nlohmann::json unsealed_object(nlohmann::json json, bool digest_may_lack) {
  if (!json.is_object()) throw data::ArgumentError("it is no JSON object, or is cut short");
  const auto found = json.find("digest");
  if (found == json.end()) {
    if (digest_may_lack) return json;
    throw data::ArgumentError("it has no digest");
  }
  const nlohmann::json said = *found;
  json.erase(found);
  if (!said.is_string() || said.get_ref<const std::string&>() != digest_of(json))
    throw data::ArgumentError("it was altered or damaged after it was written: its digest is another one");
  return json;
}

}  // namespace limitcheck::verify
