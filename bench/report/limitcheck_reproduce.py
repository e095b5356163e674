#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""limitcheck reproduce: the paper's claims, tables and figures from our own data, and one page that shows them."""
import argparse
import pathlib
import signal
import sys

sys.dont_write_bytecode = True  # nothing is left in the source tree
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import page  # noqa: E402
import tables  # noqa: E402
from parts import PARTS, Workshop, order  # noqa: E402
from progress import say  # noqa: E402
from record import Record  # noqa: E402

HELD, INCOMPLETE, BAD_INPUT = 0, 1, 2


def interrupt(_signal, _frame):
    raise KeyboardInterrupt


def arguments():
    parser = argparse.ArgumentParser(
        prog="limitcheck reproduce", description=__doc__,
        epilog="Each part leaves its result in the folder as soon as it is made, and the page shows what is there: a run that fails or is "
               "interrupted loses only the part it was at. Exit codes: 0 the report is complete, 1 a part is missing or claims "
               "were not run (said in it), 2 bad usage.")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=pathlib.Path("build/report"),
                        help="folder of the report (default: %(default)s)")
    parser.add_argument("--quick", action="store_true", help="fewer frames and meshes: two minutes instead of a third of an hour")
    parser.add_argument("--only", action="append", metavar="PART", choices=PARTS,
                        help="make this part, and of the parts it needs those that are not in the folder; may be repeated")
    parser.add_argument("--map", action="append", metavar="SUBJECT@MESH[@DEPTH]", default=[],
                        help="errors of a tessellator on a mesh, in the view; may be repeated (default: two libraries and row-stream)")
    parser.add_argument("--list", action="store_true", help="the names of all parts")
    return parser.parse_args()


def make(selected, shop, record):
    """Makes the parts, each saved before the next begins."""
    for number, name in enumerate(selected, 1):
        part = PARTS[name]
        label = f"[{number}/{len(selected)}] {part.title}"
        missing = [n for n in part.needs if not record.has(n)]
        if missing:
            record.fail(name, f"needs {', '.join(missing)}, which could not be made")
            say(f"{label}: {record.problem(name)}")
            continue
        shop.begin(label, record.seconds(name, shop.quick))
        try:
            with record.making(name, shop.quick):
                part.make(shop)
            say(f"{label}: {record.seconds(name, shop.quick):.0f} s")
        except KeyboardInterrupt:
            record.fail(name, "interrupted")
            for rest in selected[number:]:
                record.fail(rest, "not made: the run was interrupted before it")
            page.write(shop.folder, record)
            raise
        except (OSError, ValueError, KeyError) as error:  # parts.PartError is a ValueError
            record.fail(name, str(error))
            say(f"{label}: {error}")
        page.write(shop.folder, record)


def complete(selected, folder, record):
    """Whether each part was made; of the claims, whether each that has a test was run."""
    if any(record.problem(name) for name in selected):
        return False
    if "claims" not in selected:
        return True
    claims = page.load(folder, "claims.json", [])
    reason = tables.claims_not_run(claims) if claims else "claims.json cannot be read"
    if reason:
        say(reason)
    return not reason


def main():
    args = arguments()
    if args.list:
        for name, part in PARTS.items():
            print(f"{name:<12} {part.title}")
        return HELD
    programs = pathlib.Path(sys.argv[0]).absolute().parent  # where the build puts a link to this file
    try:
        args.output.mkdir(parents=True, exist_ok=True)
        record = Record(args.output, PARTS)
    except (OSError, ValueError) as error:
        say(f"limitcheck reproduce: {error}")
        return BAD_INPUT
    selected = order(args.only or list(PARTS), record)
    if not args.only:
        for name in selected:
            record.fail(name, "not made yet")
    for number in (signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, interrupt)
    try:
        make(selected, Workshop(programs, args.output, args.quick, args.map), record)
    except KeyboardInterrupt:
        say(f"interrupted; what was made is in {args.output / 'index.html'}")
        return INCOMPLETE
    print(args.output / "index.html")
    return HELD if complete(selected, args.output, record) else INCOMPLETE


if __name__ == "__main__":
    sys.exit(main())
