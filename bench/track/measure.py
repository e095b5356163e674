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
    # What a change of any kernel, of the set-up or of the output shows in, on one thread.
    "standard": r"row-stream/(avx512|avx2|whole-pairs)/steady/bumpy/faces:1000/depth:[35]/threads:1|"
                r"row-stream/avx2/scratch/bumpy/faces:1000/depth:3/|sliding-window/steady/bumpy/faces:200/depth:[35]/threads:1",
    "quick": r"row-stream/avx2/steady/bumpy/faces:1000/depth:[35]/threads:1|sliding-window/steady/bumpy/faces:200/depth:3/threads:1",
}


class MeasureError(Exception):
    """A program is missing or failed; the message says which and how."""


def matches(pattern, name):
    return re.search(pattern, name) is not None


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


def time_once(programs, pattern, repetitions, min_time):
    """The JSON of Google Benchmark, verbatim, repetitions interleaved at random."""
    with tempfile.NamedTemporaryFile(suffix=".json") as out:
        run_program([str(programs / "throughput_bench"), f"--benchmark_filter={pattern}",
                     f"--benchmark_repetitions={repetitions}", "--benchmark_enable_random_interleaving=true",
                     f"--benchmark_min_time={min_time}", f"--benchmark_out={out.name}", "--benchmark_out_format=json"])
        return json.load(out)


def counted_cases(programs):
    """(what the build is, [cases])."""
    lines = run_program([str(programs / "instruction_case")])[0].splitlines()
    return lines[0], lines[1:]


def callgrind(programs, case, profile):
    # The environment lies on the stack and moves it, and with it what the C library does by alignment.
    return run_program(["valgrind", "--tool=callgrind", "--collect-atstart=no", f"--callgrind-out-file={profile}",
                        str(programs / "instruction_case"), case], {"PATH": os.environ.get("PATH", os.defpath)})[1]


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
    cases = [case for case in counted_cases(programs)[1] if matches(pattern, case)]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        counts = {}
        for case, count in zip(cases, pool.map(lambda c: instructions_of(programs, c), cases)):
            counts[case] = count
            progress(f"instructions {len(counts)}/{len(cases)}")
        return counts


def identity(programs):
    """Machine, compiler, flags and targets of a build, without measuring it."""
    return machine.identity(time_once(programs, "^write-only/first-level", 1, 0.001)["context"])


def commit_of(folder):
    try:
        return run_program(["git", "-C", str(folder), "describe", "--always", "--dirty", "--abbrev=12"])[0].strip()
    except MeasureError:
        return "unknown"


def measure(programs, suite="standard", repetitions=6, rounds=2, min_time=0.05, counts=True, progress=lambda text: None):
    """A record: identity, key, label, rounds of verbatim timings, exact counts."""
    programs = pathlib.Path(programs)
    timings = []
    for round_ in range(rounds):
        progress(f"timing, round {round_ + 1} of {rounds}")
        timings.append(time_once(programs, SUITES.get(suite, suite), repetitions, min_time))
    identity = machine.identity(timings[0]["context"])
    return {
        "format": 1,
        "identity": identity,
        "key": machine.key(identity),
        "commit": commit_of(pathlib.Path(__file__).parent),
        "date": datetime.datetime.now(datetime.timezone.utc).isoformat(timespec="seconds"),
        "suite": suite,
        "rounds": timings,
        "instructions": instruction_counts(programs, progress) if counts else {},
    }
