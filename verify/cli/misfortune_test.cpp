// SPDX-License-Identifier: MIT
// What happens around the program goes wrong: no memory, a full disk, closed streams, signals, odd files.
// Each has its exit code and one line that says so, and nothing that was done is lost.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>

#include "verify/cli/command_test.h"

namespace limitcheck::cli {
namespace {

class Misfortune : public CommandTest {};

constexpr const char* kQuickAudit = "limitcheck audit naive tetrahedron --depth 1 --level quick ";

TEST_F(Misfortune, AFullDiskBehindStandardOutputIsAnError) {
  for (const char* command : {"generate --list", "audit naive tetrahedron --depth 1 --level quick --json",
                              "audit naive tetrahedron --depth 1 --level quick", "eval icosahedron 0 1/3 1/3",
                              "tessellate icosahedron", "claims --errata", "--help", "--version"}) {
    const Outcome o = shell(std::string("limitcheck ") + command + " > /dev/full", 2);
    EXPECT_TRUE(o.err.starts_with("limitcheck: ")) << command << ": " << o.err;
    EXPECT_EQ(std::count(o.err.begin(), o.err.end(), '\n'), 1) << command << ": " << o.err;
  }
}

// Beyond the range of the numbers no subject can be right: such meshes are refused before any is called.
TEST_F(Misfortune, AMeshOfAbsurdSizeIsRefusedOrNotJudged) {
  const auto tetrahedron = [&](const std::string& e) {
    write(e + ".obj",
          fmt::format("v 1{0} 1{0} 1{0}\nv -1{0} -1{0} 1{0}\nv -1{0} 1{0} -1{0}\nv 1{0} -1{0} -1{0}\n"
                      "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n",
                      e));
  };
  for (const std::string size : {"e200", "e-200"}) {
    tetrahedron(size);
    for (const std::string& command :
         {"audit row-stream " + size + ".obj", "audit naive " + size + ".obj", "tessellate " + size + ".obj",
          "audit --control " + size + ".obj --tessellation " + size + ".obj"}) {
      const Outcome o = run(command, 2);
      EXPECT_TRUE(
          o.err.starts_with("limitcheck: " + size + ".obj: the largest coordinate is 1" + size.substr(0, 1)))
          << o.err;
    }
    EXPECT_EQ(run("eval " + size + ".obj 0 1/3 1/3").code, 0) << "the exact evaluator has no such limit";
  }
  tetrahedron("e35");
  const std::string table = run("audit row-stream e35.obj --depth 1").out;
  EXPECT_TRUE(says(table, "not supported: e35.obj: the largest coordinate is 1e+35: with single precision"));
  EXPECT_FALSE(says(run("audit opensubdiv-far:precision=double e35.obj --depth 1 --level quick").out,
                    "not supported: "));
}

TEST_F(Misfortune, ClosedStreamsDoNotLandInTheFiles) {
  Outcome o = shell(kQuickAudit + std::string("--json report.json >&-"), 2);
  EXPECT_TRUE(nlohmann::json::accept(read("report.json"))) << read("report.json");
  o = shell("limitcheck eval no-such.obj 0 0 0 2>&-", 2);
  o = shell("limitcheck eval icosahedron 0 0 0 <&-", 0);
}

TEST_F(Misfortune, AReaderThatGoesAwayCostsNoReport) {
  (void)shell(kQuickAudit + std::string("--json report.json --junit report.xml | true"));
  EXPECT_TRUE(nlohmann::json::accept(read("report.json")));
  EXPECT_TRUE(says(read("report.xml"), "</testsuites>"));
}

// In a pipe as in a script that ignores the signal.
TEST_F(Misfortune, AReaderThatGoesAwayEndsTheProgramInSilence) {
  for (const char* before : {"", "trap '' PIPE; "})
    for (const char* command : {"audit naive tetrahedron --depth 1 --level quick", "generate --list",
                                "eval cube 0 0 0 --digits 9000"}) {
      const Outcome o =
          shell(std::string(before) + "limitcheck " + command + " | true; exit ${PIPESTATUS[0]}");
      EXPECT_TRUE(o.code == 141 || o.code == 0)
          << before << command << ": " << o.code;  // 0: it was quicker than the reader
      EXPECT_EQ(o.err, "") << before << command;
    }
  const Outcome o =
      shell("trap '' PIPE; { sleep 0.5; limitcheck eval cube 0 0 0; } | true; exit ${PIPESTATUS[0]}", 141);
  EXPECT_EQ(o.err, "");
}

TEST_F(Misfortune, ForeignTextIsMadeVisibleAtEveryOutput) {
  const std::string name = "caf\xe9 \x1b[31m\xef\xbf\xbe.obj";  // Latin-1, an escape sequence, U+FFFE
  ASSERT_EQ(run("generate cube -o cube.obj").code, 0);
  write(name, read("cube.obj"));
  const auto clean = [](const std::string& what, const std::string& text) {
    EXPECT_FALSE(says(text, "\x1b")) << what;
    EXPECT_NO_THROW((void)nlohmann::json(text).dump()) << what;  // is UTF-8
  };
  for (const std::string command :
       {"check", "check --json", "audit naive --details --depth 1",
        "audit opensubdiv-bfr --depth 1 --junit j.xml --json r.json --html p.html", "tessellate --json",
        "audit --depth", "generate", "eval --subject naive 0 0 0"}) {
    const Outcome o = run(command + " '" + name + "'");
    EXPECT_GE(o.code, 0) << command;
    EXPECT_FALSE(o.out.empty() && o.err.empty()) << command;
    clean(command, o.out), clean(command, o.err);
    if (command.ends_with("--json")) {
      EXPECT_TRUE(nlohmann::json::accept(o.out)) << command << o.out << o.err;
    }
  }
  for (const char* file : {"j.xml", "r.json", "p.html"}) {
    EXPECT_FALSE(read(file).empty()) << file;
    clean(file, read(file));
  }
  EXPECT_EQ(command("/usr/bin/python3 -c \"import xml.dom.minidom as x; x.parse('j.xml')\"").code, 0)
      << read(".stderr");
  EXPECT_TRUE(nlohmann::json::accept(read("r.json")));
}

TEST_F(Misfortune, NumbersBeyondTheirRangeAreRefusedAndNotCut) {
  const std::string beyond = "18446744073709551616";  // 2^64
  for (const std::string option :
       {"hunt naive --seed ", "hunt naive --cases ", "hunt naive --attempts ", "tessellate cube --seed ",
        "tessellate cube --depth ", "tessellate cube --threads ", "audit naive cube --memory ",
        "audit naive cube --depths random:", "audit naive cube --sample ",
        "audit naive cube --sample 3:", "generate bumpy:20 -o x.obj --seed ", "eval cube 0 0 0 --digits ",
        "prove --depth ", "hunt naive --shard 1/"})
    expect_refused(option + beyond, {""});
  EXPECT_EQ(run("tessellate cube --seed 18446744073709551615").code, 0);
}

TEST_F(Misfortune, AReportThroughAPipeOrALinkLeavesThePipeAndTheLink) {
  Outcome o = shell("mkfifo pipe; cat pipe > got & " + std::string(kQuickAudit) +
                    "--junit pipe > table; code=$?; wait; test -p pipe || exit 9; exit $code");
  EXPECT_LE(o.code, 1) << o.err;
  EXPECT_TRUE(says(read("got"), "</testsuites>"));
  for (const std::string& command : {std::string(kQuickAudit) + "--json link.obj.json > table",
                                     std::string("limitcheck generate icosahedron -o link.obj"),
                                     std::string("limitcheck tessellate icosahedron -o link.obj")}) {
    o = shell("rm -f link.*; touch real; ln -s real link.obj; ln -s real link.obj.json; " + command +
                  "; test -L link.obj -a -L link.obj.json -a -s real && rm real",
              0);
  }
}

TEST_F(Misfortune, AReportWhereADirectoryIsLeavesNothingBehind) {
  const Outcome o = shell(
      "mkdir report.json; " + std::string(kQuickAudit) + "--json report.json; code=$?; ls; exit $code", 2);
  EXPECT_TRUE(o.out.ends_with("report.json\nscript.sh\n")) << o.out;
  EXPECT_TRUE(says(o.out, "positions")) << "the table is there all the same";
}

// A sanitizer needs more addresses than it is left here.
#ifndef LIMITCHECK_SANITIZED
TEST_F(Misfortune, NoMemoryIsOneLineAndExitCodeTwo) {
  const Outcome o = shell(
      "ulimit -v 200000; limitcheck tessellate bumpy:4000 --depth 7 -o out.ply; code=$?; ls; exit $code", 2);
  EXPECT_EQ(o.err, "limitcheck: out of memory\n");
  EXPECT_EQ(o.out, "script.sh\n");
}
#endif

TEST_F(Misfortune, MorePointsThanMemoryAreRefusedBeforeHoursOfSwapping) {
  const Outcome o = run("audit naive bumpy:4000 --depth 12", 2);
  EXPECT_EQ(o.out, "");
  EXPECT_TRUE(says(o.err, "bumpy:4000: the audit of 3.36e+10 points needs some 11753 GB"));
}

TEST_F(Misfortune, FilesThatAreNoneAreRefused) {
  for (const char* file : {"''", "/", ".", "/dev/zero", "folder.obj", "empty.obj", "/dev/null"}) {
    const Outcome o =
        shell(std::string("mkdir -p folder.obj; touch empty.obj; limitcheck eval ") + file + " 0 0 0", 2);
    EXPECT_TRUE(o.err.starts_with("limitcheck: ")) << file << ": " << o.err;
  }
  const Outcome o = shell(
      "truncate -s 5G large.obj; limitcheck eval large.obj 0 0 0; code=$?; rm large.obj; exit $code", 2);
  EXPECT_TRUE(says(o.err, "FILE_TOO_LARGE"));
}

TEST_F(Misfortune, OptionsThatNameNoFileOrNoNumberAreRefusedAtOnce) {
  write("9999.json",
        R"({"waivers": [{"subject": "*", "check": "*", "reason": "r", "expires": "9999-99-99"}]})");
  write(
      "twice.json",
      R"({"waivers": [{"subject": "*", "check": "*", "reason": "r", "reason": "s", "expires": "2099-01-01"}]})");
  struct {
    const char *options, *words;
  } const cases[] = {
      {"--depths file:/dev/zero", "FILE_CANNOT_OPEN"},
      {"--waivers /dev/zero", "FILE_CANNOT_OPEN"},
      {"--waivers 9999.json", "is no date"},
      {"--waivers twice.json", "\"reason\" stands twice"},
      {"--timeout nan", "no finite number"},
      {"--timeout inf", "--timeout"},
      {"--shrink nan", "no finite number"},
      {"--json r.json --junit r.json", "--json and --junit name the same file"},
      {"--json r.json --junit ./folder/../r.json", "name the same file"},
      {"--json r.json --junit link.json", "name the same file"},
  };
  for (const auto& c : cases) {
    const Outcome o = shell(
        "mkdir -p folder; touch r.json; ln -sf r.json link.json; ulimit -t 20; timeout 20 "
        "'" LIMITCHECK_PROGRAM "' audit naive tetrahedron --depth 1 --level quick " +
        std::string(c.options) + " > table; code=$?; test -s r.json && exit 9; exit $code");
    EXPECT_EQ(o.code, 2) << c.options << o.err;
    EXPECT_TRUE(says(o.err, c.words)) << c.options;
  }
  for (const char* option : {"--tolerance nan", "--max-deviation nan", "--provenance /dev/zero",
                             "--json x.json --per-vertex x.json"})
    EXPECT_EQ(shell("limitcheck generate octahedron -o o.obj; timeout 20 '" LIMITCHECK_PROGRAM
                    "' audit --control o.obj --tessellation o.obj " +
                    std::string(option) + " > table")
                  .code,
              2)
        << option;
}

TEST_F(Misfortune, AFileThatMayNotGrowIsAnErrorAndNotHalfAFile) {
  const Outcome o = shell(
      "ulimit -f 1; " + std::string(kQuickAudit) + "--json report.json > /dev/null; code=$?; ls; exit $code",
      2);
  EXPECT_TRUE(says(o.err, "FILE_CANNOT_WRITE"));
  EXPECT_EQ(o.out, "script.sh\n");
}

// The control mesh is smaller than what a file may hold here, the rest of the witness is not.
TEST_F(Misfortune, AWitnessIsAWholeFolderOrNone) {
  const Outcome o = shell(
      "ulimit -f 1; limitcheck audit opensubdiv-far:precision=double fan:5 --depth 1 --level quick "
      "--witnesses w "
      "> /dev/null; code=$?; ls -A w; exit $code",
      2);
  EXPECT_EQ(o.out, "") << "nothing is left of the one that could not be written";
}

#ifndef LIMITCHECK_SANITIZED
TEST_F(Misfortune, TheHostsOwnLackOfMemoryIsNotBlamedOnTheSubject) {
  write("many.sh", kTellsWhatItCan +
                       "head -c 144 > /dev/null\n"
                       "echo '{\"status\": \"ok\"}'\nread -r line\n"
                       "echo '{\"status\": \"ok\", \"vertices\": 40000000, \"triangles\": 4}'\nsleep 1\n");
  const Outcome o = shell(
      "ulimit -v 1500000; limitcheck audit --program 'bash many.sh' tetrahedron --depth 0 --level quick "
      "--json -");
  const auto report = nlohmann::json::parse(o.out, nullptr, false);
  ASSERT_FALSE(report.is_discarded()) << o.out << o.err;
  EXPECT_EQ(o.code, 2) << o.out << o.err;
  EXPECT_EQ(report["incomplete"], "this program ran out of memory");
  for (const auto& row : report["results"]) EXPECT_EQ(row["status"], "not-run") << row;
}

// Whatever this system does not give a right subject in a process of its own: no row is a breakdown of it.
TEST_F(Misfortune, WhatTheSystemLacksIsNotJudgedAndNoFaultOfTheSubject) {
  for (const std::string limit :
       {"-n 16", "-n 20", "-v 600000", "-v 250000", "-v 100000", "-d 60000", "-u 3"}) {
    const Outcome o =
        shell("rm -f r.json r.jsonl; ulimit " + limit +
              "; limitcheck audit naive tetrahedron --isolate --depth 1 --level quick --json r.json");
    // Root may start as many processes as it likes.
    EXPECT_TRUE(o.code == 2 || (o.code == 0 && !says(o.out, "FINDING")))
        << limit << ": " << o.code << o.out << o.err;
    EXPECT_FALSE(says(o.out + o.err, "high") || o.code == 1) << limit;
    if (o.code != 2 || !std::filesystem::exists(folder_ / "r.json")) continue;
    const auto report = json_in("r.json");
    EXPECT_FALSE(report["incomplete"].is_null()) << limit;
    for (const auto& row : report["results"]) {
      EXPECT_EQ(row["status"], "not-run") << limit << row;
      EXPECT_EQ(row["origin"], "host") << limit << row;
    }
  }
}

// A subject that crashes where it may have met a limit of the system, and one that crashes where it has enough.
TEST_F(Misfortune, ABreakdownUnderTightLimitsIsNotJudged) {
  write("dies.sh", kTellsWhatItCan + "kill -SEGV $$\n");
  for (const auto& [limit, words] : {std::pair{"--nofile=63", "the system allows 63 open files"},
                                     {"--nproc=63", "the system allows 63 processes"},
                                     {"--as=3000000000", "the system allows 3000000000 bytes of addresses"},
                                     {"--data=3000000000", "the system allows 3000000000 bytes of data"},
                                     {"--nofile=64", ""}}) {
    const Outcome o = shell("prlimit " + std::string(limit) +
                            " '" LIMITCHECK_PROGRAM
                            "' audit --program 'bash dies.sh' tetrahedron --depth 1 --level quick --json -");
    const bool judged = *words == '\0';
    EXPECT_EQ(o.code, judged ? 1 : 2) << limit << o.out << o.err;
    const auto report = nlohmann::json::parse(o.out, nullptr, false);
    ASSERT_FALSE(report.is_discarded()) << o.out << o.err;
    const auto& row = report["results"][0];
    EXPECT_EQ(row["origin"], judged ? "subject" : "host") << limit << row;
    EXPECT_EQ(row["status"], judged ? "crash" : "not-run") << limit << row;
    EXPECT_EQ(report["held"], false);
    EXPECT_TRUE(says(row["message"].get<std::string>(), words));
  }
}

TEST_F(Misfortune, AFullDiskLeavesWhatWasThereAndNoHalfFile) {
  ASSERT_EQ(run("generate bumpy:2000 -o m.obj").code, 0);
  for (const std::string command :
       {"generate bumpy:2000 -o disk/out.obj", "generate bumpy:2000 -o disk/out.ply",
        "repair m.obj -o disk/out.obj", "tessellate bumpy:800 -o disk/out.glb",
        "audit naive cube --depth 1 --level quick --json disk/out.json",
        "audit naive cube --depth 1 --level quick --junit disk/out.json",
        "audit naive cube --depth 1 --level quick --html disk/out.json",
        "audit naive cube --depth 1 --level quick --shard 1/2 --json disk/out.json",
        "prove --depth 0 --valences 3 --json disk/out.json"}) {
    const Outcome o = shell(
        "unshare -Urm bash -c 'mkdir -p disk; mount -t tmpfs -o size=1m none disk || exit 77; "
        "for e in obj ply glb json; do echo old > disk/out.$e; done; "
        "cat /dev/zero > disk/fill 2> log; \"$0\" " +
        command + " > log; code=$?; ls -A disk; cat disk/out.*; exit $code' '" LIMITCHECK_PROGRAM "'");
    if (o.code == 77) GTEST_SKIP() << o.err;
    EXPECT_EQ(o.code, 2) << command << o.out << o.err;
    EXPECT_TRUE(says(o.err, "FILE_CANNOT_WRITE")) << command;
    EXPECT_EQ(o.out, "fill\nout.glb\nout.json\nout.obj\nout.ply\nold\nold\nold\nold\n") << command;
  }
}

TEST_F(Misfortune, ASystemWithoutNamespacesHoldsProcessesByASubreaper) {
  const Outcome o = shell(
      "unshare -Ur bash -c 'echo 0 > /proc/sys/user/max_pid_namespaces && "
      "\"$0\" audit naive tetrahedron --isolate --depth 1 --level quick --json r.json' \"" LIMITCHECK_PROGRAM
      "\" || { code=$?; test -e r.json || exit 77; exit $code; }");
  if (o.code == 77) GTEST_SKIP() << o.err;
  EXPECT_EQ(o.code, 0) << o.out << o.err;
  EXPECT_TRUE(says(json_in("r.json")["containment"].get<std::string>(), "subreaper"));
}
#endif

TEST_F(Misfortune, RowsSayWhoseDoingABreakdownIs) {
  write("dies.sh", kTellsWhatItCan + "kill -SEGV $$\n");
  write("mute.sh", kTellsWhatItCan + "sleep 1000\n");
  for (const auto& [script, origin] : {std::pair{"dies.sh", "subject"}, {"mute.sh", "limit"}}) {
    const auto report = json_of(std::string("audit --program 'bash ") + script +
                                    "' tetrahedron --depth 1 --level quick --timeout 1 --json",
                                1);
    EXPECT_EQ(report["results"][0]["origin"], origin) << report["results"][0];
    EXPECT_TRUE(report["results"][1]["origin"].is_null());
  }
}

TEST_F(Misfortune, AnExistingFileKeepsItsMode) {
  for (const std::string command : {"generate cube -o", "repair broken.obj -o", "tessellate cube -o"}) {
    const Outcome o =
        shell("limitcheck generate cube -o broken.obj; touch out.obj; chmod 640 out.obj; limitcheck " +
              command + " out.obj > log && stat -c %a out.obj");
    EXPECT_EQ(o.out, "640\n") << command << o.err;
  }
}

// Twenty moments; verify/kills.sh has more.
TEST_F(Misfortune, WhatIsKilledAtAnyMomentEndsInTheSameReport) {
  const Outcome o = command("bash '" LIMITCHECK_SOURCE "/verify/kills.sh' '" LIMITCHECK_PROGRAM "' 4", 0);
}

TEST_F(Misfortune, NamesMayHaveSpacesQuotesAndOtherAlphabets) {
  const Outcome o = shell(
      "mkdir 'Größe \"ñ\" 网格'; cd 'Größe \"ñ\" 网格'; limitcheck generate icosahedron -o \"a b'ü.obj\" && "
      "limitcheck audit opensubdiv-bfr \"a b'ü.obj\" --depth 1 --json 'r é.json' > table; test $? -le 1 && "
      "sed -n 's/^ *limitcheck eval/limitcheck eval/p' table > again.sh && test -s again.sh && "
      "while read -r line; do eval \"$line\"; test $? = 1 || exit 3; done < again.sh",
      0);
}

// A built-in subject in this process, and the reference, look for no signal.
TEST_F(Misfortune, ASignalEndsWhatTakesLong) {
  for (const std::string command : {"audit naive bumpy:4000 --depth 6 --json r.json",
                                    "audit naive bipyramid:60000 --depth 1 --json r.json"}) {
    std::filesystem::remove(folder_ / "r.jsonl");
    const Outcome o = signalled(command + " --level quick", "[ -e r.jsonl ] && sleep 0.5", "TERM");
    EXPECT_EQ(o.code, 143) << command << o.err;
    EXPECT_TRUE(says(o.out, "INCOMPLETE: interrupted by SIGTERM"));
    EXPECT_EQ(json_in("r.json")["incomplete"], "interrupted by SIGTERM");
  }
}

TEST_F(Misfortune, ASignalEndsTheQuestionWhetherBrokenMeshesAreRefused) {
  write("mute.sh", "touch asked\nsleep 1000\n");
  write("broken.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 3\n");
  const Outcome o =
      signalled("audit --must-refuse --program 'bash mute.sh' broken.obj", "[ -e asked ]", "TERM");
  EXPECT_EQ(o.code, 143) << o.out << o.err;
}

TEST_F(Misfortune, ASignalLeavesAPartialReportAndNoProcess) {
  // Says what it can do, and is silent from then on.
  write("mute.sh", kTellsWhatItCan + "touch asked\nsleep 123456 &\nwait\n");
  for (const auto& [signal, code] : {std::pair{"INT", 130}, std::pair{"TERM", 143}, std::pair{"HUP", 129}}) {
    (void)shell("rm -f asked r.jsonl");
    const Outcome o = signalled(
        "audit --program 'bash mute.sh' tetrahedron icosahedron --depth 1 --level quick --json r.json",
        "[ -e asked ] && sleep 0.2", signal, "123456");
    EXPECT_EQ(o.code, code) << signal << o.err;
    EXPECT_TRUE(says(o.out, "INCOMPLETE: interrupted by SIG" + std::string(signal)));
    const auto report = json_in("r.json");
    EXPECT_EQ(report["incomplete"], "interrupted by SIG" + std::string(signal));
    EXPECT_EQ(report["held"], false);
    EXPECT_GT(report["results"].size(), 10U) << "a row for each check of the mesh that was begun";
    for (const auto& row : report["results"]) EXPECT_EQ(row["status"], "not-run") << row;
  }
}

}  // namespace
}  // namespace limitcheck::cli
