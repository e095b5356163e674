// SPDX-License-Identifier: MIT
// Subjects that break down in every way we know of: each is a row with the right status and the input that
// caused it, and the rest of the audit completes. As a user runs it: `limitcheck audit`.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "verify/cli/command_test.h"

namespace limitcheck::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string library(const std::string& name) {
  return "'" LIMITCHECK_TEST_SUBJECTS "/" + name + ".so'";
}

class Breakdown : public CommandTest {
 protected:
  static json row(const json& report, const std::string& mesh, const std::string& check) {
    for (const json& r : report["results"])
      if (r["mesh"] == mesh && r["check"] == check) return r;
    ADD_FAILURE() << "no row for " << mesh << ", " << check;
    return {};
  }
  /// The rows of `mesh` all hold, and there are as many as checks.
  static void expect_held(const json& report, const std::string& mesh) {
    std::size_t rows = 0;
    for (const json& r : report["results"]) {
      if (r["mesh"] != mesh) continue;
      ++rows;
      EXPECT_EQ(r["status"], "held") << r;
    }
    EXPECT_GE(rows, 12U);
  }
  /// What stands behind "again with: limitcheck " in a message.
  static std::string again(const json& row) {
    const std::string message = row["message"], key = "again with: limitcheck ";
    const std::size_t place = message.find(key);
    EXPECT_NE(place, std::string::npos) << message;
    return place == std::string::npos ? "" : message.substr(place + key.size());
  }
  /// The relations between tessellations, which standard adds, have tests of their own.
  json report_of(const std::string& arguments, int code) const {
    return json_of(arguments + " --level quick", code);
  }
  std::set<std::string> files() const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_)) names.insert(entry.path().filename());
    return names;
  }
};

struct Case {
  const char* what;
  const char* check;  // the row that tells
  const char* status;
  const char* words;  // in its message
  const char* limits = "";
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.what;
}

class Hostile : public Breakdown, public testing::WithParamInterface<Case> {};

TEST_P(Hostile, IsAFindingAndTheAuditGoesOn) {
  const Case& c = GetParam();
  const json report =
      report_of("audit " + library("behaviours_2") +
                    " octahedron tetrahedron --depth 1 --json - --options on=octahedron,behaviour=" + c.what +
                    " " + c.limits,
                std::string(c.status) == "held" ? 0 : 1);
  const json told = row(report, "octahedron", c.check);
  EXPECT_EQ(told["status"], c.status) << told;
  if (*c.words != '\0') {
    EXPECT_TRUE(says(told["message"].get<std::string>(), c.words));
  }
  expect_held(report, "tetrahedron");
  if (std::string(c.status) == "held") expect_held(report, "octahedron");

  const json& receipt = report["receipts"].at(0);
  const bool too_large = std::string(c.what) == "memory@tessellate";
  EXPECT_EQ(receipt["over_time"], std::string(c.status) == "timeout" ? 1 : 0);
  EXPECT_EQ(receipt["over_memory"], too_large ? 1 : 0);
  EXPECT_EQ(receipt["crashes"], std::string(c.status) == "crash" && !too_large ? 1 : 0);
  EXPECT_GE(receipt["processes"], 2);
  EXPECT_GE(receipt["peak_bytes"], too_large ? 500 << 20 : 1 << 20);

  // A breakdown is saved, and the command in the message repeats it; nothing else is left behind.
  std::set<std::string> left{".stdout", ".stderr"};
  if (std::string(c.status) == "crash" || std::string(c.status) == "timeout") {
    left.insert("limitcheck-witness");
    const std::string command = again(told);
    EXPECT_NE(command.find(".obj"), std::string::npos) << command;
    const json repeated = report_of(command + " --json -", 1);
    EXPECT_EQ(repeated["results"][0]["status"], c.status) << repeated["results"][0];
  }
  EXPECT_EQ(files(), left);
}

INSTANTIATE_TEST_SUITE_P(
    EachWay, Hostile,
    testing::Values(
        Case{"segfault@tessellate", "tessellates", "crash", "killed by SIGSEGV"},
        Case{"exit0@tessellate", "tessellates", "crash", "exit status 0 before its answer"},
        Case{"segfault@create", "tessellates", "crash", "killed by SIGSEGV"},
        Case{"abort@destroy", "tessellates", "crash", "at the end"},
        Case{"throw@tessellate", "tessellates", "error", "tessellate() threw: out of luck"},
        Case{"sleep@tessellate", "tessellates", "timeout", "no complete answer within 3 s", "--timeout 3"},
        Case{"memory@tessellate", "tessellates", "crash", "500 MiB are allowed", "--memory 500"},
        Case{"leak@tessellate", "tessellates", "held", ""},
        Case{"write_8_before@answer", "written", "finding",
             "positions written 8 bytes in front of its memory"},
        Case{"heap_positions@answer", "written", "finding", "positions is not memory from allocate()"},
        Case{"throw@release", "written", "finding", "release() threw"}),
    [](const auto& of) {
      const std::string what = of.param.what;
      return what.substr(0, what.find('@')) + "_" + what.substr(what.find('@') + 1);
    });

TEST_F(Breakdown, LibrariesThatAreNoSubjectsAreBadInputAndSayWhy) {
  write("text.so", "this is a text\n");
  struct {
    std::string arguments;
    const char* words;
  } const cases[] = {
      {"./missing.so", "there is no such file"},
      {"./text.so", "cannot be loaded as a shared library"},
      {library("no_entry"), "does not export lc_subject_get()"},
      {library("serves_nothing"), "offers no interface from 1 to 2"},
      {library("other_interface"), "was built for interface 43, this program has 2"},
      {library("empty_table"), "has no name, or a function of it is NULL"},
      {library("needs_another_library"), "undefined symbol: function_of_another_library"},
      {"--program no-such-program", "no-such-program: not found"},
      {"naive --timeout 0", "--timeout"},
      {"naive --memory 0", "--memory"},
      {"naive --depths file:missing", "cannot read missing"},
      {"nobody", "shared libraries (./libnobody.so), programs (program:COMMAND) and shaders (shader:FILE)"},
  };
  for (const auto& c : cases) {
    EXPECT_TRUE(says(run("audit " + c.arguments + " tetrahedron", 2).err, c.words)) << c.arguments;
  }
}

TEST_F(Breakdown, ALibraryThatCrashesWhileItIsLoadedIsAFinding) {
  const json report = report_of("audit " + library("crashes_when_loaded") + " tetrahedron --json -", 1);
  EXPECT_EQ(report["results"][0]["status"], "crash");
}

TEST_F(Breakdown, CapabilitiesThatMeanNothingAreAFinding) {
  const json report =
      report_of("audit " + library("behaviours_2") + " octahedron --json - --options behaviour=weights", 1);
  EXPECT_EQ(report["results"][0]["status"], "finding");
  EXPECT_TRUE(says(report["results"][0]["message"].get<std::string>(), "weights is 9"));
}

// What a program may answer wrongly, and what the audit calls it.
TEST_F(Breakdown, ProgramsThatBreakTheProtocolAreFindings) {
  const std::string hello =
      R"({"limitcheck": 1, "status": "ok", "precision": "float64", "weights": "loop", "boundary": "spline", )"
      R"("points": "limit", "max_depth": 9, "normals": true, "per_face_depth": true, "exact_lattice": true})";
  write("hello", hello + "\n" + R"({"status": "ok"})" + "\n");
  struct {
    const char* program;
    const char* status;
    const char* words;
    const char* limits = "--timeout 30";
  } const cases[] = {
      {"echo hello", "finding", "where a line with a JSON object belongs it wrote \"hello\""},
      {"head -c 100000 /dev/zero", "finding", "without a line end"},
      {"echo '{}'", "finding", "does not say \"limitcheck\": 1"},
      {"echo '{\"limitcheck\": 7}'", "finding", "speaks version 7 of the protocol, this program speaks 1"},
      {"exit 0", "crash", "exit status 0 before its answer"},
      {"echo oops >&2; exit 3", "crash",
       "exit status 3 before its answer was complete; its standard error: oops"},
      {"kill -KILL $$", "crash", "killed by SIGKILL"},
      {"head -n 1 hello; exit 127", "crash", "exit status 127 before its answer"},
      {"sleep 1000", "timeout", "within 1 s", "--timeout 1"},
      {"yes >&2", "timeout", "its standard error ends in: ", "--timeout 1"},
      {"cat hello; sleep 1000", "finding", "wrote more on its standard output than it announced"},
      {"head -n 1 hello; exec cat > /dev/null", "finding", "closed its standard input or output"},
      {"answer '{\"status\": \"ok\", \"vertices\": 1000000000000000000, \"triangles\": 1}'", "finding",
       "it announces 1000000000000000000 vertices and 1 triangles"},
      {"answer '{\"status\": \"ok\", \"vertices\": 1e18, \"triangles\": 1}'", "finding",
       "\"vertices\": 1e+18 is not an integer"},
      {"answer '{\"status\": \"ok\", \"vertices\": -1, \"triangles\": 1}'", "finding",
       "\"vertices\": -1 is not an integer"},
      {"answer '{\"status\": \"ok\", \"vertices\": 100, \"triangles\": 1}'; printf 'short'", "crash",
       "exit status 0 before its answer"},
      {"answer '{\"status\": \"failed\", \"message\": \"no luck\"}'", "error", "no luck"},
      {"answer '{\"status\": \"not-supported\", \"message\": \"no luck\"}'", "finding",
       "no luck; its capabilities do not exclude this"},
  };
  // Answers line by line, so that nothing lies in the pipe before it is asked for.
  write("answer",
        "#!/bin/sh\nread q; head -n 1 hello\nread q; head -c 144 >/dev/null; tail -n 1 hello\nread q; echo "
        "\"$1\"\n");
  fs::permissions(folder_ / "answer", fs::perms::owner_all);
  for (const auto& c : cases) {
    std::string program = c.program;
    if (program.starts_with("answer")) program = "./" + program;
    std::string quoted;
    for (const char x : program) quoted += x == '\'' ? std::string("'\\''") : std::string(1, x);
    const json told = json_of("audit --program '" + quoted +
                              "' tetrahedron --depth 0 --level quick --json - " + c.limits)["results"][0];
    EXPECT_EQ(told["status"], c.status) << c.program << "\n" << told;
    EXPECT_TRUE(says(told["message"].get<std::string>(), c.words)) << c.program;
  }
}

// The text payload, spoken by a program that knows the
// octahedron only: its limit is 24/55 of the control point.
TEST_F(Breakdown, AProgramMaySpeakText) {
  write("text.py", R"(import json, sys
def answer(**a): print(json.dumps({'limitcheck': 1, 'status': 'ok', **a}), flush=True)
for line in sys.stdin:
    q = json.loads(line)
    rows = lambda n: [sys.stdin.readline().split() for _ in range(n)]
    if q['request'] == 'capabilities':
        answer(payload='text', precision='float64', weights='loop', boundary='none', points='limit', max_depth=0,
               normals=True, per_face_depth=False, exact_lattice=True)
    elif q['request'] == 'create':
        points, faces = rows(q['vertices']), rows(q['triangles'])
        answer()
    else:
        rows(q['triangles'])
        answer(vertices=len(points), triangles=len(faces))
        for v, p in enumerate(points):
            f = [k for k, t in enumerate(faces) if str(v) in t][0]
            c = faces[f].index(str(v))
            print(*[float(x) * 24 / 55 for x in p], *p, f, int(c == 1), int(c == 2), 1)
        for f, t in enumerate(faces): print(*t, f)
        sys.stdout.flush()
)");
  expect_held(report_of("audit --program 'python3 text.py' octahedron --depth 0 --json -", 0), "octahedron");
}

// Depths that differ are saved beside the mesh.
TEST_F(Breakdown, TheSavedInputHasTheDepthsOfAllFaces) {
  write("die.py", R"(import json, os, sys
for line in sys.stdin.buffer:
    q = json.loads(line)
    if q['request'] == 'capabilities':
        print(json.dumps({'limitcheck': 1, 'status': 'ok', 'precision': 'float32', 'weights': 'loop', 'boundary': 'spline',
              'points': 'limit', 'max_depth': 9, 'normals': True, 'per_face_depth': True, 'exact_lattice': True}), flush=True)
    elif q['request'] == 'create':
        mesh = sys.stdin.buffer.read(24 * q['vertices'] + 12 * q['triangles'])
        print('{"status": "ok"}', flush=True)
    else:
        with open('got', 'ab') as f: f.write(q['triangles'].to_bytes(4, 'little') + mesh + sys.stdin.buffer.read(4 * q['triangles']))
        os.kill(os.getpid(), 11)
)");
  const json report =
      report_of("audit --program 'python3 die.py' icosahedron --depth 5 --depths random:3 --json -", 1);
  const std::string command = again(report["results"][0]);
  EXPECT_NE(command.find("--depths file:limitcheck-witness/"), std::string::npos) << command;
  EXPECT_EQ(report_of(command + " --json -", 1)["results"][0]["status"], "crash");
  const std::string got = read("got");
  ASSERT_EQ(got.size(), 2U * (4 + 24 * 12 + 12 * 20 + 4 * 20));
  EXPECT_EQ(got.substr(0, got.size() / 2), got.substr(got.size() / 2))
      << "the repeated call got another input";
}

TEST_F(Breakdown, BuiltInSubjectsRunIsolatedToTheSameResults) {
  const std::string arguments = "audit row-stream bumpy:100 holes --depths random --json -";
  json isolated = report_of(arguments + " --isolate", 0)["results"],
       here = report_of(arguments, 0)["results"];
  for (json* rows : {&isolated, &here})
    for (json& row : *rows) row.erase("seconds");
  EXPECT_TRUE(isolated == here) << json::diff(isolated, here);
}

}  // namespace
}  // namespace limitcheck::cli
