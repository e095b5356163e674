# SPDX-License-Identifier: MIT
"""The history of a store of records as one page: a figure per machine and compiler."""
import html
import json
import pathlib
import statistics
import subprocess
import tempfile

import decide
import measure

REPORT = pathlib.Path(__file__).resolve().parent.parent / "report"

PAGE = """<!doctype html>
<html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>limitcheck: performance over time</title>
<style>body{{font:16px/1.5 system-ui,sans-serif;max-width:70rem;margin:2rem auto;padding:0 1rem}}svg{{max-width:100%;height:auto}}
td,th{{padding:.1rem .8rem .1rem 0;text-align:left;vertical-align:top}}</style>
<h1>Performance over time</h1>
<p>Each curve is one benchmark, relative to its first record on that machine: 1 is as it was, below is faster.
Times are medians of all repetitions; instruction counts are exact.</p>
{sections}</html>
"""


def history(records):
    """One row per record and benchmark: its value relative to the first record that has it."""
    rows, first = [], {}
    for number, record in enumerate(records):
        place = {"record": f"{number + 1} {record['commit']}", "date": record["date"]}
        times = {}
        for timing in record["rounds"]:
            for name, values in decide.samples(timing).items():
                times.setdefault(name, []).extend(values)
        for kind, values in (("time", {n: statistics.median(v) for n, v in times.items()}),
                             ("instructions", record["instructions"])):
            for name, value in values.items():
                base = first.setdefault((kind, name), value)
                rows.append({**place, "kind": kind, "benchmark": name, "ratio": value / base})
    return rows


def specification(rows):
    return {
        "$schema": "https://vega.github.io/schema/vega-lite/v6.json",
        "data": {"values": rows},
        "facet": {"row": {"field": "kind", "type": "nominal", "title": None}},
        "spec": {
            "width": 640, "height": 240, "mark": {"type": "line", "point": True},
            "encoding": {
                "x": {"field": "record", "type": "ordinal", "sort": None, "title": "record"},
                "y": {"field": "ratio", "type": "quantitative", "scale": {"zero": False}, "title": "relative to the first"},
                "color": {"field": "benchmark", "type": "nominal", "legend": {"labelLimit": 400, "columns": 1, "symbolLimit": 60}},
            },
        },
        "resolve": {"scale": {"y": "independent", "color": "independent"}},
    }


def draw(spec):
    if not (REPORT / "node_modules").is_dir():
        raise measure.MeasureError(f"drawing needs Vega-Lite: npm install --prefix {REPORT}")
    with tempfile.NamedTemporaryFile("w", suffix=".vl.json") as file:
        json.dump(spec, file)
        file.flush()
        done = subprocess.run(["node", str(REPORT / "render.mjs"), file.name], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise measure.MeasureError(done.stderr.strip())
    return done.stdout


def page(records):
    by_key = {}
    for record in sorted(records, key=lambda r: r["date"]):
        by_key.setdefault(record["key"], []).append(record)
    sections = []
    for key, some in by_key.items():
        facts = "".join(f"<tr><th>{html.escape(n)}<td>{html.escape(str(v))}" for n, v in some[0]["identity"].items())
        sections.append(f"<h2>{html.escape(some[0]['identity']['machine'])} <small>{key}</small></h2>"
                        f"<table>{facts}</table>{draw(specification(history(some)))}")
    return PAGE.format(sections="\n".join(sections))
