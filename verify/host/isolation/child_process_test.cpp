// SPDX-License-Identifier: MIT
// Whatever happens to the process: no zombie, no open pipe, no signal for the host.
#include "verify/host/isolation/child_process.h"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cerrno>
#include <filesystem>

namespace {

using namespace limitcheck::verify;
using Kind = SubjectDied::Kind;

class Process : public testing::Test {
 protected:
  void SetUp() override { open_before_ = open_files(); }
  void TearDown() override {
    EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "a child is left";
    EXPECT_EQ(errno, ECHILD);
    EXPECT_EQ(open_files(), open_before_);
  }
  static std::ptrdiff_t open_files() {
    const std::filesystem::directory_iterator all("/proc/self/fd");
    return std::distance(begin(all), end(all));
  }
  static std::vector<std::string> sh(const char* command) { return {"/bin/sh", "-c", command}; }

  std::ptrdiff_t open_before_ = 0;
};

Kind kind_of(const auto& work, const char* words = "") {
  try {
    work();
  } catch (const SubjectDied& died) {
    EXPECT_NE(std::string(died.what()).find(words), std::string::npos) << died.what();
    return died.kind();
  }
  ADD_FAILURE() << "lives";
  return Kind::kCrash;
}

TEST_F(Process, AnswersInLinesAndBytesUpToTheLastOne) {
  ChildProcess cat({"/bin/cat"}, {});
  std::string big(1 << 20, 'x');
  for (int turn = 0; turn < 3; ++turn) {
    // A pipe holds 64 KiB, and cat does not wait for the whole: only what fits is asked at once.
    cat.ask("first\n" + big.substr(0, 30000));
    EXPECT_EQ(cat.line(100), "first");
    std::string back(30000, ' ');
    cat.read(std::as_writable_bytes(std::span(back)));
    EXPECT_EQ(back, big.substr(0, 30000));
  }
  cat.finish();
  EXPECT_EQ(kind_of([&] { cat.ask("more"); }), Kind::kCrash);
}

TEST_F(Process, ThatNoLongerReadsDoesNotKillTheHost) {
  ChildProcess deaf(sh("exec 0<&-; exec sleep 1000"), {});
  EXPECT_EQ(kind_of([&] { deaf.ask(std::string(1 << 20, 'x')); }, "closed its standard input"),
            Kind::kProtocol);
  ChildProcess gone(sh("exit 5"), {});
  EXPECT_EQ(kind_of([&] { gone.ask(std::string(1 << 20, 'x')); }, "exit status 5"), Kind::kCrash);
}

TEST_F(Process, ThatHasBrokenDownStaysSo) {
  ChildProcess child(sh("kill -SEGV $$"), {});
  for (int k = 0; k < 2; ++k) EXPECT_EQ(kind_of([&] { child.line(100); }, "SIGSEGV"), Kind::kCrash);
}

TEST_F(Process, IsKilledWhenItsTimeIsOver) {
  ChildProcess slow(sh("trap '' TERM INT; sleep 1000"), {0.3, 4096});
  slow.ask("?");
  EXPECT_EQ(kind_of([&] { slow.line(100); }, "within 0.3 s"), Kind::kTimeout);
  ChildProcess drip(sh("while :; do printf x; sleep 0.05; done"), {0.5, 4096});
  drip.ask("?");
  EXPECT_EQ(kind_of([&] { drip.line(1000); }), Kind::kTimeout) << "the time is for the whole answer";
}

TEST_F(Process, IsKilledWithItsChildrenWhenTheyTakeTooMuchMemory) {
  ChildProcess child(sh("python3 -c 'import time; x = bytes([1]) * (300 << 20); time.sleep(1000)'; :"),
                     {60, 200});
  child.ask("?");
  EXPECT_EQ(kind_of([&] { child.line(100); }, "200 MiB are allowed"), Kind::kMemory);
}

TEST_F(Process, IsGoneWithTheObject) {
  ChildProcess idle(sh("sleep 1000"), {});
}

TEST_F(Process, ThatCannotBeStartedSaysSo) {
  ChildProcess missing({"/no/such/program"}, {});
  // It may be gone before or after it is asked.
  EXPECT_EQ(kind_of([&] { missing.ask("?"), missing.line(100); }), Kind::kCrash);
  EXPECT_TRUE(missing.not_started());
}

}  // namespace
