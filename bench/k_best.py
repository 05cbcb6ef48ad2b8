#!/usr/bin/python3
"""What the k best solutions take beside the best one, on every public instance.

    bench/k_best.py [--time-limit S] [--most-arcs N] [--markdown FILE] [PATTERN...]

solves each file of ../shared/data/arcs of at most N arcs with build/release/nda, one thread, for k = 1, 10, 100 and 1000, three
times where that takes less than a second, and compares the medians of the solve times.  Files that are not proven at k = 1 within the
limit are left out; 10 and 100 ranks get the 5 and 20 times that they may take, where that is more.  Where a list is not proven, no
longer one is tried.  PATTERN selects files by a part of their path.  Exit code 1
where `nda check` finds a fault, or where the best solution of a longer list is not that of a shorter one.  docs/benchmarks/k_best.md is
written by

    bench/k_best.py --markdown docs/benchmarks/k_best.md
"""

import argparse
import collections
import gzip
import json
import math
import pathlib
import statistics
import subprocess
import sys
import tempfile

import shared

ARCS = shared.ROOT.parent / "shared/data/arcs"
NDA = shared.ROOT / "build/release/nda"
KS = (1, 10, 100, 1000)
TARGETS = {10: 5, 100: 20}
REPEATED = 1.0  # seconds

Run = collections.namedtuple("Run", "seconds proven listed")  # infinitely many where it was not tried
Row = collections.namedtuple("Row", "file arcs runs")  # by k


def num_arcs(path):
    """As the file's `p` line has it."""
    with gzip.open(path, "rt") as file:
        return next(int(line.split()[-1]) for line in file if line.startswith("p"))


def rank(path, k, limit, folder):
    """The solution, its file, and the median of the seconds."""
    output = pathlib.Path(folder) / f"{k}.json"
    seconds = []
    while len(seconds) < 3:
        subprocess.run([NDA, "solve", path, "--k", str(k), "--threads", "1", "--time-limit", str(limit), "-q", "-o", output],
                       check=False, stdout=subprocess.PIPE)
        solution = json.loads(output.read_text())
        seconds.append(solution["stats"]["solve_seconds"])
        if seconds[-1] > REPEATED:
            break
    return solution, output, statistics.median(seconds)


def judge(path, limit, folder, faults):
    """A row; None where the best solution is not proven."""
    name = path.name.removesuffix(".nda.gz")
    runs = {}
    best = None
    for k in KS:
        if any(run.proven < run.listed for run in runs.values()):
            runs[k] = Run(math.inf, 0, k)
            continue
        allowed = limit if k == 1 else max(limit, TARGETS.get(k, 0) * runs[1].seconds)
        solution, output, seconds = rank(path, k, allowed, folder)
        if k == 1 and not solution["proven"]:
            return None
        if subprocess.run([NDA, "check", path, output], check=False, stdout=subprocess.PIPE).returncode != 0:
            faults.append(f"{name}, k = {k}: refused by nda check")
        best = solution["cost"] if best is None else best
        if abs(solution["cost"] - best) > 1e-9 * max(1, abs(best)):
            faults.append(f"{name}, k = {k}: {solution['cost']} is not {best}")
        ranks = solution["solutions"]
        runs[k] = Run(seconds, sum(rank["proven"] for rank in ranks), len(ranks))
    return Row(name, solution["instance"]["arcs"], runs)


def ratio(row, k):
    return row.runs[k].seconds / row.runs[1].seconds


def summary(table):
    """One line for every k: medians over all files, with infinity for what was not tried."""
    lines = []
    for k in KS[1:]:
        ratios = [ratio(row, k) for row in table]
        proven = sum(row.runs[k].proven == row.runs[k].listed for row in table)
        target = f", aim {TARGETS[k]}" if k in TARGETS else ""
        lines.append(f"- {k} best: proven on {proven} of {len(table)} files; median {statistics.median(ratios):.1f} times the best alone{target}.")
    return "\n".join(lines)


def page(table, arguments):
    head = "| file | arcs | best, s | " + " | ".join(f"{k} best | of them proven" for k in KS[1:]) + " |\n|---" + "|--:" * (2 + 2 * len(KS[1:])) + "|\n"
    body = ""
    for row in table:
        cells = [row.file, f"{row.arcs}", f"{row.runs[1].seconds:.4f}"]
        for k in KS[1:]:
            run = row.runs[k]
            cells += [f"x {ratio(row, k):.1f}", f"{run.proven} of {run.listed}"] if run.seconds < math.inf else ["-", "-"]
        body += "| " + " | ".join(cells) + " |\n"
    chosen = "".join(f" {pattern}" for pattern in arguments.pattern)
    return f"""# The k best on every public instance

Written by `bench/k_best.py --markdown docs/benchmarks/k_best.md{chosen}`: files of at most {arguments.most_arcs} arcs whose best solution is proven in {arguments.time_limit:g} s, the limit for ranks, too,
unless 5 (10 best) or 20 (100 best) times what the best took is more; one thread, solve times without reading on {shared.processor()}, median of three where they are below a
second. `x`: times the best alone. How ranking works: [the k best](../k_best.md).

{summary(table)}

{head}{body}"""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pattern", nargs="*")
    parser.add_argument("--time-limit", type=float, default=10)
    parser.add_argument("--most-arcs", type=int, default=100000)
    parser.add_argument("--markdown", type=pathlib.Path)
    arguments = parser.parse_args()
    table, faults = [], []
    with tempfile.TemporaryDirectory() as folder:
        for path in sorted(ARCS.rglob("*.nda.gz")):
            if arguments.pattern and not any(pattern in str(path) for pattern in arguments.pattern):
                continue
            few = num_arcs(path) <= arguments.most_arcs
            row = judge(path, arguments.time_limit, folder, faults) if few else None
            if row is None:
                continue
            table.append(row)
            cells = [f"{run.seconds:9.4f} s {run.proven:5d}/{run.listed}" for run in row.runs.values()]
            print(f"{row.file:32} {row.arcs:8} " + "  ".join(cells), flush=True)
    print(summary(table))
    print("\n".join(faults))
    if arguments.markdown:
        arguments.markdown.write_text(page(table, arguments))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
