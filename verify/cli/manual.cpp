// SPDX-License-Identifier: MIT
// The manual page: the same tables as --help, written for man. The build fills the page's frame
// (verify/package/limitcheck.1.in) with it.
#include <algorithm>
#include <fstream>
#include <iostream>
#include <memory>
#include <sstream>

#include "data/error.h"
#include "verify/cli/commands.h"

namespace limitcheck::cli {
namespace {

// Text as troff takes it: a '-' that can be copied, a '.' that begins no request.
std::string plain(const std::string& text) {
  std::string out = text.starts_with('.') || text.starts_with('\'') ? "\\&" : "";
  for (const char c : text) {
    if (c == '-' || c == '\\') out += '\\';
    out += c == '\\' ? 'e' : c;
  }
  return out;
}

std::string bold(const std::string& text) {
  return "\\fB" + plain(text) + "\\fR";
}
std::string italic(const std::string& text) {
  return "\\fI" + plain(text) + "\\fR";
}

std::string sentence(const std::string& text) {
  return plain(text) + (text.ends_with('.') ? "\n" : ".\n");
}

// Of an option: what its value is called, and in words what is required of it, from "INT:INT in [0 - 12]" or
// "TEXT:{loop,warren}".
struct Value {
  std::string name, range;
};

Value value_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t colon = type.find(':');
  if (option.get_items_expected_max() == 0 || type.empty()) return {};
  Value value{italic(type.substr(0, colon)), ""};
  if (colon == std::string::npos) return value;
  const std::string condition = type.substr(colon + 1);
  const std::size_t from = condition.find('['), to = condition.find(" - "), end = condition.find(']');
  if (condition.starts_with('{') && type.starts_with("TEXT:")) {
    std::vector<std::string> choices = CLI::detail::split(condition.substr(1, condition.find('}') - 1), ',');
    std::ranges::transform(choices, choices.begin(), italic);
    value.name = CLI::detail::join(choices, "|");
  } else if (from < to && to < end && end != std::string::npos) {
    value.range = condition.substr(from + 1, to - from - 1) + " to " + condition.substr(to + 3, end - to - 3);
  }
  return value;
}

std::string option_entry(const CLI::Option& option) {
  std::string names;
  for (const auto& [dashes, list] :
       {std::pair("-", option.get_snames()), std::pair("--", option.get_lnames())})
    for (const std::string& name : list) names += (names.empty() ? "" : ", ") + bold(dashes + name);
  const Value value = value_of(option);
  std::string notes = value.range;
  const std::string standard = value.name.empty() ? "" : option.get_default_str();
  if (!standard.empty() && standard != "-") notes += (notes.empty() ? "default " : ", default ") + standard;
  return ".TP\n" + names + (value.name.empty() ? "" : " " + value.name) + "\n" +
         sentence(option.get_description() + (notes.empty() ? "" : " (" + notes + ")"));
}

// What stands below the options; lines that begin with a blank are a table.
std::string footer_text(const std::string& footer) {
  const bool table = footer.find("\n ") != std::string::npos;
  std::string out = table ? ".PP\n.nf\n" : "";
  std::istringstream lines(footer);
  for (std::string line; std::getline(lines, line);) out += (table ? "" : ".PP\n") + plain(line) + "\n";
  return table ? out + ".fi\n" : out;
}

std::vector<const CLI::App*> commands(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App* c) { return !c->get_group().empty(); });
}

std::vector<const CLI::Option*> positionals(const CLI::App& command) {
  return command.get_options([](const CLI::Option* o) { return o->get_positional(); });
}

std::string synopsis(const CLI::App& command) {
  std::string out = ".B limitcheck " + plain(command.get_name()) + "\n[" + italic("options") + "]";
  for (const CLI::Option* option : command.get_options())
    if (option->get_required() && option->nonpositional())
      out += " " + bold("-" + option->get_snames().front()) + " " + value_of(*option).name;
  for (const CLI::Option* option : positionals(command)) {
    const std::string name =
        italic(option->get_name(true)) + (option->get_items_expected_max() > 1 ? "..." : "");
    out += option->get_required() ? " " + name : " [" + name + "]";
  }
  return out + "\n.br\n";
}

std::string section(const CLI::App& command, const std::string& common_footer) {
  std::string out =
      ".SS limitcheck " + plain(command.get_name()) + "\n" + sentence(command.get_description());
  if (command.get_help_ptr() == nullptr)
    return out + "A program of its own:\n" + bold("limitcheck " + command.get_name() + " --help") +
           "\ntells its options.\n";
  for (const Example& e : examples_of(command.get_name()))
    out += ".TP\n" + bold(std::string(e.line)) + "\n" + sentence(std::string(e.purpose));
  for (const CLI::Option* option : positionals(command))
    out += ".TP\n" + italic(option->get_name(true)) + "\n" + sentence(option->get_description());
  for (const std::string& group : command.get_groups()) {
    const auto options = command.get_options([&](const CLI::Option* o) {
      return o->get_group() == group && o->nonpositional() && o != command.get_help_ptr();
    });
    if (group.empty() || options.empty()) continue;
    if (group != "Options") out += ".PP\n" + plain(group) + ":\n";
    for (const CLI::Option* option : options) out += option_entry(*option);
  }
  return command.get_footer() == common_footer ? out : out + footer_text(command.get_footer());
}

}  // namespace

void add_manual(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("manual", "Fill the frame of the manual page");
  command->group("");
  const auto frame = std::make_shared<std::string>();
  command->add_option("FRAME", *frame, "limitcheck.1.in")->required();
  command->callback([&app, frame, &exit_code] {
    std::ifstream in(*frame);
    if (!in) throw data::ArgumentError("cannot read " + *frame);
    for (std::string line; std::getline(in, line);) {
      if (line == "@SYNOPSIS@")
        for (const CLI::App* c : commands(app)) std::cout << synopsis(*c);
      else if (line == "@COMMANDS@")
        for (const CLI::App* c : commands(app)) std::cout << section(*c, app.get_footer());
      else if (const std::size_t at = line.find("@VERSION@"); at != std::string::npos)
        std::cout << line.replace(at, 9, LIMITCHECK_VERSION) << "\n";
      else
        std::cout << line << "\n";
    }
    exit_code = kHeld;
  });
}

}  // namespace limitcheck::cli
