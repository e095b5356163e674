# SPDX-License-Identifier: MIT
"""Times two builds in turns of a few milliseconds, so that both meet the same neighbours on a busy machine."""
import os
import pathlib
import random
import subprocess

import decide
import measure

LAUNCHES = 10    # pairs of fresh processes in a round: where memory lies is chosen anew for each
BLOCKS = 10      # turns of each build and case in a launch, at random A first or B first
REPETITIONS = 2  # of about two milliseconds each in a turn; the least counts
PROGRAMS = ("timing_turns", "instruction_case", "throughput_bench")


class Turns:
    """One process of one build, on one core, that times what it is told to."""

    def __init__(self, programs, core):
        self.program = programs / "timing_turns"
        try:
            self.process = subprocess.Popen([self.program, "--serve"], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                            stderr=subprocess.DEVNULL, text=True,
                                            env={**os.environ, **measure.environment_of(programs)})
        except OSError as error:
            raise measure.MeasureError(f"{self.program}: {error.strerror}") from error
        os.sched_setaffinity(self.process.pid, {core})

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.kill()
        self.process.communicate()

    def nanoseconds(self, case, repetitions=REPETITIONS):
        """Processor time of a run: the least of some repetitions."""
        try:
            self.process.stdin.write(f"{repetitions} {case}\n")
            self.process.stdin.flush()
            return min(map(float, self.process.stdout.readline().split()))
        except (OSError, ValueError) as error:
            raise measure.MeasureError(f"{self.program}: no time for {case}") from error


def build_and_cases(programs):
    """(what the build is, [names of its cases])."""
    lines = measure.run_program([str(programs / "timing_turns")])[0].splitlines()
    return lines[0], lines[1:]


def matching(programs, suite):
    pattern = measure.SUITES.get(suite, suite)
    return [case for case in build_and_cases(programs)[1] if measure.matches(pattern, case)]


def time_once(programs, suite, repetitions):
    """Each case so many times, in random order, in the form that records of 0.1 have: processor time, under `real_time`."""
    cases, core = matching(programs, suite), random.choice(sorted(os.sched_getaffinity(0)))
    if not cases:
        raise measure.MeasureError(f"no case of {programs} matches '{suite}'")
    runs = []
    with Turns(programs, core) as process:
        for _ in range(repetitions):
            for case in random.sample(cases, len(cases)):
                runs.append({"run_name": case, "run_type": "iteration", "time_unit": "ms",
                             "real_time": 1e-6 * process.nanoseconds(case)})
    return {"benchmarks": runs}


def one_launch(a, b, cases, rng, blocks_wanted):
    """{case: [(nanoseconds of A, of B) of each block]}. Both on the same core: cores have different neighbours."""
    core = rng.choice(sorted(os.sched_getaffinity(0)))
    blocks = {case: [] for case in cases}
    with Turns(a, core) as first, Turns(b, core) as second:
        for case in cases:  # the first turn touches memory
            first.nanoseconds(case, 1), second.nanoseconds(case, 1)
        for _ in range(blocks_wanted):
            for case in rng.sample(cases, len(cases)):
                time = {}
                for side in rng.sample((first, second), 2):
                    time[side] = side.nanoseconds(case)
                blocks[case].append((time[first], time[second]))
    return blocks


def one_round(a, b, cases, rng, progress, name, blocks=BLOCKS):
    """{case: [blocks of each launch]}."""
    result = {case: [] for case in cases}
    for launch in range(LAUNCHES):
        progress(f"{name}, launch {launch + 1} of {LAUNCHES}, {len(cases)} cases")
        for case, of_launch in one_launch(a, b, cases, rng, blocks).items():
            result[case].append(of_launch)
    return result


def rows_of(a, b, cases, rng, progress=lambda text: None, blocks=BLOCKS):
    """Rows for decide. The second round times again what the first found different, in new processes."""
    first = one_round(a, b, cases, rng, progress, "first round", blocks)
    judged = {case: [decide.judge_launches(launches)] for case, launches in first.items()}
    again = [case for case in cases if judged[case][0][2] != 0]
    if again:
        for case, launches in one_round(a, b, again, rng, progress, "second round", blocks).items():
            judged[case].append(decide.judge_launches(launches))
    return [decide.time_row(case, judged[case]) for case in cases]


def compare(a, b, suite, seed=None, progress=lambda text: None):
    """Rows for decide, only_a, only_b."""
    of_a, of_b = (matching(side, suite) for side in (a, b))
    cases = [c for c in of_a if c in of_b]
    if not cases:
        raise measure.MeasureError(f"no case of {a} and {b} matches '{suite}'")
    return (rows_of(a, b, cases, random.Random(seed), progress),
            [c for c in of_a if c not in of_b], [c for c in of_b if c not in of_a])


def programs_of(folder):
    """The folder of the programs of a build: itself, or bench/ in it."""
    folder = pathlib.Path(folder)
    for place in (folder, folder / "bench"):
        if (place / "timing_turns").is_file():
            return place
    raise measure.MeasureError(f"{folder}: no build with benchmark programs (timing_turns) is there")
