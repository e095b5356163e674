// SPDX-License-Identifier: MIT
// USD as text, word by word. Private to usda.cpp.
#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "data/error.h"
#include "data/io/text_scanner.h"

namespace limitcheck::data::io {

struct UsdToken {
  enum class Kind { kEnd, kWord, kText, kMark } kind = Kind::kEnd;
  std::string_view text;  // of a text without its quotes
  std::int64_t line = 0;
  bool is(std::string_view mark) const { return kind == Kind::kMark && text == mark; }
};

// Words are names, numbers and paths; marks are brackets, '=', ',' and ';'.
class UsdWords {
 public:
  UsdWords(std::string_view content, std::string name) : content_(content), name_(std::move(name)) {
    if (!content_.starts_with("#usda "))
      fail("FILE_UNSUPPORTED", "it does not begin with #usda: only USD as text is read");
    pass();
  }

  const UsdToken& next() const { return next_; }
  UsdToken take() {
    const UsdToken taken = next_;
    pass();
    return taken;
  }
  bool take_if(std::string_view mark) {
    const bool there = next_.is(mark);
    if (there) pass();
    return there;
  }
  void need(std::string_view mark) {
    if (!take_if(mark)) syntax_error(fmt::format("'{}' is missing before {}", mark, said(next_)));
  }
  static std::string said(const UsdToken& token) {
    return token.kind == UsdToken::Kind::kEnd ? "the end" : io::quoted(token.text);
  }
  [[noreturn]] void fail(const char* code, const std::string& why, std::int64_t line = -1) const {
    throw InputError(code, name_, line < 0 ? line_ : line, why);
  }
  [[noreturn]] void syntax_error(const std::string& why) const { fail("FILE_SYNTAX", why, next_.line); }

 private:
  void pass() {
    skip_blanks();
    next_ = {UsdToken::Kind::kEnd, {}, line_};
    if (at_ == content_.size()) return;
    const char c = content_[at_];
    if (c == '"' || c == '\'') return pass_text(c);
    if (c == '@' || c == '<') return pass_text(c == '<' ? '>' : c);
    std::size_t end = at_ + 1;
    next_.kind = UsdToken::Kind::kMark;
    if (is_of_a_word(c)) {
      next_.kind = UsdToken::Kind::kWord;
      while (end < content_.size() && is_of_a_word(content_[end])) ++end;
      if (content_.substr(end, 2) == "[]") end += 2;  // of a type
    }
    next_.text = content_.substr(at_, end - at_);
    at_ = end;
  }
  void skip_blanks() {
    while (at_ < content_.size()) {
      const char c = content_[at_];
      if (c == '#')
        at_ = std::min(content_.find('\n', at_), content_.size());
      else if (std::isspace(static_cast<unsigned char>(c)) != 0)
        line_ += content_[at_++] == '\n';
      else
        break;
    }
  }
  // Between quotes, or three quotes each, in which a backslash hides one.
  void pass_text(char quote) {
    const std::string three(3, quote);
    const std::string_view end = content_.substr(at_).starts_with(three)
                                     ? std::string_view(three)
                                     : std::string_view(three).substr(0, 1);
    const std::size_t begin = at_ + end.size();
    std::size_t k = begin;
    for (;; ++k) {
      if (k >= content_.size()) fail("FILE_TRUNCATED", "the file ends within a text", next_.line);
      if (content_.substr(k, end.size()) == end) break;
      if (content_[k] == '\\' && k + 1 < content_.size()) ++k;
      line_ += content_[k] == '\n';
    }
    next_.kind = UsdToken::Kind::kText;
    next_.text = content_.substr(begin, k - begin);
    at_ = std::min(k + end.size(), content_.size());
  }
  static bool is_of_a_word(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || std::string_view("_:.+-").find(c) < 5 ||
           static_cast<unsigned char>(c) >= 0x80;
  }

  std::string_view content_;
  std::string name_;
  std::size_t at_ = 0;
  std::int64_t line_ = 1;
  UsdToken next_;
};

}  // namespace limitcheck::data::io
