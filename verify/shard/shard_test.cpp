// SPDX-License-Identifier: MIT
#include "verify/shard/shard.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "data/error.h"
#include "data/test_support/assertions.h"
#include "data/untrusted_json.h"

namespace limitcheck::verify {
namespace {

using Json = nlohmann::json;

TEST(Shard, IsNamedFromOneOn) {
  EXPECT_EQ(parse_shard("3/8").index, 2U);
  EXPECT_EQ(parse_shard("3/8").text(), "3/8");
  for (const char* text :
       {"", "0/3", "4/3", "3", "a/b", "1/", "/2", "1/2/3", "-1/2", "1/0", "1/99999999999999999999"})
    EXPECT_THROW(parse_shard(text), data::ArgumentError) << text;
}

// Seven units, two of which go together: unit n has the result 10 n.
Plan plan(const Shard& shard, int seed = 1) {
  return {"limitcheck test", Json{{"seed", seed}}, 7, 2, shard};
}

PartReport part(const Shard& shard) {
  PartReport p{plan(shard), {}, 1.5, "", shard.text() + "\n", ""};
  for (std::size_t unit = 0; unit < 7; ++unit)
    if (p.plan.has(unit)) p.results[unit] = 10 * unit;
  return p;
}

TEST(Part, AllOfThemAreTheWhole) {
  std::vector<PartReport> parts;
  for (const std::uint64_t k : {2U, 0U, 1U}) parts.push_back(read_part(to_json(part({k, 3}))));
  EXPECT_EQ(parts[1].results.size(), 3U) << "units 0, 1 and 6";
  const PartReport whole = joined(parts);
  EXPECT_EQ(whole.results, part({}).results);
  EXPECT_EQ(whole.seconds, 4.5);
  EXPECT_EQ(whole.printed, "1/3\n2/3\n3/3\n");
  EXPECT_TRUE(joined({part({})}).is_complete());
}

std::string why_not(const std::vector<PartReport>& parts) {
  return refusal_of<data::ArgumentError>([&] { (void)joined(parts); });
}

TEST(Part, HasAsManyUnitsAsThePlanDealsToIt) {
  for (std::uint64_t count = 1; count <= 6; ++count)
    for (std::uint64_t k = 0; k < count; ++k)
      for (Plan p = plan({k, count}); p.units <= 13; ++p.units)
        for (p.together = 1; p.together <= 4; ++p.together) {
          std::size_t units = 0;
          for (std::size_t unit = 0; unit < p.units; ++unit) units += p.has(unit);
          EXPECT_EQ(p.size(), units) << p.shard.text() << " " << p.units << " " << p.together;
        }
}

// Of a file that somebody wrote: this must not take as long as the plan has units.
TEST(Part, OfAnEndlessPlanIsIncomplete) {
  PartReport endless = part({1, 2});
  endless.plan.units = endless.plan.together = std::size_t{1} << 60;
  endless.results.clear();
  PartReport first = endless;
  first.plan.shard.index = 0;
  EXPECT_EQ(why_not({endless, first}), "shard 1/2 is incomplete");
}

TEST(Part, IsRefusedWhereTheWholeWouldBeWrong) {
  EXPECT_EQ(why_not({}), "there is nothing to merge");
  EXPECT_EQ(why_not({part({0, 2})}), "shard 2/2 is missing");
  EXPECT_EQ(why_not({part({0, 2}), part({1, 2}), part({0, 2})}), "shard 1/2 is there twice");
  EXPECT_EQ(why_not({part({0, 2}), part({1, 3})}), "shard 2/3 is not of 2 shards");
  PartReport other = part({1, 2});
  other.plan.what["seed"] = 2;
  EXPECT_EQ(why_not({part({0, 2}), other}), "shard 2/2 is of another plan than shard 1/2");
  other = part({1, 2}), other.incomplete = "interrupted by SIGINT";
  EXPECT_EQ(why_not({part({0, 2}), other}), "shard 2/2 is incomplete: interrupted by SIGINT");
  other = part({1, 2}), other.results.erase(3);
  EXPECT_EQ(why_not({part({0, 2}), other}), "shard 2/2 is incomplete");
  other.results[7] = 70;  // as many as it should have
  EXPECT_EQ(why_not({part({0, 2}), other}), "shard 2/2 is incomplete") << "there is no unit 7";
  other.results.erase(7), other.results[3] = 30, other.results[4] = 40;
  EXPECT_EQ(why_not({part({0, 2}), other}), "shard 2/2 is incomplete") << "unit 4 is of the other shard";
  for (const char* text : {"", "[]", "{}", "{\"program\": \"limitcheck audit\", \"results\": []}"})
    EXPECT_THROW(read_part(text), data::ArgumentError) << text;
}

class JournalTest : public testing::Test {
 protected:
  std::string text() const { return contents_of(file_); }

  const TestFolder folder_;
  const std::filesystem::path file_ = folder_ / "journal.jsonl";
};

TEST_F(JournalTest, KnowsWhatWasDoneBeforeTheProgramEnded) {
  EXPECT_THROW(Journal(plan({}), file_, true), data::ArgumentError) << "there is no file";
  {
    Journal journal(plan({}), file_, false);
    journal.keep(0, 5), journal.keep(3, Json::array({1, "x"}));
  }
  std::ofstream(file_, std::ios::app) << "{\"unit\": 4, \"res";  // killed while it wrote
  {
    Journal again(plan({}), file_, true);
    ASSERT_NE(again.recall(0), nullptr);
    EXPECT_EQ(*again.recall(0), Json(5));
    EXPECT_EQ(*again.recall(3), Json::array({1, "x"}));
    EXPECT_EQ(again.recall(4), nullptr);
    again.keep(4, "y");
  }
  EXPECT_THROW(Journal(plan({}, 2), file_, true), data::ArgumentError) << "of another plan";
  EXPECT_THROW(Journal(plan({0, 2}), file_, true), data::ArgumentError) << "of another shard";
  Journal third(plan({}), file_, true);
  EXPECT_EQ(third.results().size(), 3U);
  EXPECT_THROW(Journal(plan({}), file_, true), data::ArgumentError) << "another run is writing it";
  third.remove();
  EXPECT_FALSE(std::filesystem::exists(file_));
}

TEST_F(JournalTest, BeginsAnewWhereTheProgramEndedBeforeItsFirstLineWasWhole) {
  const std::size_t whole = [&] {
    Journal journal(plan({}), file_, false);
    return text().size();
  }();
  for (const std::size_t size : {std::size_t{0}, std::size_t{10}, whole - 1}) {
    std::filesystem::resize_file(file_, size);
    { Journal(plan({}), file_, true).keep(3, 1); }
    const Journal again(plan({}), file_, true);
    EXPECT_EQ(again.results().size(), 1U) << size;
    ASSERT_NE(again.recall(3), nullptr) << size;
  }
}

TEST_F(JournalTest, TouchesNoFileThatIsNotItsOwn) {
  std::ofstream(file_) << "somebody's notes\n";
  EXPECT_THROW(Journal(plan({}), file_, false), data::ArgumentError);
  EXPECT_THROW(Journal(plan({}), file_, true), data::ArgumentError);
  const std::filesystem::path link = file_.string() + "-link";
  std::filesystem::create_symlink(file_, link);
  EXPECT_THROW(Journal(plan({}), link, false), data::ArgumentError);
  EXPECT_THROW(Journal(plan({}), link, true), data::ArgumentError);
  std::filesystem::remove(link);
  EXPECT_EQ(text(), "somebody's notes\n");
}

TEST_F(JournalTest, BelievesNoLineThatWasAltered) {
  {
    Journal journal(plan({}), file_, false);
    for (std::size_t unit = 0; unit < 7; ++unit) journal.keep(unit, Json{{"worst", 1.5 * unit}});
  }
  const std::string whole = text();
  std::vector<std::string> altered;
  const std::size_t second = whole.find('\n') + 1, third = whole.find('\n', second) + 1;
  std::string line = whole.substr(second, third - second);
  altered.push_back(whole + line);  // twice
  line.replace(line.find("\"unit\":0"), 8, "\"unit\":5");
  altered.push_back(whole.substr(0, second) + line);  // the result of another unit
  for (std::size_t k = 0; k < 300; ++k) {
    altered.push_back(whole);
    altered.back()[(k * 7919) % (whole.size() - 1)] ^= static_cast<char>(1 << (k % 7));
  }
  for (const std::string& content : altered) {
    std::ofstream(file_, std::ios::trunc | std::ios::binary) << content;
    try {
      const Journal journal(plan({}), file_, true);
      for (const auto& [unit, result] : journal.results())  // white space was altered, or the end
        ASSERT_EQ(result, (Json{{"worst", 1.5 * static_cast<double>(unit)}})) << content;
    } catch (const data::ArgumentError&) {
    }
  }
}

TEST(Part, BelievesNoBitThatWasAltered) {
  const PartReport before = part({0, 2});
  const std::string text = to_json(before);
  std::size_t accepted = 0;
  for (std::size_t k = 0; k < 10000; ++k) {
    std::string altered = text;
    altered[(k * 7919) % text.size()] ^= static_cast<char>(1 << (k % 8));
    try {
      const PartReport after = read_part(altered);
      ASSERT_EQ(to_json(after), text) << altered;
      ++accepted;
    } catch (const data::ArgumentError&) {
    }
  }
  EXPECT_LT(accepted, 100U) << "the new line at the end, as another white space";
}

TEST(Part, NestedWithoutEndIsRefused) {
  EXPECT_THROW(read_part(std::string(200000, '[')), data::ArgumentError);
  EXPECT_THROW(read_part("{\"shard\":" + std::string(200000, '[') + std::string(200000, ']') + "}"),
               data::ArgumentError);
}

TEST_F(JournalTest, WithoutAFileIsInMemoryOnly) {
  Journal journal(plan({}));
  journal.keep(2, 7);
  EXPECT_EQ(*journal.recall(2), Json(7));
  journal.remove();
  EXPECT_EQ(text(), "");
}

// Of 1e76 a conversion would make anything, of 1.5 one.
TEST(Part, AWholeNumberThatIsNoneOrDoesNotFitIsRefused) {
  for (const char* text : {"1.5", "1e76", "-1", "18446744073709551616", "\"1\"", "true"})
    EXPECT_THROW(data::value_of<std::size_t>(nlohmann::json::parse(text)), data::ArgumentError) << text;
  EXPECT_THROW(data::value_of<std::int32_t>(nlohmann::json::parse("2147483648")), data::ArgumentError);
  EXPECT_EQ(data::value_of<std::int32_t>(nlohmann::json::parse("-2147483648")), INT32_MIN);
}

}  // namespace
}  // namespace limitcheck::verify
