#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""The tracker's decisions on made-up records, and its answers to bad usage."""
import contextlib
import copy
import io
import json
import pathlib
import random
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import decide  # noqa: E402
import limitcheck_bench  # noqa: E402


def timing(rng, factor=1.0, noise=0.02, repetitions=6):
    runs = [{"run_name": "window", "run_type": "iteration", "real_time": factor * rng.gauss(10, 10 * noise)}
            for _ in range(repetitions)]
    return {"benchmarks": runs}


def record(seed=1, factors=(1.0, 1.0), instructions=1_000_000):
    rng = random.Random(seed)
    return {"format": 1, "identity": {"machine": "m", "compiler": "c"}, "key": "k", "commit": "x", "date": "2026-01-01",
            "suite": "quick", "rounds": [timing(rng, f) for f in factors], "instructions": {"case": instructions}}


class Decisions(unittest.TestCase):
    def test_a_build_against_itself_raises_at_most_one_alarm_in_twenty(self):
        alarms = sum(decide.compare(record(2 * k), record(2 * k + 1))["regressions"] for k in range(20))
        self.assertLessEqual(alarms, 1)

    def test_ten_per_cent_in_time_is_found_nine_times_of_ten(self):
        found = sum(decide.compare(record(2 * k), record(2 * k + 1, (1.1, 1.1)))["regressions"] for k in range(10))
        self.assertGreaterEqual(found, 9)

    def test_a_slow_round_alone_is_no_regression(self):
        self.assertEqual(decide.compare(record(1), record(2, (1.5, 1.0)))["regressions"], 0)

    def test_one_round_is_never_enough(self):
        self.assertEqual(decide.compare(record(1, (1.0,)), record(2, (1.5,)))["regressions"], 0)

    def test_faster_is_not_a_regression(self):
        result = decide.compare(record(1), record(2, (0.5, 0.5), 900_000))
        self.assertEqual(result["regressions"], 0)
        self.assertEqual({row["verdict"] for row in result["rows"]}, {"faster", "fewer"})

    def test_counts_decide_by_themselves_beyond_half_a_per_cent(self):
        self.assertEqual(decide.compare(record(), record(instructions=1_004_900))["regressions"], 0)
        self.assertEqual(decide.compare(record(), record(instructions=1_005_100))["regressions"], 1)

    def test_other_compilers_are_not_compared(self):
        other = record()
        other["identity"]["compiler"] = "d"
        result = decide.compare(record(), other)
        self.assertFalse(result["comparable"])
        self.assertEqual(result["differences"], ["compiler: c | d"])

    def test_what_only_one_record_has_is_named(self):
        less = copy.deepcopy(record())
        less["instructions"] = {}
        self.assertEqual(decide.compare(record(), less)["only_a"], ["case"])


class CommandLine(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.store = pathlib.Path(self.folder.name)

    def keep(self, label, value, key="k"):
        (self.store / key).mkdir(exist_ok=True)
        (self.store / key / f"{label}.json").write_text(value if isinstance(value, str) else json.dumps(value))

    def run_it(self, *arguments):
        out, err = io.StringIO(), io.StringIO()
        old, sys.argv = sys.argv, ["limitcheck-bench", *arguments, "--store", str(self.store)]
        try:
            with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
                try:
                    code = limitcheck_bench.main()
                except SystemExit as error:
                    code = error.code
        finally:
            sys.argv = old
        return code, out.getvalue(), err.getvalue()

    def test_exit_codes_tell_held_from_regression(self):
        self.keep("a", record(1))
        self.keep("b", record(2))
        self.keep("slow", record(2, (1.3, 1.3)))
        self.assertEqual(self.run_it("compare", "a", "b")[0], 0)
        self.assertEqual(self.run_it("compare", "a", "slow")[0], 1)

    def test_a_lost_benchmark_is_a_finding(self):
        less = record(2)
        less["instructions"] = {}
        self.keep("a", record(1))
        self.keep("less", less)
        code, out, _ = self.run_it("compare", "a", "less")
        self.assertEqual(code, 1)
        self.assertIn("only in A: case", out)

    def test_no_baseline_is_bad_usage_that_lists_the_labels(self):
        self.keep("a", record(1))
        code, _, err = self.run_it("compare", "nightly", "a")
        self.assertEqual(code, 2)
        self.assertIn("no baseline 'nightly'", err)
        self.assertIn("which has: a", err)

    def test_another_machine_is_said_plainly(self):
        other = record(2)
        other["identity"]["machine"] = "elsewhere"
        self.keep("a", record(1))
        self.keep("b", other)
        code, _, err = self.run_it("compare", "a", "b")
        self.assertEqual(code, 2)
        self.assertIn("machine: m | elsewhere", err)

    def test_a_label_of_two_machines_is_ambiguous(self):
        self.keep("a", record(1))
        self.keep("a", record(1), "other")
        self.assertIn("several machines", self.run_it("compare", "a", "a")[2])

    def test_what_is_no_record_is_refused(self):
        for text in ("", "[]", "{}", "{\"format\": 2}"):
            self.keep("bad", text)
            self.keep("a", record(1))
            code, _, err = self.run_it("compare", "bad", "a")
            self.assertEqual(code, 2)
            self.assertIn("not a record", err)

    def test_json_is_one_document(self):
        self.keep("a", record(1))
        self.keep("b", record(2))
        _, out, _ = self.run_it("compare", "a", "b", "--json")
        self.assertTrue(json.loads(out)["comparable"])

    def test_an_empty_store_has_no_trend(self):
        code, _, err = self.run_it("trend")
        self.assertEqual(code, 2)
        self.assertIn("has no records", err)


if __name__ == "__main__":
    unittest.main()
