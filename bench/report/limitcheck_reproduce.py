#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""limitcheck reproduce: the paper's claims, tables and figures from our own data, and one page that shows them."""
import argparse
import json
import pathlib
import shutil
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import page  # noqa: E402

SOURCE = pathlib.Path(__file__).resolve().parents[2]
SPECIFICATIONS = SOURCE / "papers" / "mueller-havemann-2000" / "figures"
HERE = SOURCE / "bench" / "report"


class StepError(Exception):
    pass


def say(text):
    print(text, file=sys.stderr, flush=True)


def run(command, output=None, accepted=(0,)):
    """Runs a program; its standard output to a file, under a temporary name until it is whole."""
    try:
        done = subprocess.run([str(c) for c in command], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    except OSError as error:
        raise StepError(f"{command[0]}: {error.strerror}") from error
    if done.returncode not in accepted:
        raise StepError(f"{' '.join(map(str, command))} ended with {done.returncode}: {done.stderr.strip()[-400:]}")
    if output:
        partial = output.with_name(output.name + ".partial")
        partial.write_text(done.stdout, encoding="utf-8")
        partial.replace(output)


def draw_figures(folder):
    """SVG files of the specifications, and the viewer's script; returns why not, if they cannot be made."""
    if not shutil.which("node"):
        return "Node.js is not installed (Debian: nodejs npm): figures are left out, their data are in spheres.json."
    if not (HERE / "node_modules").is_dir():
        if not shutil.which("npm"):
            return "npm is not installed (Debian: npm): figures are left out, their data are in spheres.json."
        say("installing Vega-Lite and three.js")
        run(["npm", "install", "--prefix", HERE, "--no-audit", "--no-fund", "--no-package-lock"])
    rows = folder / "spheres-rows.json"
    rows.write_text(json.dumps(json.loads((folder / "spheres.json").read_text())["rows"]), encoding="utf-8")
    for specification in sorted(SPECIFICATIONS.glob("*.vl.json")):
        name = specification.name.removesuffix(".vl.json")
        run(["node", HERE / "render.mjs", specification, f"spheres={rows}"], folder / f"{name}.svg")
    rows.unlink()
    run([HERE / "node_modules" / ".bin" / "esbuild", HERE / "viewer.mjs", "--bundle", "--minify",
         "--format=esm", "--log-level=error", f"--outfile={folder / 'viewer.js'}"])
    return None


def steps(programs, folder, quick):
    limitcheck = programs.parent / "limitcheck"
    meshes = ["icosahedron", "bumpy:200", "fan:5"] if quick else []
    pattern = "faces:4000/depth:[35]/threads:1|write-only|100000/depth:5|set-up"
    yield "pictures and tables", lambda: run(
        [programs / "reproduction" / "reproduction", "-o", folder, *(["--quick"] if quick else [])])
    yield "claims", lambda: run([limitcheck, "claims", "--json"], folder / "claims.json", (0, 1))
    yield "audit", lambda: run([limitcheck, "audit", "all", *meshes, "--json"], folder / "audit.json", (0, 1))
    yield "proofs", lambda: run([limitcheck, "prove", *(["--depth", "2"] if quick else []), "--json"], folder / "proofs.json",
                                (0, 1))
    yield "throughput", lambda: run([programs / "throughput_bench", f"--benchmark_filter={pattern}",
                                     f"--benchmark_out={folder / 'throughput.json'}", "--benchmark_out_format=json"])


def main():
    parser = argparse.ArgumentParser(prog="limitcheck reproduce", description=__doc__,
                                     epilog="Exit codes: 0 the report is complete, 1 a part is missing (said in it), 2 bad usage.")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=pathlib.Path("build/report"),
                        help="folder of the report (default: %(default)s)")
    parser.add_argument("--quick", action="store_true", help="fewer frames and meshes: two minutes instead of a quarter of an hour")
    args = parser.parse_args()
    programs = pathlib.Path(sys.argv[0]).absolute().parent  # where the build puts a link to this file
    args.output.mkdir(parents=True, exist_ok=True)

    missing = []
    for name, step in steps(programs, args.output, args.quick):
        start = time.monotonic()
        try:
            step()
            say(f"{name}: {time.monotonic() - start:.0f} s")
        except StepError as error:
            missing.append(f"{name}: {error}")
            say(missing[-1])
    try:
        reason = draw_figures(args.output)
        if reason:
            missing.append(reason)
    except (StepError, OSError, ValueError) as error:
        missing.append(f"figures: {error}")
    page.write(args.output, missing)
    print(args.output / "index.html")
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
