// SPDX-License-Identifier: MIT
// Every file of malformed/ and wellformed/ does what its name says.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "data/error.h"
#include "data/io/read.h"

namespace limitcheck::data {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_of(const std::string& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(LIMITCHECK_SOURCE_DIR "/data/" + folder))
    files.push_back(entry);
  std::sort(files.begin(), files.end());
  return files;
}

std::string test_name(const testing::TestParamInfo<fs::path>& info) {
  std::string name = info.param.filename().string();
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

// CODE.lineN[.what].extension
class MalformedFile : public testing::TestWithParam<fs::path> {};

TEST_P(MalformedFile, IsRefusedWithTheCodeAndTheLineOfItsName) {
  const fs::path file = GetParam();
  const std::string name = file.filename().string();
  const std::size_t dot = name.find('.');
  ASSERT_EQ(name.substr(dot, 5), ".line");
  try {
    const ControlMesh mesh = read_mesh(file);
    FAIL() << "accepted with " << mesh.positions.size() << " vertices, " << mesh.faces.size() << " faces";
  } catch (const InputError& error) {
    EXPECT_EQ(error.code(), name.substr(0, dot)) << error.what();
    EXPECT_EQ(error.line(), std::stoll(name.substr(dot + 5))) << error.what();
    EXPECT_EQ(error.file(), file.string());
    const std::string place =
        error.line() > 0 ? file.string() + ":" + std::to_string(error.line()) : file.string();
    EXPECT_EQ(std::string(error.what()).rfind(place + ": " + error.code() + ": ", 0), 0u) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
}

INSTANTIATE_TEST_SUITE_P(Files, MalformedFile, testing::ValuesIn(files_of("malformed")), test_name);

// shape.vV.fF[.what].extension
class WellformedFile : public testing::TestWithParam<fs::path> {};

TEST_P(WellformedFile, IsReadWithTheCountsOfItsName) {
  const std::string name = GetParam().filename().string();
  const std::size_t v = name.find(".v"), f = name.find(".f", v);
  ASSERT_NE(f, std::string::npos);
  const ControlMesh mesh = read_mesh(GetParam());
  EXPECT_EQ(mesh.positions.size(), std::stoul(name.substr(v + 2)));
  EXPECT_EQ(mesh.faces.size(), std::stoul(name.substr(f + 2)));
}

INSTANTIATE_TEST_SUITE_P(Files, WellformedFile, testing::ValuesIn(files_of("wellformed")), test_name);

}  // namespace
}  // namespace limitcheck::data
