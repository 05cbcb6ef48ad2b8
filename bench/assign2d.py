#!/usr/bin/python3
"""Compares the two-dimensional solvers with scipy and writes docs/benchmarks/assign2d.md.

    bench/assign2d.py BUILD_DIR [--sizes 10 50 ...] [--no-write]

Needs a Release build with -DNDA_BUILD_BENCHMARKS=ON and Debian's python3-scipy.  Families:
dense     n x n, costs uniform in [0, 1), all must be assigned; rival linear_sum_assignment
integers  the same with integer costs 1..1000 (many ties)
sparse    n x n, 10 pairs a row at random and one perfect assignment, costs uniform in (0, 1),
          all must be assigned; rival min_weight_full_bipartite_matching
tracking  n rows and n columns at random in the plane, pairs within a gate (5 a row on average), cost
          between -10 and 0 by distance, outside options 0; the rival gets one free column per row
"""

import argparse
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np
import scipy
from scipy.optimize import linear_sum_assignment
from scipy.sparse import csr_matrix, hstack, identity
from scipy.sparse.csgraph import min_weight_full_bipartite_matching
from scipy.spatial import cKDTree

from shared import processor

SIZES = [10, 50, 100, 200, 500, 1000, 2000, 5000]
ROOT = pathlib.Path(__file__).resolve().parent.parent
METHODS = ["shortest-path", "auction", "network-simplex"]
LARGE_SIZES = {"sparse": [20000, 50000]}
LIMIT_S = 60


def dense(n, rng, integer=False):
    cost = rng.integers(1, 1001, (n, n)).astype(float) if integer else rng.random((n, n))
    return csr_matrix(cost + (0 if integer else 1e-12)), np.inf


def sparse(n, rng):
    per_row = min(10, n)
    rows = np.concatenate([np.repeat(np.arange(n), per_row), np.arange(n)])
    columns = np.concatenate([rng.integers(0, n, n * per_row), rng.permutation(n)])
    pairs = np.unique(rows * n + columns)
    matrix = csr_matrix((1 - rng.random(len(pairs)), (pairs // n, pairs % n)), shape=(n, n))
    return matrix, np.inf


def tracking(n, rng):
    gate = np.sqrt(5 / (np.pi * n))
    tracks, detections = rng.random((n, 2)), rng.random((n, 2))
    near = cKDTree(tracks).sparse_distance_matrix(cKDTree(detections), gate).tocsr()
    near.data = 10 * (near.data / gate) ** 2 - 10
    near.sort_indices()
    return near, 0.0


FAMILIES = {
    "dense": dense,
    "integers": lambda n, rng: dense(n, rng, True),
    "sparse": sparse,
    "tracking": tracking,
}


def scipy_cost(family, matrix, prepared):
    if family in ("dense", "integers"):
        rows, columns = linear_sum_assignment(prepared)
        return prepared[rows, columns].sum()
    rows, columns = min_weight_full_bipartite_matching(prepared)
    return prepared[rows, columns].sum() - (11 * matrix.shape[0] if family == "tracking" else 0)


def prepare(family, matrix):
    """What scipy is given; not timed.  scipy reads zeros as absent, hence the shift by 11."""
    if family in ("dense", "integers"):
        return matrix.toarray()
    if family == "sparse":
        return matrix
    n = matrix.shape[0]
    shifted = matrix.copy()
    shifted.data = shifted.data + 11
    return hstack([shifted, 11 * identity(n)], format="csr")


def time_scipy(family, matrix, limit_s):
    prepared = prepare(family, matrix)
    times = []
    while not times or (sum(times) < limit_s and len(times) < 101):
        processor, wall = time.process_time(), time.perf_counter()
        cost = scipy_cost(family, matrix, prepared)
        wall = time.perf_counter() - wall
        times.append(min(wall, time.process_time() - processor))
    return cost, 1e6 * statistics.median(times)


def write_instance(path, matrix, outside):
    n, m = matrix.shape
    with open(path, "wb") as out:
        np.array([n, m, matrix.nnz], np.uint64).tofile(out)
        matrix.indptr.astype(np.uint32).tofile(out)
        matrix.indices.astype(np.uint32).tofile(out)
        matrix.data.astype(np.float64).tofile(out)
        np.full(n + m, outside, np.float64).tofile(out)


def time_ours(program, path, method, limit_s):
    """Cost and the figures that were ready within LIMIT_S."""
    command = [program, path, method, str(limit_s)]
    try:
        output = subprocess.run(command, check=True, stdout=subprocess.PIPE, timeout=LIMIT_S).stdout
    except subprocess.TimeoutExpired as expired:
        output = expired.stdout or b""
    return [float(figure) for figure in output.split()]


def duration(us):
    return f"{us:.3g} us" if us < 1e3 else f"{us / 1e3:.3g} ms" if us < 1e6 else f"{us / 1e6:.3g} s"


def figure_cells(figures):
    """Cold, warm few, warm all; those that were not ready in time are dashes."""
    return [duration(figure) for figure in figures[1:]] + ["-"] * (4 - max(1, len(figures)))


def table_row(family, n, matrix, scipy_us, ours):
    best = ours["shortest-path"]
    ratio = f"{scipy_us / best[1]:.3g}" if len(best) > 1 else "-"
    cells = [family, str(n), str(matrix.nnz), duration(scipy_us), ratio]
    for method in METHODS:
        cells += figure_cells(ours[method])
    return "| " + " | ".join(cells) + " |"


COLUMNS = ["family", "n", "pairs", "scipy", "scipy / shortest path, cold"]
COLUMNS += [
    f"{method.replace('-', ' ')}: cold" if kind == "cold" else kind
    for method in METHODS
    for kind in ("cold", "warm, few", "warm, all")
]
HEADER = "| " + " | ".join(COLUMNS) + " |\n" + "|---" * len(COLUMNS) + "|"


def measure(program, families, sizes, limit_s):
    for family in families:
        for n in sizes or SIZES + LARGE_SIZES.get(family, []):
            matrix, outside = FAMILIES[family](n, np.random.default_rng(n))
            with tempfile.NamedTemporaryFile(suffix=".bin") as file:
                write_instance(file.name, matrix, outside)
                ours = {method: time_ours(program, file.name, method, limit_s) for method in METHODS}
            cost, scipy_us = time_scipy(family, matrix, limit_s)
            for method in METHODS:
                if ours[method] and abs(ours[method][0] - cost) > 1e-8 * max(1, abs(cost)):
                    sys.exit(f"{family} {n}: {method} finds {ours[method][0]}, scipy {cost}")
            row = table_row(family, n, matrix, scipy_us, ours)
            print(row, flush=True)
            yield row


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build_dir", type=pathlib.Path)
    parser.add_argument("--sizes", type=int, nargs="+")
    parser.add_argument("--families", nargs="+", default=list(FAMILIES), choices=list(FAMILIES))
    parser.add_argument("--seconds", type=float, default=0.3, help="per figure")
    parser.add_argument("--no-write", action="store_true", help="print the table only")
    arguments = parser.parse_args()
    print(HEADER)
    program = arguments.build_dir / "bench" / "assign2d_benchmark"
    rows = list(measure(program, arguments.families, arguments.sizes, arguments.seconds))
    if not arguments.no_write:
        page = ROOT / "docs" / "benchmarks" / "assign2d.md"
        page.parent.mkdir(parents=True, exist_ok=True)
        page.write_text(
            "# Two-dimensional assignment, measured\n\n"
            f"Written by `bench/assign2d.py`; families and changes are described there.  {processor()}, "
            f"one thread, scipy {scipy.__version__}.\n"
            "Medians of the time of the processor.  Cold: from scratch with memory reused.  Warm, few: 1 % of the costs moved by up to "
            "10 % of their range;\nwarm, all: every cost moved by up to 0.1 %.  "
            f"A solver gets {LIMIT_S} s for its three figures on a problem; a dash is a figure that took longer.\n\n"
            + "\n".join([HEADER] + rows) + "\n")


if __name__ == "__main__":
    main()
