# SPDX-License-Identifier: MIT
"""Costs that do not depend on noise against the baseline that is committed: whole numbers of operations, vectors,
allocations and bytes, the same everywhere; and instruction counts, the same wherever compiler, C library and flags are:
callgrind shows every program the same processor, so the library's own choices by processor do not differ either."""
import json
import os
import pathlib

import decide
import measure

BASELINE = pathlib.Path(__file__).resolve().parent / "baseline"
SKIPPED = 77  # of ctest
KINDS = ("exact", "instructions")


class NoBaseline(Exception):
    pass


def read(kind, folder=BASELINE):
    path = folder / f"{kind}.json"
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError as error:
        raise NoBaseline(f"{path} is not there") from error
    except ValueError as error:
        raise measure.MeasureError(f"{path}: not a baseline ({error})") from error


def measured_exact(programs):
    return json.loads(measure.run_program([str(programs / "exact_costs")])[0])


def target_of(cases):
    """The widest kernel counted: callgrind knows no AVX-512."""
    return next((t for t in ("avx2", "sse4") if any(f"row-stream/{t}/" in case for case in cases)), "scalar")


def key_of(programs):
    """"GNU-12.2.0/glibc-2.36/-O3 -DNDEBUG/avx2"."""
    build, cases = measure.counted_cases(programs)
    return f"{build}/{target_of(cases)}"


def differences(old, new, tolerance):
    """[(name, old, new)] of all that moved by more; None where one side has nothing."""
    rows = []
    for name in sorted(old.keys() | new.keys()):
        a, b = old.get(name), new.get(name)
        if a is None or b is None or abs(b - a) > tolerance * a:
            rows.append((name, a, b))
    return rows


def told(name, old, new):
    if old is None:
        return f"  {name}: {new}, not in the baseline"
    if new is None:
        return f"  {name}: {old} in the baseline, not measured"
    percent = f"{new / old - 1:+.2%}" if old else "was nothing"
    return f"  {name}: {old} -> {new} ({percent})"


def measured(kind, programs, progress):
    """(what is compared, its part of the baseline file, tolerance)."""
    if kind == "exact":
        return measured_exact(programs), None, 0
    return measure.instruction_counts(programs, progress), key_of(programs), decide.COUNT_TOLERANCE


def baseline_for(kind, key, folder):
    all_of_kind = read(kind, folder)
    if key is None:
        return all_of_kind
    if key not in all_of_kind:
        known = "".join(f"\n    {k}" for k in sorted(all_of_kind)) or " none"
        raise NoBaseline(f"no baseline for this compiler:\n    {key}\n  baselines there are:{known}")
    return all_of_kind[key]


def check(kind, programs, folder=BASELINE, progress=lambda text: None):
    """(number of costs, rows that differ). Throws NoBaseline before anything is measured."""
    if kind == "instructions":
        baseline_for(kind, key_of(programs), folder)
    new, key, tolerance = measured(kind, programs, progress)
    return len(new), differences(baseline_for(kind, key, folder), new, tolerance)


def renew(kind, programs, write, folder=BASELINE, progress=lambda text: None):
    """Puts what is measured in the place of the baseline; those of other compilers stay."""
    new, key, _ = measured(kind, programs, progress)
    if key is not None:
        try:
            new = {**read(kind, folder), key: new}
        except NoBaseline:
            new = {key: new}
    path = folder / f"{kind}.json"
    write(path, json.dumps(new, indent=1) + "\n")
    return path


def run(kinds, programs, update, unknown_skips, write, progress, folder=BASELINE):
    """Prints; the exit code."""
    code = 0
    for kind in kinds:
        if update:
            path = renew(kind, programs, write, folder, progress)
            progress("")
            print(f"{path}: renewed; commit it")
            continue
        try:
            count, rows = check(kind, programs, folder, progress)
        except NoBaseline as error:
            progress("")
            skip = unknown_skips and not os.environ.get("CI")
            print(f"{kind}: NOT CHECKED, {error}\n  make one:  limitcheck bench gate --update"
                  + ("\n  (an error where CI is set)" if skip else ""))
            code = max(code, SKIPPED if skip else 2)
            continue
        progress("")
        print(f"{kind}: {count} costs, {len(rows)} unlike the baseline"
              + (f" by more than {decide.COUNT_TOLERANCE:.1%}" if kind == "instructions" else ""))
        if kind == "instructions":
            print("  Counts are blind to caches and latency, to branches and to how well instructions overlap; times see these:\n"
                  "  limitcheck bench compare --against FOLDER")
        for row in rows:
            print(told(*row))
        if rows:
            print("  If this is meant, renew the baseline and commit it:  limitcheck bench gate --update")
            code = max(code, 1)
    return code
