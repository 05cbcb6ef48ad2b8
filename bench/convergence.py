#!/usr/bin/python3
"""A picture of one solve: how cost and lower bound close in on each other.

    bench/convergence.py [FILE [SECONDS [PICTURE]]]

Without FILE a problem of 30 targets in crossing groups, eight scans, is generated; the picture goes to
docs/images/convergence.png.  Needs build/release/nda and Debian's python3-matplotlib.
"""

import pathlib
import subprocess
import sys
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

ROOT = pathlib.Path(__file__).resolve().parent.parent
NDA = ROOT / "build/release/nda"


def solver_log(path, seconds):
    """Rows (time, cost, bound) of the log of a solve."""
    result = subprocess.run(
        [NDA, "solve", path, "--time-limit", str(seconds), "--log-interval", "0"],
        capture_output=True,
        text=True,
        check=False,
    )
    rows = [line.split()[:3] for line in result.stderr.splitlines()[1:]]
    return [tuple(map(float, row)) for row in rows]


def draw(rows, path):
    rows = [row for row in rows if row[2] > float("-inf")]
    best = rows[-1][1]
    times = [max(row[0], 1e-4) for row in rows]

    def distance(values):
        return [max(1e-4, 100 * abs(value - best) / abs(best)) for value in values]

    figure, axes = plt.subplots(figsize=(7, 3.4))
    axes.step(times, distance(row[1] for row in rows), where="post", label="best assignment")
    axes.step(times, distance(row[2] for row in rows), where="post", label="lower bound")
    axes.set(yscale="log", xlabel="seconds", ylabel="distance from the last cost, %")
    axes.legend()
    figure.tight_layout()
    figure.savefig(path, dpi=110)


def main():
    picture = pathlib.Path(sys.argv[3]) if len(sys.argv) > 3 else ROOT / "docs/images/convergence.png"
    seconds = float(sys.argv[2]) if len(sys.argv) > 2 else 10.0
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(folder) / "hard8.nda"
        if len(sys.argv) <= 1:
            subprocess.run([NDA, "generate", "groups", "--preset", "hard8", "--seed", "1", "-o", path], check=True)
        picture.parent.mkdir(parents=True, exist_ok=True)
        draw(solver_log(path, seconds), picture)
    print(picture)


if __name__ == "__main__":
    main()
