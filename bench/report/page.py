# SPDX-License-Identifier: MIT
"""The report: one page that opens from disk, everything inside it."""
import base64
import gzip
import json
import pathlib
import re

import sentences
import summary
import tables
from parts import PARTS
from record import write_whole
from tables import text

STYLE = (pathlib.Path(__file__).resolve().parent / "style.css").read_text(encoding="utf-8")

# Light for shallow, dark for deep; the same in the pictures (bench/reproduction/studio.h) and in three dimensions.
DEPTH_COLOURS = ("#fce826", "#8fd645", "#21a885", "#2b738f", "#404587", "#450054")
FAN_COLOUR = "#d9731a"
PICTURES = {
    "figure-3": ("Figure 3", "The ring of a vertex after 0, 1 and 2 steps in place. Blue: the normals of its triangles, moved to the "
                             "vertex. Red: the cone of 30 degrees about the limit normal that they have to enter, and do after two."),
    "picture-cracks": ("Figures 6 and 7", "Depth 1 beside depth 4, from the side. Left without repair: through the cracks one sees the inside, "
                       "in red. Right with the paper's fans: no crack is left."),
    "figure-8": ("Figure 8", "Two fans amid depth 3 on an icosahedron, every triangle in one shade: round the middle of the flat triangle (left) "
                             "they dent the surface, round the limit point (right) they do not."),
    "figure-10": ("Figure 10", "Bumpy spheres with 200 and 4000 control faces, uniform depth 4."),
    "figure-13": ("Figure 13", "Random depths from 0 to 4, cracks repaired. Right: faces seen from behind left out, the object turned to "
                               "show the gap; red is the inside."),
    "figure-14": ("Figure 14", "Depth by curvature. Right: the limit normals of the control vertices, which decide."),
}
MORE_PICTURES = {
    "picture-error": ("Errors", "A control mesh of 200 faces, and uniform depth 2 of it: how far each triangle's middle is off the surface, from "
                                "10⁻⁴ of the diagonal (violet) to 10⁻² (yellow)."),
    "picture-sharp": ("A sharp edge that starts and ends", "A torus of quads with three sharp edges (red), its limit surface, and how far OpenSubdiv's "
                      "limit points at depth 4 are off, from 10⁻⁷ of the diagonal (violet) to 10⁻³ (yellow): at both ends of the crease (C85)."),
    "picture-crease": ("Creases, adaptively", "A pawn of quads by Catmull and Clark's rules with three rings that stay sharp and one that is "
                       "sharp for two steps and a half, in depths by the combined strategy, in our engine. Near, the collar's "
                       "lower edge: without repair one sees through cracks beside the crease; with the paper's fans there are none."),
}
CHARTS = {
    "figure-11": ("Figure 11", "Frames per second on turning bumpy spheres of 200 to 4000 control faces, on a logarithmic scale: of the paper's "
                               "engine and of ours. The adaptive strategies (60 pixels, 30 degrees) lie among the uniform depths "
                               "1 to 5; at which error, this diagram does not say (T4). All threads and frames that are drawn: in the table."),
    "figure-12": ("Figure 12", "Left: triangles per frame of one sphere of each size, rising with the number of control faces. Right: the share of "
                               "control faces that face away and are culled, falling; means of thirty spheres of each size, the band is one "
                               "standard deviation."),
}
FRAMES = ("Row streaming on one thread, a bumpy sphere that turns by a degree a frame: as a draw list of strips and fans, which hold most "
          "points twice; as patches, which hold them once; with patches that keep their places as long as they are as they were; and with "
          "pairs of faces that stay together as well. Section 7 of the paper names reuse between frames as future work (C86). The grey "
          "strokes are all that its text says of speed: 100 000 triangles per second (C78).")
NO_NUMBERS = (
    "<p>Figures 11 and 12 of the paper are diagrams, and its text has none of their numbers: no frame rate, triangle count or culled share "
    "by number of faces, no error at all, and neither screen size nor viewing distance. Ours (1024 by 768 pixels, distance 4) stand "
    "alone. What the text does say in numbers is compared above: 10 000 triangles from 800 faces at more than 10 frames per second (T7), "
    "about 1 % faces without partner (T5). Its factor of 1.8 between two machines of 2000 (C73), the factor of about 2 forecast for "
    "reordering (C80) and the 15 to 20 frames per second cited as necessary (C05) cannot be reproduced.</p>")


def load(folder, name, gaps):
    """What a part left, or None; a file that is no JSON is said to be missing."""
    path = folder / name
    try:
        return json.loads(path.read_text(encoding="utf-8")) if path.is_file() else None
    except ValueError as error:
        gaps.append(f"{name}: {error}")
        return None


def origin(name, record):
    """Which command makes a part alone, and when it was made."""
    made, words = record.made(name), f"Alone: <code>limitcheck reproduce --only {name}</code>."
    if made:
        words += (f" Made {text(made['made'][:16].replace('T', ' '))} UTC in {made['seconds']:.0f} s"
                  + (f" from {text(made['commit'])}" if made["commit"] else "") + (", with --quick" if made["quick"] else "") + ".")
    if record.problem(name) and made:
        words += f" <b class=no>Not made anew: {text(record.problem(name))}.</b>"
    return f"<p class=origin>{words}</p>"


def figure(folder, name, title, caption, record):
    panels, png = sorted(folder.glob(f"{name}-[0-9].svg")), folder / f"{name}.png"
    if panels:
        drawings = "".join(re.sub(r"^<\?xml[^>]*\?>", "", svg.read_text(encoding="utf-8")) for svg in panels)
        image = f"<div class=paper role=img aria-label='{text(title)}: {text(caption)}'>{drawings}</div>"
    elif png.is_file():
        image = f"<img alt='{text(caption)}' src='data:image/png;base64,{base64.b64encode(png.read_bytes()).decode()}'>"
    else:
        return ""
    return f"<figure id={name}>{image}<figcaption><b>{text(title)}.</b> {text(caption)}{origin(name, record)}</figcaption></figure>"


def depth_bar():
    """Which colour is which depth, in the pictures and in three dimensions."""
    swatches = "".join(f"<span style='background:{colour}'></span>{name} "
                       for name, colour in (*enumerate(DEPTH_COLOURS), ("fan", FAN_COLOUR)))
    return f"<p class=bar>Depth: {swatches}</p>"


def view(folder, maps):
    script, data, shapes = folder / "viewer.js", folder / "model.json", folder / "shapes.json"
    if not all(path.is_file() for path in (script, data, shapes)):
        return ""
    options = "".join(f"<option value={v}>{t}" for v, t in (("depth", "depth"), ("kind", "kind of triangle"),
                                                            ("position", "error of position"), ("normal", "error of normal")))
    surfaces = "".join(f"<option value={k}>{text(t)}" for k, t in enumerate(["the combined strategy on bumpy:200",
                                                                             *(m["title"] for m in maps or [])]))
    ramp = "<span class=ramp hidden title='from little (violet) to much (yellow)'></span>"
    code = script.read_text(encoding="utf-8").replace("</script", "<\\/script")
    embed = lambda name, path: (f"<script type='application/gzip' id={name}>"  # noqa: E731
                                + base64.b64encode(gzip.compress(path.read_bytes(), 9, mtime=0)).decode() + "</script>")
    return ("<p>A bumpy sphere of 200 control faces by the combined strategy; errors are taken in the middle of each triangle. "
            "The other surfaces are what tessellators deliver, the errors those of their points. Positions are rounded to a 32 000th of the box for "
            "this view. "
            "Drag to turn it, two fingers or the wheel to come nearer; with the keyboard: arrows turn, + and - come nearer and go away. "
            "A witness of the audit is shown here on its own mesh: the control face in orange, the exact point and normal in black, what "
            "the subject delivered in red.</p>" + depth_bar()
            + f"<div id=viewer data-depths='{text(json.dumps(DEPTH_COLOURS))}' data-fan='{FAN_COLOUR}'><p><label>Surface <select name=surface>{surfaces}</select></label> "
            f"<label>Colour by <select name=colour>{options}</select></label> {ramp} "
            "<label><input type=checkbox name=wire checked> edges</label> <button name=worst>Go to the worst triangle</button> "
            "<button name=back hidden>Back to the tessellation</button> <button name=table hidden>Back to the table</button></p><p><output aria-live=polite></output></p>"
            "<canvas tabindex=0 aria-label='Tessellated surface; arrow keys turn it, plus and minus come nearer'></canvas></div>"
            + embed("model", data) + (embed("maps", folder / "maps.json") if maps else "") + embed("shapes", shapes) + f"<script type=module>{code}</script>")


def gaps_of(folder, record, loaded, broken):
    gaps = list(broken)
    for name, part in PARTS.items():
        problem = record.problem(name)
        if problem:
            gaps.append(f"{part.title} ({name}): {problem}" + (". Shown is an older result." if record.has(name) else ""))
        elif not record.has(name):
            gaps.append(f"{part.title} ({name}): not made. limitcheck reproduce --only {name}")
    if loaded["claims"] and (reason := tables.claims_not_run(loaded["claims"])):
        gaps.append(reason)
    for name, shape in (loaded["shapes"] or {}).items():
        if "error" in shape:
            gaps.append(f"witnesses on {name} in the view: {shape['error']}")
    return gaps


def write(folder, record):
    """index.html of everything in the folder; returns what is missing in it."""
    broken, sections = [], []
    names = ("claims", "audit", "proofs", "proofs-quads", "spheres", "frames", "matched", "timings", "throughput", "throughput-quads", "maps", "shapes",
             "witnesses")
    loaded = {name: load(folder, name + ".json", broken) for name in names}

    def both_schemes(name, show):
        other = loaded[name + "-quads"]
        parts = (show(loaded[name]) if loaded[name] else "") + (show(other, "Catmull-Clark") if other else "")
        return parts + origin(name, record) if parts else ""

    def section(name, title, *pieces):
        body = "".join(pieces)
        if body:
            sections.append((name, title, body))

    def result(name, show, *more):
        return show(loaded[name], *more) + origin(name, record) if loaded[name] else ""
    shown = lambda some: "".join(figure(folder, n, *about, record) for n, about in some.items())  # noqa: E731
    section("summary", "In short", summary.summary(loaded["claims"]) if loaded["claims"] else "",
            shown({"picture-error": MORE_PICTURES["picture-error"]}))
    section("sentences", "What the text says, and what came out", sentences.sentences(loaded["claims"], loaded["timings"]),
            origin("timings" if loaded["timings"] else "claims", record) if loaded["claims"] or loaded["timings"] else "")
    section("tables", "Tables and diagrams", NO_NUMBERS if loaded["spheres"] else "", shown(CHARTS), result("spheres", tables.spheres))
    section("frames", "From frame to frame", figure(folder, "frame-rates", "Frames from one to the next", FRAMES, record),
            result("frames", tables.frames))
    section("matched", "At equal error", result("matched", tables.matched), figure(
        folder, "error", "Error", "Error on the screen against triangles drawn, each strategy from coarse to fine settings: lower and "
        "further left is better.", record))
    pictures = shown(PICTURES) + shown({name: MORE_PICTURES[name] for name in ("picture-sharp", "picture-crease")})
    section("pictures", "Pictures", depth_bar() if pictures else "", pictures)
    viewer = view(folder, loaded["maps"])
    section("view", "In three dimensions", viewer, origin("view", record) if viewer else "")
    section("claims", "Claims", result("claims", tables.claims))
    section("audit", "Audit", result("audit", tables.audit, (loaded["witnesses"] or {}) if viewer else {}))
    section("proofs", "Proofs", both_schemes("proofs", tables.proofs))
    section("throughput", "Throughput", both_schemes("throughput", tables.throughput))

    gaps = gaps_of(folder, record, loaded, broken)
    made = max((record.made(n) for n in PARTS if record.made(n)), key=lambda m: m["made"], default=None)
    machine = f"Last made {text(made['made'][:10])} on {text(made['machine'])}, {made['cores']} cores, {text(made['system'])}. " if made else ""
    seed = f"Seed of the bumpy spheres: {loaded['spheres']['seed']}. " if loaded["spheres"] and "seed" in loaded["spheres"] else ""
    context = (loaded["throughput"] or {}).get("context", {})
    compiler = f"Compiler: {text(context['compiler'])}, {text(context['flags'].strip())}. " if "compiler" in context else ""
    missing = "".join(f"<li>{text(g)}</li>" for g in gaps)
    document = (f"<!doctype html><html lang=en><meta charset=utf-8><meta name=viewport content='width=device-width, initial-scale=1'>"
                f"<link rel=icon href='data:,'><title>limitcheck: Müller &amp; Havemann 2000, reproduced</title><style>{STYLE}</style>"
                f"<header><h1>Subdivision surface tessellation on the fly, reproduced</h1>"
                f"<p>Müller &amp; Havemann (2000), claim by claim. {machine}{compiler}{seed}All of it: <code>limitcheck reproduce</code>.</p>"
                + (f"<div class=gaps><b>Missing in this report</b><ul>{missing}</ul></div>" if gaps else "")
                + "<nav>" + " ".join(f"<a href='#{n}'>{text(t)}</a>" for n, t, _ in sections) + "</nav></header><main>"
                + "".join(f"<section id={n}><h2>{text(t)}</h2>{b}</section>" for n, t, b in sections) + "</main></html>")
    write_whole(folder / "index.html", document)
    return gaps
