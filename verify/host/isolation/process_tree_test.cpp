// SPDX-License-Identifier: MIT
#include "verify/host/isolation/process_tree.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <string>

namespace limitcheck::verify {
namespace {

namespace fs = std::filesystem;

// A /proc of our own making: 1 has the threads 1 and 11; 2 comes off thread 11, 3 off 2; 9 is nobody's.
class ProcessTree : public testing::Test {
 protected:
  void SetUp() override {
    const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
    proc_ = fs::temp_directory_path() / (std::string("limitcheck-process-tree-") + test.name());
    fs::remove_all(proc_);
    process(1, 0), process(2, 1), process(3, 2), process(9, 0);
    write("self/stat", "no number");
  }
  void TearDown() override { fs::remove_all(proc_); }
  void process(int number, int parent) const {
    const std::string folder = std::to_string(number) + "/";
    // The name of a process is its own to choose.
    write(folder + "stat", std::to_string(number) + " (a) S 7 (b) S " + std::to_string(parent) + " 1 1 0");
    write(folder + "statm", "5000 1000 500 1 0 1 0");
    write(folder + "smaps_rollup", "55d0-7ffc ---p 00000000 00:00 0 [rollup]\nRss: 4000 kB\nPss: 1000 kB\n");
  }
  void list_children() const {
    write("thread-self/children", "");
    write("1/task/1/children", "");
    write("1/task/11/children", "2 ");
    write("2/task/2/children", "3 ");
    write("3/task/3/children", "");
  }
  void write(const std::string& name, const std::string& text) const {
    fs::create_directories((proc_ / name).parent_path());
    std::ofstream(proc_ / name) << text;
  }
  std::vector<pid_t> of(pid_t process) const {
    std::vector<pid_t> all = descendants(process, proc_);
    std::sort(all.begin(), all.end());
    return all;
  }
  fs::path proc_;
};

TEST_F(ProcessTree, FollowsParentsWhereTheKernelListsNoChildren) {
  EXPECT_EQ(of(1), (std::vector<pid_t>{2, 3}));
  EXPECT_EQ(of(9), (std::vector<pid_t>{}));
}

TEST_F(ProcessTree, FollowsTheListsOfAllThreadsWhereThereAreSome) {
  list_children();
  fs::remove(proc_ / "2" / "stat");  // not needed then
  EXPECT_EQ(of(1), (std::vector<pid_t>{2, 3}));
  EXPECT_EQ(of(3), (std::vector<pid_t>{}));
}

TEST_F(ProcessTree, CountsPagesThatAreSharedOnceIfItMatters) {
  const auto page = static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
  EXPECT_EQ(held_bytes({2, 3}, 2000 * page, proc_).bytes, 2000 * page);
  EXPECT_EQ(held_bytes({2, 3}, 2000 * page - 1, proc_).bytes, 2U * 1000 << 10);
  fs::remove(proc_ / "3" / "smaps_rollup");  // of another user, say
  EXPECT_EQ(held_bytes({2, 3}, 1, proc_).bytes, (1000U << 10) + 1000 * page);
}

TEST(ProcessTreeHere, KnowsThisProcessFromAnother) {
  EXPECT_EQ(descendants(getpid()), std::vector<pid_t>{});
  const std::vector<pid_t> of_parent = descendants(getppid());
  EXPECT_NE(std::find(of_parent.begin(), of_parent.end(), getpid()), of_parent.end());
}

}  // namespace
}  // namespace limitcheck::verify
