#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""The report's page from made-up results: complete, self-contained, and honest about what is missing."""
import html.parser
import json
import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import page  # noqa: E402

EVIL = "<script>alert('x')</script> & co"


def timing(fps):
    return {"frames_per_second": fps, "frames": 1, "stages": {}}


RESULTS = {
    "claims": {"claims": [{"id": "C01", "statement": EVIL, "verdict": "confirmed", "check": "A.B", "ran": True, "held": False},
                          {"id": "C02", "statement": "", "verdict": "not checkable", "check": None, "ran": False, "held": None}]},
    "audit": {"results": [{"subject": EVIL, "mesh": "m", "check": "positions", "status": "finding", "count": 1, "worst": 0.5, "bound": 1e-7,
                           "unit": "", "witness": {"face": 3}},
                          {"subject": "b", "mesh": "m", "check": "positions", "status": "held", "count": 1, "worst": 0, "bound": 1,
                           "unit": "", "witness": None}]},
    "trends": [{"id": "T1", "statement": EVIL, "held": True, "figures": "1 2"}],
    "spheres": {"renderer": "r", "rows": [{"faces": 200, "strategy": "combined", "triangles": 1.0, "fans": 0.0, "singletons": 0.0,
                                           "culled_share": 0.25, "sliding_window": timing(1.0), "row_stream": timing(2.0),
                                           "sliding_window_drawn": timing(3.0), "row_stream_drawn": timing(4.0),
                                           "error_pixels": {"silhouette_99": 0.1, "interior_99": 0.2}}]},
    "throughput": {"benchmarks": [{"name": "a/real_time", "points/s": 1e6, "real_time": 2.0, "time_unit": "ms", "peak": 2**20}]},
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

    def made(self, names=tuple(RESULTS), missing=()):
        for name in names:
            (self.folder / f"{name}.json").write_text(json.dumps(RESULTS[name]))
        page.write(self.folder, list(missing))
        reader = Reader()
        self.text = (self.folder / "index.html").read_text()
        reader.feed(self.text)
        return reader

    def test_every_part_that_was_made_has_its_section(self):
        (self.folder / "figure-3.png").write_bytes(b"png")
        self.assertEqual(self.made().sections, ["trends", "tables", "pictures", "claims", "audit", "throughput"])

    def test_it_opens_from_disk_with_nothing_beside_it(self):
        (self.folder / "figure-3.png").write_bytes(b"png")
        self.assertEqual(self.made().fetched, [])

    def test_names_from_outside_stay_text(self):
        self.assertEqual(self.made().scripts, 0)
        self.assertIn("&lt;script&gt;", self.text)

    def test_a_part_that_is_missing_is_left_out_and_said(self):
        reader = self.made(("trends",), ["claims: the program crashed"])
        self.assertEqual(reader.sections, ["trends"])
        self.assertIn("claims: the program crashed", self.text)

    def test_a_broken_result_is_said_to_be_missing(self):
        (self.folder / "claims.json").write_text("----- Benchmark")
        self.assertEqual(self.made(("trends",)).sections, ["trends"])
        self.assertIn("claims.json: Expecting value", self.text)

    def test_a_claim_that_did_not_run_is_not_called_held(self):
        self.made(("claims",))
        self.assertIn("not held", self.text)
        self.assertIn("not run", self.text)
        self.assertNotIn("<b class=yes>held", self.text)

    def test_the_worst_status_of_a_check_is_shown(self):
        RESULTS["audit"]["results"].append({**RESULTS["audit"]["results"][1], "status": "crash"})
        self.addCleanup(RESULTS["audit"]["results"].pop)
        self.made(("audit",))
        self.assertIn(">crash<", self.text)


if __name__ == "__main__":
    unittest.main()
