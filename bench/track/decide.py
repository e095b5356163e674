# SPDX-License-Identifier: MIT
"""Is B slower than A? Exact counts decide by themselves; times need statistics, size and a second round."""
import statistics

import scipy.stats

import machine

COUNT_TOLERANCE = 0.005  # instruction counts repeat exactly; this is for a library that moved by an instruction
TIME_EFFECT = 0.05       # smaller differences of medians are not worth anybody's time
TIME_ALPHA = 0.01        # of a Mann-Whitney U test in each round


def samples(timing):
    """{benchmark: [time of each repetition]} of one round."""
    result = {}
    for run in timing["benchmarks"]:
        if run.get("run_type") == "iteration" and not run.get("error_occurred"):
            result.setdefault(run["run_name"], []).append(run["real_time"])
    return result


def judge_round(a, b):
    """(ratio of medians, p, +1 slower / -1 faster / 0 no difference shown)."""
    ratio = statistics.median(b) / statistics.median(a)
    p = scipy.stats.mannwhitneyu(a, b, alternative="two-sided").pvalue
    if p >= TIME_ALPHA or abs(ratio - 1) < TIME_EFFECT:
        return ratio, p, 0
    return ratio, p, 1 if ratio > 1 else -1


def judge_times(a, b):
    """One row per benchmark that both have. A difference counts when every round shows it alike."""
    rows = []
    rounds = [(samples(x), samples(y)) for x, y in zip(a["rounds"], b["rounds"])]
    for name in rounds[0][0]:
        judged = [judge_round(x[name], y[name]) for x, y in rounds if name in x and name in y]
        if len(judged) < len(rounds):
            continue
        signs = {sign for _, _, sign in judged}
        verdict = {1: "slower", -1: "faster"}.get(signs.pop() if len(signs) == 1 else 0, "")
        rows.append({"name": name, "kind": "time", "ratio": statistics.median(r for r, _, _ in judged),
                     "p": max(p for _, p, _ in judged), "verdict": verdict, "rounds": len(judged)})
    return rows


def judge_counts(a, b):
    rows = []
    for name in sorted(a["instructions"].keys() & b["instructions"].keys()):
        x, y = a["instructions"][name], b["instructions"][name]
        ratio = y / x
        verdict = "more" if ratio > 1 + COUNT_TOLERANCE else "fewer" if ratio < 1 - COUNT_TOLERANCE else ""
        rows.append({"name": name, "kind": "instructions", "ratio": ratio, "a": x, "b": y, "verdict": verdict})
    return rows


def missing(a, b):
    """Names that one record has and the other lacks: never a silent pass."""
    def names(record):
        return set(samples(record["rounds"][0])) | set(record["instructions"])
    return sorted(names(a) - names(b)), sorted(names(b) - names(a))


def compare(a, b):
    """{'comparable': bool, 'differences': [...], 'rows': [...], 'only_a', 'only_b', 'regressions': n}."""
    differences = machine.differences(a["identity"], b["identity"])
    if differences:
        return {"comparable": False, "differences": differences, "rows": [], "only_a": [], "only_b": [], "regressions": 0}
    rows = judge_counts(a, b) + judge_times(a, b)
    only_a, only_b = missing(a, b)
    confirmed = [r for r in rows if r["verdict"] == "more" or (r["verdict"] == "slower" and r["rounds"] >= 2)]
    return {"comparable": True, "differences": [], "rows": rows, "only_a": only_a, "only_b": only_b,
            "regressions": len(confirmed)}
