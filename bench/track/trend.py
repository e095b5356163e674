# SPDX-License-Identifier: MIT
"""The history of a store of records as one page: a section per machine and compiler, a panel per benchmark."""
import html
import json
import pathlib
import re
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
<p>One section per machine, compiler, flags and vector targets: figures of different sections are not comparable. One panel
per benchmark, one point per record, in the order of their dates; a star marks a working tree with changes on top of its commit. Times are medians of all repetitions, the band holds the
middle half of them; instruction counts are exact. Axes do not start at zero; they span at least 10 % either way.</p>
{sections}</html>
"""


def times_of(record):
    """{benchmark: (median, quartiles, unit)} over all rounds."""
    unit = {run["run_name"]: run.get("time_unit", "ms") for timing in record["rounds"] for run in timing["benchmarks"]}
    values = {}
    for timing in record["rounds"]:
        for name, some in decide.samples(timing).items():
            values.setdefault(name, []).extend(some)
    result = {}
    for name, some in values.items():
        low, middle, high = statistics.quantiles(some, n=4, method="inclusive") if len(some) > 1 else 3 * some
        result[name] = {"value": middle, "low": low, "high": high, "unit": f"{unit[name]} per run"}
    return result


def tick(number, record):
    """"1a2b3c4 #7"; a star for a working tree with changes."""
    return f"{record['commit'][:7]}{'*' if record['commit'].endswith('-dirty') else ''} #{number + 1}"


def history(records):
    """{(kind, benchmark): [points in the order of records]}."""
    panels = {}
    for number, record in enumerate(records):
        place = {"record": tick(number, record)}
        for name, point in times_of(record).items():
            panels.setdefault(("time", name), []).append({**place, **point})
        for name, count in record["instructions"].items():
            point = {"value": count / 1e6, "low": None, "high": None, "unit": "million instructions"}
            panels.setdefault(("instructions", name), []).append({**place, **point})
    return panels


def panel(name, points, order):
    """One benchmark over all records of its machine; a record without it leaves a gap."""
    y = {"field": "value", "type": "quantitative", "title": points[0]["unit"], "axis": {"tickCount": 4},
         "scale": {"domain": [0.9 * min(p["value"] for p in points), 1.1 * max(p["value"] for p in points)], "clamp": True}}
    x = {"field": "record", "type": "ordinal", "scale": {"domain": order}, "title": "commit",
         "axis": {"labelAngle": -45, "labelOverlap": "greedy" if len(order) > 12 else False}}
    short = name.removesuffix("/real_time").removesuffix("/threads:1")
    title = re.sub(r"/(?=steady|scratch)", "\n", short).split("\n")  # in two lines
    known = {p["record"]: p for p in points}
    values = [known.get(record, {"record": record, "value": None, "low": None, "high": None}) for record in order]
    return {
        "title": {"text": title, "fontSize": 11, "anchor": "start"}, "width": 270, "height": 110, "data": {"values": values},
        "layer": [
            {"mark": {"type": "area", "opacity": 0.25},
             "encoding": {"x": x, "y": {**y, "field": "low"}, "y2": {"field": "high"}}},
            {"mark": {"type": "line", "point": True, "invalid": "break-paths-show-path-domains"}, "encoding": {"x": x, "y": y}},
        ],
    }


def specification(panels, order):
    return {"$schema": "https://vega.github.io/schema/vega-lite/v6.json", "columns": 3, "spacing": 20,
            "concat": [panel(name, points, order) for (_, name), points in sorted(panels.items())]}


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


def fact(value):
    return html.escape(", ".join(map(str, value)) if isinstance(value, list) else str(value))


def page(records):
    by_key = {}
    for record in sorted(records, key=lambda r: r["date"]):
        by_key.setdefault(record["key"], []).append(record)
    sections = []
    for key, some in by_key.items():
        facts = "".join(f"<tr><th>{html.escape(n)}<td>{fact(v)}" for n, v in some[0]["identity"].items())
        facts += f"<tr><th>records<td>{len(some)}, {fact(some[0]['date'][:10])} to {fact(some[-1]['date'][:10])}"
        sections.append(f"<h2>{html.escape(some[0]['identity']['machine'])} <small>{html.escape(key)}</small></h2><table>{facts}</table>")
        panels = history(some)
        order = [tick(number, record) for number, record in enumerate(some)]
        for kind, title in (("time", "Times"), ("instructions", "Instruction counts")):
            of_kind = {name: points for name, points in panels.items() if name[0] == kind}
            if of_kind:
                sections.append(f"<h3>{title}</h3>{draw(specification(of_kind, order))}")
    return PAGE.format(sections="\n".join(sections))
