#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""The tracker's decisions on made-up records, and its answers to bad usage."""
import contextlib
import copy
import io
import json
import os
import pathlib
import random
import sys
import tempfile
import unittest
from unittest import mock

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import decide  # noqa: E402
import limitcheck_bench  # noqa: E402
import machine  # noqa: E402
import measure  # noqa: E402
import trend  # noqa: E402
import turns  # noqa: E402


def timing(rng, factor=1.0, noise=0.02, repetitions=6):
    runs = [{"run_name": "window", "run_type": "iteration", "real_time": factor * rng.gauss(10, 10 * noise)}
            for _ in range(repetitions)]
    return {"benchmarks": runs}


def record(seed=1, factors=(1.0, 1.0), instructions=1_000_000):
    rng = random.Random(seed)
    return {"format": 1, "identity": {"machine": "m", "compiler": "c"}, "key": "k", "commit": "x", "date": "2026-01-01",
            "suite": "quick", "rounds": [timing(rng, f) for f in factors], "instructions": {"case": instructions}}


class Decisions(unittest.TestCase):
    def test_times_of_two_records_are_advisory_however_far_apart(self):
        result = decide.compare(record(1), record(2, (7.0, 7.0)))
        self.assertEqual(result["regressions"], 0)
        self.assertEqual(result["advisories"], 1)
        self.assertEqual([r["verdict"] for r in result["rows"] if r["kind"] == "time"], ["slower"])

    def test_ten_per_cent_in_time_are_seen_nine_times_of_ten(self):
        found = sum(decide.compare(record(2 * k), record(2 * k + 1, (1.1, 1.1)))["advisories"] for k in range(10))
        self.assertGreaterEqual(found, 9)

    def test_a_slow_round_alone_is_nothing(self):
        self.assertEqual(decide.compare(record(1), record(2, (1.5, 1.0)))["advisories"], 0)

    def test_faster_is_not_a_regression(self):
        result = decide.compare(record(1), record(2, (0.5, 0.5), 900_000))
        self.assertEqual(result["regressions"] + result["advisories"], 0)
        self.assertEqual({row["verdict"] for row in result["rows"]}, {"faster", "fewer"})

    def test_the_worst_comes_first(self):
        a, b = record(), record()
        a["instructions"] = {"better": 100_000, "same": 100_000, "bad": 100_000, "near": 100_000, "worst": 100_000}
        b["instructions"] = {"better": 90_000, "same": 100_000, "bad": 101_000, "near": 100_400, "worst": 130_000}
        rows = [r for r in decide.compare(a, b)["rows"] if r["kind"] == "instructions"]
        self.assertEqual([r["name"] for r in rows], ["worst", "bad", "near", "better", "same"])

    def test_what_lies_near_the_limit_is_suspect_and_no_regression(self):
        for count, suspect in ((1_004_000, True), (1_002_000, False), (996_000, False), (1_006_000, False)):
            rows = decide.judge_counts(record(), record(instructions=count))
            self.assertEqual([r["suspect"] for r in rows], [suspect], count)

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


def launches(rng, factor, spread=0.02, bursts=0.2):
    """Turns on a busy machine: both builds of a block share what it has, but for a burst that hits one of them."""
    def block():
        shared = rng.choice((1, 1.8)) * 1e6
        burst = [rng.choice((1.3, 1.8)) if rng.random() < bursts else 1 for _ in range(2)]
        return (shared * burst[0] * rng.gauss(1, spread), shared * burst[1] * factor * rng.gauss(1, spread))
    return [[block() for _ in range(turns.BLOCKS)] for _ in range(turns.LAUNCHES)]


class Functions(unittest.TestCase):
    PROFILE = """# callgrind format
events: Ir
fl=(1) a.cpp
fn=(1) window(int)
10 500
11 200
cfn=(2) limit
calls=3 20
12 9000
fn=(2)
20 300
fn=(3) below 'quoted'
30 1
totals: 1001
"""

    def test_a_profile_is_read_as_the_instructions_of_each_function_itself(self):
        self.assertEqual(measure.own_costs(self.PROFILE), {"window(int)": 700, "limit": 300, "below 'quoted'": 1})

    def test_a_function_is_named_by_what_a_reader_knows(self):
        long = ("limitcheck::fast::row_stream::N_AVX2::Stream<limitcheck::fast::row_stream::N_AVX2::LaneNumber<hwy::N_AVX2::Simd<float, 8ul, 0> >, "
                "Target<float> >::run(int, std::function<void (int)> const&)'2")
        self.assertEqual(decide.short_function(long), "Stream::run")
        self.assertEqual(decide.short_function("malloc"), "malloc")
        self.assertLessEqual(len(decide.short_function("x" * 600)), 48)

    def test_a_case_names_its_kernel(self):
        for case, kernel in (("row-stream/avx2/steady/bumpy/faces:1000/depth:3/threads:1", "row-stream/avx2/bumpy"),
                             ("quads/row-stream/avx2/4/depth:5", "quads/row-stream/avx2/4"), ("set-up/naive", "set-up/naive"),
                             ("frame/row-stream/patches", "frame/row-stream/patches")):
            self.assertEqual(decide.kernel_of(case), kernel)

    def test_the_functions_that_moved_most_come_first(self):
        moved = decide.moved_functions({"a": 100, "b": 100, "gone": 5}, {"a": 101, "b": 150, "new": 7}, 3)
        self.assertEqual(moved, [("b", 100, 150), ("new", 0, 7), ("gone", 5, 0)])


class InTurns(unittest.TestCase):
    """The decision, and the two rounds, on made-up launches."""

    def compare(self, factors, seed=1):
        rng = random.Random(seed)
        rounds = iter(factors)

        def one_round(a, b, cases, _, progress, name, blocks):
            factor = next(rounds)
            return {case: launches(rng, factor) for case in cases}
        with mock.patch.object(turns, "build_and_cases", lambda folder: ("GNU", ["a/steady", "b/scratch"])), \
                mock.patch.object(turns, "one_round", one_round):
            return turns.compare("A", "B", "/steady", seed)

    def test_the_same_build_raises_at_most_one_alarm_in_two_hundred(self):
        rng = random.Random(2)
        alarms = sum(decide.judge_launches(launches(rng, 1))[2] != 0 for _ in range(200))
        self.assertLessEqual(alarms, 1)

    def test_ten_per_cent_are_found_nine_times_of_ten(self):
        rng = random.Random(3)
        found = sum(decide.judge_launches(launches(rng, 1.1))[2] == 1 for _ in range(100))
        self.assertGreaterEqual(found, 90)

    def test_the_shift_is_that_of_the_builds(self):
        ratio, _, sign = decide.judge_launches(launches(random.Random(4), 0.8))
        self.assertAlmostEqual(ratio, 0.8, delta=0.02)
        self.assertEqual(sign, -1)

    def test_equal_times_are_no_difference(self):
        self.assertEqual(decide.judge_launches([[(5.0, 5.0)] * 3] * turns.LAUNCHES), (1.0, 1.0, 0))

    def test_a_difference_must_show_again_in_new_processes(self):
        self.assertEqual([row["verdict"] for row in self.compare([1.2, 1.2])[0]], ["slower"])
        self.assertEqual([row["verdict"] for row in self.compare([1.2, 1.0])[0]], [""])
        self.assertEqual([row["rounds"] for row in self.compare([1.0])[0]], [1])

    def test_no_matching_case_is_an_error(self):
        with mock.patch.object(turns, "build_and_cases", lambda folder: ("GNU", ["a"])):
            with self.assertRaises(measure.MeasureError):
                turns.compare("A", "B", "nothing")


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
        self.keep("slow", record(2, (7.0, 7.0)))
        self.keep("more", record(2, instructions=1_100_000))
        self.assertEqual(self.run_it("compare", "a", "b")[0], 0)
        self.assertEqual(self.run_it("compare", "a", "more")[0], 1)
        code, out, _ = self.run_it("compare", "a", "slow")
        self.assertEqual(code, 0, "times of two hours decide nothing")
        self.assertIn("1 slower by times of different hours, which decide nothing", out)

    def test_a_comparison_as_markdown_is_a_table_of_what_is_worth_a_look(self):
        self.keep("a", record(1))
        self.keep("b", record(2, instructions=1_100_000))
        _, out, _ = self.run_it("compare", "a", "b", "--markdown")
        self.assertIn("**1 regression**", out)
        self.assertIn("| more |  | 1.100 | `case` | 1 of 1 |", out)
        self.assertNotIn("`window`", out)

    def many(self, factor):
        return {**record(1), "instructions": {f"kernel-{k}/depth:{d}": int(factor * 1_000_000) for k in range(50) for d in (3, 5)}}

    def test_a_table_for_a_pull_request_fits_one_screen_whatever_moved(self):
        self.keep("a", self.many(1))
        self.keep("b", self.many(1.2))
        _, out, _ = self.run_it("compare", "a", "b", "--markdown")
        self.assertLessEqual(len(out.splitlines()), 30)
        self.assertIn("100 of 101 cases worth a look", out)
        self.assertIn("and 30 kernels more", out)

    def test_a_comparison_has_a_line_for_each_kernel_or_each_case(self):
        self.keep("a", self.many(1))
        self.keep("b", self.many(1.2))
        _, out, _ = self.run_it("compare", "a", "b")
        lines = [line for line in out.splitlines() if "kernel-" in line]
        self.assertEqual(len(lines), 50)
        self.assertEqual(max(map(len, lines)) < 80, True, lines)
        self.assertIn("2 of 2 cases", lines[0])
        _, each, _ = self.run_it("compare", "a", "b", "--each")
        self.assertEqual(sum("kernel-" in line for line in each.splitlines()), 100)

    def test_records_of_0_1_are_compared_under_the_names_of_today(self):
        old = record(1)
        for timed in old["rounds"]:
            for run in timed["benchmarks"]:
                run["run_name"] += "/real_time"
        self.keep("old", old)
        self.keep("new", record(2))
        code, out, _ = self.run_it("compare", "old", "new")
        self.assertEqual((code, "only in" in out), (0, False), out)
        self.assertEqual(len(trend.history([old, record(2)])["time", "window"]), 2)

    def test_what_it_writes_can_be_read_by_others(self):
        old = os.umask(0o022)
        try:
            limitcheck_bench.write_whole(self.store / "page.html", "x")
        finally:
            os.umask(old)
        self.assertEqual((self.store / "page.html").stat().st_mode & 0o777, 0o644)

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

    def test_nothing_that_tells_builds_apart_is_passed_over(self):
        identity = {"machine": "m", "cores": 2, "caches": ["L1"], "compiler": "GNU 12.2.0", "flags": "-O3", "targets": "avx2 scalar"}
        a, b = record(1), record(2)
        a["identity"] = identity
        self.assertEqual(set(machine.identity({"caches": [], "compiler": "", "flags": "", "targets": ""})), set(identity))
        self.keep("a", a)
        for name in identity:
            b["identity"] = {**identity, name: "other"}
            self.keep("b", b)
            code, out, err = self.run_it("compare", "a", "b")
            self.assertEqual(code, 2)
            self.assertEqual(out, "")
            self.assertIn(f"{name}: {identity[name]} | other", err)

    def build(self, name):
        folder = self.store / name / "bench"
        folder.mkdir(parents=True)
        (folder / "timing_turns").touch()
        return folder

    def test_a_build_of_another_compiler_is_not_timed(self):
        other = self.build("other")
        names = {other: "Clang-14", pathlib.Path("ours"): "GNU-12"}
        with mock.patch.object(turns, "build_and_cases", lambda folder: (names[folder], [])):
            code, _, err = self.run_it("compare", "--against", str(other.parent), "--programs", "ours")
        self.assertEqual(code, 2)
        self.assertIn("build: Clang-14 | GNU-12", err)

    def test_compare_wants_a_record_or_a_build(self):
        self.assertEqual(self.run_it("compare")[0], 2)
        self.assertEqual(self.run_it("compare", "a", "--against", "b")[0], 2)

    def test_a_folder_without_a_build_is_said_plainly(self):
        code, _, err = self.run_it("compare", "--against", str(self.store))
        self.assertEqual(code, 2)
        self.assertIn("no build with benchmark programs", err)

    def test_kept_programs_are_timed_in_turns_and_lost_ones_are_named(self):
        for kept, note in ((self.build("kept"), "in turns with the kept programs"), (self.store / "gone", "no longer in")):
            self.keep("a", {**record(1), "kept": str(kept)})
            with mock.patch.object(measure, "identity", lambda programs: record()["identity"]), \
                    mock.patch.object(turns, "compare", lambda *a, **k: ([], [], [])), \
                    mock.patch.object(measure, "instruction_counts", lambda *a: {"case": 1_000_000}), \
                    mock.patch.object(measure, "measure", lambda *a, **k: record(2)):
                code, out, _ = self.run_it("compare", "a")
            self.assertEqual(code, 0)
            self.assertIn(note, out)

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

    def test_the_trend_never_joins_machines_and_leaves_gaps(self):
        other = {**record(3), "key": "other", "date": "2026-01-02"}
        less = {**record(4), "date": "2026-01-03", "instructions": {}}
        with mock.patch.object(trend, "draw", lambda spec: json.dumps(spec["concat"])):
            page = trend.page([record(1), other, less])
        self.assertEqual(page.count("<h2>"), 2)
        self.assertEqual(page.count("<h3>"), 4)
        counts = trend.panel("case", trend.history([record(1), less])["instructions", "case"], ["x #1", "x #2"])
        self.assertEqual([value["value"] for value in counts["data"]["values"]], [1.0, None])

    def test_the_trend_shows_labels(self):
        labelled = {**record(1), "label": "before"}
        self.assertEqual(trend.tick(0, labelled), "before #1")
        self.assertEqual(trend.tick(0, record(1)), "x #1")

    def test_steps_are_found_where_a_count_moves_and_where_times_stay_moved(self):
        counts = [100, 100, 103, 103, 103]
        self.assertEqual(trend.steps([{"value": v, "low": None, "high": None} for v in counts]), [2])
        rng = random.Random(1)
        noisy = [rng.gauss(10, .2) for _ in range(6)]
        moved = [rng.gauss(12, .2) for _ in range(6)]
        points = lambda values: [{"value": v, "low": v - .3, "high": v + .3} for v in values]  # noqa: E731
        self.assertEqual(trend.steps(points(noisy)), [])
        self.assertEqual(trend.steps(points(noisy + moved)), [6])
        self.assertEqual(trend.steps(points(noisy + moved[:1] + noisy)), [], "one slow record is no step")

    def test_the_trend_as_markdown_lists_the_steps(self):
        self.keep("a", record(1))
        self.keep("b", {**record(2, instructions=1_100_000), "date": "2026-01-02"})
        code, out, _ = self.run_it("trend", "--markdown")
        self.assertEqual(code, 0)
        self.assertIn("| `case` | instructions | +10.0 % | b #2 |", out)

    def test_an_empty_store_has_no_trend(self):
        code, _, err = self.run_it("trend")
        self.assertEqual(code, 2)
        self.assertIn("has no records", err)


if __name__ == "__main__":
    unittest.main()
