// SPDX-License-Identifier: MIT
#include "data/worst_cases.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "data/untrusted_json.h"

namespace limitcheck::data {

std::filesystem::path data_file(const std::string& name) {
  std::filesystem::path in_source = std::filesystem::path(LIMITCHECK_DATA_IN_SOURCE) / name;
  std::error_code ignored;
  if (std::filesystem::exists(in_source, ignored)) return in_source;
  return std::filesystem::path(LIMITCHECK_DATA_INSTALLED) / name;
}

std::vector<std::string> worst_case_meshes() {
  std::vector<std::string> names;
  for_each_case(data_file("worst_cases.json"), [&](const nlohmann::json& one) {
    std::string name = one.at("mesh");
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(std::move(name));
  });
  return names;
}

}  // namespace limitcheck::data
