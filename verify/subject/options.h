// SPDX-License-Identifier: MIT
// "key=value,key=value", as the plug-in interface passes options.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace limitcheck::verify {

/// The options of a subject. Each is read once by name; `finish` refuses those that were not read. All
/// members throw SubjectError(LC_INVALID_INPUT) with the option and what would be accepted.
class Options {
 public:
  /// nullptr or "": none. "key" without "=", an empty key and a key given twice are refused.
  explicit Options(const char* text);

  /// An integer in [least, most].
  int integer(const std::string& key, int fallback, int least, int most);
  /// One of `choices`; the first is the default. Returns its index.
  int choice(const std::string& key, const std::vector<std::string_view>& choices);
  /// Any text.
  std::string value(const std::string& key, const std::string& fallback);
  /// All options that have not been read yet, as "key=value,key=value", which then count as read: for a
  /// subject that wraps another.
  std::string rest();

  void finish() const;

 private:
  const std::string* find(const std::string& key);
  std::map<std::string, std::string> values_;
  std::set<std::string> read_;
  bool rest_read_ = false;
};

}  // namespace limitcheck::verify
