// SPDX-License-Identifier: MIT
// The commands of the program, and kinds of options that several have.
#pragma once

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace limitcheck::cli {

/// The exit codes of every command: stable, scripts rely on them.
enum ExitCode : int {
  kHeld = 0,
  kFindings = 1,
  kBadInput = 2,  // and anything else that stops the program: no memory, no room on the disk
  kSignalled =
      128  // plus the signal's number: an audit ended early, with a partial report; SIGPIPE: nobody reads
};

/// Each adds its commands to the parser; they store what they returned in `exit_code`.
void add_audit(CLI::App& app, int& exit_code);
void add_claims(CLI::App& app, int& exit_code);
void add_eval(CLI::App& app, int& exit_code);
void add_generate(CLI::App& app, int& exit_code);
void add_check(CLI::App& app, int& exit_code);
void add_repair(CLI::App& app, int& exit_code);
void add_hunt(CLI::App& app, int& exit_code);
void add_merge(CLI::App& app, int& exit_code);
void add_mutants(CLI::App& app, int& exit_code);
void add_tessellate(CLI::App& app, int& exit_code);
void add_manual(CLI::App& app, int& exit_code);  // hidden: what the build makes the manual page of

/// Writes to standard output or error, as visible text (verify/row/visible_text.h): all that the program prints goes this
/// way, because names and messages are somebody else's.
void say_text(std::FILE* stream, const std::string& text);
template <class... Values>
void say(std::FILE* stream, fmt::format_string<Values...> format, Values&&... values) {
  say_text(stream, fmt::format(format, std::forward<Values>(values)...));
}
template <class... Values>
void say(fmt::format_string<Values...> format, Values&&... values) {
  say_text(stdout, fmt::format(format, std::forward<Values>(values)...));
}
/// To standard output, broken into lines as wide as the screen (verify/report/columns.h).
void say_lines(const std::string& text);
/// Where this program lies. Throws data::ArgumentError: there is no /proc to tell.
std::filesystem::path program_folder();

/// limitcheck-NAME beside this program, in bench/ of a build tree, or where it is installed. Empty: not built.
std::filesystem::path find_program(const std::string& name);
/// A JSON document, whatever bytes its strings have.
std::string dumped(const nlohmann::ordered_json& json, int indent);

/// For options that are real numbers: "nan" is a number to the parser, and within every range.
extern const CLI::Validator kFinite;
/// For seeds: the parser takes the largest number for a larger one.
extern const CLI::Validator kSeed;

/// An option that is a number from `least` to `most`; --help shows its default.
template <class Number>
CLI::Option* add_number(CLI::App& command, const std::string& names, Number& value, Number least, Number most,
                        const std::string& text) {
  return command.add_option(names, value, text)->check(CLI::Range(least, most))->capture_default_str();
}

/// How many numbers a text "A" or "A:B", with this separator, has; 0: it is something else.
template <class First, class Second>
int read_numbers(const std::string& text, char separator, First& first, Second& second) {
  const char* const last = text.data() + text.size();
  std::from_chars_result read = std::from_chars(text.data(), last, first);
  const bool both = read.ec == std::errc() && read.ptr != last && *read.ptr == separator;
  if (both) read = std::from_chars(read.ptr + 1, last, second);
  return read.ec != std::errc() || read.ptr != last ? 0 : both ? 2 : 1;
}

/// An option whose value --help calls `type`.
template <class Value>
CLI::Option* add_value(CLI::App& command, const std::string& names, Value& value, const char* type,
                       const std::string& text) {
  return command.add_option(names, value, text)->type_name(type);
}

/// The words of the command line for values of a type.
template <class Value>
using Words = std::vector<std::pair<std::string, Value>>;

template <class Value>
std::string word_of(const Words<Value>& words, const Value& value) {
  for (const auto& [word, means] : words)
    if (means == value) return word;
  return "";
}

/// An option that is one of these words. --help shows the one that `value` has, if it has one.
template <class Value>
CLI::Option* add_words(CLI::App& command, const std::string& names, Value& value, const Words<Value>& words,
                       const std::string& text) {
  std::vector<std::string> all;
  for (const auto& [word, means] : words) all.push_back(word);
  const auto take = [&value, words](const std::string& given) {
    for (const auto& [word, means] : words)
      if (word == given) value = means;
  };
  return command.add_option_function<std::string>(names, take, text)
      ->check(CLI::IsMember(all))
      ->default_str(word_of(words, value));
}

}  // namespace limitcheck::cli
