#!/usr/bin/python3
"""What a warm call of the library takes on every public instance of few arcs.

    bench/tiny_calls.py [--arcs N] [--markdown FILE]

calls the library on each file of ../shared/data/arcs with fewer than N arcs (default 100), by build/release/bench/warm_benchmark, and prints microseconds: of the
first call after one on three arcs, the median of several processes, and of the calls that follow, as of a tracker that calls again and again.  Exit code 1 where
the latter exceed the mark of 100 microseconds, or an optimum is not proven.  docs/benchmarks/tiny_calls.md is written by

    bench/tiny_calls.py --markdown docs/benchmarks/tiny_calls.md
"""

import argparse
import gzip
import pathlib
import statistics
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
ARCS = ROOT.parent / "shared/data/arcs"
WARM = ROOT / "build/release/bench/warm_benchmark"
MARK_US = 100
PROCESSES = 11
CALLS = 201
TIME_LIMIT_S = 10

PAGE = """# Tiny calls

Written by `bench/tiny_calls.py --markdown docs/benchmarks/tiny_calls.md`: every public instance of fewer than {arcs} arcs, one thread, no reading. The first call
comes after one on three arcs, when nothing of the problem is in the caches, median of {processes} processes; the others follow it, median of {calls} calls each and of
the processes. Mark of the latter: {mark} microseconds; {missed} of {count} files miss it.

| file | arcs | first call, us | the next ones, us |
|---|--:|--:|--:|
{rows}
"""


def num_arcs(path):
    """By the problem line."""
    open_text = gzip.open if path.suffix == ".gz" else open
    with open_text(path, "rt") as file:
        return next(int(line.split()[-1]) for line in file if line.startswith("p "))


def measure(path):
    """Microseconds of the first call and of the next ones."""
    command = [WARM, path, str(TIME_LIMIT_S), str(CALLS)]
    runs = [subprocess.run(command, check=True, capture_output=True, text=True).stdout.split() for _ in range(PROCESSES)]
    return [1e6 * statistics.median(float(seconds) for seconds in column) for column in zip(*runs)]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--arcs", type=int, default=100)
    parser.add_argument("--markdown", type=pathlib.Path)
    arguments = parser.parse_args()
    rows, missed = [], 0
    for path in sorted(ARCS.glob("*/*.nda*")):
        arcs = num_arcs(path)
        if arcs >= arguments.arcs:
            continue
        first, again = measure(path)
        missed += again > MARK_US
        rows.append(f"| {path.name} | {arcs} | {first:.0f} | {again:.0f} |")
        print(rows[-1], flush=True)
    print(f"{missed} of {len(rows)} files miss the mark of {MARK_US} microseconds")
    if arguments.markdown:
        page = PAGE.format(
            arcs=arguments.arcs, processes=PROCESSES, calls=CALLS, mark=MARK_US, missed=missed, count=len(rows), rows="\n".join(rows)
        )
        arguments.markdown.write_text(page)
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
