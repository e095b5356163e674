# SPDX-License-Identifier: MIT
"""Is B slower than A? Exact counts decide by themselves; times need statistics, size and a second round."""
import itertools
import math
import statistics

import scipy.stats

import machine

COUNT_TOLERANCE = 0.005  # counts of kernels repeat exactly, those of set-up, which allocates, within 0.0015
TIME_EFFECT = 0.05       # smaller differences are not worth anybody's time
TIME_ALPHA = 0.01        # of the test of each round


def samples(timing):
    """{benchmark: [time of each repetition]} of one round."""
    result = {}
    for run in timing["benchmarks"]:
        if run.get("run_type") == "iteration" and not run.get("error_occurred"):
            result.setdefault(run["run_name"], []).append(run["real_time"])
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
    return {"name": name, "kind": "time", "ratio": statistics.median(r for r, _, _ in judged),
            "p": max(p for _, p, _ in judged), "verdict": verdict, "rounds": len(judged)}


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
        rows.append({"name": name, "kind": "instructions", "ratio": ratio, "a": x, "b": y, "verdict": verdict})
    return rows


def unmatched(a, b):
    """Names that one side has and the other lacks: never a silent pass."""
    return sorted(set(a) - set(b)), sorted(set(b) - set(a))


def names(record):
    return set(samples(record["rounds"][0])) | set(record["instructions"])


def result(rows, only_a, only_b, differences=()):
    """What a comparison says, as --json prints it."""
    confirmed = [r for r in rows if r["verdict"] == "more" or (r["verdict"] == "slower" and r["rounds"] >= 2)]
    return {"comparable": not differences, "differences": list(differences), "rows": rows, "only_a": only_a,
            "only_b": only_b, "regressions": len(confirmed)}


def compare(a, b):
    """Two records: {'comparable': bool, 'differences': [...], 'rows': [...], 'only_a', 'only_b', 'regressions': n}."""
    differences = machine.differences(a["identity"], b["identity"])
    if differences:
        return result([], [], [], differences)
    return result(judge_counts(a, b) + judge_times(a, b), *unmatched(names(a), names(b)))
