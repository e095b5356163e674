// SPDX-License-Identifier: MIT
#include "verify/claims/register.h"

#include <fmt/core.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

namespace limitcheck::verify {

extern const char kClaimRegister[];  // generated from claims.json

const std::vector<Claim>& claim_register() {
  static const std::vector<Claim> claims = [] {
    const auto json = nlohmann::json::parse(kClaimRegister);
    std::vector<Claim> list;
    for (const auto& row : json["claims"]) {
      const auto text = [&](const char* key) { return row.value(key, std::string()); };
      Claim c{text("id"),   text("place"),   text("statement"), text("verdict"),
              text("note"), text("finding"), text("why"),       {}};
      if (!row["check"].is_null()) c.check = row["check"].get<std::vector<std::string>>();
      list.push_back(std::move(c));
    }
    return list;
  }();
  return claims;
}

std::vector<std::pair<std::string, std::int64_t>> count_verdicts(const std::vector<const Claim*>& claims) {
  std::vector<std::pair<std::string, std::int64_t>> counts;
  const auto json = nlohmann::ordered_json::parse(kClaimRegister);
  for (const auto& item : json["verdicts"].items())
    counts.emplace_back(item.key(), std::count_if(claims.begin(), claims.end(),
                                                  [&](const Claim* c) { return c->verdict == item.key(); }));
  return counts;
}

std::string_view word(ClaimOutcome outcome) {
  switch (outcome) {
    case ClaimOutcome::kHeld:
      return "held";
    case ClaimOutcome::kNotHeld:
      return "not held";
    case ClaimOutcome::kNotRun:
      return "not run";
    case ClaimOutcome::kNotCheckable:
      return "not checkable";
  }
  return "not run";
}

std::vector<std::filesystem::path> claim_programs(const std::filesystem::path& folder) {
  namespace fs = std::filesystem;
  const fs::path home = folder.empty() ? fs::read_symlink("/proc/self/exe").parent_path() : folder;
  std::vector<fs::path> programs;
  std::ifstream in(home / "claims_programs.txt");
  for (std::string line; std::getline(in, line);)
    if (!line.empty() && fs::exists(home / line)) programs.push_back(home / line);
  return programs;
}

std::string errata() {
  std::string out =
      "# Errata\n\nK. Müller and S. Havemann, \"Subdivision Surface Tessellation on the Fly using a "
      "versatile Mesh Data\nStructure\", 2000. Written by `limitcheck claims --errata` from the register of "
      "claims; each line has tests\nthat re-derive it (`limitcheck claims ID`).\n";
  const struct {
    const char *verdict, *title, *column;
  } sections[]{{"misprint", "Wrong as printed", "correction"},
               {"refuted", "Not true", "what is true"},
               {"depends", "True or not by what is left open", "on what it depends"},
               {"ambiguous", "Left open by the text", "what is missing, and our reading"}};
  const auto cell = [](std::string text) {
    for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2)
      text.insert(at, 1, '\\');
    return text;
  };
  for (const auto& section : sections) {
    out += fmt::format("\n## {}\n\n| id | place | claim, in our words | {} |\n|---|---|---|---|\n",
                       section.title, section.column);
    for (const Claim& c : claim_register()) {
      if (c.verdict != section.verdict) continue;
      out += fmt::format("| {} | {} | {} | {} |\n", c.id, cell(c.place), cell(c.statement), cell(c.note));
    }
  }
  return out;
}

}  // namespace limitcheck::verify
