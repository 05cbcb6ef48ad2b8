#!/usr/bin/python3
"""Times the ranking of two-dimensional assignments and writes docs/benchmarks/assign2d_k_best.md.

    bench/assign2d_k_best.py BUILD_DIR [--seconds S] [--limit S] [--no-write]

Needs a Release build with -DNDA_BUILD_BENCHMARKS=ON and Debian's python3-scipy.  Families: those of assign2d.py.  The rival, since
Debian has no k-best package, is Murty's algorithm as in the textbooks: every subproblem is solved anew, by scipy's
linear_sum_assignment on the rows and columns that are not fixed; outside options are a column for every row.  It stops after --limit
seconds.  Exit code 1 where costs differ.
"""

import argparse
import heapq
import itertools
import pathlib
import subprocess
import sys
import tempfile
import time

import numpy as np
import scipy
from scipy.optimize import linear_sum_assignment

import assign2d
from shared import ROOT, processor

KS = [1, 10, 100, 1000, 10000]
PROBLEMS = [("dense", 10), ("dense", 100), ("dense", 1000), ("integers", 100), ("sparse", 1000), ("tracking", 100), ("tracking", 1000)]
PAGE = ROOT / "docs/benchmarks/assign2d_k_best.md"
COLUMNS = ["family", "n", "k", "nda", "times the best alone", "us a rank", "peak memory", "textbook Murty", "Murty / nda"]
HEADER = "| " + " | ".join(COLUMNS) + " |\n|---" + "|--:" * (len(COLUMNS) - 1) + "|"


def full_matrix(matrix, outside):
    """With +inf for what is absent; one free column for every row where rows may stay outside."""
    n, m = matrix.shape
    full = np.full((n, m), np.inf)
    coordinates = matrix.tocoo()
    full[coordinates.row, coordinates.col] = coordinates.data
    if np.isinf(outside):
        return full
    alone = np.full((n, n), np.inf)
    np.fill_diagonal(alone, outside)
    return np.hstack([full, alone])


def solve(cost, fixed, forbidden):
    """Cost and columns of the best assignment with the first rows fixed and some columns forbidden to the next one."""
    rest = np.delete(cost[len(fixed):], fixed, axis=1)
    names = np.delete(np.arange(cost.shape[1]), fixed)
    rest[0, np.isin(names, list(forbidden))] = np.inf
    try:
        rows, columns = linear_sum_assignment(rest)
    except ValueError:
        return None
    total = cost[np.arange(len(fixed)), fixed].sum() + rest[rows, columns].sum()
    return total, fixed + names[columns].tolist()


def murty(cost):
    """The costs of all assignments, ascending; rows in their order, as Murty has it."""
    number = itertools.count()
    best = solve(cost, [], set())
    heap = [(best[0], next(number), best[1], 0, set())] if best else []
    while heap:
        total, _, columns, first, forbidden = heapq.heappop(heap)
        yield total
        for row in range(first, cost.shape[0]):
            excluded = (forbidden if row == first else set()) | {columns[row]}
            found = solve(cost, columns[:row], excluded)
            if found:
                heapq.heappush(heap, (found[0], next(number), found[1], row, excluded))


def time_murty(cost, limit_s):
    """k -> (cost, microseconds of the processor) for every k that was reached in time."""
    reached, ranks = {}, murty(cost)
    begin = time.process_time()
    for k in range(1, KS[-1] + 1):
        total = next(ranks, None)
        seconds = time.process_time() - begin
        if total is None or (seconds > limit_s and k > 1):
            break
        if k in KS:
            reached[k] = (total, 1e6 * seconds)
        if k > 1 and seconds / (k - 1) * 9 > limit_s and k in KS:
            break
    return reached


def time_ours(program, path, limit_s):
    lines = subprocess.run([program, path, str(limit_s), *map(str, KS)], check=True, stdout=subprocess.PIPE, text=True).stdout.splitlines()
    return float(lines[0]), [(int(count), float(cost), float(us), float(memory)) for count, cost, us, memory in map(str.split, lines[1:])]


def rows_of(family, n, arguments):
    matrix, outside = assign2d.FAMILIES[family](n, np.random.default_rng(n))
    with tempfile.NamedTemporaryFile(suffix=".bin") as file:
        assign2d.write_instance(file.name, matrix, outside)
        alone, ours = time_ours(arguments.build_dir / "bench/assign2d_k_best_benchmark", file.name, arguments.seconds)
    rival = time_murty(full_matrix(matrix, outside), arguments.limit)
    for k, (count, cost, us, memory) in zip(KS, ours):
        if k in rival and abs(rival[k][0] - cost) > 1e-9 * max(1, abs(cost)):
            sys.exit(f"{family} {n}, k = {k}: {cost}, textbook Murty {rival[k][0]}")
        cells = [family, str(n), str(count), assign2d.duration(us), f"{us / alone:.3g}", f"{us / count:.3g}", f"{memory / 1024:.0f} MB"]
        cells += [assign2d.duration(rival[k][1]), f"{rival[k][1] / us:.3g}"] if k in rival else ["-", "-"]
        yield "| " + " | ".join(cells) + " |"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build_dir", type=pathlib.Path)
    parser.add_argument("--seconds", type=float, default=0.5, help="per figure of ours")
    parser.add_argument("--limit", type=float, default=15, help="seconds for the rival on a problem")
    parser.add_argument("--no-write", action="store_true", help="print the table only")
    arguments = parser.parse_args()
    print(HEADER)
    rows = []
    for family, n in PROBLEMS:
        for row in rows_of(family, n, arguments):
            print(row, flush=True)
            rows.append(row)
    if not arguments.no_write:
        PAGE.write_text(
            "# The k best two-dimensional assignments, measured\n\n"
            f"Written by `bench/assign2d_k_best.py`; families and the rival are described there and in `bench/assign2d.py`.  {processor()}, one thread,\n"
            f"scipy {scipy.__version__}.  Medians of the time of the processor, from the problem to the k-th assignment: copy, first solve, ranking, every\n"
            "assignment written down.  `times the best alone`: a solver that keeps its memory.  `peak memory`: of the whole process, which holds the problem\n"
            f"twice.  A dash: the rival did not get there in {arguments.limit:g} s.\n\n"
            "Miller, Stone & Cox (1997) give 0.6 s for the 100 best of 100 x 100 (row `dense`, 100, 100), on a machine of their time.\n\n"
            + "\n".join([HEADER] + rows) + "\n")


if __name__ == "__main__":
    main()
