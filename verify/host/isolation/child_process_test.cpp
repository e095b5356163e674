// SPDX-License-Identifier: MIT
// Whatever happens to the process: no zombie, no open pipe, no signal for the host.
#include "verify/host/isolation/child_process.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>

namespace {

using namespace limitcheck::verify;
using Kind = SubjectDied::Kind;

[[maybe_unused]] const bool kKept = (use_keeper(LIMITCHECK_KEEPER), true);  // of all tests of this program

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

TEST_F(Process, LeavesAReceiptOfWhatItTook) {
  Receipt receipt;
  {
    // Holds 60 MB for a moment between two looks; then one process more than itself.
    ChildProcess child(
        sh("python3 -c 'x = bytes([1]) * 60000000'; sleep 1000 & echo here; read line; echo ok"), {},
        &receipt);
    child.ask("?\n");
    EXPECT_EQ(child.line(100), "here");
    EXPECT_GE(receipt.most_at_once, 2);
    EXPECT_EQ(child.line(100), "ok");
    child.finish();
  }
  {
    ChildProcess child(
        sh("exec python3 -c 'x = bytes([1]) * 60000000; del x; print(1, flush=True); input()'"), {},
        &receipt);
    EXPECT_EQ(child.line(100), "1");
    EXPECT_GE(receipt.peak_bytes, 60000000) << "though it had it between two looks";
    EXPECT_LT(receipt.peak_bytes, 200000000);
  }
  EXPECT_EQ(receipt.processes, 2);
  EXPECT_EQ(receipt.peak_shared, 0);
  EXPECT_EQ(receipt.crashes + receipt.over_time + receipt.over_memory + receipt.broke_protocol, 0);
  ChildProcess gone(sh("exit 5"), {}, &receipt);
  EXPECT_EQ(kind_of([&] { gone.line(100); }), Kind::kCrash);
  ChildProcess slow(sh("sleep 1000"), {0.3, 4096}, &receipt);
  EXPECT_EQ(kind_of([&] { slow.line(100); }), Kind::kTimeout);
  ChildProcess shares(
      sh("exec python3 -c 'import os, time; f = os.memfd_create(\"m\"); "
         "os.ftruncate(f, 300 << 20); os.posix_fallocate(f, 0, 300 << 20); time.sleep(1000)'"),
      {60, 200}, &receipt);
  EXPECT_EQ(kind_of([&] { shares.line(100); }), Kind::kMemory);
  EXPECT_EQ(receipt.crashes, 1);
  EXPECT_EQ(receipt.over_time, 1);
  EXPECT_EQ(receipt.over_memory, 1);
  EXPECT_GT(receipt.peak_shared, 150 << 20) << "an interpreter itself has less than 50 of the 200 MiB";
  EXPECT_EQ(receipt.processes, 5);
}

TEST_F(Process, ThatCannotBeStartedSaysSo) {
  ChildProcess missing({"/no/such/program"}, {});
  // It may be gone before or after it is asked.
  EXPECT_EQ(kind_of([&] { missing.ask("?"), missing.line(100); }), Kind::kCrash);
  EXPECT_TRUE(missing.not_started());
}

std::string said(const std::string& command) {
  ChildProcess child({"/bin/sh", "-c", command}, {});
  std::string line = child.line(1000);
  child.finish();
  return line;
}

// Of the keeper of a child, while this process has so much more memory than before.
long keeper_mib_beside(std::size_t bytes) {
  void* const large = mmap(nullptr, bytes, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  EXPECT_NE(large, MAP_FAILED);
  const std::string line = said("grep VmSize /proc/$PPID/status");
  munmap(large, bytes);
  return std::stol(line.substr(line.find(':') + 1)) / 1024;
}

TEST_F(Process, HasAKeeperThatHasNothingOfTheMemoryOfThisProgram) {
  EXPECT_LT(keeper_mib_beside(std::size_t{1} << 40), 64);
}

TEST_F(Process, MayHaveALongCommand) {
  for (const std::size_t size : {100, 65000, 66000, 120000})
    EXPECT_EQ(said("echo up #" + std::string(size, 'x')), "up") << size;
}

TEST_F(Process, HasNoDescriptorsButItsOwn) {
  const int open_here = open("/dev/null", O_RDONLY);  // without O_CLOEXEC
  EXPECT_EQ(said("python3 -c 'import os; print(len(os.listdir(\"/proc/self/fd\")))'"),
            "4");  // one is the list's
  EXPECT_EQ(said("exec grep ^SigBlk /proc/self/status"), "SigBlk:\t0000000000000000");
  close(open_here);
}

TEST_F(Process, CannotBeStartedWithoutAKeeper) {
  use_keeper("/no/such/keeper");
  EXPECT_THROW(ChildProcess({"/bin/true"}, {}), HostLacks);
  use_keeper(LIMITCHECK_KEEPER);
}

}  // namespace
