// SPDX-License-Identifier: MIT
// What the tests of the shader door have in common.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "verify/cli/command_test.h"

namespace limitcheck::cli {

using nlohmann::json;
inline const std::filesystem::path kTemplates =
    std::filesystem::path(LIMITCHECK_SOURCE_DIR) / "verify/subject/examples/shaders";

class ShaderDoor : public CommandTest {
 protected:
  /// A template in which this stands once, changed, as file `wrong.glsl`.
  void plant(const std::string& file, const std::string& right, const std::string& wrong) const {
    std::string text = contents_of(kTemplates / file);
    const std::size_t place = text.find(right);
    ASSERT_NE(place, std::string::npos) << right;
    ASSERT_EQ(text.find(right, place + 1), std::string::npos) << right;
    write("wrong.glsl", text.replace(place, right.size(), wrong));
  }
  json audited(const std::string& arguments, int code) const {
    return json_of("audit --json - --shader " + arguments, code);
  }
  static json row(const json& report, const std::string& check, const std::string& mesh = "quad-torus") {
    for (const json& r : report["results"])
      if (r["check"] == check && r["mesh"] == mesh) return r;
    return {};
  }
  static std::string status(const json& report, const std::string& check,
                            const std::string& mesh = "quad-torus") {
    return row(report, check, mesh).value("status", "no such row");
  }
};

}  // namespace limitcheck::cli
