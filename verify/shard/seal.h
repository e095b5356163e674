// SPDX-License-Identifier: MIT
// Records that tell whether they are whole and as they were written: the first key is a digest of all the rest.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace limitcheck::verify {

/// SHA-256 of the bytes, 64 hexadecimal digits.
std::string digest(std::string_view bytes);

/// The text of a JSON object with the key "digest" before its own: the digest of the object without it, its keys in
/// order and without white space. Ends with a new line.
///   indent   as nlohmann::json::dump: -1 for one line
std::string sealed(const std::string& object_text);
template <class Json>
std::string sealed(const Json& object, int indent = -1) {
  return sealed(object.dump(indent, ' ', false, Json::error_handler_t::replace));
}

/// The object without its digest. Throws data::ArgumentError: it is no JSON object, has no digest (unless that
/// may lack, in files of before 0.2), or another one than the text has now.
nlohmann::json unsealed_object(nlohmann::json object, bool digest_may_lack = false);
nlohmann::json unsealed(std::string_view text, bool digest_may_lack = false);

}  // namespace limitcheck::verify
