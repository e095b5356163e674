# SPDX-License-Identifier: MIT
"""Results as tables of the report."""
import html
import json
import re

from parts import place_key, shown_findings


def text(value):
    return html.escape(str(value))


def number(value, digits=3):
    """Nothing for what is not there."""
    return "" if value is None else f"{value:.{digits}g}" if isinstance(value, float) else text(value)


WIDEST = 1.5  # repetitions that differ by more say nothing


def rate(value, spread=1):
    """A measured rate, unless its repetitions contradict each other."""
    if spread > WIDEST:
        return f"<span class=open>not measured: {spread:.1f}</span>"
    return f"{value:.3g}" if value < 1000 else f"{value:.0f}"


def table(header, rows, caption=""):
    head = "".join(f"<th scope=col>{text(h)}" for h in header)
    body = "".join("<tr>" + "".join(f"<td>{cell}" for cell in row) + "\n" for row in rows)
    return (f"<div class=wide tabindex=0><table><caption>{caption}</caption><thead><tr>{head}<tbody>{body}</table></div>")


def details(summary, body):
    return f"<details><summary>{summary}</summary>{body}</details>"


def mark(claim):
    """Whether our test agrees with what we conclude; some claims no test could decide."""
    if not claim["ran"]:
        return f"<b class=open>{'not run' if claim['check'] else 'none'}</b>"
    return "<b class=yes>green</b>" if claim["held"] else "<b class=no>red</b>"


def badge(verdict):
    """What we conclude about a sentence of the paper."""
    return f"<b class='verdict {text(verdict.replace(' ', '-'))}'>{text(verdict)}</b>"


def headline(data):
    """How many claims of each verdict, and how our tests stand: the same words as `limitcheck claims`."""
    rows = data["claims"]
    counts = {}
    for row in rows:
        counts[row["verdict"]] = counts.get(row["verdict"], 0) + 1
    known = [v for v in data.get("verdicts", counts) if v in counts]
    concluded = ", ".join(f"{text(v)} {counts[v]}" for v in known)
    green = sum(bool(r["ran"] and r["held"]) for r in rows)
    red = sum(bool(r["ran"] and not r["held"]) for r in rows)
    waiting = sum(bool(not r["ran"] and r["check"]) for r in rows)
    return (f"{len(rows)} claims of the paper: {concluded}. Our tests: green {green}, red {red}, not run {waiting}, none "
            f"{len(rows) - green - red - waiting}.")


def claims(data):
    rows = data["claims"]
    errata = [r for r in rows if r["verdict"] == "misprint"]
    said = lambda r: "<br>".join(text(r[key]) for key in ("note", "finding") if r.get(key))  # noqa: E731
    return (f"<p>{headline(data)}</p>"
            + table(["claim", "place", "printed", "correction"],
                    [[text(r["id"]), text(r.get("place", "")), text(r["statement"]), text(r.get("note") or "")] for r in errata],
                    f"{len(errata)} wrong as printed; the errata as Markdown: <code>limitcheck claims --errata</code>")
            + details(f"All {len(rows)} claims", table(
                ["claim", "the paper says", "we conclude", "our test", "note, and what was measured", "check"],
                [[f"<span id={text(r['id'])}>{text(r['id'])}</span>", text(r.get("statement", "")), badge(r["verdict"]),
                  mark(r), said(r),
                  f"<code>{text(', '.join(r['check']) if isinstance(r['check'], list) else r['check'] or '')}</code>"] for r in rows])))


def claims_not_run(data):
    """Why a part of the claims says nothing today; '' if all ran."""
    waiting = [r["id"] for r in data["claims"] if not r["ran"] and r["check"]]
    return (f"{len(waiting)} of {len(data['claims'])} claims were not run, their test programs are not built "
            "(bash verify/test.sh builds them)") if waiting else ""


def audit(data, places):
    results = data["results"]
    subjects = list(dict.fromkeys(r["subject"] for r in results))
    checks = list(dict.fromkeys(r["check"] for r in results))
    cells = {}
    for r in results:
        cells.setdefault((r["subject"], r["check"]), []).append(r)
    rank = ["crash", "timeout", "error", "finding", "unexpected-pass", "quality-warning", "waived", "not-run", "held", "not-supported"]

    def worst(some):
        status = min((r["status"] for r in some), key=lambda s: rank.index(s) if s in rank else 0)
        return f"<span class='status {text(status)}'>{text(status)}</span>"
    rows = [[text(c), *(worst(cells[s, c]) if (s, c) in cells else "" for s in subjects)] for c in checks]
    meshes = ", ".join(text(m["name"]) for m in data.get("meshes", []))
    return (table(["check", *subjects], rows, f"The worst of all meshes: {meshes}") + causes(data, places))


def causes(data, places):
    """What lies behind the findings, and the worst witness of each cause that the view can show."""
    shown, bad = shown_findings(data["results"])
    lines = []
    for cause in data.get("causes", []):
        row = shown.get(cause["number"])
        place = places.get(place_key(row)) if row else None
        button = f"<button class=jump data-witness='{text(json.dumps(place))}'>show</button>" if place else ""
        lines.append([text(cause["number"]), text(cause["severity"]), text(cause["title"]), text(", ".join(cause["subjects"])),
                      text(cause["rows"]), button, f"<code>{text(cause['command'])}</code>"])
    return table(["", "severity", "cause", "subjects", "findings", "in the view", "again with"], lines,
                 f"{len(lines)} root cause{'' if len(lines) == 1 else 's'} of {bad} findings; each finding: <code>limitcheck audit all --details</code>")


PIXELS = ("Difference of the shade of each pixel, of 255, from deep uniform depth, seen from two sides by a rasteriser without a driver. "
          "A pixel that shows the surface in one of the pictures only counts as off by 255.")
TIMED = (f"The least of three repetitions; where they differ by more than a factor of {WIDEST}, nothing is measured, and the factor "
         "stands in its place.")
ONE_THREAD = f"Processor time of one thread; the wall's where there are more. {TIMED}"
ENGINES = (("sliding_window", "sliding window"), ("row_stream", "row streaming"))


def spheres(data):
    rows = data["rows"]

    def lines(*columns):
        return [[text(r["faces"]), text(r["strategy"]), *(c(r) for c in columns)] for r in rows]
    share = lambda value: f"{value:.1%}"  # noqa: E731
    mean = lambda key, digits=0: lambda r: f"{r[key]:.{digits}f}"  # noqa: E731
    fps = lambda key: lambda r: rate(r[key]["frames_per_second"], r[key].get("spread", 1))  # noqa: E731
    stage = lambda key, name: lambda r: share(r[key]["stages"][name])  # noqa: E731
    shade = lambda key: lambda r: number(float(r["picture"][key]))  # noqa: E731
    first, threads = ["faces", "strategy"], data["threads"]
    stages = ["heuristics", "pairing", "cracks", "window"]
    return (
        details("Frames per second", table(
            first + [f"{name}, {how}" for _, name in ENGINES for how in ("1 thread", f"{threads} threads", "1 thread, drawn")],
            lines(*(fps(key + end) for key, _ in ENGINES for end in ("", "_all_threads", "_drawn"))),
            f"Drawn: with OpenGL by {text(data['renderer'])}, {data['viewport'][0]} by {data['viewport'][1]} pixels. One thread: processor time; "
            f"{threads} threads: time on the wall (load {number(float(data.get('load', 0)))}). {TIMED}"))
        + details("What a frame holds", table(
            first + ["triangles", "strips", "fans", "pairs", "no partner (singletons)", "culled", "limit points"],
            lines(mean("triangles"), mean("strips"), mean("fans"), mean("pairs"), mean("singletons", 1),
                  lambda r: share(r["culled_share"]), mean("limit_points")),
            "Means over the frames of a turn of one sphere. The claims look at it from one side or from two, and so have other numbers."))
        + details("Shares of the stages", table(
            first + [f"{name}: {s}" for _, name in ENGINES for s in stages] + [f"{name}, drawn: drawing" for _, name in ENGINES],
            lines(*(stage(key, s) for key, _ in ENGINES for s in stages), *(stage(key + "_drawn", "drawing") for key, _ in ENGINES)),
            "Of the time of a frame, one thread. Row streaming plans pairs and cracks together. Drawing: share of a frame that is drawn."))
        + details("How they look", table(
            first + ["pixels off by more than 4", "99 % of the pixels", "mean", "median", "missing pixels", "extra pixels"],
            lines(lambda r: share(r["picture"]["share"]), *(shade(k) for k in ("percentile_99", "mean", "median")),
                  *(lambda r, k=k: text(r["picture"][k]) for k in ("missing", "extra"))),
            PIXELS)))



def matched(data):
    families = [k for k in data["rows"][0] if k not in ("faces", "measure", "as", "error")]
    measures = {"percentile_99": "99 % of the pixels", "mean": "mean", "median": "median", "share": "share of pixels off by more than 4"}

    def cell(row, family):
        it, uniform = row[family], row["uniform"]
        if not it:
            return "not reached"
        ratio = "" if family == "uniform" else f" ({uniform['triangles'] / it['triangles']:.2f})"
        return f"{it['triangles']:.0f}{ratio}<br>{rate(it['frames_per_second'], it.get('spread', 1))}"
    rows = [[text(r["faces"]), text(measures[r["measure"]]), text(r["as"]), number(float(r["error"])), *(cell(r, f) for f in families)]
            for r in data["rows"]]
    intro = ("<p>Equal depth is no comparison: the strategies do not show the surface equally well. Here each adaptive strategy is run "
             "from coarse to fine settings (240 to 3.75 pixels, half the number of degrees), and read off where its picture is as far off "
             "as that of a uniform depth. " + PIXELS + " In each cell: triangles, (those of uniform depth divided by them: above 1 the strategy is "
             "better), and below frames per second. What holds the strategies back are the paper's fans, which drop all points inside a "
             "face: the last two columns keep these and stitch only the border (not in the paper).</p>")
    only = lambda depth: [row for row, r in zip(rows, data["rows"]) if r["as"] == depth]  # noqa: E731
    header = ["faces", "error", "as", "of 255", *families]
    return (intro + table(header, only("uniform-3"), f"At the error of uniform depth 3; {text(data['engine'])}")
            + details("At the error of uniform depths 2 and 4", table(header, only("uniform-2") + only("uniform-4"))))


FORMS = {"draw": "draw list", "patches": "patches", "kept": "patches that stay", "sticky": "pairs stay, too"}


def frames(data):
    """Frames per second of each form of output: one line for each strategy and mesh."""
    cases = {}
    for run in data["benchmarks"]:
        form, case = run["name"].partition("/threads")[0].split("/", 1)
        cases.setdefault(case, {})[form] = run

    def line(case, runs):
        triangles = lambda run: f"{run['triangles/s'] / run['frames/s']:.0f}"  # noqa: E731
        return [text(case.replace("/", ", ")),
                *(show(runs[form]) if form in runs else "" for form in FORMS
                  for show in (triangles, lambda run: rate(run["frames/s"], run.get("spread", 1))))]
    columns = [f"{what}, {name}" for name in FORMS.values() for what in ("triangles", "frames per second")]
    return details("As a table", table(["case", *columns], [line(case, runs) for case, runs in cases.items()],
                                       f"{ONE_THREAD} More cases and forms: <code>build/release/bench/frame_bench</code>"))


OURS = ("row-stream", "sliding-window", "naive", "reference", "write-only")


def throughput(data, scheme="Loop"):
    """Rates as bars, our own variants apart from others; and all of it as a table."""
    cases = {}
    for r in data["benchmarks"]:
        if "points/s" in r and r.get("run_type") != "aggregate":
            route, _, case = re.sub(r"/(steady|scratch)/", r"|\1/", r["name"].replace("/real_time", ""), count=1).partition("|")
            cases.setdefault(case, {})[route] = r
    rows = []
    for case, some in cases.items():
        sound = {route: r["points/s"] for route, r in some.items() if r.get("spread", 1) <= WIDEST}
        best = max((speed for route, speed in sound.items() if route.startswith("row-stream/")), default=None)
        for route, r in sorted(some.items()):
            clock = "cpu_time" if "/threads:1" in case and "cpu_time" in r else "real_time"
            rows.append([text(case), text(route), rate(r["points/s"] / 1e6, r.get("spread", 1)),
                         f"{best / r['points/s']:.3g}" if best and route in sound else "", f"{r.get('spread', 1):.2f}",
                         f"{r[clock]:.4g} {r['time_unit']}", f"{r['peak'] / 2**20:.3g} MiB" if "peak" in r else ""])
        cases[case] = list(sound.items())
    charts = "".join(bars(case, some) for case, some in cases.items() if len(some) > 1)
    option = "" if scheme == "Loop" else " --scheme catmull-clark"
    return f"<h3>{scheme}</h3>" + charts + details(f"All cases of {scheme} as a table", table(
        ["case", "route", "million points/s", "the fastest row streaming is so many times as fast", "spread", "time", "peak memory"], rows,
        f"Points are distinct points of the mesh; the peak is what the process grows by in a run from scratch. {ONE_THREAD} All cases, with the least ratios wanted: <code>build/release/bench/throughput_bench{option}</code>"))


def bars(case, rates):
    most = max(rate for _, rate in rates)

    def group(title, some):
        lines = "".join(f"<tr><th scope=row>{text(route)}<td class=rate><span style='width:{100 * rate / most:.2f}%'></span>"
                        f"<td>{rate / 1e6:.3g}" for route, rate in sorted(some, key=lambda x: -x[1]))
        return f"<tbody><tr><th colspan=3>{title}{lines}" if some else ""
    mine = [x for x in rates if x[0].startswith(OURS)]
    return (f"<div class=wide tabindex=0><table class=bars><caption>{text(case)}: million points per second</caption>"
            + group("ours", mine) + group("others", [x for x in rates if x not in mine]) + "</table></div>")


GROUPS = {
    "triples": "every triple of valences round a face", "deep": "the same at depths 5 and 6",
    "digits": "computed with 50 digits and compared with Stam's evaluator, too", "rational": "valences 3, 4 and 6, in exact fractions",
    "high": "valences 20, 50 and 100", "boundary": "boundary edges and vertices round pairs of several valences",
    "boundary-deep": "boundaries round the regular pair, deeper", "alone": "a face without neighbours",
    "spheres": "every pair of faces of bumpy spheres", "quadruples": "every four valences at a quad's corners, in every order",
    "cuts": "creases and corners at a quad", "darts": "ends of creases at a quad", "semi-sharp": "semi-sharp edges and vertices at a quad"}
# What a name means for quads, where that is something else.
OF_QUADS = {"deep": "the regular quad and others, deeper", "high": "valences 20 and 50", "boundary": "boundary edges and vertices round a quad"}


def proofs(data, scheme="Loop"):
    """One line for each group of topologies, kernel and arithmetic."""
    groups = {}
    for row in data["rows"]:
        groups.setdefault((row["group"], row["kernel"], row["arithmetic"]), []).append(row)
    lines = []
    for (group, kernel, _), some in groups.items():
        wrong = [r for r in some if r["map"] != "equal"]
        bounds, digits = [r for r in some if r.get("bound")], [r["digits"] for r in some if r.get("digits")]
        bound, worst = max((r["bound"] for r in bounds), default=None), max((r["worst"] for r in bounds), default=None)
        lines.append([text(group), text(kernel), text(len({r["topology"] for r in some})),
                      f"{min(r['depths'][0] for r in some)} to {max(r['depths'][1] for r in some)}",
                      text(sum(r["points"] for r in some)), "<b class=yes>equal</b>" if not wrong else "<b class=no>differs</b>", ", ".join(sorted({text(r["arithmetic"]) for r in some})),
                      f"{min(digits):.1f}" if digits else "", number(bound) if bound else "", number(worst) if worst else "",
                      number(bound / worst) if bound and worst else ""])
    known = GROUPS if scheme == "Loop" else {**GROUPS, **OF_QUADS}
    explained = "; ".join(f"<b>{text(g)}</b>: {text(known[g])}" for g in dict.fromkeys(g for g, *_ in groups) if g in known)
    return (f"<h3>{scheme}</h3>" + (f"<p>Groups of neighbourhoods. {explained}.</p>" if explained else "") + "<p>The map from control points to limit points that each kernel applies, against the reference's, for every geometry of a "
            "topology at once; and a bound of the float32 error over all control meshes in the unit box. Topology by topology: "
            f"<code>limitcheck prove{'' if scheme == 'Loop' else ' --scheme catmull-clark'} --each</code>.</p>"
            + table(["group", "kernel", "topologies", "depths", "points", "map equal", "arithmetic", "digits", "proved bound",
                     "worst observed", "slack"], lines))
