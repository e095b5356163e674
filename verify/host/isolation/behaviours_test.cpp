// SPDX-License-Identifier: MIT
// Everything that we can think of that a library may do to its host, in each function it has: each is
// contained and told for what it is, and leaves no process, no open pipe and no file behind. With a namespace
// and without.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "data/shapes.h"
#include "data/test_support/assertions.h"
#include "verify/host/host.h"
#include "verify/host/isolation/remote_subject.h"
#include "verify/host/isolation/test_subjects/behaviours_table.h"

namespace limitcheck::verify {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMark = "LIMITCHECK_BEHAVIOURS_TEST";

// What came of it, in a word, and the message.
struct Outcome {
  std::string word;
  std::string message;
};

Outcome outcome_of(const RemoteSubject& remote, const std::string& options) {
  static const char* const kDied[] = {"crash", "timeout", "memory", "protocol"};
  try {
    Session session(remote.subject(), data::octahedron(), options);
    const Tessellation t = session.tessellate(0);
    session.close();
    if (!t.defects().empty()) return {"defect", t.defects()[0].message};
    if (t.overruns().empty()) return {"right", ""};
    const Overrun& o = t.overruns()[0];
    return {"defect",
            o.array + " written " + std::to_string(o.distance) + (o.before ? " before" : " behind")};
  } catch (const SubjectDied& error) {
    return {kDied[static_cast<int>(error.kind())], error.what()};
  } catch (const SubjectError& error) {
    return {"refused", error.what()};
  }
}

// Processes with the mark of this one in their environment, alive. Other tests run at the same time.
std::vector<std::string> strays() {
  const std::string mark = kMark + ("=" + std::to_string(getpid())) + '\0';
  std::vector<std::string> found;
  std::error_code error;
  for (fs::directory_iterator p("/proc", error), end; !error && p != end; p.increment(error)) {
    std::ifstream environment(p->path() / "environ", std::ios::binary), stat(p->path() / "stat");
    const std::string text{std::istreambuf_iterator<char>(environment), {}};
    std::string state;
    std::getline(stat, state);
    const std::size_t name_end = state.rfind(") ");
    const bool dead =
        name_end != std::string::npos && std::string("ZX").find(state[name_end + 2]) != std::string::npos;
    if (text.find(mark) != std::string::npos && !dead) found.push_back(p->path().filename());
  }
  return found;
}

std::ptrdiff_t open_files() {
  const fs::directory_iterator all("/proc/self/fd");
  return std::distance(begin(all), end(all));
}

class Behaviours : public testing::TestWithParam<bool> {
 protected:
  void SetUp() override {
    const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string("limitcheck-") + test.test_suite_name() + test.name();
    for (char& c : name) c = c == '/' ? '-' : c;
    folder_ = fs::temp_directory_path() / name;
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    before_ = fs::current_path();
    fs::current_path(folder_);
    setenv(kMark, std::to_string(getpid()).c_str(), 1);
    settings_.worker = LIMITCHECK_WORKER;
    settings_.limits.memory_mib = 300;
    settings_.limits.processes = 50;
    settings_.limits.namespaces = GetParam();
  }
  void TearDown() override {
    unsetenv(kMark);
    fs::current_path(before_);
    fs::remove_all(folder_);
  }

  void expect_all(RemoteSubject::Kind kind, const std::string& what,
                  const std::vector<BehaviourGroup>& table) {
    open_before_ = open_files();
    int seen = 0;
    for (const BehaviourGroup& b : table)
      for (const std::string how : b.how) {
        SCOPED_TRACE(how);
        expect(kind, what, how, b.outcome, b.words);
        ++seen;
      }
    EXPECT_GE(seen, kind == RemoteSubject::Kind::kProgram ? 40 : 100);
  }
  void expect(RemoteSubject::Kind kind, const std::string& what, const std::string& how,
              const std::string& outcome, const char* words) {
    // What hangs need not hang long. What does not has all the time it needs on a busy machine.
    settings_.limits.seconds = says(outcome, "timeout") ? 0.4 : 60;
    const bool program = kind == RemoteSubject::Kind::kProgram;
    const RemoteSubject remote(kind, program ? "exec " + what + " " + how : what, settings_);
    const Outcome got = outcome_of(remote, program ? "" : "behaviour=" + how);
    EXPECT_TRUE(says(outcome, got.word)) << got.message;
    if (outcome.starts_with(got.word)) {
      EXPECT_TRUE(says(got.message, words));
    }
    EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "leaves a child";
    EXPECT_EQ(open_files(), open_before_) << "leaves a pipe";
    EXPECT_TRUE(fs::is_empty(folder_)) << "leaves a file";
    expect_no_strays();
  }
  // They are dead when the call returns, or doomed: the kernel may take its time to bury them.
  static void expect_no_strays() {
    std::vector<std::string> left = strays();
    for (int k = 0; k < 200 && !left.empty(); ++k, left = strays())
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_EQ(left, std::vector<std::string>{});
  }

  fs::path folder_, before_;
  IsolationSettings settings_;
  std::ptrdiff_t open_before_ = 0;
};

TEST_P(Behaviours, OfLibrariesAreContainedAndToldForWhatTheyAre) {
  for (const char* interface : {"1", "2"}) {
    SCOPED_TRACE(interface);
    expect_all(RemoteSubject::Kind::kLibrary,
               std::string(LIMITCHECK_TEST_SUBJECTS "/behaviours_") + interface + ".so",
               library_behaviours());
  }
}

TEST_P(Behaviours, OfProgramsAreContainedAndToldForWhatTheyAre) {
  expect_all(RemoteSubject::Kind::kProgram, LIMITCHECK_TEST_SUBJECTS "/behaviours", program_behaviours());
}

// Nobody is left to clean up after whom SIGKILL ends.
TEST_P(Behaviours, EndWithTheHostHoweverItEnds) {
  const pid_t host = fork();
  if (host == 0) {
    ChildProcess child(
        {"/bin/sh", "-c", "sleep 1000 & setsid sleep 1000 & (setsid sleep 1000 &) ; echo up; wait"},
        settings_.limits);
    child.line(100);
    raise(SIGKILL);
  }
  waitpid(host, nullptr, 0);
  expect_no_strays();
}

INSTANTIATE_TEST_SUITE_P(Held, Behaviours, testing::Bool(),
                         [](const auto& of) { return of.param ? "InANamespace" : "ByASubreaper"; });

}  // namespace
}  // namespace limitcheck::verify
