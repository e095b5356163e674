# SPDX-License-Identifier: MIT
"""The parts of the report: what makes each, from what, into which files."""
import collections
import json
import pathlib

import node_tools
import progress
from record import write_whole

HERE = pathlib.Path(__file__).resolve().parent
SPECIFICATIONS = HERE.parents[1] / "papers" / "mueller-havemann-2000" / "figures"


Part = collections.namedtuple("Part", "title make files needs", defaults=((),))


class PartError(ValueError):
    pass


class Workshop:
    """Runs programs for a part; results go to a temporary name until they are whole."""

    def __init__(self, programs, folder, quick, maps=()):
        self.bench, self.limitcheck, self.folder, self.quick = programs, programs.parent / "limitcheck", folder, quick
        self.maps = maps  # of errors, in the view: SUBJECT[:OPTIONS]@MESH[@DEPTH]; none: the program's own choice
        self.label, self.expected = "", None

    def begin(self, label, expected):
        self.label, self.expected = label, expected

    def run(self, command, output=None, accepted=(0,)):
        partial = self.folder / (output + ".partial") if output else None
        try:
            with open(partial or "/dev/null", "wb") as stdout:
                code, words = progress.run(command, self.label, self.expected, stdout)
            if code not in accepted:
                raise PartError(f"{pathlib.Path(command[0]).name} ended with {code}: {words[-600:] or 'no message'}")
            if output and output.endswith(".json"):
                self.check_json(partial, command, words)
            if output:
                partial.replace(self.folder / output)
        except FileNotFoundError as error:
            raise PartError(f"{command[0]} is not there: build it with bash verify/build.sh release") from error
        finally:
            if partial:
                partial.unlink(missing_ok=True)

    @staticmethod
    def check_json(path, command, words):
        try:
            json.loads(path.read_text(encoding="utf-8"))
        except ValueError as error:
            raise PartError(f"{pathlib.Path(command[0]).name} left no JSON ({error}): {words[-600:] or 'no message'}") from error

    def reproduction(self, *arguments):
        self.run([self.bench / "reproduction" / "reproduction", "-o", self.folder, *arguments, *(["--quick"] if self.quick else [])])

    def node(self):
        """The folder of our scripts for Node.js, with the packages that they need."""
        try:
            return node_tools.prepare(self.bench, self.run)
        except node_tools.NodeError as error:
            raise PartError(str(error)) from error


def picture(name):
    return lambda shop: shop.reproduction(name)


def chart(title, name, source, key):
    """A part: an SVG for each panel of the specification papers/.../NAME.vl.json, of the rows of a result."""
    specification = SPECIFICATIONS / f"{name}.vl.json"
    files = [f"{name}-{k}.svg" for k, _ in enumerate(json.loads(specification.read_text(encoding="utf-8"))["panels"], 1)]

    def draw(shop):
        tools = shop.node()
        rows = shop.folder / f"{name}-rows.json"
        try:
            rows.write_text(json.dumps(json.loads((shop.folder / f"{source}.json").read_text(encoding="utf-8"))[key]), encoding="utf-8")
            for panel, file in enumerate(files, 1):
                shop.run(["node", tools / "render.mjs", f"{specification}#{panel}", f"{source}={rows}"], file)
        finally:
            rows.unlink(missing_ok=True)
    return Part(title, draw, files, [source])


def claims(shop):
    shop.run([shop.limitcheck, "claims", "--json"], "claims.json", (0, 1))


def audit(shop):
    meshes = ["icosahedron", "bumpy:200", "fan:5"] if shop.quick else []
    shop.run([shop.limitcheck, "audit", "all", *meshes, "--all-rows", "--json"], "audit.json", (0, 1))


def proofs(shop):
    for scheme, output in (("loop", "proofs.json"), ("catmull-clark", "proofs-quads.json")):
        shop.run([shop.limitcheck, "prove", "--scheme", scheme, *(["--set", "sample"] if shop.quick else []), "--json"],
                 output, (0, 1))


REPETITIONS = 3


def best_repetitions(runs):
    """Of each case the repetition with the least time, and `spread`: how many times as long the slowest took."""
    cases = {}
    for run in runs:
        if run.get("run_type") != "aggregate":
            cases.setdefault(run.get("run_name", run["name"]).removesuffix("/real_time"), []).append(run)
    best = []
    for name, some in cases.items():
        clock = "cpu_time" if "/threads:1" in name and "cpu_time" in some[0] else "real_time"
        times = [run[clock] for run in some]
        best.append({**min(some, key=lambda run: run[clock]), "name": name, "spread": max(times) / min(times) if min(times) > 0 else 1})
    return best


def benchmark(shop, program, output, cases, *arguments):
    """The JSON of a benchmark's cases, of each the best of some repetitions: processor time of one thread, the wall's of more."""
    partial = shop.folder / f"{output}.partial"
    try:
        shop.run([shop.bench / program, f"--benchmark_filter={cases}", f"--benchmark_min_time={0.005 if shop.quick else 0.03}",
                  f"--benchmark_repetitions={REPETITIONS}", "--benchmark_enable_random_interleaving=true", f"--benchmark_out={partial}", "--benchmark_out_format=json", *arguments])
        data = json.loads(partial.read_text(encoding="utf-8"))
        data["benchmarks"] = best_repetitions(data["benchmarks"])
        write_whole(shop.folder / output, json.dumps(data))
    finally:
        partial.unlink(missing_ok=True)


def throughput(shop):
    of_loop = "faces:1000/depth:3/threads:1" if shop.quick else "faces:4000/depth:[35]/threads:1|100000/depth:5"
    of_quads = "faces:400[028]/depth:3/threads:1" if shop.quick else "depth:[35]/threads:1"
    benchmark(shop, "throughput_bench", "throughput.json", f"{of_loop}|write-only|set-up/bumpy/faces:4000", "--scheme=loop")
    benchmark(shop, "throughput_bench", "throughput-quads.json", f"{of_quads}|write-only", "--scheme=catmull-clark")


def frames(shop):
    benchmark(shop, "frame_bench", "frames.json", "^(draw|patches|kept|sticky)/.*/threads:1$")


def shown_findings(results):
    """({cause: the worst of its findings that names a point of the surface}, how many findings there are)."""
    bad = [r for r in results if r["status"] in ("finding", "crash", "timeout", "error")]
    shown = {}
    for r in sorted(bad, key=lambda r: -((r.get("worst") or 0) / (r.get("bound") or 1e-9))):
        if place_key(r):
            shown.setdefault(r.get("cause"), r)
    return shown, len(bad)


def place_key(r):
    """Names the finding's witness; '' if it names no point of the surface."""
    w = r.get("witness")
    named = isinstance(w, dict) and w.get("face") is not None and w.get("l1") is not None
    return f"{r['subject']}|{r['check']}|{r['mesh']}|{w['face']}|{w['l1']}|{w['l2']}" if named else ""


def delivered(r):
    """What the subject delivered in the place of the exact point or normal: {"got_position"} or {"got_normal"}, or nothing."""
    got = r["witness"].get("got")
    if not isinstance(got, list) or len(got) != 3 or not all(isinstance(x, (int, float)) for x in got):
        return {}
    name = "got_normal" if "normal" in r["check"] else "got_position"
    return {name: got}


def places(shop, findings):
    """Where the witnesses lie, by the exact evaluator: {key: what the view shows}."""
    points, found = {}, {}
    for r in findings:
        if not place_key(r):
            continue
        w = r["witness"]
        at = (r["mesh"], str(w["face"]), w["l1"], w["l2"])
        if at not in points:
            try:
                shop.run([shop.limitcheck, "eval", *at, "--json"], "point.json")
                exact = json.loads((shop.folder / "point.json").read_text(encoding="utf-8"))
                points[at] = {k: [float(x) for x in exact[k]] for k in ("position", "normal")}
            except (ValueError, KeyError, TypeError):
                points[at] = None  # a point without normal, or a mesh made for one relation only
        if points[at]:
            bound = f", bound {r['bound']:.3g}" if r.get("bound") is not None else ""
            off = f": {r['worst']:.3g} {r.get('unit') or ''}{bound}" if r.get("worst") is not None else ""
            found[place_key(r)] = {"mesh": r["mesh"], "face": w["face"], **points[at], **delivered(r),
                                   "text": f"{r['subject']} / {r['check']}{off}; {r['mesh']} face {w['face']} at ({w['l1']}, {w['l2']})"}
    (shop.folder / "point.json").unlink(missing_ok=True)
    return found


def view(shop):
    tools = shop.node()
    shop.reproduction("model")
    shop.reproduction("maps", *(word for m in shop.maps for word in ("--map", m)))
    audited = shop.folder / "audit.json"
    findings = []
    if audited.is_file():  # the surfaces its witnesses lie on
        findings = list(shown_findings(json.loads(audited.read_text(encoding="utf-8"))["results"])[0].values())
    names = sorted({r["mesh"] for r in findings})
    shop.reproduction("shapes", *(word for name in names for word in ("--mesh", name)))
    (shop.folder / "witnesses.json").write_text(json.dumps(places(shop, findings)), encoding="utf-8")
    partial = shop.folder / "viewer.js.partial"
    shop.run(["node", tools / "bundle.mjs", tools / "viewer.mjs", partial])
    partial.replace(shop.folder / "viewer.js")



def parts():
    yield "spheres", Part("frame rates, counts and pictures of bumpy spheres", lambda shop: shop.reproduction("spheres"), ["spheres.json"])
    yield "matched", Part("strategies at equal error", lambda shop: shop.reproduction("matched"), ["matched.json"])
    yield "timings", Part("what the text says of time", lambda shop: shop.reproduction("timings"), ["timings.json"], ["spheres", "matched"])
    for name, title in (("figure-11", "frames per second"), ("figure-12", "triangles and culled faces")):
        yield name, chart(f"{name}: {title}", name, "spheres", "rows")
    yield "frames", Part("frames from the camera to triangles, and from one to the next", frames, ["frames.json"])
    yield "frame-rates", chart("frames per second, case by case", "frame-rates", "frames", "benchmarks")
    yield "error", chart("error against triangles", "error", "matched", "curves")
    for number, title in ((3, "normal cone"), (8, "centres of fans"), (10, "bumpy spheres"),
                          (13, "random depths"), (14, "depth by curvature")):
        yield f"figure-{number}", Part(f"figure-{number}: {title}", picture(f"figure-{number}"), [f"figure-{number}.png"])
    for name, title in (("error", "an error map beside its control mesh"), ("cracks", "figures 6 and 7, cracks and their repair"),
                        ("sharp", "a crease that starts and ends"), ("crease", "creases of a mesh of quads, drawn adaptively")):
        yield f"picture-{name}", Part(f"picture-{name}: {title}", picture(f"picture-{name}"), [f"picture-{name}.png"])
    yield "claims", Part("the paper's claims", claims, ["claims.json"])
    yield "audit", Part("audit of the built-in tessellators", audit, ["audit.json"])
    yield "proofs", Part("proofs", proofs, ["proofs.json", "proofs-quads.json"])
    yield "throughput", Part("throughput against others", throughput, ["throughput.json", "throughput-quads.json"])
    yield "view", Part("view in three dimensions", view, ["model.json", "maps.json", "shapes.json", "witnesses.json", "viewer.js"])


PARTS = dict(parts())


def order(wanted, record):
    """The parts wanted and those they need and the folder lacks, in the order of PARTS."""
    chosen = set()

    def choose(name):
        chosen.add(name)
        for need in PARTS[name].needs:
            if need not in chosen and not record.has(need):
                choose(need)
    for name in wanted:
        choose(name)
    return [name for name in PARTS if name in chosen]
