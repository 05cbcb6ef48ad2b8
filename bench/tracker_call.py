#!/usr/bin/python3
"""What a tracker waits for: the k best of a window of 20 targets in 6 scans, about 5,000 arcs, called again and again.

    bench/tracker_call.py [--windows N] [--calls N] [--cpu N] [--markdown FILE]

builds bench/tracker_call_benchmark.cpp, which says what is called, runs it on one processor and prints its figures as a table.
Exit code 1 where the ten best take 10 ms or more in the median, or where a rank is not proven.  docs/benchmarks/tracker_call.md is written by

    bench/tracker_call.py --markdown docs/benchmarks/tracker_call.md
"""

import argparse
import pathlib
import subprocess
import sys

import shared

MARK_MS = 10
MARKED = "k = 10"


def measure(windows, calls, cpu):
    """Rows of kind, way, median and worst; whether all ranks were proven."""
    program = shared.build("tracker_call_benchmark") / "tracker_call_benchmark"
    run = subprocess.run(["taskset", "-c", str(cpu), program, str(windows), str(calls)], stdout=subprocess.PIPE, text=True)
    rows = [line.split("\t") for line in run.stdout.splitlines()]
    return [(kind, way, float(median), float(worst)) for kind, way, median, worst in rows], run.returncode == 0


def table(rows):
    lines = ["| windows | call | median, ms | worst, ms |", "|---|---|--:|--:|"]
    lines += [f"| {kind} | {way} | {median:.3f} | {worst:.3f} |" for kind, way, median, worst in rows]
    return "\n".join(lines)


def page(rows, arguments):
    worst = max(row[3] for row in rows if row[1] == MARKED)
    median = max(row[2] for row in rows if row[1] == MARKED)
    return f"""# A tracker's call

Written by `bench/tracker_call.py --markdown docs/benchmarks/tracker_call.md`: windows of 20 targets in 6 scans with 4,000 to 6,000 arcs, {arguments.windows} of every
kind, {arguments.calls} calls each after one that is not counted; milliseconds of processor time on one processor ({shared.processor()}), of all calls of a kind. Every rank
is proven. What the kinds are: `bench/tracker_call_benchmark.cpp`. `next()` is that of `nda::Ranking`, which finds ten ranks at its second call.

The ten best, mark {MARK_MS} ms: at most {median:.1f} ms in the median of a kind, {worst:.1f} ms in the worst of all calls.

{table(rows)}
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--windows", type=int, default=20)
    parser.add_argument("--calls", type=int, default=10)
    parser.add_argument("--cpu", type=int, default=0)
    parser.add_argument("--markdown", type=pathlib.Path)
    arguments = parser.parse_args()
    rows, proven = measure(arguments.windows, arguments.calls, arguments.cpu)
    print(table(rows))
    if arguments.markdown:
        arguments.markdown.write_text(page(rows, arguments))
    return 0 if proven and all(row[2] < MARK_MS for row in rows if row[1] == MARKED) else 1


if __name__ == "__main__":
    sys.exit(main())
