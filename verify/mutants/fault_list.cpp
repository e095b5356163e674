// SPDX-License-Identifier: MIT
// Reads faults.txt, which is built in.
#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <regex>
#include <sstream>
#include <stdexcept>

#include "verify/mutants/change_rows.h"
#include "verify/mutants/mutant_rules.h"

namespace limitcheck::verify {

extern const char kFaults[];  // generated from it

namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw std::logic_error("faults.txt: " + what);
}

// The words at the end of a line.
void read_words(const std::string& words, Change& c) {
  static const std::map<std::string, bool Change::*> kFlags{
      {"sharp", &Change::sharp},         {"deep", &Change::deep}, {"deaf", &Change::deaf},
      {"some", &Change::on_some_meshes}, {"rare", &Change::rare}, {"process", &Change::of_the_process}};
  std::istringstream in(words);
  for (std::string word; in >> word;) {
    if (const auto flag = kFlags.find(word); flag != kFlags.end())
      c.*(flag->second) = true;
    else if (word == "quads" || word == "both")
      c.on = word == "quads" ? Change::On::kQuads : Change::On::kBoth;
    else if (word.front() == 'C')
      c.claim = word;
    else if (word.starts_with("of="))
      c.of = word.substr(3);
    else if (word.find('=') != std::string::npos)
      c.options = word;
    else
      refuse("what is " + word + "?");
  }
}

const std::vector<Change>& section(const std::string& name) {
  static const std::map<std::string, std::vector<Change>> all = [] {
    static const std::regex line_of(R"((\S+) \| (\S*) \| ([^|]+?)(?: \| (.*))?)");
    std::map<std::string, std::vector<Change>> sections;
    std::istringstream in(kFaults);
    std::string to;
    std::smatch part;
    for (std::string line; std::getline(in, line);) {
      if (line.starts_with('[')) to = line;
      if (line.empty() || line.starts_with('#') || line == to) continue;
      if (!std::regex_match(line, part, line_of)) refuse("no name, row and description: " + line);
      Change& c = sections[to].emplace_back();
      c.name = part.str(1), c.check = part.str(2), c.description = part.str(3);
      read_words(part.str(4), c);
    }
    return sections;
  }();
  return all.at(name);
}

}  // namespace

Change rows::row(std::string_view name) {
  const std::vector<Change>& all = section("[faults and habits]");
  const auto found = std::ranges::find(all, name, &Change::name);
  if (found == all.end()) refuse(fmt::format("no line of {}", name));
  return *found;
}

std::span<const Change> mutations(data::Scheme scheme) {
  return section(scheme == data::Scheme::kLoop ? "[rules of loop]" : "[rules of catmull-clark]");
}

}  // namespace limitcheck::verify
