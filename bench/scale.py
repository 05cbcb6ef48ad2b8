#!/usr/bin/python3
"""Time and memory against the number of arcs; writes docs/benchmarks/scale.md.

    bench/scale.py BUILD_DIR [--runs N] [--wait S] [--no-write]

Needs a Release build, an idle machine of two cores, 1.5 GB in the folder for temporary files, and some minutes.  Every file is solved by one thread
and by two in turn, N times (a third of that with more than 2,000,000 arcs); the least time counts.  Before each turn the script waits until nothing else
runs, for S seconds at most in all.
"""

import argparse
import json
import math
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

from shared import ROOT, processor

PAGE = ROOT / "docs/benchmarks/scale.md"
FILES = [(20, 1), (20, 2), (20, 3), (200, 1), (200, 2), (200, 3), (2000, 1), (2000, 2), (2000, 3), (20000, 1)]  # targets, seed
PRESET_TARGETS = 2000  # of the preset, which has about a million arcs
MANY_ARCS = 2000000
LEAST_IDLE = 0.95
PLANTED_ARCS = 10000000
LIMITS_S = [2, 4, 6, 8, 10]
MOST_SOLVE_S, MOST_READ_S, LEAST_SPEEDUP, MOST_GAP, MOST_BYTES = 1.5, 0.3, 1.8, 1e-3, 64


class Idle:
    """Waits until the processors are idle, for some seconds in all."""

    def __init__(self, patience_s):
        self.patience_s = patience_s
        self.turns = self.idle_turns = 0

    def wait(self):
        begin = time.monotonic()
        is_idle = self.share() >= LEAST_IDLE
        while not is_idle and time.monotonic() - begin < self.patience_s:
            is_idle = self.share() >= LEAST_IDLE
        self.patience_s -= time.monotonic() - begin
        self.turns += 1
        self.idle_turns += is_idle

    @staticmethod
    def share():
        def ticks():
            numbers = [int(word) for word in pathlib.Path("/proc/stat").read_text().split("\n", 1)[0].split()[1:]]
            return numbers[3] + numbers[4], sum(numbers)

        before = ticks()
        time.sleep(0.2)
        after = ticks()
        return (after[0] - before[0]) / max(1, after[1] - before[1])


def generate(nda, path, *options):
    with open(path, "w") as out:
        subprocess.run([nda, "generate", *map(str, options)], stdout=out, stderr=subprocess.DEVNULL, check=True)
    return path


def generate_groups(nda, folder, targets, seed):
    share = targets / PRESET_TARGETS
    size = ["--targets", targets, "--side", f"{20000 * math.sqrt(share):.0f}", "--clutter", 400 * share]
    return generate(nda, folder / "groups.nda", "groups", "--preset", "largegroup", *size, "--seed", seed)


def solve(nda, path, *options):
    command = [nda, "solve", path, "-q", "--json", *map(str, options)]
    return json.loads(subprocess.run(command, capture_output=True, text=True, check=False).stdout)


class Measured:
    """The least times of a file, by one thread and by two."""

    def __init__(self, nda, path, runs, idle):
        idle.wait()
        first = solve(nda, path, "--threads", 1)
        self.arcs = first["instance"]["arcs"]
        self.parts = first["instance"]["components"]
        self.bytes = first["stats"]["peak_memory_bytes"]
        answers = {1: [first], 2: []}
        for run in range(runs if self.arcs <= MANY_ARCS else max(1, runs // 3)):
            idle.wait()
            for threads in [1, 2] if run > 0 else [2]:
                answers[threads].append(solve(nda, path, "--threads", threads))
        self.proven = all(answer["proven"] for answer in answers[1] + answers[2])
        self.solve_s = {threads: min(a["stats"]["solve_seconds"] for a in answers[threads]) for threads in [1, 2]}
        self.read_s = min(a["stats"]["read_seconds"] for a in answers[1] + answers[2])

    def speedup(self):
        return self.solve_s[1] / self.solve_s[2]

    def row(self, seed):
        times = f"{self.read_s:.3f} | {self.solve_s[1]:.3f} | {1e9 * self.solve_s[1] / self.arcs:.0f} | {self.solve_s[2]:.3f} | {self.speedup():.2f}"
        memory = f"{self.bytes / 2**20:.0f} | {self.bytes / self.arcs:.0f}"
        return f"| {self.arcs} | {seed} | {self.parts} | {times} | {memory} | {'yes' if self.proven else 'no'} |"


def judge(name, value, mark, reached):
    return f"- {name}: {value}; mark {mark}, {'reached' if reached else 'missed'}"


def of_seeds(values, unit):
    """The median, and what it is the median of."""
    return f"{statistics.median(values):.2f} {unit} (seeds: {', '.join(f'{value:.2f}' for value in values)})"


def groups_marks(seeds):
    """Of the medians over the seeds; all of them must be proven."""
    solve, read = [times.solve_s[1] for times in seeds], [times.read_s for times in seeds]
    speedup = [times.speedup() for times in seeds]
    proven = sum(times.proven for times in seeds)
    marks = [
        judge("proven", f"{proven} of {len(seeds)}", "all", proven == len(seeds)),
        judge("solving, one thread", of_seeds(solve, "s"), f"{MOST_SOLVE_S} s", statistics.median(solve) <= MOST_SOLVE_S),
        judge("reading", of_seeds(read, "s"), f"{MOST_READ_S} s", statistics.median(read) <= MOST_READ_S),
        judge("two threads", of_seeds(speedup, "times one"), f"{LEAST_SPEEDUP} times", statistics.median(speedup) >= LEAST_SPEEDUP),
    ]
    return "\n".join(marks)


def groups_tables(nda, folder, runs, idle):
    rows, seeds = [], []
    for targets, seed in FILES:
        times = Measured(nda, generate_groups(nda, folder, targets, seed), runs, idle)
        rows.append(times.row(seed))
        print(rows[-1], flush=True)
        if targets == PRESET_TARGETS:
            seeds.append(times)
    return "\n".join(rows), groups_marks(seeds)


def optimum_of(path):
    with open(path) as file:
        return next(float(line.split()[2]) for line in file if line.startswith("c optimum"))


def planted_tables(nda, folder, idle):
    path = generate(nda, folder / "planted.nda", "planted", "--size", PLANTED_ARCS // 500, "--arcs", PLANTED_ARCS)
    optimum = optimum_of(path)
    rows, reached_s, most_bytes = [], math.inf, 0
    for limit in LIMITS_S:
        idle.wait()
        answer = solve(nda, path, "--threads", 1, "--time-limit", limit)
        stats = answer["stats"]
        gap = (optimum - answer["lower_bound"]) / abs(optimum)
        bytes_an_arc = stats["peak_memory_bytes"] / answer["instance"]["arcs"]
        most_bytes = max(most_bytes, bytes_an_arc)
        if gap <= MOST_GAP:
            reached_s = min(reached_s, stats["solve_seconds"])
        cost = (answer["cost"] - optimum) / abs(optimum)
        times = f"{stats['solve_seconds']:.2f} | {stats['read_seconds']:.2f} | {stats['dual_evaluations']}"
        rows.append(f"| {limit} | {times} | {100 * gap:.3f} | {100 * cost:.1f} | {bytes_an_arc:.0f} |")
        print(rows[-1], flush=True)
    when = f"within 0.1 % after {reached_s:.1f} s" if reached_s < math.inf else f"not within 0.1 % after {LIMITS_S[-1]} s"
    marks = [
        judge("bound", when, f"{LIMITS_S[-1]} s", reached_s <= 1.01 * LIMITS_S[-1]),
        judge("memory", f"{most_bytes:.0f} bytes an arc", f"{MOST_BYTES} bytes", most_bytes < MOST_BYTES),
    ]
    return "\n".join(rows), "\n".join(marks)


TEXT = """# Scale

Written by `bench/scale.py` on: {processor}.  Nothing else ran before {idle_turns} of the {turns} turns; elsewhere other programs shared the cores, of which
two threads lose more than one.

## Many components

`nda generate groups --preset largegroup`, with targets, clutter and area in proportion: about 10^4, 10^5, 10^6 and 10^7 arcs. Least times of {runs} runs
(a third of that above 2,000,000 arcs); *peak* is the resident memory of the whole process with one thread, the file as it was read included.

| arcs | seed | components | reading, s | solving, s | ns an arc | two threads, s | times faster | peak, MiB | bytes an arc | proven |
|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|---|
{groups}

With 2,000 targets, the median of the seeds:

{groups_marks}

Most components take some milliseconds, and their time is in proportion to their arcs. A few take a hundred or a thousand times as long: groups that cross, whose linear
relaxation leaves a gap that neither cuts nor a search within the slack ends soon. How many of these a file holds is chance, and decides
its time; so does the longest of them with more threads than one.

## One component

`nda generate planted --size {size} --arcs {arcs}`, one thread, ended by `--time-limit`. *Bound* and *solution* tell how far they are from the planted optimum.

| limit, s | solving, s | reading, s | evaluations | bound, % | solution, % | bytes an arc |
|--:|--:|--:|--:|--:|--:|--:|
{planted}

{planted_marks}
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--wait", type=float, default=600)
    parser.add_argument("--no-write", action="store_true")
    arguments = parser.parse_args()
    nda = arguments.build / "nda"
    idle = Idle(arguments.wait)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        groups, marks = groups_tables(nda, folder, arguments.runs, idle)
        planted, planted_marks = planted_tables(nda, folder, idle)
    page = TEXT.format(
        processor=processor(),
        idle_turns=idle.idle_turns,
        turns=idle.turns,
        runs=arguments.runs,
        size=PLANTED_ARCS // 500,
        arcs=PLANTED_ARCS,
        groups=groups,
        groups_marks=marks,
        planted=planted,
        planted_marks=planted_marks,
    )
    print(page)
    if not arguments.no_write:
        PAGE.write_text(page, encoding="utf-8")
    return 1 if "missed" in marks + planted_marks else 0


if __name__ == "__main__":
    sys.exit(main())
