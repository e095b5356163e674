// SPDX-License-Identifier: MIT
#include "verify/row/visible_text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "data/splitmix64.h"
#include "verify/report/junit.h"

namespace limitcheck::verify {
namespace {

TEST(VisibleText, ShowsWhatATerminalOrXmlWouldNotTake) {
  const std::string none = "\xef\xbf\xbd";
  const struct {
    std::string is, shown;
  } cases[] = {{"Größe 网格 \U0001f600\n\tx", "Größe 网格 \U0001f600\n\tx"},
               {"\x1b[31mred", "\xe2\x90\x9b[31mred"},  // ESC
               {std::string("\0\r\x7f", 3), "\xe2\x90\x80\xe2\x90\x8d\xe2\x90\xa1"},
               {"caf\xe9.obj", "caf" + none + ".obj"},  // Latin-1
               {"\xc2\x9b"
                "2J",
                none + "2J"},                                     // U+009B opens sequences as ESC [ does
               {"\xef\xbf\xbe|\xef\xb7\x90", none + "|" + none},  // U+FFFE, U+FDD0
               {"\xed\xa0\x80", none + none + none},              // a lone surrogate
               {"\xc0\xaf|\xf4\x90\x80\x80|\xe2\x82",
                none + none + "|" + none + none + none + none + "|" + none + none}};
  for (const auto& [is, shown] : cases) EXPECT_EQ(visible_text(is), shown) << is;
}

TEST(VisibleText, OfAnyBytesIsUtf8WithoutControlCharactersAndStaysAsItIs) {
  data::SplitMix64 random(1);
  for (int k = 0; k < 20000; ++k) {
    std::string bytes(random.next() % 12, '\0');
    for (char& c : bytes)
      c = static_cast<char>(random.next() % 4 == 0 ? random.next() % 0x20 : random.next());
    const std::string shown = visible_text(bytes), xml = xml_text(bytes);
    EXPECT_EQ(visible_text(shown), shown);
    EXPECT_NO_THROW((void)nlohmann::json(shown).dump()) << shown;  // which takes nothing but UTF-8
    EXPECT_NO_THROW((void)nlohmann::json(xml).dump()) << xml;
    const auto is_control = [](char c) {
      return static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t';
    };
    EXPECT_TRUE(std::none_of(shown.begin(), shown.end(), is_control));
    EXPECT_EQ(xml.find_first_of("<>\"\n\t\x1b"), std::string::npos);
  }
}

}  // namespace
}  // namespace limitcheck::verify
