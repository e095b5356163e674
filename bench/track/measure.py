# SPDX-License-Identifier: MIT
"""Runs the benchmark programs and callgrind, and makes one record of what they say."""
import concurrent.futures
import datetime
import json
import os
import pathlib
import re
import subprocess
import tempfile

import machine

SUITES = {
    # What every engine does on the best targets and on AVX2, on one thread.
    "standard": r"^(?!naive)(?!.*(sse4|scalar|/4/|threads:2|two-threads))",
    "quick": r"row-stream/avx2/steady/.*/depth:[35]/threads:1|^sliding-window/steady/.*/depth:3|frame/row-stream/patches$",
    "all": "",
}


class MeasureError(Exception):
    """A program is missing or failed; the message says which and how."""


def matches(pattern, name):
    return re.search(pattern, name) is not None


class Planted:
    """The programs of a build of which one kernel function is slower, as bench/cases/planted_kernels.cpp takes it."""

    def __init__(self, programs, plant):
        self.folder, self.environment = programs / "planted", {"LIMITCHECK_PLANT": plant}

    def __truediv__(self, name):
        return self.folder / name


def environment_of(programs):
    return getattr(programs, "environment", {})


def run_program(command, environment=None):
    try:
        done = subprocess.run(command, capture_output=True, text=True, check=False, env=environment)
    except OSError as error:
        raise MeasureError(f"{command[0]}: {error.strerror}; is it "
                           + ("installed?" if command[0] == "valgrind" else "built?")) from error
    if done.returncode != 0:
        last = (done.stderr.strip() or done.stdout.strip()).splitlines()[-1:]
        raise MeasureError(f"{command[0]} ended with {done.returncode}: {''.join(last)}")
    return done.stdout, done.stderr


def counted_cases(programs):
    """(what the build is, [cases])."""
    lines = run_program([str(programs / "instruction_case")])[0].splitlines()
    return lines[0], lines[1:]


def callgrind(programs, case, profile):
    # The environment lies on the stack and moves it, and with it what the C library does by alignment.
    return run_program(["valgrind", "--tool=callgrind", "--collect-atstart=no", f"--callgrind-out-file={profile}",
                        str(programs / "instruction_case"), case],
                       {"PATH": os.environ.get("PATH", os.defpath), **environment_of(programs)})[1]


def instructions_of(programs, case):
    return int(re.search(r"Collected : (\d+)", callgrind(programs, case, "/dev/null")).group(1))


def own_costs(profile):
    """{function: instructions in it, without those that it calls}, of a file of callgrind."""
    names, costs, function, called = {}, {}, None, False
    for line in profile.splitlines():
        key, _, value = line.partition("=")
        if key == "calls":
            called = True  # the next line is the cost of the call
        elif key in ("fn", "cfn"):
            number, name = re.fullmatch(r"(\(\d+\))\s*(.*)", value).groups()
            names.setdefault(number, name)
            if key == "fn":
                function = names[number]
        elif function and re.match(r"[+*\d-]", line):
            if not called:
                costs[function] = costs.get(function, 0) + int(line.split()[-1])
            called = False
    return costs


def functions_of(programs, case):
    with tempfile.NamedTemporaryFile(suffix=".callgrind") as out:
        callgrind(programs, case, out.name)
        return own_costs(pathlib.Path(out.name).read_text(encoding="utf-8"))


def instruction_counts(programs, progress, pattern=""):
    """{case: instructions}, of the cases that match."""
    return counts_of(programs, [case for case in counted_cases(programs)[1] if matches(pattern, case)], progress)


def counts_of(programs, cases, progress):
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        counts = {}
        for case, count in zip(cases, pool.map(lambda c: instructions_of(programs, c), cases)):
            counts[case] = count
            progress(f"instructions {len(counts)}/{len(cases)}")
        return counts


def identity(programs):
    """Machine, compiler, flags and targets of a build, without measuring it."""
    with tempfile.NamedTemporaryFile(suffix=".json") as out:
        run_program([str(programs / "throughput_bench"), "--benchmark_filter=^write-only/first-level", "--benchmark_min_time=0.001",
                     f"--benchmark_out={out.name}", "--benchmark_out_format=json"])
        return machine.identity(json.load(out)["context"])


def kernel_calls(programs, program):
    """{kernel function: {case: calls}} of a run of each case of timing_turns or instruction_case."""
    counting = Planted(programs, "calls")
    cases = run_program([str(counting / program)])[0].splitlines()[1:]
    calls = {}
    for case in cases:
        for line in run_program([str(counting / program), case], {**os.environ, **counting.environment})[1].splitlines():
            _, function, number = line.split()
            calls.setdefault(function, {})
            if int(number) > 0:
                calls[function][case] = int(number)
    return calls


def commit_of(folder):
    try:
        return run_program(["git", "-C", str(folder), "describe", "--always", "--dirty", "--abbrev=12"])[0].strip()
    except MeasureError:
        return "unknown"


def measure(programs, time_once, suite="standard", repetitions=6, rounds=2, counts=True, progress=lambda text: None):
    """A record: identity, key, label, rounds of timings as turns.time_once makes them, exact counts."""
    programs = pathlib.Path(programs)
    timings = []
    for round_ in range(rounds):
        progress(f"timing, round {round_ + 1} of {rounds}")
        timings.append(time_once(programs, SUITES.get(suite, suite), repetitions))
    of_build = identity(programs)
    return {
        "format": 1,
        "identity": of_build,
        "key": machine.key(of_build),
        "commit": commit_of(pathlib.Path(__file__).parent),
        "date": datetime.datetime.now(datetime.timezone.utc).isoformat(timespec="seconds"),
        "suite": suite,
        "rounds": timings,
        "instructions": instruction_counts(programs, progress) if counts else {},
    }
