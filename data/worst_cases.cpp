// SPDX-License-Identifier: MIT
#include "data/worst_cases.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "data/error.h"
#include "data/known_answers.h"

namespace limitcheck::data {

std::vector<std::string> worst_case_meshes() {
  const auto file = known_answers_path().parent_path() / "worst_cases.json";
  std::ifstream stream(file);
  if (!stream) throw InputError("FILE_CANNOT_OPEN", file.string(), 0, "cannot be opened for reading");
  std::vector<std::string> names;
  try {
    const auto json = nlohmann::json::parse(stream);
    for (const auto& one : json.at("cases")) {
      const std::string name = one.at("mesh");
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
  } catch (const std::exception& error) {
    throw InputError("FILE_SYNTAX", file.string(), 0, error.what());
  }
  return names;
}

}  // namespace limitcheck::data
