#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""The report's page from made-up results: complete, self-contained, and honest about what is missing."""
import html.parser
import json
import pathlib
import re
import sys
import tempfile
import unittest
from unittest import mock

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import page  # noqa: E402
import parts  # noqa: E402
import tables  # noqa: E402
from parts import PARTS  # noqa: E402
from record import Record  # noqa: E402

EVIL = "<script>alert('x')</script> & co"


def timing(fps, spread=1.1):
    return {"frames_per_second": fps, "spread": spread, "frames": 1,
            "stages": {"heuristics": 0.1, "pairing": 0.1, "cracks": 0.1, "window": 0.2, "drawing": 0.5}}


def needs(triangles):
    return {"triangles": triangles, "frames_per_second": 7.0}


RESULTS = {
    "claims": {"claims": [{"id": "C01", "statement": EVIL, "verdict": "confirmed", "check": "A.B", "ran": True, "held": False},
                          {"id": "C02", "statement": "", "verdict": "not checkable", "check": None, "ran": False, "held": None},
                          {"id": "C79", "place": "7", "statement": "no perceivable difference", "verdict": "depends", "check": "A.C", "ran": True,
                           "held": True, "note": "On the settings.", "finding": "8.6 % are off.",
                           "measured": {"percent_off_200": "8.6", "percent_off_800": "11.5", "pixels": "60"}}]},
    "audit": {"causes": [{"number": 1, "severity": "high", "title": "Positions are off", "subjects": [EVIL], "rows": 1, "mesh": "m",
                          "command": "limitcheck audit x"}],
              "results": [{"subject": EVIL, "mesh": "m", "check": "positions", "status": "finding", "count": 1, "worst": 0.5, "bound": 1e-7,
                           "unit": "", "witness": {"face": 3, "l1": "1/2", "l2": "0"}, "cause": 1},
                          {"subject": "b", "mesh": "m", "check": "positions", "status": "held", "count": 1, "worst": 0, "bound": 1,
                           "unit": "", "witness": None}]},
    "timings": {"load": 1.5, "rows": [{"id": "T7", "outcome": "could not be measured", "figures": EVIL, "series": [
        {"name": "frames", "unit": "faces", "at": [200, 800], "values": [1.0, 2.0]}]}]},
    "spheres": {"renderer": "r", "threads": 2, "viewport": [1024, 768], "seed": 1, "rows": [
        {"faces": 200, "strategy": "combined", "triangles": 1.0, "strips": 2.0, "fans": 0.0, "pairs": 3.0, "singletons": 0.0,
         "culled_share": 0.25, "limit_points": 4.0,
         **{engine + how: timing(1.0) for engine in ("sliding_window", "row_stream") for how in ("", "_all_threads", "_drawn")},
         "picture": {"mean": 0.1, "median": 0.2, "percentile_99": 0.2, "share": 0.01, "missing": 5, "extra": 6}}]},
    "matched": {"engine": "e", "curves": [], "rows": [{"faces": 200, "measure": "mean", "as": "uniform-3", "error": 0.5,
                                                      "uniform": needs(100.0), "combined": needs(50.0), "combined, stitched": None}]},
    "proofs": {"rows": [{"group": "g", "kernel": "k", "map": "equal", "topology": "3 3 3", "depths": [0, 2], "points": 5,
                         "arithmetic": "exact", "bound": 1e-6, "worst": 1e-7, "digits": None}]},
    "throughput": {"benchmarks": [{"name": "a/real_time", "points/s": 1e6, "real_time": 2.0, "time_unit": "ms", "peak": 2**20}]},
    "frames": {"benchmarks": [{"name": f"{form}/uniform:3/faces:800/threads:1", "frames/s": 100.0 * k, "real_time": 1.0, "cpu_time": 1.0,
                               "triangles/s": 100.0 * k * triangles} for k, form, triangles in ((1, "draw", 50000), (3, "sticky", 40000))]},
}


class Reader(html.parser.HTMLParser):
    """Collects what a browser would fetch, the sections and the scripts."""

    def __init__(self):
        super().__init__()
        self.fetched, self.sections, self.scripts = [], [], 0

    def handle_starttag(self, tag, attrs):
        attributes = dict(attrs)
        self.fetched += [v for n, v in attrs if n in ("src", "href") and v and not v.startswith(("#", "data:"))]
        self.scripts += tag == "script"
        if tag == "section":
            self.sections.append(attributes["id"])


class Page(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def made(self, names=tuple(RESULTS), failed=()):
        record = Record(self.folder, PARTS)
        for name in names:
            (self.folder / f"{name}.json").write_text(json.dumps(RESULTS[name]))
        for name in PARTS:
            if all((self.folder / file).is_file() for file in PARTS[name].files):
                with record.making(name, False):
                    pass
        for name, why in failed:
            record.fail(name, why)
        self.gaps = page.write(self.folder, record)
        reader = Reader()
        self.text = (self.folder / "index.html").read_text()
        reader.feed(self.text)
        return reader

    def draw_all(self):
        for name in (f for part in PARTS.values() for f in part.files):
            (self.folder / name).write_text("{}")

    def test_every_part_has_its_section(self):
        self.draw_all()
        self.assertEqual(self.made().sections,
                         ["summary", "sentences", "tables", "frames", "matched", "pictures", "view", "claims", "audit", "proofs", "throughput"])
        self.assertEqual(self.gaps, [])

    def test_every_table_and_figure_names_the_command_that_makes_it_alone(self):
        self.draw_all()
        self.made()
        named = re.findall(r"<code>limitcheck reproduce --only ([^<]*)</code>", self.text)
        self.assertEqual(sorted(named), sorted(PARTS))
        for block in re.findall(r"<figure.*?</figure>|<section.*?</section>", self.text, re.DOTALL):
            self.assertIn("limitcheck reproduce --only", block)

    def test_pictures_and_the_view_have_one_palette(self):
        source = (pathlib.Path(__file__).resolve().parents[1] / "reproduction" / "studio.h").read_text()
        scale = source.partition("constexpr Colour scale[] = {")[2].partition("};")[0]
        colours = [[float(x.strip().rstrip("f")) for x in c.split(",")] for c in re.findall(r"\{([^{}]*)\}", scale + "}")]
        self.assertEqual(len(colours), 6)
        for ours, theirs in zip(page.DEPTH_COLOURS, colours):
            for k, part in zip((1, 3, 5), theirs):
                self.assertLessEqual(abs(int(ours[k:k + 2], 16) - 255 * part), 1, (ours, theirs))

    def test_the_summary_says_what_came_out(self):
        self.made(("claims",))
        short = self.text.partition("<section id=summary>")[2].partition("</section>")[0]
        for words in ("3 claims of the paper", "8.6 % are off.", "project-sphere", "Figures that are not reproduced: 1, 2, 9"):
            self.assertIn(words, short)

    def test_what_the_subject_delivered_goes_with_its_witness(self):
        witness = {"got": [1.0, 2.0, 3.0]}
        self.assertEqual(parts.delivered({"check": "positions", "witness": witness}), {"got_position": [1.0, 2.0, 3.0]})
        self.assertEqual(parts.delivered({"check": "normals", "witness": witness}), {"got_normal": [1.0, 2.0, 3.0]})
        self.assertEqual(parts.delivered({"check": "holes", "witness": {"got": None}}), {})

    def test_throughput_sets_our_variants_apart_from_others(self):
        runs = [{"name": f"{route}/steady/bumpy/faces:4000/depth:3/threads:1/real_time", "points/s": rate, "real_time": 1.0, "time_unit": "ms"}
                for route, rate in (("row-stream/avx2", 6e6), ("row-stream/compact", 4e6), ("far/uniform", 2e6))]
        (self.folder / "throughput.json").write_text(json.dumps({"benchmarks": runs}))
        self.made(())
        ours, _, others = self.text.partition("<table class=bars>")[2].partition("</table>")[0].partition(">others")
        self.assertIn("row-stream/compact", ours)
        self.assertIn("far/uniform", others)

    def test_it_opens_from_disk_with_nothing_beside_it(self):
        (self.folder / "figure-3.png").write_bytes(b"png")
        self.assertEqual(self.made().fetched, [])

    def test_names_from_outside_stay_text(self):
        self.assertEqual(self.made().scripts, 0)
        self.assertIn("&lt;script&gt;", self.text)

    def test_a_part_that_is_missing_is_left_out_and_said(self):
        reader = self.made(("timings",), [("claims", "the program crashed")])
        self.assertEqual(reader.sections, ["sentences"])
        self.assertIn("the paper&#x27;s claims (claims): the program crashed", self.text)
        for name in set(PARTS) - {"timings", "claims"}:
            self.assertIn(f"({name}): not made", self.text)

    def test_an_older_result_is_not_passed_off_as_new(self):
        self.made(("claims",), [("claims", "interrupted")])
        self.assertIn("Shown is an older result", self.text)
        self.assertIn("Not made anew: interrupted", self.text)

    def test_all_rates_counts_stages_and_errors_are_in_the_tables(self):
        self.made(("spheres",))
        for words in ("sliding window, 1 thread<", "sliding window, 2 threads", "sliding window, 1 thread, drawn", "row streaming, 1 thread<",
                      "row streaming, 2 threads", "row streaming, 1 thread, drawn", "triangles", "strips", "fans", "singletons", "culled",
                      "heuristics", "pairing", "window", "cracks", "drawing", "99 % of the pixels", "missing pixels", "by r, 1024 by 768"):
            self.assertIn(words, self.text)

    def test_at_equal_error_the_ratio_says_how_many_triangles_are_saved(self):
        self.made(("matched",))
        self.assertIn("50 (2.00)", self.text)
        self.assertIn("not reached", self.text)

    def test_a_broken_result_is_said_to_be_missing(self):
        (self.folder / "claims.json").write_text("----- Benchmark")
        self.assertEqual(self.made(("timings",)).sections, ["sentences"])
        self.assertIn("claims.json: Expecting value", self.text)

    def test_frames_are_one_line_for_each_case(self):
        self.made()
        row = re.search(r"<tr><td>uniform:3, faces:800(.*)", self.text)
        self.assertTrue(row, "a row of the case")
        self.assertEqual(row.group(1).split("<td>")[1:], ["50000", "100", "", "", "", "", "40000", "300"], "each form has its own triangles")

    def test_throughput_has_ratios(self):
        runs = [{"name": f"{route}/steady/bumpy/faces:4000/depth:3/threads:1/real_time", "points/s": rate, "real_time": 1.0, "time_unit": "ms"}
                for route, rate in (("row-stream/avx2", 6e6), ("far/uniform", 2e6))]
        (self.folder / "throughput.json").write_text(json.dumps({"benchmarks": runs}))
        self.made(())
        self.assertIn("<td>far/uniform<td>2<td>3<td>", self.text)

    def test_what_repetitions_contradict_has_no_bar_and_no_ratio(self):
        runs = [{"name": f"{route}/steady/bumpy/faces:4000/depth:3/threads:1", "points/s": rate, "spread": spread, "real_time": 9.0,
                 "cpu_time": 1.0, "time_unit": "ms"}
                for route, rate, spread in (("far/uniform", 2e6, 1.1), ("row-stream/avx512", 9e6, 1.7), ("row-stream/avx2", 6e6, 1.1))]
        (self.folder / "throughput.json").write_text(json.dumps({"benchmarks": runs}))
        self.made(())
        bars = self.text.partition("<table class=bars>")[2].partition("</table>")[0]
        self.assertNotIn("avx512", bars)
        self.assertIn("<td>far/uniform<td>2<td>3<td>1.10<td>1 ms", self.text, "the fastest that was measured, by the clock that counts")

    def test_what_clock_a_time_is_of_is_said_beside_it(self):
        self.made()
        for section in ("frames", "throughput"):
            self.assertIn("Processor time of one thread", self.text.partition(f"<section id={section}>")[2].partition("</section>")[0])

    def test_what_repetitions_contradict_is_not_measured(self):
        self.assertEqual(tables.rate(123.0, tables.WIDEST), "123")
        self.assertIn("not measured: 1.6", tables.rate(123.0, 1.6))
        row = RESULTS["spheres"]["rows"][0]
        with mock.patch.dict(row, sliding_window=timing(777.0, 2.5)):
            self.made(("spheres",))
        self.assertIn("not measured: 2.5", self.text)
        self.assertNotIn("777", self.text)

    def test_of_repetitions_the_least_by_the_clock_that_counts_is_kept(self):
        runs = [{"name": "a/threads:1", "run_name": "a/threads:1", "run_type": "iteration", "cpu_time": c, "real_time": r, "frames/s": 1 / c}
                for c, r in ((2.0, 9.0), (1.0, 50.0), (4.0, 8.0))]
        runs += [{"name": "a/threads:1_mean", "run_name": "a/threads:1", "run_type": "aggregate", "cpu_time": 0.1, "real_time": 0.1}]
        runs += [{"name": "b/threads:2/real_time", "run_type": "iteration", "cpu_time": c, "real_time": r} for c, r in ((1.0, 3.0), (2.0, 2.0))]
        one, two = parts.best_repetitions(runs)
        self.assertEqual((one["name"], one["frames/s"], one["spread"]), ("a/threads:1", 1.0, 4.0))
        self.assertEqual((two["name"], two["real_time"], two["spread"]), ("b/threads:2", 2.0, 1.5))

    def test_findings_are_told_by_their_causes_and_no_cell_says_none(self):
        RESULTS["audit"]["results"].append({**RESULTS["audit"]["results"][0], "check": "written", "worst": None, "bound": None, "cause": 2})
        self.addCleanup(RESULTS["audit"]["results"].pop)
        (self.folder / "viewer.js").write_text("")
        for name in ("model", "shapes"):
            (self.folder / f"{name}.json").write_text("{}")
        witness = {parts.place_key(RESULTS["audit"]["results"][0]): {"mesh": "m", "face": 3, "text": "here"}}
        (self.folder / "witnesses.json").write_text(json.dumps(witness))
        self.made(("audit",))
        self.assertIn("1 root cause of 2 findings", self.text)
        self.assertIn("Positions are off", self.text)
        self.assertEqual(self.text.count("class=jump"), 1)
        self.assertNotIn("<td>None", self.text)

    def test_pictures_are_told_in_words(self):
        self.draw_all()
        self.made()
        for words in re.findall(r"(?:alt|aria-label)='([^']*)'", self.text):
            self.assertGreater(len(words), 40, words)

    def test_a_claim_that_did_not_run_is_not_called_held(self):
        self.made(("claims",))
        with mock.patch.dict(RESULTS["claims"]["claims"][2], ran=False, held=None):
            self.made(("claims",))
        row = self.text.partition("<span id=C79>")[2].partition("\n")[0]
        self.assertIn("not run", row)
        self.assertNotIn("green", row)
        row = self.text.partition("<span id=C02>")[2].partition("\n")[0]
        self.assertIn(">none<", row, "as the headline counts what no test could decide")
        self.assertIn("red", self.text.partition("<span id=C01>")[2].partition("\n")[0])

    def test_a_sentence_has_one_verdict_wherever_it_is_judged(self):
        self.made(("claims", "timings"))
        sentence, row = (self.text.partition(f"{start}")[2].partition(end)[0]
                         for start, end in (("<article id=T10>", "</article>"), ("<span id=C79>", "\n")))
        for part in (sentence, row):
            self.assertIn(">depends<", part)
            self.assertNotIn(">confirmed<", part)
            self.assertIn(">green<", part)
            self.assertIn("8.6 % are off.", part)
        self.assertIn("<td>percent off<td>8.6<td>11.5", sentence)

    def test_the_headline_counts_conclusions_and_tests_apart(self):
        self.made(("claims",))
        self.assertIn("3 claims of the paper: confirmed 1, not checkable 1, depends 1. Our tests: green 1, red 1, not run 0, none 1.", self.text)

    def test_what_could_not_be_measured_is_said_and_no_verdict(self):
        self.made(("timings",))
        self.assertIn("<b class=open>could not be measured</b>", self.text)

    def test_the_worst_status_of_a_check_is_shown(self):
        RESULTS["audit"]["results"].append({**RESULTS["audit"]["results"][1], "status": "crash"})
        self.addCleanup(RESULTS["audit"]["results"].pop)
        self.made(("audit",))
        self.assertIn(">crash<", self.text)


if __name__ == "__main__":
    unittest.main()
