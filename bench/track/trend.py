# SPDX-License-Identifier: MIT
"""The history of a store of records as one page: a section per machine and compiler, a panel per benchmark."""
import html
import json
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

import decide
import measure

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "report"))
import node_tools  # noqa: E402

PAGE = """<!doctype html>
<html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>limitcheck: performance over time</title>
<style>body{{font:16px/1.5 system-ui,sans-serif;max-width:70rem;margin:2rem auto;padding:0 1rem}}svg{{max-width:100%;height:auto}}
td,th{{padding:.1rem .8rem .1rem 0;text-align:left;vertical-align:top}}</style>
<h1>Performance over time</h1>
<p>One section per machine, compiler, flags and vector targets: figures of different sections are not comparable. One panel
per benchmark, one point per record, in the order of their dates, under its label or commit; a star marks a working tree with changes. A dashed red line marks a step: a level that
later records keep. Times are medians of all repetitions, the band holds the
middle half of them; instruction counts are exact. Axes do not start at zero; they span at least 10 % either way.</p>
{sections}</html>
"""


def times_of(record):
    """{benchmark: (median, quartiles, unit)} over all rounds."""
    unit = {run["run_name"].removesuffix("/real_time"): run.get("time_unit", "ms") for timing in record["rounds"] for run in timing["benchmarks"]}
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
    """"before #1": the label, or the commit with a star for a working tree with changes: "1a2b3c4* #7"."""
    commit = f"{record['commit'][:7]}{'*' if record['commit'].endswith('-dirty') else ''}"
    label = record.get("label", record["commit"])
    return f"{commit if label == record['commit'] else label} #{number + 1}"


def steps(points):
    """Where a series moves and stays: indices of the first points of new levels. Counts, which repeat, move beyond their
    tolerance from one record to the next. Of times the medians of up to three records on either side differ by what counts, and
    no record's middle half reaches across: one slow record is no step."""
    found = []
    for k in range(1, len(points)):
        start = max(found[-1] if found else 0, k - 3)
        before, after = points[start:k], points[k:k + 3]
        if points[k]["low"] is None:
            if abs(after[0]["value"] / before[-1]["value"] - 1) > decide.COUNT_TOLERANCE:
                found.append(k)
            continue
        ratio = statistics.median(p["value"] for p in after) / statistics.median(p["value"] for p in before)
        apart = (min(p["low"] for p in after) > max(p["high"] for p in before)
                 or max(p["high"] for p in after) < min(p["low"] for p in before))
        if len(before) >= 2 and len(after) >= 2 and abs(ratio - 1) >= decide.TIME_EFFECT and apart:
            found.append(k)
    return found


def by_machine(records):
    groups = {}
    for record in sorted(records, key=lambda r: r["date"]):
        groups.setdefault(record["key"], []).append(record)
    return groups


def markdown(records):
    """The steps of every series as a table, the largest first."""
    rows = []
    for some in by_machine(records).values():
        for (kind, name), points in history(some).items():
            for k in steps(points):
                change = points[k]["value"] / points[k - 1]["value"] - 1
                rows.append((change, f"| `{name}` | {kind} | {100 * change:+.1f} % | {points[k]['record']} |"))
    lines = [f"{len(records)} records, {len(rows)} step{'' if len(rows) == 1 else 's'}", ""]
    if rows:
        lines += ["| benchmark | | change | from |", "|---|---|---|---|"]
    return "\n".join(lines + [row for _, row in sorted(rows, reverse=True)])


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
    x = {"field": "record", "type": "ordinal", "scale": {"domain": order}, "title": "record",
         "axis": {"labelAngle": -45, "labelOverlap": "greedy" if len(order) > 12 else False}}
    short = name.removesuffix("/threads:1")
    title = re.sub(r"/(?=steady|scratch)", "\n", short).split("\n")  # in two lines
    known = {p["record"]: p for p in points}
    moved = [points[k]["record"] for k in steps(points)]
    values = [known.get(record, {"record": record, "value": None, "low": None, "high": None}) for record in order]
    return {
        "title": {"text": title, "fontSize": 11, "anchor": "start"}, "width": 270, "height": 110, "data": {"values": values},
        "layer": [
            {"mark": {"type": "area", "opacity": 0.25},
             "encoding": {"x": x, "y": {**y, "field": "low"}, "y2": {"field": "high"}}},
            {"mark": {"type": "line", "point": True, "invalid": "break-paths-show-path-domains"}, "encoding": {"x": x, "y": y}},
            {"mark": {"type": "rule", "strokeDash": [4, 3], "color": "#c0341d"}, "transform": [{"filter": {"field": "record", "oneOf": moved}}],
             "encoding": {"x": x}},
        ],
    }


def specification(panels, order):
    return {"$schema": "https://vega.github.io/schema/vega-lite/v6.json", "columns": 3, "spacing": 20,
            "concat": [panel(name, points, order) for (_, name), points in sorted(panels.items())]}


def run(command):
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise node_tools.NodeError(done.stderr.strip())
    return done.stdout


def draw(spec):
    with tempfile.NamedTemporaryFile("w", suffix=".vl.json") as file:
        json.dump(spec, file)
        file.flush()
        try:
            tools = node_tools.prepare(pathlib.Path(sys.argv[0]).absolute().parent, run)
            return run(["node", tools / "render.mjs", file.name])
        except node_tools.NodeError as error:
            raise measure.MeasureError(str(error)) from error


def fact(value):
    return html.escape(", ".join(map(str, value)) if isinstance(value, list) else str(value))


def page(records):
    sections = []
    for key, some in by_machine(records).items():
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
