// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>
#include <exception>
#include <set>
#include <string_view>
#include <utility>

#include "data/error.h"
#include "verify/hunt/hunt_plan.h"

namespace limitcheck::verify {
namespace {

constexpr std::size_t kPairs = 64;  // that are tried at most; each is a question to the subject

struct Key {
  std::string name;
  std::vector<std::string> values;
};

bool in_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
}

// "key=one|two|...": what stands behind each "=".
std::vector<Key> keys_in(std::string_view text) {
  std::vector<Key> keys;
  for (std::size_t at = text.find('='); at != std::string_view::npos; at = text.find('=', at + 1)) {
    std::size_t begin = at;
    while (begin > 0 && in_word(text[begin - 1])) --begin;
    Key key{std::string(text.substr(begin, at - begin)), {}};
    for (std::size_t from = at + 1;;) {
      std::size_t end = from;
      while (end < text.size() && in_word(text[end])) ++end;
      if (end > from) key.values.emplace_back(text.substr(from, end - from));
      if (text.substr(from, 1) == "N") key.values = {"1", "2", "3", "4"};
      // "avx2/4" is a word that this does not know
      if (end < text.size() && text[end] == '/' && !key.values.empty()) key.values.pop_back();
      while (end < text.size() && text[end] != '|' && text[end] != ',' && text[end] != ' ') ++end;
      if (end >= text.size() || text[end] != '|') break;
      from = end + 1;
    }
    if (!key.name.empty() && !key.values.empty()) keys.push_back(std::move(key));
  }
  return keys;
}

}  // namespace

std::vector<Way> ways_of(const AuditSubject& subject, const std::vector<data::Scheme>& schemes,
                         const std::vector<std::string>& asked) {
  const char* const text = subject.subject->options;
  std::vector<Key> keys = keys_in(text != nullptr ? text : "");
  for (const std::string& name : asked)
    if (name != "all" && std::none_of(keys.begin(), keys.end(), [&](const Key& k) { return k.name == name; }))
      throw data::ArgumentError(fmt::format("--vary {}: the options of {} are {}", name,
                                            subject.subject->name, text != nullptr ? text : "none"));
  const auto given = [&](const std::string& name) {
    return fmt::format(",{}", subject.options).find(fmt::format(",{}=", name)) != std::string::npos;
  };
  std::erase_if(keys, [&](const Key& k) {
    const bool wanted = std::any_of(asked.begin(), asked.end(),
                                    [&](const std::string& name) { return name == "all" || name == k.name; });
    return !wanted || given(k.name);
  });

  std::vector<Way> ways;
  const auto attempt = [&](const std::string& more) {
    AuditSubject with = subject;
    with.options += (with.options.empty() ? "" : ",") + more;
    Way way{with.options, {}};
    for (const data::Scheme scheme : schemes) try {
        for (const Does& d : does_of(with, scheme)) way.does.push_back(d);
      } catch (const std::exception&) {  // not together, or not for this scheme
      }
    if (!way.does.empty()) ways.push_back(std::move(way));
  };
  std::vector<std::string> pairs;
  for (std::size_t a = 0; a < keys.size(); ++a)
    for (const std::string& x : keys[a].values) {
      attempt(keys[a].name + "=" + x);
      for (std::size_t b = a + 1; b < keys.size(); ++b)
        for (const std::string& y : keys[b].values)
          pairs.push_back(keys[a].name + "=" + x + "," + keys[b].name + "=" + y);
    }
  const std::size_t step = std::max<std::size_t>(1, pairs.size() / kPairs);
  for (std::size_t k = 0; k < pairs.size(); k += step) attempt(pairs[k]);
  return ways;
}

}  // namespace limitcheck::verify
