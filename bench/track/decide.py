# SPDX-License-Identifier: MIT
"""Is B slower than A? Exact counts decide by themselves; times need statistics, size and a second round."""
import itertools
import math
import re
import statistics

import scipy.stats

import machine

COUNT_TOLERANCE = 0.005  # counts of kernels repeat exactly, those of set-up, which allocates, within 0.0015
TIME_EFFECT = 0.05       # smaller differences are not worth anybody's time
TIME_ALPHA = 0.01        # of the test of each round
SUSPECT = 0.5            # from this part of a limit on, a row is worth a look


def samples(timing):
    """{benchmark: [time of each repetition]} of one round."""
    result = {}
    for run in timing["benchmarks"]:
        if run.get("run_type") == "iteration" and not run.get("error_occurred"):
            name = run["run_name"].removesuffix("/real_time")  # as records of 0.1 have it
            result.setdefault(name, []).append(run["real_time"])
    return result


def judge_round(a, b):
    """(ratio of medians, p of Mann and Whitney's test, +1 slower / -1 faster / 0 no difference shown)."""
    ratio = statistics.median(b) / statistics.median(a)
    p = scipy.stats.mannwhitneyu(a, b, alternative="two-sided").pvalue
    return ratio, p, sign_of(ratio, p)


def judge_launches(launches):
    """Of two builds timed in turns, see turns.py: as judge_round. A launch counts once, as the median of its pairs of
    turns; then Wilcoxon's signed-rank test, and the shift that belongs to it (Hodges and Lehmann)."""
    logs = [statistics.median(math.log(b / a) for a, b in blocks) for blocks in launches]
    ratio = math.exp(statistics.median((x + y) / 2 for x, y in itertools.combinations_with_replacement(logs, 2)))
    p = scipy.stats.wilcoxon(logs).pvalue if any(logs) else 1.0
    return ratio, p, sign_of(ratio, p)


def sign_of(ratio, p):
    if p >= TIME_ALPHA or abs(ratio - 1) < TIME_EFFECT:
        return 0
    return 1 if ratio > 1 else -1


def time_row(name, judged):
    """A difference counts when every round shows it alike."""
    signs = {sign for _, _, sign in judged}
    verdict = {1: "slower", -1: "faster"}.get(signs.pop() if len(signs) == 1 else 0, "")
    near = any(p < TIME_ALPHA and abs(ratio - 1) >= SUSPECT * TIME_EFFECT for ratio, p, _ in judged)
    return {"name": name, "kind": "time", "ratio": statistics.median(r for r, _, _ in judged),
            "p": max(p for _, p, _ in judged), "verdict": verdict, "rounds": len(judged), "suspect": near and not verdict}


def judge_times(a, b):
    """One row per benchmark that both have."""
    rows = []
    rounds = [(samples(x), samples(y)) for x, y in zip(a["rounds"], b["rounds"])]
    for name in rounds[0][0]:
        judged = [judge_round(x[name], y[name]) for x, y in rounds if name in x and name in y]
        if len(judged) == len(rounds):
            rows.append(time_row(name, judged))
    return rows


def judge_counts(a, b):
    rows = []
    for name in sorted(a["instructions"].keys() & b["instructions"].keys()):
        x, y = a["instructions"][name], b["instructions"][name]
        ratio = y / x
        verdict = "more" if ratio > 1 + COUNT_TOLERANCE else "fewer" if ratio < 1 - COUNT_TOLERANCE else ""
        near = abs(ratio - 1) > SUSPECT * COUNT_TOLERANCE and ratio > 1
        rows.append({"name": name, "kind": "instructions", "ratio": ratio, "a": x, "b": y, "verdict": verdict,
                     "suspect": near and not verdict})
    return rows


def moved_functions(a, b, most=5):
    """[(function, instructions in A, in B)] of two profiles {function: instructions}: those that moved most."""
    moved = [(name, a.get(name, 0), b.get(name, 0)) for name in a.keys() | b.keys() if a.get(name, 0) != b.get(name, 0)]
    return sorted(moved, key=lambda row: (-abs(row[2] - row[1]), row[0]))[:most]


def worst_first(rows):
    """What got worse, what is suspect, what got better, the rest; of each the furthest first."""
    def place(row):
        worse = row["verdict"] in ("slower", "more")
        rank = 0 if worse else 1 if row["suspect"] else 2 if row["verdict"] else 3
        return rank, -abs(math.log(row["ratio"])), row["name"]
    return sorted(rows, key=place)


def kernel_of(case):
    """What a case is of: its name without what it does with it. "row-stream/avx2/bumpy", "set-up/naive"."""
    return re.sub(r"/(steady|scratch|faces:\d+|depth:\d+|threads:\d+)(?=/|$)", "", case)


def by_kernel(rows):
    """{kernel: its rows, worst first}, in the order of the worst."""
    groups = {}
    for row in worst_first(rows):
        groups.setdefault(kernel_of(row["name"]), []).append(row)
    return groups


def short_function(name, most=48):
    """A function as callgrind names it, without arguments, templates, namespaces and the build's suffix."""
    name = re.sub(r"\[clone .*|'\d+$", "", name).strip()
    while (plain := re.sub(r"<[^<>]*>|\([^()]*\)( const)?", "", name)) != name:
        name = plain
    name = "::".join(name.split(" ")[-1].split("::")[-2:])
    return name if len(name) <= most else name[:most - 1] + "…"


def unmatched(a, b):
    """Names that one side has and the other lacks: never a silent pass."""
    return sorted(set(a) - set(b)), sorted(set(b) - set(a))


def names(record):
    return set(samples(record["rounds"][0])) | set(record["instructions"])


def result(rows, only_a, only_b, differences=(), times_decide=True):
    """What a comparison says, as --json prints it. Times of two records, taken at different hours, decide nothing: identical
    programs have differed by a factor of seven so. They are advisories."""
    slower = [r for r in rows if r["verdict"] == "slower" and r["rounds"] >= 2]
    more = [r for r in rows if r["verdict"] == "more"]
    return {"comparable": not differences, "differences": list(differences), "rows": worst_first(rows), "only_a": only_a,
            "only_b": only_b, "regressions": len(more) + (len(slower) if times_decide else 0),
            "advisories": 0 if times_decide else len(slower)}


def compare(a, b):
    """Two records: {'comparable': bool, 'differences': [...], 'rows': [...], 'only_a', 'only_b', 'regressions': n}."""
    differences = machine.differences(a["identity"], b["identity"])
    if differences:
        return result([], [], [], differences)
    return result(judge_counts(a, b) + judge_times(a, b), *unmatched(names(a), names(b)), times_decide=False)
