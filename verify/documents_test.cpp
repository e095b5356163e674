// SPDX-License-Identifier: MIT
// The project's pages link to what is there.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>

namespace {

namespace fs = std::filesystem;

TEST(Documents, LinkOnlyToWhatIsThere) {
  static const std::regex link("\\]\\(([^)#:\\s]+)[^):]*\\)");
  const fs::path root = LIMITCHECK_SOURCE_DIR;
  int links = 0;
  const auto look = [&](const fs::path& page) {
    std::ifstream in(page);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    for (std::sregex_iterator m(text.begin(), text.end(), link), end; m != end; ++m, ++links)
      EXPECT_TRUE(fs::exists(page.parent_path() / (*m)[1].str()))
          << page.lexically_relative(root) << " links to " << (*m)[1];
  };
  look(root / "README.md");
  for (const char* folder : {".github", "bench", "data", "fast", "papers", "reference", "verify"})
    for (auto entry = fs::recursive_directory_iterator(root / folder); entry != fs::end(entry); ++entry) {
      if (entry->path().filename() == "node_modules") entry.disable_recursion_pending();
      if (entry->path().extension() == ".md") look(entry->path());
    }
  EXPECT_GT(links, 20);
}

}  // namespace
