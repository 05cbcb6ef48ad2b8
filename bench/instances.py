#!/usr/bin/python3
"""Every public instance of ../shared/data/arcs, solved and judged.

    bench/instances.py [--time-limit S] [--csv FILE] [PATTERN...]

solves each file on one core with build/release/nda, has `nda check` verify the solution, and compares cost and bound with the listed
reference values: cost within 1 % (tracking, real, assignment) or within 5 % or 3 units (the others), bound never below the listed
value of the linear relaxation by more than 0.1 %, proven optimal wherever that value equals the optimum.  PATTERN selects files
by a part of their path.  Exit code 1 when a file misses a mark.
"""

import argparse
import csv
import gzip
import json
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
ARCS = ROOT.parent / "shared/data/arcs"
NDA = ROOT / "build/release/nda"
ASSIGNMENT_OPTIMA = {"assign100": 305.0, "assign200": 475.0, "assign300": 626.0, "assign400": 804.0}


def rows(path):
    """Rows of a CSV file whose comment lines start with #."""
    lines = [line for line in path.read_text().splitlines() if line and not line.startswith("#")]
    return list(csv.DictReader(lines))


def constant_of(path):
    """What variables without rows add to a set packing instance."""
    with gzip.open(path, "rt") as file:
        for line in file:
            found = re.search(r"constant from rowless variables: (-?[\d.]+)", line)
            if found:
                return float(found.group(1))
            if not line.startswith("c"):
                return 0.0
    return 0.0


def references():
    """file name -> (best value, value of the linear relaxation or None)."""
    known = {}
    for row in rows(ARCS / "real/INDEX.csv"):
        known[row["file"]] = (float(row["optimum"]), float(row["lp_value"]))
    for row in rows(ARCS / "simulated/OPTIMA.csv"):
        known[row["file"]] = (float(row["best_value"]), float(row["lp_value"]))
    for row in rows(ARCS / "balas_saltzman_3ap/OPTIMA.csv"):
        known[row["instance"] + ".nda.gz"] = (float(row["optimum"]), None)
    for row in rows(ARCS / "setpacking/OPTIMA.csv"):
        path = ARCS / "setpacking" / row["instance"].replace(".dat", ".nda.gz")
        if path.exists():
            known[path.name] = (-float(row["value"]) - constant_of(path), None)
    for name, value in ASSIGNMENT_OPTIMA.items():
        known[name + ".nda.gz"] = (value, value)
    known["kim4.nda"] = (37.0, None)
    return known


def is_close_family(path):
    """Families whose cost must come within 1 %."""
    return path.parent.name in ("real", "lap_orlib", "kim2010_4x4x4") or path.name.startswith("tracking-")


def run(path, time_limit, folder):
    output = folder / "solution.json"
    subprocess.run(
        [NDA, "solve", "--quiet", path, "--time-limit", str(time_limit), "--output", output],
        stdout=subprocess.DEVNULL,
        check=False,
    )
    checked = subprocess.run([NDA, "check", path, output], stdout=subprocess.DEVNULL, check=False).returncode == 0
    return json.loads(output.read_text()), checked


def faults(path, solution, checked, best, relaxation):
    """What this result misses, as short words."""
    found = []
    if not checked:
        found.append("check")
    if not solution["solutions"]:
        return found + ["no solution"]
    excess = solution["cost"] - best
    if is_close_family(path):
        if excess > 0.01 * abs(best):
            found.append("cost")
    elif excess > 0.05 * abs(best) and excess > 3:
        found.append("cost")
    if relaxation is not None:
        if solution["lower_bound"] < relaxation - 1e-3 * abs(relaxation):
            found.append("bound")
        if abs(relaxation - best) <= 1e-6 * abs(best) and not solution["proven"]:
            found.append("not proven")
    if solution["proven"] and excess > 1e-6 * max(1.0, abs(best)):
        found.append("FALSE PROOF")
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--time-limit", type=float, default=60.0)
    parser.add_argument("--csv", type=pathlib.Path)
    parser.add_argument("pattern", nargs="*")
    arguments = parser.parse_args()
    known = references()
    table = []
    print(f"{'file':38} {'best known':>14} {'cost':>14} {'lower bound':>14} {'gap %':>8} {'s':>7} proven  misses")
    with tempfile.TemporaryDirectory() as folder:
        for path in sorted(ARCS.glob("*/*.nda*")):
            if arguments.pattern and not any(p in str(path) for p in arguments.pattern):
                continue
            best, relaxation = known[path.name]
            solution, checked = run(path, arguments.time_limit, pathlib.Path(folder))
            missed = faults(path, solution, checked, best, relaxation)
            cost = solution["cost"] if isinstance(solution["cost"], (int, float)) else float("inf")
            bound = solution["lower_bound"]
            gap = 100 * (cost - bound) / max(1e-9, abs(cost))
            seconds = solution["stats"]["solve_seconds"]
            print(
                f"{path.name:38} {best:14.4f} {cost:14.4f} {bound:14.4f} {gap:8.3f} {seconds:7.2f} "
                f"{'yes' if solution['proven'] else 'no':6}  {', '.join(missed)}",
                flush=True,
            )
            table.append((path.name, best, cost, bound, gap, seconds, solution["proven"], " ".join(missed)))
    if arguments.csv:
        with arguments.csv.open("w", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(("file", "best", "cost", "lower_bound", "gap_percent", "seconds", "proven", "misses"))
            writer.writerows(table)
    bad = sum(1 for row in table if row[-1])
    print(f"{len(table)} files, {sum(1 for row in table if row[6])} proven, {bad} miss a mark")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
