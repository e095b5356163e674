// SPDX-License-Identifier: MIT
// Lines and words of a text, each error with its line. Independent of the locale.
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>

namespace limitcheck::data::io {

/// Walks through the lines of a text (ended by LF, CR LF or CR), and through the words of each.
class TextScanner {
 public:
  /// A byte-order mark at the beginning is skipped. `comment` begins a comment up to the end of the line; 0
  /// for none. `continuation` joins a line ending in \ with the next.
  TextScanner(std::string_view text, std::string name, char comment, bool continuation = false)
      : text_(text),
        name_(std::move(name)),
        comment_(comment),
        continuation_(continuation),
        next_(text.starts_with("\xEF\xBB\xBF") ? 3 : 0) {}

  /// Goes to the next line that has words. False at the end of the text.
  bool next_line();

  /// The next word of the line; empty at its end.
  std::string_view word();
  std::string_view peek() const { return rest_.substr(0, word_length()); }  ///< the same, without passing it

  /// The next word as a number (nan and inf included: the validator reports them). Throws FILE_SYNTAX; `what`
  /// names it.
  double number(std::string_view what);
  std::int64_t integer(std::string_view what);
  /// Passes the rest of the line, at most so many numbers, and says how many. Throws FILE_SYNTAX: it has more, or
  /// other words.
  int pass_numbers(int most);

  /// Throws FILE_SYNTAX if the line has more words.
  void end_of_line();

  std::int64_t line() const { return line_; }   ///< from 1
  std::size_t offset() const { return next_; }  ///< of the first byte after the line
  [[noreturn]] void syntax_error(const std::string& message) const;
  [[noreturn]] void fail(const std::string& code, const std::string& message) const;
  [[noreturn]] void truncated(const std::string& message) const;  ///< at the end of the text

 private:
  std::string_view raw_line();
  std::string_view without_comment(std::string_view line) const;
  std::size_t word_length() const;
  std::string_view word_due(std::string_view what);

  std::string_view text_;
  std::string name_;
  char comment_;
  bool continuation_;
  std::size_t next_;       // where the next line begins
  std::int64_t line_ = 0;  // number of the current line, the first of those joined
  std::int64_t lines_read_ = 0;
  std::string_view rest_;  // of the current line
  std::string joined_;     // holds the current line if it was continued
};

/// The whole of `word` as a number, correctly rounded; too large is infinite, too small is zero. Empty if it
/// is not one.
std::optional<double> to_double(std::string_view word);
std::optional<std::int64_t> to_integer(std::string_view word);

/// Whether a list has a word.
template <class List>
bool contains(const List& list, std::string_view word) {
  return std::find(std::begin(list), std::end(list), word) != std::end(list);
}

/// A word for a message: shortened, unprintable characters replaced.
std::string quoted(std::string_view word);

}  // namespace limitcheck::data::io
