# SPDX-License-Identifier: MIT
"""Would the tracker notice, and does it cry wolf? Tried out on this machine: a build against itself, and against builds of
which one function of one kernel is slower. Which cases call a function is counted, not read from their names."""
import os
import random

import decide
import measure
import turns

DOUBLED_CASES = 4  # of those that call a function, its greatest users first
DOUBLED_BLOCKS = 3
SHARES = (.01, .02, .05, .1)


def say(text=""):
    print(text, flush=True)


def best_users(cases, most):
    """The cases that call a function most, those whose time is mostly its own before frames."""
    return sorted(cases, key=lambda case: ("frame" in case, -cases[case], case))[:most]


def doubled(programs, calls, rng, progress):
    """Every function of every kernel at twice its time: whether a case that calls it is found slower, and none that does not."""
    every = sorted({case for cases in calls.values() for case in cases})
    missed, alarms = [], 0
    for number, (function, cases) in enumerate(calls.items(), 1):
        users, others = best_users(cases, DOUBLED_CASES), [case for case in every if case not in cases]
        looked_at = users + rng.sample(others, min(2, len(others)))
        rows = turns.rows_of(programs, measure.Planted(programs, f"{function}=1"), looked_at, rng, blocks=DOUBLED_BLOCKS,
                             progress=lambda text, n=number: progress(f"doubled {n} of {len(calls)}: {text}"))
        found = [row for row in rows if row["verdict"] == "slower" and row["name"] in users]
        alarms += sum(row["verdict"] != "" for row in rows if row["name"] not in users)
        missed += [] if found else [function]
        progress("")
        most = max((row["ratio"] for row in rows if row["name"] in users), default=1)
        say(f"  {function:40} {len(found)} of {len(users)} cases slower, up to {most:.2f}{'' if found else '  MISSED'}")
    say(f"twice the time: {len(calls) - len(missed)} of {len(calls)} functions found by times; {alarms} alarms in cases that do not "
        "call them")
    return not missed and alarms == 0


def instructions_for(programs, function, case, before, progress):
    """What a call of the function must take more so that the case takes all of its instructions once more."""
    pilot = 1000
    after = measure.counts_of(measure.Planted(programs, f"{function}=+{pilot}"), [case], progress)[case]
    return pilot * before / (after - before)


def by_counts(programs, calls, progress):
    """Every function that is counted, each call longer by so many instructions that a case grows by a share."""
    chosen = {function: best_users(cases, 1)[0] for function, cases in calls.items() if cases}
    before = measure.counts_of(programs, sorted(set(chosen.values())), progress)
    whole = {function: instructions_for(programs, function, case, before[case], progress) for function, case in chosen.items()}
    held = True
    for share in SHARES:
        found, growth = 0, []
        for function, case in chosen.items():
            plant = f"{function}=+{round(share * whole[function])}"
            with_plant = measure.counts_of(measure.Planted(programs, plant), [case], progress)
            row, = decide.judge_counts({"instructions": {case: before[case]}}, {"instructions": with_plant})
            found += row["verdict"] == "more"
            growth.append(row["ratio"] - 1)
        progress("")
        say(f"  {share:4.0%} by instructions: {found} of {len(chosen)} functions found ({min(growth):+.2%} to {max(growth):+.2%})")
        held = held and found == len(chosen)
    return held


def by_times(programs, calls, trials, rng, progress):
    """The best kernel of each scheme slower by a share of its time: its cases of whole meshes."""
    best = [next(f for f in calls if f.endswith(name)) for name in ("/run", "/quads")]
    held = True
    for share in SHARES:
        found = all_cases = caught = 0
        for trial in range(trials):
            for function in best:
                cases = [case for case in calls[function] if "/steady/" in case and case.endswith("threads:1")
                         and function.split("/")[1] in case.split("/")][:DOUBLED_CASES]
                rows = turns.rows_of(programs, measure.Planted(programs, f"{function}={share}"), cases, rng,
                                     progress=lambda text, t=trial: progress(f"{share:.0%} by times, {t + 1} of {trials}: {text}"))
                found += sum(row["verdict"] == "slower" for row in rows)
                caught += any(row["verdict"] == "slower" for row in rows)
                all_cases += len(rows)
        progress("")
        comparisons = trials * len(best)
        say(f"  {share:4.0%} by times:        in {caught} of {comparisons} comparisons, {found} of {all_cases} cases")
        held = held and (share < 2 * decide.TIME_EFFECT or 10 * caught >= 9 * comparisons)
    return held


def nothing_planted(programs, same, suite, progress):
    alarms = 0
    for trial in range(same):
        rows, _, _ = turns.compare(programs, programs, suite,
                                   progress=lambda text, t=trial: progress(f"the same build {t + 1} of {same}: {text}"))
        found = [row for row in rows if row["verdict"]]
        alarms += bool(found)
        apart = max(rows, key=lambda row: abs(row["ratio"] - 1))
        progress("")
        say(f"  {trial + 1:2}  {len(rows)} cases, {len(found)} different; furthest from 1: {apart['ratio']:.3f} {apart['name']}")
        for row in found:
            say(f"      {row['verdict']} {row['ratio']:.3f}, p {row['p']:.1e}  {row['name']}")
    say(f"the same build: {alarms} of {same} comparisons raise an alarm")
    return alarms == 0


def run(programs, same, planted, suite, progress):
    """Prints the tables; true if all held."""
    rng = random.Random(1)
    timed, counted = (measure.kernel_calls(programs, program) for program in ("timing_turns", "instruction_case"))
    reached = {function: cases for function, cases in counted.items() if "avx512" not in function}
    load = os.getloadavg()[0]
    say(f"{len(timed)} functions of kernels, load {load:.1f}; each at twice its time:")
    held = [doubled(programs, timed, rng, progress)]
    say("slower by a share:")
    held.append(by_counts(programs, reached, progress))
    held.append(by_times(programs, timed, planted, rng, progress))
    say(f"the same build, {same} comparisons of suite {suite}:")
    held.append(nothing_planted(programs, same, suite, progress))
    say("self-test " + ("held" if all(held) else "FAILED"))
    return all(held)
