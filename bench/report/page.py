# SPDX-License-Identifier: MIT
"""The report: one page that opens from disk, everything inside it."""
import base64
import datetime
import html
import json
import pathlib
import platform
import re

STYLE = (pathlib.Path(__file__).resolve().parent / "style.css").read_text(encoding="utf-8")

PICTURES = {
    "figure-3.png": ("Figure 3", "The ring of a vertex after 0, 1 and 2 steps in place, the normals of its triangles, and the "
                                 "cone of 30 degrees about the limit normal that they have to enter."),
    "figure-6.png": ("Figure 6", "Random depths without repair: cracks wherever depths differ."),
    "figure-7.png": ("Figure 7", "The same with the paper's fans, in orange: no crack is left."),
    "figure-8.png": ("Figure 8", "Fans on an icosahedron: round the middle of the flat triangle (left) they dent the surface, "
                                 "round the limit point (right) they do not."),
    "figure-10.png": ("Figure 10", "Bumpy spheres with 200 and 4000 control faces, uniform depth 4."),
    "figure-13.png": ("Figure 13", "Random depths from 0 to 4, fans in orange. Right: faces seen from behind left out, the "
                                   "object turned to show the gap; red is the inside."),
    "figure-14.png": ("Figure 14", "Depth by curvature: the darker, the deeper; fans in orange. Right: the limit normals of the "
                                   "control vertices, which decide."),
}
FIGURES = {
    "figure-11.svg": ("Figure 11", "Frames per second on turning bumpy spheres. The paper's own numbers are not in its text."),
    "figure-12.svg": ("Figure 12", "Triangles per frame, and control faces culled."),
    "error.svg": ("Error", "What the paper's comparison leaves out: the error on the screen that each strategy buys with its "
                           "triangles. Below the line is better than uniform depth."),
}


def text(value):
    return html.escape(str(value))


def number(value, digits=3):
    return f"{value:.{digits}g}" if isinstance(value, float) else text(value)


def table(header, rows, caption=""):
    head = "".join(f"<th scope=col>{text(h)}" for h in header)
    body = "".join("<tr>" + "".join(f"<td>{cell}" for cell in row) + "\n" for row in rows)
    return f"<div class=wide><table><caption>{caption}</caption><thead><tr>{head}<tbody>{body}</table></div>"


def load(folder, name, missing):
    """What a step left, or None; a file that is no JSON is said to be missing."""
    path = folder / name
    try:
        return json.loads(path.read_text(encoding="utf-8")) if path.is_file() else None
    except ValueError as error:
        missing.append(f"{name}: {error}")
        return None


def mark(held):
    return {True: "<b class=yes>held</b>", False: "<b class=no>not held</b>"}.get(held, "<b class=open>not run</b>")


def claims(data):
    rows = data["claims"]
    counts = {}
    for row in rows:
        counts[row["verdict"]] = counts.get(row["verdict"], 0) + 1
    summary = ", ".join(f"{n} {text(v)}" for v, n in sorted(counts.items(), key=lambda item: -item[1]))
    return (f"<p>{len(rows)} claims: {summary}. Alone: <code>limitcheck claims</code>.</p>"
            + table(["claim", "says", "verdict", "today", "check"],
                    [[text(r["id"]), text(r.get("statement", "")), text(r["verdict"]),
                      mark(r["held"] if r["ran"] else None), f"<code>{text(r['check'] or '')}</code>"] for r in rows]))


def audit(data):
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
    failed = [r for r in results if r["status"] in ("finding", "crash", "timeout", "error") and r.get("witness")]
    witnesses = table(["subject", "mesh", "check", "worst", "bound", "witness"],
                      [[text(r["subject"]), text(r["mesh"]), text(r["check"]), number(r["worst"]), number(r["bound"]),
                        f"<code>{text(r['witness'] if isinstance(r['witness'], str) else json.dumps(r['witness']))[:400]}</code>"]
                       for r in failed[:60]])
    return ("<p>Alone: <code>limitcheck audit</code>.</p>" + table(["check", *subjects], rows)
            + f"<details><summary>{len(failed)} findings with witnesses</summary>{witnesses}</details>")


def trends(data):
    return table(["", "the text says", "today", "figures"],
                 [[text(t["id"]), text(t["statement"]), mark(t["held"]), text(t["figures"])] for t in data])


def spheres(data):
    engines = ("sliding_window", "row_stream", "sliding_window_drawn", "row_stream_drawn")
    rows = [[text(r["faces"]), text(r["strategy"]), f"{r['triangles']:.0f}", f"{r['fans']:.0f}", f"{r['singletons']:.1f}",
             f"{r['culled_share']:.1%}", *(number(r[e]["frames_per_second"]) for e in engines),
             number(r["error_pixels"]["silhouette_99"]), number(r["error_pixels"]["interior_99"])] for r in data["rows"]]
    header = ["faces", "strategy", "triangles", "fans", "no partner", "culled", "window fps", "row stream fps", "window drawn",
              "row stream drawn", "silhouette px", "interior px"]
    caption = (f"Frames per second on one thread; drawn: with OpenGL by {text(data['renderer'])}. Errors: 99 % of the samples "
               "are closer to the exact surface, in pixels.")
    return "<details><summary>All numbers</summary>" + table(header, rows, caption) + "</details>"


def throughput(data):
    runs = [r for r in data["benchmarks"] if "points/s" in r]
    rows = [[text(r["name"].replace("/real_time", "")), f"{r['points/s'] / 1e6:.4g}", f"{r['real_time']:.4g} {r['time_unit']}",
             f"{r['peak'] / 2**20:.3g} MiB" if "peak" in r else ""] for r in runs]
    return ("<p>Alone, with ratios: <code>build/release/bench/throughput_bench</code>.</p>"
            + table(["route", "million points/s", "time", "peak memory"], rows))


def proofs(data):
    """One line for each group of topologies and kernel."""
    groups = {}
    for row in data["rows"]:
        groups.setdefault((row["group"], row["kernel"]), []).append(row)
    lines = []
    for (group, kernel), some in groups.items():
        wrong = [r for r in some if r["map"] != "equal"]
        bounds, digits = [r for r in some if r.get("bound")], [r["digits"] for r in some if r.get("digits")]
        bound, worst = max((r["bound"] for r in bounds), default=None), max((r["worst"] for r in bounds), default=None)
        lines.append([text(group), text(kernel), text(len({r["topology"] for r in some})),
                      f"{min(r['depths'][0] for r in some)} to {max(r['depths'][1] for r in some)}",
                      text(sum(r["points"] for r in some)), mark(not wrong), ", ".join(sorted({text(r["arithmetic"]) for r in some})),
                      f"{min(digits):.1f}" if digits else "", number(bound) if bound else "", number(worst) if worst else "",
                      number(bound / worst) if bound and worst else ""])
    return ("<p>Topology by topology: <code>limitcheck prove --each</code>.</p>"
            + table(["group", "kernel", "topologies", "depths", "points", "map equal", "arithmetic", "digits", "proved bound",
                     "worst observed", "slack"], lines))


def view(folder):
    script, data = folder / "viewer.js", folder / "model.json"
    if not (script.is_file() and data.is_file()):
        return ""
    options = "".join(f"<option value={v}>{t}" for v, t in (("depth", "depth"), ("kind", "kind of triangle"),
                                                            ("position", "error of position"), ("normal", "error of normal")))
    code = script.read_text(encoding="utf-8").replace("</script", "<\\/script")
    return ("<p>A bumpy sphere of 200 control faces by the combined strategy; errors are taken in the middle of each triangle. "
            "Drag or use the arrow keys to turn it, two fingers or the wheel to come nearer.</p>"
            f"<div id=viewer><p><label>Colour by <select>{options}</select></label> "
            "<label><input type=checkbox name=wire checked> edges</label> <button>Go to the worst triangle</button> <output></output></p>"
            "<canvas tabindex=0 aria-label='Tessellated bumpy sphere'></canvas></div>"
            f"<script type='application/json' id=model>{data.read_text(encoding='utf-8')}</script><script type=module>{code}</script>")


def picture(folder, name, title, caption):
    path = folder / name
    if not path.is_file():
        return ""
    if path.suffix == ".svg":
        image = re.sub(r"^<\?xml[^>]*\?>", "", path.read_text(encoding="utf-8"))
        image = f"<div class=paper role=img aria-label='{text(title)}'>{image}</div>"
    else:
        image = f"<img alt='{text(title)}' src='data:image/png;base64,{base64.b64encode(path.read_bytes()).decode()}'>"
    return f"<figure>{image}<figcaption><b>{text(title)}.</b> {text(caption)}</figcaption></figure>"


def write(folder, missing):
    missing, sections = list(missing), []

    def section(name, title, body):
        if body:
            sections.append((name, title, body))
    loaded = {name: load(folder, name + ".json", missing) for name in ("claims", "audit", "proofs", "spheres", "trends", "throughput")}
    pictures = lambda some: "".join(picture(folder, n, *about) for n, about in some.items())  # noqa: E731
    section("trends", "Does what the text says of its figures hold?", trends(loaded["trends"]) if loaded["trends"] else "")
    section("tables", "Tables", (pictures(FIGURES) + spheres(loaded["spheres"])) if loaded["spheres"] else "")
    section("pictures", "Pictures", pictures(PICTURES))
    section("view", "A tessellation to turn", view(folder))
    section("claims", "Claims", claims(loaded["claims"]) if loaded["claims"] else "")
    section("audit", "Audit", audit(loaded["audit"]) if loaded["audit"] else "")
    section("proofs", "Proofs", proofs(loaded["proofs"]) if loaded["proofs"] else "")
    section("throughput", "Throughput", throughput(loaded["throughput"]) if loaded["throughput"] else "")

    gaps = "".join(f"<li>{text(m)}" for m in missing)
    made = datetime.datetime.now(datetime.timezone.utc).isoformat(timespec="minutes")
    document = (f"<!doctype html><html lang=en><meta charset=utf-8><meta name=viewport content='width=device-width'>"
                f"<title>limitcheck: Müller &amp; Havemann 2000, reproduced</title><style>{STYLE}</style>"
                f"<header><h1>Subdivision surface tessellation on the fly, reproduced</h1>"
                f"<p>Müller &amp; Havemann (2000), claim by claim. Made {made} on {text(platform.machine())}, "
                f"{text(platform.platform())}, by <code>limitcheck reproduce</code>.</p>"
                + (f"<div class=gaps><b>Missing in this report</b><ul>{gaps}</ul></div>" if missing else "")
                + "<nav>" + " ".join(f"<a href='#{n}'>{text(t)}</a>" for n, t, _ in sections) + "</nav></header><main>"
                + "".join(f"<section id={n}><h2>{text(t)}</h2>{b}</section>" for n, t, b in sections) + "</main></html>")
    partial = folder / "index.html.partial"
    partial.write_text(document, encoding="utf-8")
    partial.replace(folder / "index.html")
