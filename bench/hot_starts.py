#!/usr/bin/python3
"""What a hot start saves on windows moved by one scan, and which part of it saves what.

    bench/hot_starts.py [--scenarios N] [--moves N] [--first-seed N] [--cpu N] [--markdown FILE]

builds bench/hot_starts_benchmark.cpp, which says what is solved, runs it on one processor and prints its figures as a table.
Exit code 1 where a hot start changed a cost.  docs/benchmarks/hot_starts.md is written by

    bench/hot_starts.py --markdown docs/benchmarks/hot_starts.md
"""

import argparse
import pathlib
import subprocess
import sys

import shared

HEAD = """| windows | kind | start | arcs | same as before | cold, us | hot, us | saved | evaluations | nodes | open arcs |
|---|---|---|--:|--:|--:|--:|--:|--:|--:|--:|"""


def measure(scenarios, moves, first_seed, cpu):
    """Rows of three texts and ten figures; whether all answers were right."""
    program = shared.build("hot_starts_benchmark") / "hot_starts_benchmark"
    run = subprocess.run(["taskset", "-c", str(cpu), program, str(scenarios), str(moves), str(first_seed)], stdout=subprocess.PIPE, text=True)
    rows = [line.split("\t") for line in run.stdout.splitlines()]
    return [row[:3] + [float(figure) for figure in row[3:]] for row in rows], run.returncode == 0


def table(rows):
    lines = [HEAD]
    for windows, kind, way, arcs, same, cold, hot, ratio, cold_evaluations, evaluations, cold_nodes, nodes, still_open in rows:
        lines.append(f"| {windows} | {kind} | {way} | {arcs:.0f} | {100 * same:.0f} % | {cold:.0f} | {hot:.0f} | {100 - 100 * ratio:.0f} % "
                     f"| {cold_evaluations:.0f} to {evaluations:.0f} | {cold_nodes:.0f} to {nodes:.0f} | {still_open:.0f} |")
    return "\n".join(lines)


def page(rows, arguments):
    return f"""# Hot starts

Written by `bench/hot_starts.py --markdown docs/benchmarks/hot_starts.md`: {arguments.scenarios} scenarios of every kind (seeds from {arguments.first_seed} on), {arguments.moves} moves by one scan each,
solved cold and from the last window's solution on one processor ({shared.processor()}), the quicker of three runs each, in turn. All figures are medians over
the {arguments.scenarios * arguments.moves} windows of a kind; what is saved is the median of the windows' own shares. Times are all of `solve()`, the use of the warm start included.
"All of these": the same over the windows of all kinds. "Same as before": arcs that the last window had at the same cost. Evaluations and nodes: cold to hot. "Open arcs": what the hot start left to the rest of the pipeline.
Every hot answer cost what the cold one cost and was proven. What the kinds are: `bench/hot_starts_benchmark.cpp`; what to make of it: [hot starts](../hot_starts.md).

{table(rows)}
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scenarios", type=int, default=10)
    parser.add_argument("--moves", type=int, default=10)
    parser.add_argument("--first-seed", type=int, default=101, help="of the scenarios of a kind; those from 1 on served for tuning")
    parser.add_argument("--cpu", type=int, default=0)
    parser.add_argument("--markdown", type=pathlib.Path)
    arguments = parser.parse_args()
    rows, right = measure(arguments.scenarios, arguments.moves, arguments.first_seed, arguments.cpu)
    print(table(rows))
    if arguments.markdown:
        arguments.markdown.write_text(page(rows, arguments))
    return 0 if right else 1


if __name__ == "__main__":
    sys.exit(main())
