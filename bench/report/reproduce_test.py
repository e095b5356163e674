#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""limitcheck reproduce with made-up programs: without Node.js, with programs that fail or hang, without a network."""
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.dont_write_bytecode = True
from page_test import RESULTS  # noqa: E402

TOP = pathlib.Path(__file__).resolve().parents[2]
# Stands for limitcheck, reproduction and the benchmarks: leaves the results of page_test.
PROGRAM = """#!/usr/bin/python3
import json, os, pathlib, signal, sys, time
results = json.loads(pathlib.Path(__file__).with_name("results.json").read_text())
words = sys.argv[1:]
if os.environ.get("BREAKS") in words:
    sys.exit("something went wrong here")
if os.environ.get("HANGS") in words:
    if "CLEARS" in os.environ:
        signal.signal(signal.SIGTERM, lambda *_: pathlib.Path(os.environ["CLEARS"]).write_text("cleared") and sys.exit(143))
    time.sleep(60)
if "-o" in words:
    part, folder = words[2], pathlib.Path(words[1])
    name = part + (".png" if part.startswith("figure") else ".json")
    (folder / name).write_text(json.dumps(results.get(part, {})))
elif words[0].startswith("--benchmark"):
    out = next(w for w in words if w.startswith("--benchmark_out=")).partition("=")[2]
    pathlib.Path(out).write_text(json.dumps(results[pathlib.Path(out).name.split(".")[0].split("-")[0]]))
else:
    print(json.dumps(results[{"prove": "proofs"}.get(words[0], words[0])]))
"""


class Reproduce(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        top = pathlib.Path(folder.name)
        for part in ("bench/report", "bench/track", "papers/mueller-havemann-2000/figures"):  # no node_modules there
            shutil.copytree(TOP / part, top / "source" / part, ignore=shutil.ignore_patterns("node_modules"))
        self.build, self.out, self.bin = top / "build", top / "out", top / "bin"
        self.bin.mkdir()
        for name in ("limitcheck", "bench/frame_bench", "bench/throughput_bench", "bench/reproduction/reproduction"):
            self.program(self.build / name, PROGRAM)
            (self.build / name).with_name("results.json").write_text(json.dumps(RESULTS))
        self.command = self.build / "bench" / "limitcheck-reproduce"
        self.command.symlink_to(top / "source" / "bench" / "report" / "limitcheck_reproduce.py")

    @staticmethod
    def program(path, content):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(content)
        path.chmod(0o755)

    def start(self, *words, **environment):
        return subprocess.Popen([self.command, "-o", self.out, *words], env={"PATH": str(self.bin), **environment}, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, text=True, start_new_session=True)

    def wait_for(self, name):
        for _ in range(600):
            if (self.out / name).exists():
                return
            time.sleep(0.1)
        self.fail(f"{name} does not come")

    def run_it(self, *words, **environment):
        with self.start(*words, **environment) as process:
            self.said = "\n".join(process.communicate(timeout=60))
        page = self.out / "index.html"
        self.page = page.read_text() if page.is_file() else ""
        return process.returncode

    def says(self, words):
        self.assertTrue(words in self.page, f"the page does not say: {words}")

    def sections(self):
        return [s.partition(">")[0] for s in self.page.split("<section id=")[1:]]

    def test_without_node_the_report_lacks_only_what_needs_it_and_says_so(self):
        self.assertEqual(self.run_it(), 1)
        self.assertEqual(self.sections(), ["summary", "sentences", "tables", "frames", "matched", "pictures", "claims", "audit", "proofs", "throughput"])
        for part in ("figure-11", "figure-12", "error", "view"):
            self.says(f"({part}): node is not installed (apt-get install nodejs npm)")
        self.assertFalse("<script" in self.page)

    def test_without_a_network_it_says_that_npm_failed_and_why(self):
        self.program(self.bin / "node", "#!/bin/sh\nexit 0\n")
        self.program(self.bin / "npm", "#!/bin/sh\necho 'npm ERR! network request failed' >&2\nexit 1\n")
        self.assertEqual(self.run_it("--only", "figure-11"), 1)
        self.says("(is there a network?)")
        self.says("network request failed")
        self.assertIn("tables", self.sections())

    def test_packages_are_those_of_the_lock_file_and_their_scripts_are_not_run(self):
        self.program(self.bin / "node", "#!/bin/sh\nexit 0\n")
        self.program(self.bin / "npm", "#!/bin/sh\necho \"npm was asked for: $*\" >&2\nexit 1\n")
        self.run_it("--only", "figure-11")
        asked = self.page.partition("npm was asked for: ")[2].partition("<")[0]
        self.assertTrue(asked.startswith("ci "), asked)
        self.assertIn("--ignore-scripts", asked)
        folder = TOP / "bench" / "report"
        wanted = json.loads((folder / "package.json").read_text())
        locked = json.loads((folder / "package-lock.json").read_text())["packages"]
        for name, version in {**wanted["dependencies"], **wanted["devDependencies"]}.items():
            self.assertEqual(locked[f"node_modules/{name}"]["version"], version)
        self.assertEqual([n for n, p in locked.items() if n and not p.get("integrity")], [], "each package has its hash")

    def test_a_part_that_fails_leaves_the_others(self):
        self.assertEqual(self.run_it(BREAKS="audit"), 1)
        self.says("something went wrong here")
        self.assertNotIn("audit", self.sections())
        self.assertIn("throughput", self.sections())

    def test_claims_that_were_not_run_leave_the_report_incomplete(self):
        self.assertEqual(self.run_it("--only", "claims"), 0, "each claim that has a test was run")
        claims = json.loads(json.dumps(RESULTS["claims"]))
        claims["claims"][0].update(ran=False, held=None)
        (self.build / "results.json").write_text(json.dumps({**RESULTS, "claims": claims}))
        self.assertEqual(self.run_it("--only", "claims"), 1)
        self.says("1 of 3 claims were not run")
        self.assertIn("1 of 3 claims were not run", self.said)
        self.assertEqual(self.run_it("--only", "proofs"), 0, "asked for another part alone")

    def test_what_needs_a_part_that_failed_says_which(self):
        self.run_it(BREAKS="spheres")
        self.says("(timings): needs spheres, which could not be made")

    def test_an_interrupted_run_keeps_what_it_made_and_says_what_is_missing(self):
        with self.start(HANGS="prove") as process:
            self.wait_for("proofs.json.partial")
            process.send_signal(signal.SIGTERM)
            process.communicate(timeout=30)
        self.assertEqual(process.returncode, 1)
        self.page = (self.out / "index.html").read_text()
        self.assertEqual(self.sections(), ["summary", "sentences", "tables", "frames", "matched", "pictures", "claims", "audit"])
        self.says("(proofs): interrupted")
        self.says("(throughput): not made: the run was interrupted before it")
        self.assertFalse(list(self.out.glob("*.partial")))
        # The rest alone.
        self.assertEqual(self.run_it("--only", "proofs", "--only", "throughput"), 0)
        self.assertIn("throughput", self.sections())
        self.assertFalse("(proofs): interrupted" in self.page)

    def test_an_interrupt_lets_the_program_clear_up(self):
        for number in (signal.SIGTERM, signal.SIGHUP, signal.SIGINT):
            cleared = self.build / f"cleared-{number}"
            with self.start("--only", "claims", HANGS="claims", CLEARS=str(cleared)) as process:
                self.wait_for("claims.json.partial")
                time.sleep(1)
                process.send_signal(number)
                process.communicate(timeout=30)
            self.assertEqual(process.returncode, 1)
            self.assertTrue(cleared.exists(), f"signal {number}")
            self.assertFalse(list(self.out.glob("*.partial")))

    def test_killed_outright_it_does_not_count_as_made(self):
        with self.start("--only", "claims", HANGS="claims") as process:
            self.wait_for("claims.json.partial")
            os.killpg(process.pid, signal.SIGKILL)
        self.run_it("--only", "audit")
        self.says("(claims): interrupted")

    def test_one_part_alone_makes_what_it_needs_and_nothing_else(self):
        self.assertEqual(self.run_it("--only", "timings"), 0)
        self.assertEqual(sorted(p.name for p in self.out.glob("*.json")), ["matched.json", "reproduction.json", "spheres.json", "timings.json"])
        before = (self.out / "spheres.json").stat().st_mtime_ns
        self.run_it("--only", "timings")
        self.assertEqual((self.out / "spheres.json").stat().st_mtime_ns, before)

    def test_a_program_that_is_not_built_is_named(self):
        (self.build / "bench" / "throughput_bench").unlink()
        self.assertEqual(self.run_it("--only", "throughput"), 1)
        self.says("throughput_bench is not there: build it")

    def test_a_part_that_is_unknown_is_bad_usage(self):
        self.assertEqual(self.run_it("--only", "figure-99"), 2)
        self.assertIn("figure-99", self.said)

    def test_every_command_of_the_page_is_accepted(self):
        self.run_it()
        commands = [part.partition("</code>")[0].split() for part in self.page.split("<code>limitcheck reproduce")[1:]]
        self.assertGreater(len(commands), 10)
        self.assertEqual(self.run_it(*(word for command in commands for word in command), "--list"), 0, self.said)


if __name__ == "__main__":
    unittest.main()
