// SPDX-License-Identifier: MIT
#include "data/io/text_scanner.h"

#include <fmt/core.h>
#include <locale.h>  // NOLINT(modernize-deprecated-headers): newlocale is POSIX, not C++
#include <stdlib.h>  // NOLINT(modernize-deprecated-headers): strtod_l likewise

#include <charconv>

#include "data/error.h"

namespace limitcheck::data::io {
namespace {

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

}  // namespace

std::optional<double> to_double(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size() || error == std::errc::invalid_argument) return std::nullopt;
  if (error == std::errc::result_out_of_range) {
    // from_chars does not say whether it is too large or too small.
    static const locale_t c_locale = newlocale(LC_ALL_MASK, "C", nullptr);
    return strtod_l(std::string(word).c_str(), nullptr, c_locale);
  }
  return value;
}

std::optional<std::int64_t> to_integer(std::string_view word) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size() || error != std::errc()) return std::nullopt;
  return value;
}

std::string quoted(std::string_view word) {
  std::string text = "\"";
  for (const char c : word.substr(0, 40)) text += c >= ' ' && c <= '~' ? c : '?';
  if (word.size() > 40) text += "...";
  return text + "\"";
}

std::string_view TextScanner::raw_line() {
  const std::size_t end = std::min(text_.find_first_of("\r\n", next_), text_.size());
  const std::string_view line = text_.substr(next_, end - next_);
  next_ = end;
  if (next_ < text_.size()) next_ += text_.substr(next_, 2) == "\r\n" ? 2 : 1;
  ++lines_read_;
  return line;
}

// A comment is not continued, whatever it ends in.
std::string_view TextScanner::without_comment(std::string_view line) const {
  return comment_ == 0 ? line : line.substr(0, line.find(comment_));
}

bool TextScanner::next_line() {
  while (next_ < text_.size()) {
    line_ = lines_read_ + 1;
    rest_ = without_comment(raw_line());
    if (continuation_ && rest_.ends_with('\\')) {
      joined_.clear();
      while (rest_.ends_with('\\') && next_ < text_.size()) {
        joined_.append(rest_.substr(0, rest_.size() - 1)).append(1, ' ');
        rest_ = without_comment(raw_line());
      }
      joined_.append(rest_);
      rest_ = joined_;
    }
    while (!rest_.empty() && is_space(rest_.front())) rest_.remove_prefix(1);
    if (!rest_.empty()) return true;
  }
  rest_ = {};
  return false;
}

std::size_t TextScanner::word_length() const {
  std::size_t length = 0;
  while (length < rest_.size() && !is_space(rest_[length])) ++length;
  return length;
}

std::string_view TextScanner::word() {
  const std::string_view result = peek();
  std::size_t length = result.size();
  while (length < rest_.size() && is_space(rest_[length])) ++length;
  rest_.remove_prefix(length);
  return result;
}

std::string_view TextScanner::word_due(std::string_view what) {
  const std::string_view text = word();
  if (text.empty()) syntax_error(fmt::format("the line ends where {} is due", what));
  return text;
}

double TextScanner::number(std::string_view what) {
  const std::string_view text = word_due(what);
  const auto value = to_double(text);
  if (!value) syntax_error(fmt::format("{} is not a number: {}", what, quoted(text)));
  return *value;
}

std::int64_t TextScanner::integer(std::string_view what) {
  const std::string_view text = word_due(what);
  const auto value = to_integer(text);
  if (!value) syntax_error(fmt::format("{} is not a whole number: {}", what, quoted(text)));
  return *value;
}

int TextScanner::pass_numbers(int most) {
  for (int count = 0;; ++count) {
    const std::string_view text = word();
    if (text.empty()) return count;
    if (count == most || !to_double(text)) syntax_error(fmt::format("unexpected {}", quoted(text)));
  }
}

void TextScanner::end_of_line() {
  if (!rest_.empty()) syntax_error(fmt::format("unexpected {}", quoted(word())));
}

void TextScanner::syntax_error(const std::string& message) const {
  fail("FILE_SYNTAX", message);
}

void TextScanner::fail(const std::string& code, const std::string& message) const {
  throw InputError(code, name_, line_, message);
}

void TextScanner::truncated(const std::string& message) const {
  throw InputError("FILE_TRUNCATED", name_, std::max<std::int64_t>(lines_read_, 1), message);
}

}  // namespace limitcheck::data::io
