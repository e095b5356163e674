#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Performance tracking: run measures and stores, compare decides, gate holds exact costs, trend draws."""
import argparse
import json
import os
import pathlib
import re
import shutil
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import decide  # noqa: E402
import gate  # noqa: E402
import machine  # noqa: E402
import measure  # noqa: E402
import self_test  # noqa: E402
import trend  # noqa: E402
import turns  # noqa: E402

HELD, FINDINGS, BAD_INPUT = 0, 1, 2
MOST_LINES = 20  # of a table for a pull request
EXPLAINED = 3  # rows whose counts moved: so many are told by function


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
        mask = os.umask(0)
        os.umask(mask)
        os.chmod(name, 0o666 & ~mask)  # a temporary file is its owner's alone
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


def keep(programs, name):
    """Copies the programs that comparisons need to a folder beside them."""
    folder = programs / "kept" / name
    folder.mkdir(parents=True, exist_ok=True)
    for program in turns.PROGRAMS:
        shutil.copy2(programs / program, folder / program)
    return str(folder.resolve())


def command_run(args):
    record = measure.measure(args.programs, turns.time_once, args.suite, args.repetitions, args.rounds, counts=not args.no_counts,
                             progress=progress)
    progress("")
    name = args.label or record["commit"]
    if args.keep:
        record["kept"] = keep(args.programs, name)
    path = args.store / record["key"] / f"{name}.json"
    write_whole(path, json.dumps(record, indent=1))
    names = decide.samples(record["rounds"][0])
    print(f"{path}: {len(names)} benchmarks, {args.rounds} rounds of {args.repetitions} repetitions, "
          f"{len(record['instructions'])} instruction counts")
    if args.keep:
        print(f"programs kept in {record['kept']}")
    return HELD


def in_turns(a, b, suite, counts_of_a, differences):
    """Two builds that are both here. counts_of_a: None to measure them, too."""
    if differences:
        return decide.result([], [], [], differences)
    rows, only_a, only_b = turns.compare(a, b, suite, progress=progress)
    if counts_of_a is None:
        counts_of_a = measure.instruction_counts(a, progress)
    of_a, of_b = {"instructions": counts_of_a}, {"instructions": {}}
    if counts_of_a:
        of_b = {"instructions": measure.instruction_counts(b, progress)}
    lost, new = decide.unmatched(of_a["instructions"], of_b["instructions"])
    result = decide.result(decide.judge_counts(of_a, of_b) + rows, only_a + lost, only_b + new)
    moved = [row for row in result["rows"] if row["kind"] == "instructions" and row["verdict"]]
    for row in moved[:EXPLAINED]:
        progress(f"functions of {row['name']}")
        profiles = (measure.functions_of(side, row["name"]) for side in (a, b))
        row["functions"] = decide.moved_functions(*profiles)
    return result


def compare_with_build(args):
    other = turns.programs_of(args.against)
    builds = [turns.build_and_cases(side)[0] for side in (other, args.programs)]
    differences = [f"build: {builds[0]} | {builds[1]}"] if builds[0] != builds[1] else []
    return in_turns(other, args.programs, args.suite, {} if args.no_counts else None, differences)


def compare_records(args):
    """(result, note about how the times were compared)."""
    a = load(args.store, args.a)
    if args.b:
        return decide.compare(a, load(args.store, args.b)), "times of two records, which decide nothing"
    kept = pathlib.Path(a.get("kept", "/nowhere"))
    if (kept / "timing_turns").is_file():
        differences = machine.differences(a["identity"], measure.identity(args.programs))
        result = in_turns(kept, args.programs, a["suite"], a["instructions"], differences)
        return result, "times in turns with the kept programs"
    b = measure.measure(args.programs, turns.time_once, a["suite"], counts=bool(a["instructions"]), progress=progress)
    lost = f"the programs of {args.a} are no longer in {kept}" if "kept" in a else f"the programs of {args.a} were not kept"
    return decide.compare(a, b), f"{lost} (bench run --keep), so its times are of another hour, and decide nothing"


def this_build(args):
    return "this build" if args.programs == default_programs() else str(args.programs)


def command_compare(args):
    if (args.a is None) == (args.against is None):
        raise UsageError("compare needs a record A or --against FOLDER, and not both")
    if args.against is not None:
        result, note = compare_with_build(args), "times in turns"
        names = str(args.against), this_build(args)
    else:
        result, note = compare_records(args)
        names = args.a, args.b or this_build(args)
    progress("")
    if args.json:
        print(json.dumps(result, indent=1))
    elif args.markdown and result["comparable"]:
        print(markdown(*names, result))
    else:
        print_comparison(*names, result, note, args.each)
    if not result["comparable"]:
        return BAD_INPUT
    return FINDINGS if result["regressions"] or result["only_a"] else HELD


def word(row):
    return row["verdict"] or ("suspect" if row["suspect"] else "")


def worth_a_look(rows):
    return [row for row in rows if word(row)]


def worst_of(rows, kind):
    """The first of that kind, which is the worst; or None."""
    return next((row for row in rows if row["kind"] == kind), None)


def moved_words(rows):
    """In which functions the counts of these rows moved most."""
    return ", ".join(f"{decide.short_function(name)} {of_b - of_a:+d}"
                     for row in rows[:1] for name, of_a, of_b in row.get("functions", ())[:2])


def markdown(a, b, result):
    """For a pull request, on one screen: the kernels that are worth a look, worst first."""
    groups = {kernel: rows for kernel, rows in decide.by_kernel(result["rows"]).items() if worth_a_look(rows)}
    plural = "" if result["regressions"] == 1 else "s"
    lines = [f"**{result['regressions']} regression{plural}**, {len(worth_a_look(result['rows']))} of {len(result['rows'])} cases "
             f"worth a look (A = {a}, B = {b})", ""]
    if groups:
        lines += ["| | time B / A | instructions B / A | kernel | cases |", "|---|---|---|---|---|"]
    for kernel, rows in list(groups.items())[:MOST_LINES]:
        time, count = (worst_of(rows, kind) for kind in ("time", "instructions"))
        lines.append(f"| {word(rows[0])} | {ratio_of(time)} | {ratio_of(count)} | `{kernel}` | {len(worth_a_look(rows))} of {len(rows)} |")
    if len(groups) > MOST_LINES:
        lines.append(f"| | | | and {len(groups) - MOST_LINES} kernels more | |")
    for side, names in (("A", result["only_a"]), ("B", result["only_b"])):
        if names:
            lines.append(f"- only in {side}: {len(names)} case{'' if len(names) == 1 else 's'}, `{names[0]}`"
                         + (" first" if len(names) > 1 else ""))
    return "\n".join(lines)


def ratio_of(row):
    return f"{row['ratio']:.3f}" if row else ""


def print_each(result):
    """A line for each case."""
    print(f"{'':9}{'B / A':>7}  {'p':>8}  {'':12}  case")
    for row in result["rows"]:
        p = f"{row['p']:.1e}" if "p" in row else "exact"
        counts = f": {row['a']} -> {row['b']}" if row["verdict"] and "a" in row else ""
        print(f"{word(row):9}{row['ratio']:7.3f}  {p:>8}  {row['kind']:12}  {row['name']}{counts}")
        for function, of_a, of_b in row.get("functions", ()):
            print(f"{'':40}{of_b - of_a:+d} in {decide.short_function(function, 80)}")


def print_kernels(result):
    """A line for each kernel: its worst case by times and by instructions."""
    print(f"{'':9}{'time':>7}  {'instr.':>7}  kernel (B / A of its worst case)")
    for kernel, rows in decide.by_kernel(result["rows"]).items():
        time, count = (worst_of(rows, kind) for kind in ("time", "instructions"))
        worst = worth_a_look(rows)
        where = f": {len(worst)} of {len(rows)} cases" if worst else ""
        print(f"{word(rows[0]):9}{ratio_of(time):>7}  {ratio_of(count):>7}  {kernel}{where}")
        if worst and (moved := moved_words(worst)):
            print(f"{'':27}{moved}")


def print_comparison(a, b, result, note, each):
    if not result["comparable"]:
        print(f"limitcheck bench: {a} and {b} cannot be compared:", *result["differences"], sep="\n  ", file=sys.stderr)
        return
    print(f"A = {a}, B = {b}; {note}")
    (print_each if each else print_kernels)(result)
    for side, names in (("A", result["only_a"]), ("B", result["only_b"])):
        for name in names:
            print(f"only in {side}: {name}")
    lost = f", {len(result['only_a'])} benchmarks of A lost" if result["only_a"] else ""
    plural = "" if result["regressions"] == 1 else "s"
    if result["advisories"]:
        print(f"{result['advisories']} slower by times of different hours, which decide nothing: time both builds in turns "
              "(limitcheck bench compare --against FOLDER, or bench run --keep)")
    print(f"{result['regressions']} regression{plural}{lost}. A difference in time counts when two rounds show at least "
          f"{decide.TIME_EFFECT:.0%} with p < {decide.TIME_ALPHA}; one in instructions from {decide.COUNT_TOLERANCE:.1%} on.")


def command_gate(args):
    kinds = [args.only] if args.only else gate.KINDS
    return gate.run(kinds, args.programs, args.update, args.unknown_skips, write_whole, progress)


def command_self_test(args):
    return HELD if self_test.run(args.programs, args.same, args.planted, args.suite, progress) else FINDINGS


def command_trend(args):
    records = [{**load(args.store, str(path)), "label": path.stem} for path in sorted(args.store.glob("*/*.json"))]
    if not records:
        raise UsageError(f"{args.store} has no records; make one with `limitcheck bench run`")
    if args.markdown:
        print(trend.markdown(records))
        return HELD
    write_whole(args.output, trend.page(records))
    print(f"{args.output}: {len(records)} records")
    return HELD


def parser():
    top = argparse.ArgumentParser(prog="limitcheck bench", description=__doc__,
                                  epilog="Exit codes: 0 no regression, 1 regression, 2 bad usage, no baseline or not comparable.")
    commands = top.add_subparsers(dest="command", required=True, metavar="COMMAND")

    def command(name, function, text, more=""):
        sub = commands.add_parser(name, help=text, description=f"{text[0].upper()}{text[1:]}.{more}")
        sub.set_defaults(function=function)
        return sub

    def takes_programs(sub):
        sub.add_argument("--programs", type=pathlib.Path, default=default_programs(), metavar="FOLDER",
                         help="where the benchmark programs of this build are (default: %(default)s)")

    def takes_store(sub):
        sub.add_argument("--store", type=pathlib.Path, default=pathlib.Path("bench-records"), metavar="FOLDER",
                         help="where records are kept (default: %(default)s)")

    suites = f"{', '.join(measure.SUITES)}, or a regular expression of benchmark names (default: %(default)s)"

    run = command("run", command_run, "measure this build and store a record under its machine, compiler, flags and targets")
    run.add_argument("--label", type=label, help="name of the record (default: the commit)")
    run.add_argument("--keep", action="store_true",
                     help="keep the programs, too, in kept/LABEL beside them: later builds are timed in turns with them")
    run.add_argument("--suite", default="standard", help=suites)
    run.add_argument("--repetitions", type=positive, default=6, metavar="N",
                     help="of each benchmark in a round (default: %(default)s)")
    run.add_argument("--rounds", type=positive, default=2, metavar="N",
                     help="independent rounds; a difference in time must show in each (default: %(default)s)")
    run.add_argument("--no-counts", action="store_true", help="leave out the instruction counts (no valgrind needed)")
    takes_store(run)
    takes_programs(run)

    compare = command("compare", command_compare, "compare two records, or a record or another build with this build",
                      " Two builds that are both here are timed in turns of milliseconds, which is what works on a busy machine.")
    compare.add_argument("a", metavar="A", nargs="?", help="label or file of a record")
    compare.add_argument("b", metavar="B", nargs="?", help="label or file; without it this build is measured")
    compare.add_argument("--against", type=pathlib.Path, metavar="FOLDER", help="a build folder in place of A")
    compare.add_argument("--suite", default="standard", help=f"with --against: {suites}")
    compare.add_argument("--no-counts", action="store_true", help="with --against: times only")
    compare.add_argument("--each", action="store_true", help="a line for each case, not for each kernel")
    compare.add_argument("--json", action="store_true", help="print one JSON document")
    compare.add_argument("--markdown", action="store_true", help="print the kernels that are worth a look as Markdown, on one screen, for a pull request")
    takes_store(compare)
    takes_programs(compare)

    gated = command("gate", command_gate, "hold this build's exact costs against the baseline in bench/track/baseline",
                    " Operations, vectors, allocations and bytes must be equal; instruction counts within "
                    f"{decide.COUNT_TOLERANCE * 100:.1f} %, for the compilers that have a baseline.")
    gated.add_argument("--update", action="store_true", help="make what is measured the baseline")
    gated.add_argument("--only", choices=gate.KINDS, help="one kind of cost")
    gated.add_argument("--unknown-skips", action="store_true",
                       help=f"for ctest: exit code {gate.SKIPPED} if there is no baseline for this compiler and CI is not set")
    takes_programs(gated)

    tried = command("self-test", command_self_test,
                    "try on this machine whether planted slowdowns are found and equal builds pass",
                    " Takes half an hour; gives the best answer at high priority (nice -n -15).")
    tried.add_argument("--same", type=positive, default=20, metavar="N",
                       help="comparisons of this build with itself (default: %(default)s)")
    tried.add_argument("--planted", type=positive, default=5, metavar="N",
                       help="comparisons with builds of which one kernel is 1, 2, 5, 10 %% slower, of each (default: %(default)s)")
    tried.add_argument("--suite", default="standard", help=suites)
    takes_programs(tried)

    drawn = command("trend", command_trend, "draw the history of all records as a page")
    drawn.add_argument("-o", "--output", type=pathlib.Path, default=pathlib.Path("trend.html"), metavar="FILE",
                       help="the page (default: %(default)s)")
    drawn.add_argument("--markdown", action="store_true", help="print the steps as Markdown instead")
    takes_store(drawn)
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
