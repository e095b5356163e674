// SPDX-License-Identifier: MIT
// For all tests: texts with a part, errors as values, files, and a folder that is gone afterwards.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>

namespace limitcheck {

/// Whether `text` has `part`; the text is printed where that is not as expected.
inline testing::AssertionResult says(const std::string& text, const std::string& part) {
  const bool has = text.find(part) != std::string::npos;
  return (has ? testing::AssertionSuccess() : testing::AssertionFailure()) << '"' << part << "\": " << text;
}

/// The error of this type that the work throws; nothing if it does not.
template <class Error, class Work>
std::optional<Error> thrown(Work&& work) {
  try {
    work();
  } catch (const Error& error) {
    return error;
  }
  return std::nullopt;
}
/// What that error says; "accepted" if there is none.
template <class Error, class Work>
std::string refusal_of(Work&& work) {
  const auto error = thrown<Error>(work);
  return error ? error->what() : "accepted";
}

inline std::string contents_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Of the test that runs, in the folder for temporary files: empty at first, deleted in the end.
class TestFolder {
 public:
  TestFolder() {
    const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string("limitcheck-") + test.test_suite_name() + "-" + test.name();
    for (char& c : name)
      if (c == '/') c = '-';  // of parameterised tests
    path_ = std::filesystem::temp_directory_path() / name;
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~TestFolder() { std::filesystem::remove_all(path_); }
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  std::size_t files() const {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(path_), std::filesystem::directory_iterator{}));
  }

 private:
  std::filesystem::path path_;
};

}  // namespace limitcheck
