#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""limitcheck bench: performance tracking. run measures and stores, compare decides, trend draws."""
import argparse
import json
import os
import pathlib
import re
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import decide  # noqa: E402
import measure  # noqa: E402
import trend  # noqa: E402

HELD, FINDINGS, BAD_INPUT = 0, 1, 2


class UsageError(Exception):
    pass


def progress(text):
    if sys.stderr.isatty():
        print(f"\r\033[K{text}", end="", file=sys.stderr, flush=True)


def write_whole(path, text):
    """To a temporary name, then renamed: a reader never sees half of it."""
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=path.name + ".partial-")
    try:
        with os.fdopen(handle, "w", encoding="utf-8") as file:
            file.write(text)
        os.replace(name, path)
    except BaseException:
        os.unlink(name)
        raise


def load(store, name):
    """A record by file name, or by label from the store; of several machines' the error lists them."""
    path = pathlib.Path(name)
    if not path.is_file():
        found = sorted(store.glob(f"*/{name}.json"))
        if not found:
            known = sorted({p.stem for p in store.glob("*/*.json")})
            raise UsageError(f"no baseline '{name}': neither a file nor a label in {store}"
                             + (f" (which has: {', '.join(known)})" if known else " (which is empty)"))
        if len(found) > 1:
            raise UsageError(f"'{name}' was measured on several machines or compilers; name the file: "
                             + ", ".join(map(str, found)))
        path = found[0]
    try:
        record = json.loads(path.read_text(encoding="utf-8"))
        if record["format"] != 1 or not record["rounds"]:
            raise KeyError("format")
        return record
    except (ValueError, KeyError, TypeError, UnicodeDecodeError) as error:
        raise UsageError(f"{path}: not a record of `limitcheck bench run` ({error})") from error


def command_run(args):
    record = measure.measure(args.programs, args.suite, args.repetitions, args.rounds, counts=not args.no_counts,
                             progress=progress)
    progress("")
    label = args.label or record["commit"]
    path = args.store / record["key"] / f"{label}.json"
    write_whole(path, json.dumps(record, indent=1))
    names = decide.samples(record["rounds"][0])
    print(f"{path}: {len(names)} benchmarks, {args.rounds} rounds of {args.repetitions}, "
          f"{len(record['instructions'])} instruction counts")
    return HELD


def command_compare(args):
    a = load(args.store, args.a)
    if args.b:
        b = load(args.store, args.b)
    else:
        b = measure.measure(args.programs, a["suite"], counts=bool(a["instructions"]), progress=progress)
        progress("")
    result = decide.compare(a, b)
    if args.json:
        print(json.dumps(result, indent=1))
    else:
        print_comparison(args, result)
    if not result["comparable"]:
        return BAD_INPUT
    return FINDINGS if result["regressions"] or result["only_a"] else HELD


def print_comparison(args, result):
    b = args.b or "working tree"
    if not result["comparable"]:
        print(f"limitcheck bench: {args.a} and {b} cannot be compared:", *result["differences"], sep="\n  ", file=sys.stderr)
        return
    print(f"{'':9}{'B / A':>7}  {'p':>8}   A = {args.a}, B = {b}")
    for row in result["rows"]:
        p = f"{row['p']:.1e}" if "p" in row else "exact"
        print(f"{row['verdict']:9}{row['ratio']:7.3f}  {p:>8}   {row['kind']:12} {row['name']}")
    for side, names in (("A", result["only_a"]), ("B", result["only_b"])):
        for name in names:
            print(f"only in {side}: {name}")
    print(f"{result['regressions']} regressions. Times count when every round shows at least "
          f"{decide.TIME_EFFECT:.0%} with p < {decide.TIME_ALPHA}; counts from {decide.COUNT_TOLERANCE:.1%} on.")


def command_trend(args):
    records = [load(args.store, str(path)) for path in sorted(args.store.glob("*/*.json"))]
    if not records:
        raise UsageError(f"{args.store} has no records; make one with `limitcheck bench run`")
    write_whole(args.output, trend.page(records))
    print(f"{args.output}: {len(records)} records")
    return HELD


def parser():
    top = argparse.ArgumentParser(prog="limitcheck bench", description=__doc__,
                                  epilog="Exit codes: 0 no regression, 1 regression, 2 bad usage, no baseline or not comparable.")
    commands = top.add_subparsers(dest="command", required=True)

    def command(name, function, text):
        sub = commands.add_parser(name, help=text, description=text)
        sub.set_defaults(function=function)
        sub.add_argument("--store", type=pathlib.Path, default=pathlib.Path("bench-records"),
                         help="folder of records (default: bench-records)")
        sub.add_argument("--programs", type=pathlib.Path, default=default_programs(),
                         help="folder of the benchmark programs (default: %(default)s)")
        return sub

    run = command("run", command_run, "measure this build and store the result under its machine and compiler")
    run.add_argument("--label", type=label, help="name of the record (default: the commit)")
    run.add_argument("--suite", default="standard", help="standard, quick, or a regular expression of benchmark names")
    run.add_argument("--repetitions", type=positive, default=6)
    run.add_argument("--rounds", type=positive, default=2, help="independent rounds; a difference in time must show in each")
    run.add_argument("--no-counts", action="store_true", help="leave out the instruction counts (no valgrind needed)")

    compare = command("compare", command_compare, "compare two records, or a record with this build")
    compare.add_argument("a", metavar="A", help="label or file")
    compare.add_argument("b", metavar="B", nargs="?", help="label or file; without it this build is measured")
    compare.add_argument("--json", action="store_true")

    drawn = command("trend", command_trend, "draw the history of all records as a page")
    drawn.add_argument("-o", "--output", type=pathlib.Path, default=pathlib.Path("trend.html"))
    return top


def positive(text):
    if not text.isdigit() or int(text) == 0:
        raise argparse.ArgumentTypeError(f"'{text}' is not a positive whole number")
    return int(text)


def label(text):
    if not re.fullmatch(r"[\w.+-]+", text):
        raise argparse.ArgumentTypeError(f"'{text}': letters, digits and . _ + - only")
    return text


def default_programs():
    return pathlib.Path(sys.argv[0]).absolute().parent  # where the build puts a link to this file


def main():
    args = parser().parse_args()
    try:
        return args.function(args)
    except (UsageError, measure.MeasureError, OSError) as error:
        progress("")
        print(f"limitcheck bench: {error}", file=sys.stderr)
        return BAD_INPUT


if __name__ == "__main__":
    sys.exit(main())
