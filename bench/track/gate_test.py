#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""The gate on made-up costs; and, with the folder of the built programs as argument, on a build slowed down on purpose."""
import contextlib
import io
import json
import os
import pathlib
import sys
import tempfile
import unittest
from unittest import mock

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import decide  # noqa: E402
import gate  # noqa: E402
import measure  # noqa: E402
import self_test  # noqa: E402
import turns  # noqa: E402

PROGRAMS = None
QUIET = lambda text: None  # noqa: E731


class MadeUp(unittest.TestCase):
    """Costs and baselines from dictionaries."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.exact = {"flops/row-stream/torus/depth:3": 9345, "allocations/later-run/row-stream": 0}
        self.counts = {"row-stream/avx2/depth:3": 1_000_000}
        for name, value in (("measured_exact", lambda programs: self.exact), ("key_of", lambda programs: "GNU-12/avx2")):
            patch = mock.patch.object(gate, name, value)
            patch.start()
            self.addCleanup(patch.stop)
        patch = mock.patch.object(measure, "instruction_counts", lambda programs, progress: self.counts)
        patch.start()
        self.addCleanup(patch.stop)
        self.run_gate(update=True)

    def run_gate(self, kinds=gate.KINDS, update=False, skips=False, ci=False):
        out = io.StringIO()
        with contextlib.redirect_stdout(out), mock.patch.dict(os.environ):
            os.environ.pop("CI", None)
            if ci:
                os.environ["CI"] = "true"
            code = gate.run(kinds, None, update, skips, lambda path, text: path.write_text(text), QUIET, self.folder)
        return code, out.getvalue()

    def test_what_equals_its_baseline_passes(self):
        self.assertEqual(self.run_gate()[0], 0)

    def test_a_gate_that_passes_says_to_what_it_is_blind(self):
        self.assertIn("blind to caches and latency", self.run_gate(["instructions"])[1])
        self.assertNotIn("blind", self.run_gate(["exact"])[1])

    def test_one_flop_more_or_less_is_told_with_both_numbers_and_what_to_do(self):
        for flops, percent in ((9346, "+0.01%"), (9344, "-0.01%"), (18690, "+100.00%")):
            self.exact = {**self.exact, "flops/row-stream/torus/depth:3": flops}
            code, out = self.run_gate()
            self.assertEqual(code, 1)
            self.assertIn(f"flops/row-stream/torus/depth:3: 9345 -> {flops} ({percent})", out)
            self.assertIn("limitcheck bench gate --update", out)

    def test_an_allocation_where_there_was_none_fails(self):
        self.exact = {**self.exact, "allocations/later-run/row-stream": 1}
        self.assertEqual(self.run_gate()[0], 1)

    def test_instructions_may_move_by_half_a_per_cent_up_or_down(self):
        for count, code in ((1_005_000, 0), (1_005_001, 1), (995_000, 0), (994_999, 1)):
            self.counts = {"row-stream/avx2/depth:3": count}
            self.assertEqual(self.run_gate()[0], code, count)

    def test_a_cost_that_is_lost_or_new_fails(self):
        self.counts = {"another": 5}
        code, out = self.run_gate()
        self.assertEqual(code, 1)
        self.assertIn("row-stream/avx2/depth:3: 1000000 in the baseline, not measured", out)
        self.assertIn("another: 5, not in the baseline", out)

    def test_another_compiler_is_an_error_that_lists_the_baselines(self):
        with mock.patch.object(gate, "key_of", lambda programs: "Clang-14/avx2"):
            code, out = self.run_gate()
            self.assertEqual(code, 2)
            for text in ("NOT CHECKED", "no baseline for this compiler", "Clang-14/avx2", "GNU-12/avx2"):
                self.assertIn(text, out)

    def test_under_ctest_another_compiler_is_skipped_but_never_in_ci(self):
        with mock.patch.object(gate, "key_of", lambda programs: "Clang-14/avx2"):
            self.assertEqual(self.run_gate(skips=True)[0], gate.SKIPPED)
            self.assertEqual(self.run_gate(skips=True, ci=True)[0], 2)

    def test_no_baseline_at_all_is_an_error(self):
        (self.folder / "exact.json").unlink()
        code, out = self.run_gate()
        self.assertEqual(code, 2)
        self.assertIn("exact.json is not there", out)

    def test_a_regression_is_not_hidden_by_a_missing_baseline(self):
        (self.folder / "instructions.json").unlink()
        self.exact = {}
        self.assertNotEqual(self.run_gate(skips=True)[0], 0)

    def test_renewing_keeps_the_other_compilers(self):
        with mock.patch.object(gate, "key_of", lambda programs: "Clang-14/avx2"):
            self.run_gate(["instructions"], update=True)
        kept = json.loads((self.folder / "instructions.json").read_text())
        self.assertEqual(set(kept), {"GNU-12/avx2", "Clang-14/avx2"})


class Built(unittest.TestCase):
    """What the programs of this build say."""

    def setUp(self):
        if PROGRAMS is None:
            raise unittest.SkipTest("give the folder of the programs")

    def test_every_function_of_every_kernel_is_timed_and_where_callgrind_knows_it_counted(self):
        timed, counted = (measure.kernel_calls(PROGRAMS, program) for program in ("timing_turns", "instruction_case"))
        self.assertGreaterEqual(len(timed), 2 * 5, "the scalar kernels alone have five functions")
        self.assertEqual([f for f, cases in timed.items() if not cases], [])
        self.assertEqual([f for f, cases in counted.items() if not cases and "avx512" not in f], [])
        standard = measure.SUITES["standard"]
        best = next(f.split("/")[1] for f in timed)  # the targets come best first
        for function, cases in timed.items():
            if function.split("/")[1:-1] == [best]:
                self.assertTrue(any(measure.matches(standard, case) for case in cases), function)

    def test_every_scheme_form_and_use_is_among_the_cases(self):
        timed = turns.build_and_cases(PROGRAMS)[1]
        counted = measure.counted_cases(PROGRAMS)[1]
        forms = ("random-depths", "indexed", "patches", "patches-kept", "patches-compact", "patches-sticky", "deforming-project-sphere",
                 "deforming-combined")
        wanted = [f"{scheme}frame/row-stream/{form}" for scheme in ("", "quads/") for form in forms]
        wanted += [f"equal-error/{what}" for what in ("points/normals:2^-16", "points/quads/normals:2^-16", "frames/pixels:0.5",
                                                      "frames/quads/pixels:0.5")]
        wanted += ["n-gons/frame/row-stream/patches", "semi-sharp/frame/row-stream/patches"]
        self.assertEqual(sorted(set(wanted) - set(timed)), [])
        self.assertEqual(sorted(set(wanted) - set(counted)), [])
        for pattern in (r"^row-stream/whole-pairs/steady", r"^row-stream/whole-quads/steady", r"^row-stream/streamed/steady/bumpy",
                        r"^row-stream/streamed/steady/quads", r"/scratch/bumpy", r"/scratch/quads", r"bumpy/.*threads:2$",
                        r"quads/.*threads:2$", r"^frame/row-stream/two-threads$", r"^quads/frame/row-stream/two-threads$"):
            self.assertTrue(any(measure.matches(pattern, case) for case in timed), pattern)

    def test_a_kernel_slower_by_two_per_cent_of_a_case_shows_in_it_and_in_no_case_that_does_not_call_it(self):
        case, other, function = "row-stream/avx2/depth:3", "quads/row-stream/avx2/depth:3", "loop/avx2/run"
        if case not in measure.counted_cases(PROGRAMS)[1]:
            self.skipTest("this machine has no AVX2")
        before = measure.counts_of(PROGRAMS, [case, other], QUIET)
        whole = self_test.instructions_for(PROGRAMS, function, case, before[case], QUIET)
        plant = measure.Planted(PROGRAMS, f"{function}=+{round(.02 * whole)}")
        rows = {row["name"]: row for row in decide.judge_counts({"instructions": before},
                                                               {"instructions": measure.counts_of(plant, [case, other], QUIET)})}
        self.assertAlmostEqual(rows[case]["ratio"], 1.02, delta=.002)
        self.assertEqual((rows[case]["verdict"], rows[other]["verdict"]), ("more", ""))

    def test_nothing_is_allocated_once_a_contender_has_run(self):
        later = {n: v for n, v in gate.measured_exact(PROGRAMS).items() if n.startswith("allocations/later-run/")}
        self.assertGreater(len(later), 0)
        self.assertEqual(set(later.values()), {0}, later)

    def test_the_environment_moves_counts_by_less_than_half_of_what_is_allowed(self):
        case = "^set-up/row-stream/avx2$|^set-up/sliding-window$"
        with mock.patch.dict(os.environ, {"A_LONG_VARIABLE": 5000 * "x"}):
            longer = measure.instruction_counts(PROGRAMS, QUIET, case)
        for name, count in measure.instruction_counts(PROGRAMS, QUIET, case).items():
            self.assertAlmostEqual(longer[name] / count, 1, delta=decide.COUNT_TOLERANCE / 2)


if __name__ == "__main__":
    if len(sys.argv) > 1 and pathlib.Path(sys.argv[1]).is_dir():
        PROGRAMS = pathlib.Path(sys.argv.pop(1))
    unittest.main()
