#!/usr/bin/python3
"""How far beyond its time limit does a solve go?

    bench/deadline.py [--limits MS,...] [--long-limit MS] [--repeats N] [--core N] [--csv FILE] [PATTERN...]

solves every file of data/, the larger ones of ../shared/data/arcs where they are, and generated problems of a million arcs with
build/release/nda on one core, under every limit, and prints overshoot = solve_seconds - limit: the least and the median of the
repeats for every file and limit, then the worst.  Other work on the machine lengthens single runs: a median far above the least tells
of that, a large least is the solver's own.  `allowed` is what include/nda/options.hpp promises for the size of the file.  The long
limit is tried on the generated problems and the hard ones alone.  PATTERN selects files by a part of their path.  Exit code 1 when a
least overshoot is above what is allowed, or `nda check` rejects an answer.
"""

import argparse
import csv
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
ARCS = ROOT.parent / "shared/data/arcs"
NDA = ROOT / "build/release/nda"
LARGE_BYTES = 100_000
GENERATED = {
    "planted-5d-1m.nda": ("planted", "--size", "20000", "--arcs", "1000000"),
    "planted-2d-1m.nda": ("planted", "--dimensions", "2", "--size", "5000", "--spread", "0", "--arcs", "1000000"),
    "planted-forbidden-1m.nda": ("planted", "--size", "20000", "--arcs", "1000000", "--singletons", "forbidden", "--miss-rate", "0"),
    "planted-parts-1m.nda": ("planted", "--size", "200000", "--spread", "2", "--arcs", "1000000"),
    "map3-100.nda": ("map3", "--size", "100"),
    "gadgets-100k.nda": ("gadgets", "--gadgets", "100000"),
}
HARD = ("hard", "noisy", "groups", "planted-5d", "planted-2d", "map3-100")
# The promise of include/nda/options.hpp.
ALLOWED_MS = 5.0
ALLOWED_SHARE = 0.01
ALLOWED_NS_PER_MEMBER = 100.0  # arc or index


def instances(folder, patterns):
    """Paths of all problems whose path has one of the patterns in it."""

    def wanted(path):
        return not patterns or any(pattern in str(path) for pattern in patterns)

    paths = sorted((ROOT / "data").glob("*.nda"))
    paths += [path for path in sorted(ARCS.glob("*/*.nda*")) if path.stat().st_size >= LARGE_BYTES]
    for name, arguments in GENERATED.items():
        path = folder / name
        if wanted(path):
            subprocess.run([NDA, "generate", *arguments, "-o", path], check=True, stderr=subprocess.DEVNULL)
            paths.append(path)
    return [path for path in paths if wanted(path)]


def solve(path, limit_ms, output):
    """(arcs, arcs and indices, solve_seconds, status) of one solve whose solution goes to a file."""
    command = [NDA, "solve", "--quiet", path, "--time-limit", str(limit_ms / 1000), "--output", output]
    subprocess.run(command, check=False, stdout=subprocess.DEVNULL)
    solution = json.loads(output.read_text())
    num_arcs = solution["instance"]["arcs"]
    num_members = num_arcs + sum(solution["instance"]["sizes"])
    return num_arcs, num_members, solution["stats"]["solve_seconds"], solution["status"]


def is_right(path, output):
    return subprocess.run([NDA, "check", path, output], check=False, stdout=subprocess.DEVNULL).returncode == 0


def allowed_ms(limit_ms, num_members):
    return max(ALLOWED_MS, ALLOWED_SHARE * limit_ms, 1e-6 * ALLOWED_NS_PER_MEMBER * num_members)


def measure(path, limit_ms, repeats, folder):
    """A row of the table; None where the problem is solved before the limit."""
    output = folder / "solution.json"
    overshoots = []
    for _ in range(repeats):
        num_arcs, num_members, seconds, status = solve(path, limit_ms, output)
        if seconds * 1000 < limit_ms and status != "time_limit":
            return None
        overshoots.append(1000 * seconds - limit_ms)
    return {
        "file": path.name,
        "arcs": num_arcs,
        "limit_ms": limit_ms,
        "least_ms": min(overshoots),
        "median_ms": statistics.median(overshoots),
        "allowed_ms": allowed_ms(limit_ms, num_members),
        "checked": is_right(path, output),
    }


def show(row):
    fault = "" if row["checked"] else "  CHECK FAILED"
    late = "  late" if row["least_ms"] > row["allowed_ms"] else ""
    print(
        f"{row['file']:36} {row['arcs']:9} {row['limit_ms']:8.0f} {row['least_ms']:9.2f} {row['median_ms']:9.2f} "
        f"{row['allowed_ms']:9.2f}{late}{fault}",
        flush=True,
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--limits", default="1,10,100,1000", help="milliseconds")
    parser.add_argument("--long-limit", type=float, default=5000.0, help="milliseconds, 0 for none")
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--core", type=int, default=-1, help="stay on this core")
    parser.add_argument("--csv", type=pathlib.Path)
    parser.add_argument("pattern", nargs="*")
    arguments = parser.parse_args()
    if arguments.core >= 0:
        os.sched_setaffinity(0, {arguments.core})
    header = f"{'file':36} {'arcs':>9} {'limit':>8} {'least':>9} {'median':>9} {'allowed':>9}  (ms)"
    print(header)
    table = []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for path in instances(folder, arguments.pattern):
            limits = [float(limit) for limit in arguments.limits.split(",")]
            if arguments.long_limit > 0 and any(part in path.name for part in HARD):
                limits.append(arguments.long_limit)
            for limit_ms in limits:
                row = measure(path, limit_ms, 2 if limit_ms > 2000 else arguments.repeats, folder)
                if row:
                    table.append(row)
                    show(row)
    table.sort(key=lambda row: row["median_ms"] - row["allowed_ms"], reverse=True)
    print("\nthe worst\n" + header)
    for row in table[:10]:
        show(row)
    if arguments.csv:
        with arguments.csv.open("w", newline="") as file:
            writer = csv.DictWriter(file, table[0].keys())
            writer.writeheader()
            writer.writerows(table)
    bad = sum(1 for row in table if row["least_ms"] > row["allowed_ms"] or not row["checked"])
    print(f"{len(table)} cases, {bad} beyond what is allowed")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
