# SPDX-License-Identifier: MIT
"""Would the tracker notice, and does it cry wolf? Tried out on this machine: a build against itself, and against builds of
which one kernel (row streaming, rows overwritten) runs a part of its batches twice."""
import decide
import measure
import turns

PLANTED_KERNEL = r"^row-stream/(avx|sse|scalar)"  # the routes that the planted builds slow down
COUNT_TRIALS = 3


def say(text=""):
    print(text, flush=True)


def counts(programs, progress):
    """A planted 5 % by instruction counts: (cases of the kernel, caught, other cases, alarms among them) in all trials."""
    slow = programs / "planted" / "5"
    rows = []
    for _ in range(COUNT_TRIALS):
        a, b = ({"instructions": measure.instruction_counts(side, progress)} for side in (programs, slow))
        rows += decide.judge_counts(a, b)
    progress("")
    kernel = [r for r in rows if measure.matches(PLANTED_KERNEL, r["name"])]
    others = [r for r in rows if r not in kernel]
    ratios = [r["ratio"] for r in kernel]
    caught = sum(r["verdict"] == "more" for r in kernel)
    alarms = sum(r["verdict"] != "" for r in others)
    say(f"planted 5 %, instruction counts, {COUNT_TRIALS} trials: {caught} of {len(kernel)} cases of the kernel caught "
        f"({min(ratios) - 1:+.1%} to {max(ratios) - 1:+.1%}); of {len(others)} other cases {alarms} alarms")
    return caught == len(kernel) and alarms == 0


def times(programs, other, trials, suite, what, progress):
    """[rows of each comparison], each summed up in a line."""
    say(f"{what}, times, {trials} comparisons:")
    results = []
    for trial in range(trials):
        rows, _, _ = turns.compare(programs, other, suite,
                                   progress=lambda text, t=trial: progress(f"{what} {t + 1} of {trials}: {text}"))
        progress("")
        results.append(rows)
        found = [r for r in rows if r["verdict"]]
        apart = max(rows, key=lambda r: abs(r["ratio"] - 1))
        say(f"  {trial + 1:2}  {len(found)} different; furthest from 1: {apart['ratio']:.3f} {apart['name']}")
        for r in found:
            say(f"        {r['verdict']} {r['ratio']:.3f}, p {r['p']:.1e}  {r['name']}")
    return results


def run(programs, same, slower, suite, progress):
    """Prints the table; true if all held."""
    held = [counts(programs, progress)]
    nulls = times(programs, programs, same, suite, "the same build", progress)
    alarms = sum(any(r["verdict"] for r in rows) for rows in nulls)
    allowed = max(1, same // 20)
    held.append(alarms <= allowed)

    planted = times(programs, programs / "planted" / "10", slower, suite, "planted 10 %", progress)
    steady = [[r for r in rows if measure.matches(PLANTED_KERNEL, r["name"]) and "/steady/" in r["name"]]
              for rows in planted]
    caught = sum(any(r["verdict"] == "slower" for r in rows) for rows in steady)
    each = [r for rows in steady for r in rows]
    wrong = sum(r["verdict"] != "" for rows in planted for r in rows if not measure.matches(PLANTED_KERNEL, r["name"]))
    held.append(10 * caught >= 9 * slower)

    say(f"the same build: {alarms} of {same} comparisons raise an alarm (at most {allowed})")
    say(f"planted 10 %: caught in {caught} of {slower} comparisons (at least 9 of 10); single cases "
        f"{sum(r['verdict'] == 'slower' for r in each)} of {len(each)}; of other kernels {wrong} alarms")
    say("self-test " + ("held" if all(held) else "FAILED"))
    return all(held)
