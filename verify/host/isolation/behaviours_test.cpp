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

// Those with one outcome.
struct BehaviourGroup {
  const char* outcome;  // right, defect, refused, crash, timeout, memory, protocol
  const char* words;    // with which the first of these is told
  // Each THING@PLACE of test_subjects/behaviours.cpp, or THING of test_subjects/behaviours_program.cpp.
  std::vector<const char*> how;
};

const std::vector<BehaviourGroup> kOfLibraries{
    {"right",
     "",
     {"nothing@create",
      "memfd_small@tessellate",
      "child@tessellate",
      "child@destroy",
      "child@unload",
      "deaf_child@tessellate",
      "session_child@tessellate",
      "daemon@tessellate",
      "daemon@unload",
      "stopped_child@tessellate",
      "zombie@tessellate",
      "spinning_thread@tessellate",
      "print@tessellate",
      "write_to_1@destroy",
      "close_standard@tessellate",
      "other_folder@tessellate",
      "no_permissions@tessellate",
      "lower_limits@tessellate",
      "leak@tessellate",
      "shared_children@tessellate",
      "signal_handlers@tessellate",
      "renamed@tessellate",
      "not_a_number@answer",
      "infinite@answer",
      "nothing_at_all@answer"}},
    {"memory",
     "300 MiB are allowed",
     {"memfd_written@tessellate", "memfd_mapped@create", "memory@tessellate", "memory@destroy",
      "memory@unload", "memory_in_a_child@tessellate", "memory_off_a_thread@tessellate",
      "memory_in_a_daemon@tessellate", "memory_in_five@tessellate"}},
    {"crash",
     "SIGSEGV",
     {"segfault@capabilities", "segfault@create", "segfault@tessellate", "segfault@release",
      "segfault@destroy", "segfault@unload", "stack@tessellate", "stack@destroy",
      "crash_in_a_thread@tessellate", "unmap@answer"}},
    {"crash",
     "SIGABRT",
     {"abort@create", "abort@destroy", "abort@unload", "terminate@tessellate", "double_free@tessellate",
      "end_of_thread@tessellate", "throw@unload"}},
    {"crash", "SIGFPE", {"divide@tessellate"}},
    {"crash", "SIGILL", {"illegal@tessellate"}},
    {"crash", "SIGBUS", {"bus@tessellate"}},
    {"crash",
     "exit status 0",
     {"exit0@capabilities", "exit0@create", "exit0@release", "_exit0@tessellate", "_exit0@destroy",
      "_exit0@unload", "quick_exit@tessellate", "quick_exit@destroy", "exit_in_a_thread@tessellate",
      "close_all@tessellate"}},
    {"crash", "exit status 0 before its answer was complete", {"exit0@tessellate", "exit0@destroy"}},
    {"crash", "exit status 3", {"exit3@destroy", "exit3@unload", "_exit3@destroy", "_exit3@unload"}},
    {"crash", "exit status 127", {"_exit127@tessellate", "_exit127@destroy"}},
    {"crash", "SIGTERM", {"raise_term@tessellate"}},
    {"crash", "SIGKILL", {"raise_kill@tessellate", "kill_group@tessellate"}},
    {"crash", "SIGPIPE", {"raise_pipe@tessellate"}},
    {"crash", "SIGUSR1", {"raise_usr1@destroy"}},
    {"crash", "SIGALRM", {"alarm@tessellate"}},
    {"crash", "killed by SIG", {"cpu_limit@tessellate", "heap@tessellate", "free_it@answer"}},
    {"refused", "capabilities() threw: out of luck", {"throw@capabilities"}},
    {"refused", "create() threw: out of luck", {"throw@create"}},
    {"refused", "tessellate() threw: out of luck", {"throw@tessellate"}},
    {"defect", "release() threw", {"throw@release"}},
    {"refused", "destroy() threw: out of luck", {"throw@destroy"}},
    {"refused", "tessellate() threw", {"throw_int@tessellate"}},
    {"refused", "destroy() threw", {"throw_int@destroy"}},
    {"timeout",
     "within 0.4 s",
     {"sleep@capabilities", "sleep@create", "sleep@tessellate", "sleep@release", "sleep@destroy",
      "sleep@unload"}},
    {"timeout",
     "",
     {"spin@tessellate", "stop@tessellate", "stop_group@tessellate", "leave_group@tessellate",
      "own_session@tessellate", "ignore_signals@tessellate", "block_signals@destroy", "deadlock@tessellate",
      "wait_for_input@tessellate", "survive_parent@tessellate", "stop_parent@tessellate",
      "terminate_parent@tessellate"}},
    {"timeout", "its standard error ends in: ", {"flood_errors@tessellate"}},
    {"timeout or crash", "", {"kill_parent@tessellate"}},
    {"memory", "50 are allowed", {"many_processes@tessellate"}},
    {"crash", "exit status", {"close_all@destroy"}},
    {"protocol", "broke the protocol", {"write_to_all@tessellate"}},
    {"protocol", "it writes behind the 72 bytes", {"later_interface"}},
    {"refused", "it writes behind the 96 bytes", {"write_behind_itself@answer"}},
    {"defect", "vertex_count is 1152921504606846976", {"huge_vertex_count@answer"}},
    {"defect", "triangle_count is 9223372036854775807", {"huge_triangle_count@answer"}},
    {"defect", "vertex_count is -1", {"negative_vertices@answer"}},
    {"defect", "triangle_count is -9223372036854775808", {"negative_triangles@answer"}},
    {"defect", "positions", {"one_vertex_more@answer", "misaligned@answer"}},
    {"defect", "positions is NULL", {"no_positions@answer"}},
    {"defect", "triangles is NULL", {"no_triangles@answer"}},
    {"defect", "provenance is NULL", {"no_provenance@answer"}},
    {"defect", "triangle_face is NULL", {"no_faces@answer"}},
    {"defect",
     "positions is not memory from allocate()",
     {"heap_positions@answer", "stack_positions@answer", "wild_positions@answer"}},
    {"defect", "positions and normals", {"same_array@answer"}},
    {"defect", "positions written 8 behind", {"write_8_behind@answer"}},
    {"defect", "positions written 1000 behind", {"write_1000_behind@answer"}},
    {"crash",
     "byte 1097 behind a block of 144 bytes from allocate() was touched",
     {"write_1100_behind@answer"}},
    {"crash", "byte 100001 behind a block of 144 bytes", {"write_100000_behind@answer"}},
    {"defect", "positions written 8 before", {"write_8_before@answer"}},
    {"crash", "byte 9000 in front of a block of 144 bytes", {"write_9000_before@answer"}},
    {"defect", "positions written 6", {"write_a5_behind@answer"}},
    {"crash", "byte 32001 behind a block of 144 bytes", {"read_behind@answer"}},
    {"crash", "behind a block of 144 bytes", {"erase_all@answer"}},
    {"defect", "triangles", {"bad_index@answer"}},
    {"defect", "1 of 8 triangles name a control face that does not exist", {"bad_face@answer"}},
    {"defect", "1 of 6 vertices name a place outside", {"bad_provenance@answer"}},
    {"defect",
     "the subject changed the control mesh",
     {"modify_positions@answer", "modify_triangles@answer"}},
};

const std::vector<BehaviourGroup> kOfPrograms{
    {"right", "", {"nothing", "child", "daemon", "exit3 at end", "tiny_number"}},
    {"crash", "SIGSEGV", {"segfault", "segfault at hello", "segfault at end"}},
    {"crash", "SIGABRT", {"abort at create"}},
    {"crash", "exit status 0 before its answer was complete", {"exit0", "in_the_middle"}},
    {"crash", "exit status 0", {"exit0 at hello"}},
    {"crash", "exit status 3", {"exit3"}},
    {"crash", "exit status 126", {"exit126"}},
    {"crash", "exit status 127", {"exit127", "exit127 at create"}},
    {"crash", "exit status 139", {"exit139 at end"}},
    {"crash", "SIGKILL", {"kill_group"}},
    {"crash", "its standard error: no luck today", {"complain"}},
    {"timeout", "within 0.4 s", {"sleep at hello"}},
    {"timeout",
     "",
     {"sleep at create", "sleep", "sleep at end", "stop", "leave_group", "own_session", "drip"}},
    {"timeout or crash", "", {"kill_parent"}},
    {"timeout", "its standard error ends in: ", {"flood_errors"}},
    {"protocol", "closed its standard input or output", {"deaf", "dumb"}},
    {"memory", "300 MiB are allowed", {"memory", "memory_in_a_daemon"}},
    {"memory", "50 are allowed", {"many_processes"}},
    {"protocol", "where a line with a JSON object belongs it wrote \"hello there\"", {"chatter"}},
    {"protocol", "where a line with a JSON object belongs", {"chatter at hello"}},
    {"protocol", "without a line end", {"no_end_of_line"}},
    {"protocol", "its JSON nests 60000 deep", {"nested"}},
    {"protocol", "its JSON nests 12001 deep", {"nested_value"}},
    {"protocol", "broke the protocol", {"not_utf8"}},
    {"protocol", "wrote more on its standard output than it announced", {"more", "more at end"}},
    {"protocol", "it announces 1000000000000000000 vertices", {"counts_1e18"}},
    {"protocol", "is not an integer", {"counts_negative", "counts_real", "counts_text"}},
    {"protocol", "its answer has no \"vertices\"", {"no_counts"}},
    {"protocol", "vertex 0 is", {"short_row", "long_row", "words"}},
    {"defect", "triangles", {"index_beyond"}},
    {"refused", "no luck", {"failed", "not_supported"}},
    {"protocol", "is none of", {"other_status"}},
};

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
               std::string(LIMITCHECK_TEST_SUBJECTS "/behaviours_") + interface + ".so", kOfLibraries);
  }
}

TEST_P(Behaviours, OfProgramsAreContainedAndToldForWhatTheyAre) {
  expect_all(RemoteSubject::Kind::kProgram, LIMITCHECK_TEST_SUBJECTS "/behaviours", kOfPrograms);
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
