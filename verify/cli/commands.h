// SPDX-License-Identifier: MIT
// The commands of the program, kinds of options that several have, and what limitcheck and the programs that it hands
// commands over to have in common.
#pragma once

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <type_traits>
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

/// The whole of main(): parses, which runs the command, and says what is wrong. Returns the exit code, which the
/// command has stored in `exit_code`.
int run_program(CLI::App& app, int argc, char** argv, const int& exit_code);

/// What the work returns, or kBadInput and a line on standard error where it throws.
int guarded(const std::function<int()>& work);

/// Becomes limitcheck-NAME (find_program), with these arguments, or those of this program. Returns, with an exit code,
/// only if that fails, and says why.
int hand_over(const std::string& name, const std::vector<std::string>& arguments);
int hand_over(const std::string& name);

/// A command line, and what it is for.
struct Example {
  std::string_view line, purpose;
};
/// Of a command, the most usual first: what --help shows besides the options. Each runs as it stands in
/// an empty folder, but for those that name a file or a library of the user's.
std::vector<Example> examples_of(std::string_view command);

/// --help of this program and of all commands that are added from now on: description, examples, options.
void show_examples(CLI::App& app);

/// Puts options of a command together, under a title.
void group(CLI::App& command, const char* title, std::initializer_list<const char*> options);
/// Throws data::ArgumentError, "OPTION why", if one of these is given.
void refuse(const CLI::App& command, std::initializer_list<const char*> options, const std::string& why);

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
/// For what would be taken for not given at all: names from a variable that is not set.
extern const CLI::Validator kNotEmpty;
/// For seeds: the parser takes the largest number for a larger one.
extern const CLI::Validator kSeed;

/// An option that is a number from `least` to `most`; --help shows its default.
template <class Number>
CLI::Option* add_number(CLI::App& command, const std::string& names, Number& value, Number least, Number most,
                        const std::string& text) {
  return command.add_option(names, value, text)->check(CLI::Range(least, most))->capture_default_str();
}

/// An option whose value --help calls `type`; no empty text.
template <class Value>
CLI::Option* add_value(CLI::App& command, const std::string& names, Value& value, const char* type,
                       const std::string& text) {
  CLI::Option* const option = command.add_option(names, value, text)->type_name(type);
  if constexpr (std::is_same_v<Value, std::string>) option->check(kNotEmpty);
  return option;
}

/// An option that is one of these texts; --help shows its default.
inline CLI::Option* add_choice(CLI::App& command, const std::string& names, std::string& value,
                               const std::vector<std::string>& choices, const std::string& text) {
  return command.add_option(names, value, text)->check(CLI::IsMember(choices))->capture_default_str();
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
