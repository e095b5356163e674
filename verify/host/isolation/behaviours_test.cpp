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
#include "verify/host/host.h"
#include "verify/host/isolation/launcher.h"
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
    settings_.worker = LIMITCHECK_PROGRAM;
    settings_.limits.memory_mib = 300;
    settings_.limits.processes = 50;
    settings_.limits.namespaces = GetParam();
  }
  void TearDown() override {
    unsetenv(kMark);
    fs::current_path(before_);
    fs::remove_all(folder_);
  }

  void expect_all(RemoteSubject::Kind kind, const std::string& what, const std::vector<Behaviour>& table) {
    const std::ptrdiff_t open_before = open_files();
    for (const Behaviour& b : table) {
      // What hangs need not hang long. What does not has all the time it needs on a busy machine.
      const bool hangs = std::string(b.outcome).find("timeout") != std::string::npos;
      settings_.limits.seconds = hangs ? 0.4 : 60;
      const bool program = kind == RemoteSubject::Kind::kProgram;
      const RemoteSubject remote(kind, program ? "exec " + what + " " + b.how : what, settings_);
      const Outcome got = outcome_of(remote, program ? "" : std::string("behaviour=") + b.how);
      EXPECT_NE(std::string(b.outcome).find(got.word), std::string::npos)
          << b.how << ": " << got.word << ", not " << b.outcome << ": " << got.message;
      if (got.word == std::string(b.outcome).substr(0, got.word.size())) {
        EXPECT_NE(got.message.find(b.words), std::string::npos) << b.how << ": " << got.message;
      }
      EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << b.how << " leaves a child";
      EXPECT_EQ(open_files(), open_before) << b.how << " leaves a pipe";
      EXPECT_TRUE(fs::is_empty(folder_)) << b.how << " leaves a file";
      // They are dead when the call returns, or doomed: the kernel may take its time to bury them.
      std::vector<std::string> left = strays();
      for (int k = 0; k < 100 && !left.empty(); ++k, left = strays())
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
      EXPECT_EQ(left, std::vector<std::string>{}) << b.how;
    }
  }

  fs::path folder_, before_;
  IsolationSettings settings_;
};

TEST_P(Behaviours, OfLibrariesAreContainedAndToldForWhatTheyAre) {
  EXPECT_GE(library_behaviours().size(), 100U);
  for (const char* interface : {"1", "2"}) {
    SCOPED_TRACE(interface);
    expect_all(RemoteSubject::Kind::kLibrary,
               std::string(LIMITCHECK_TEST_SUBJECTS "/behaviours_") + interface + ".so",
               library_behaviours());
  }
}

TEST_P(Behaviours, OfProgramsAreContainedAndToldForWhatTheyAre) {
  EXPECT_GE(program_behaviours().size(), 40U);
  expect_all(RemoteSubject::Kind::kProgram, LIMITCHECK_TEST_SUBJECTS "/behaviours", program_behaviours());
}

// Nobody is left to clean up after whom SIGKILL ends.
TEST_P(Behaviours, EndWithTheHostHoweverItEnds) {
  for (const bool launched : {false, true}) {
    const pid_t host = fork();
    if (host == 0) {
      if (launched) use_launcher();
      ChildProcess child(
          {"/bin/sh", "-c", "sleep 1000 & setsid sleep 1000 & (setsid sleep 1000 &) ; echo up; wait"},
          settings_.limits);
      child.line(100);
      raise(SIGKILL);
    }
    waitpid(host, nullptr, 0);
    std::vector<std::string> left = strays();
    for (int k = 0; k < 200 && !left.empty(); ++k, left = strays())
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_EQ(left, std::vector<std::string>{}) << launched;
  }
}

INSTANTIATE_TEST_SUITE_P(Held, Behaviours, testing::Bool(),
                         [](const auto& of) { return of.param ? "InANamespace" : "ByASubreaper"; });

}  // namespace
}  // namespace limitcheck::verify
