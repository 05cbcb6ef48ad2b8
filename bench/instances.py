#!/usr/bin/python3
"""Every public instance of ../shared/data/arcs, solved and judged.

    bench/instances.py [--time-limit S] [--seed N] [--csv FILE] [--markdown FILE] [PATTERN...]

solves each file on one core with build/release/nda, has `nda check` verify the solution and the proof of its bound, and compares cost and bound with the listed
reference values: cost within 1 % (tracking, real, assignment), no more than the best known (set packing) or within 5 % or 3 units (the others), bound never below the listed
value of the linear relaxation by more than 0.1 %, proven optimal wherever that value equals the optimum.  PATTERN selects files
by a part of their path.  Exit code 1 when a file misses a mark.  docs/benchmarks/instances.md is written by

    bench/instances.py --time-limit 60 --markdown docs/benchmarks/instances.md
"""

import argparse
import collections
import csv
import gzip
import itertools
import json
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
ARCS = ROOT.parent / "shared/data/arcs"
NDA = ROOT / "build/release/nda"
ASSIGNMENT_OPTIMA = {"assign100": 305.0, "assign200": 475.0, "assign300": 626.0, "assign400": 804.0}

Row = collections.namedtuple("Row", "family file best cost lower_bound gap_percent seconds proven check_seconds proof_bytes misses")

Checked = collections.namedtuple("Checked", "passed seconds proof_bytes")


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


def run(path, limits, folder):
    output, proof = folder / "solution.json", folder / "proof.gz"
    subprocess.run(
        [NDA, "solve", "--quiet", path, *limits, "--output", output, "--proof", proof],
        stdout=subprocess.DEVNULL,
        check=False,
    )
    begin = time.perf_counter()
    check = subprocess.run([NDA, "check", path, output, "--proof", proof], stdout=subprocess.DEVNULL, check=False)
    checked = Checked(check.returncode == 0, time.perf_counter() - begin, proof.stat().st_size)
    return json.loads(output.read_text()), checked


def faults(path, solution, checked, best, relaxation):
    """What this result misses, as short words."""
    found = []
    if not checked.passed:
        found.append("check")
    if not solution["solutions"]:
        return found + ["no solution"]
    excess = solution["cost"] - best
    if is_close_family(path):
        if excess > 0.01 * abs(best):
            found.append("cost")
    elif path.parent.name == "setpacking":
        if excess > 1e-6:
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


PAGE = """# Every public instance

Written by `bench/instances.py --time-limit {limit:g} --markdown FILE`: {limit:g} s each on one core, no reading, answers and proofs verified by
`nda check`; the times are those of the machine it ran on.  {count} files, {proven} proven optimal, {bad} miss a mark (the marks
stand at the top of the script; the best known values come with the instances).

| family | files | proven | median s | slowest s | slowest check, s | largest proof, kB | largest gap, % | largest excess over the best known, % |
|---|---|---|---|---|---|---|---|---|
{families}

{tables}
"""


def family_row(family, rows):
    seconds = [row.seconds for row in rows]
    excess = max(100 * (row.cost - row.best) / max(1e-9, abs(row.best)) for row in rows)
    return (
        f"| {family} | {len(rows)} | {sum(row.proven for row in rows)} | {statistics.median(seconds):.3f} | {max(seconds):.2f} "
        f"| {max(row.check_seconds for row in rows):.2f} | {max(row.proof_bytes for row in rows) / 1000:.0f} "
        f"| {max(row.gap_percent for row in rows):.3f} | {max(0.0, excess):.3f} |"
    )


def family_table(family, rows):
    lines = [f"## {family}\n", "| file | best known | cost | lower bound | gap, % | s | proven | check, s | proof, kB | misses |", "|---" * 10 + "|"]
    lines += [
        f"| {row.file} | {row.best:.4f} | {row.cost:.4f} | {row.lower_bound:.4f} | {row.gap_percent:.3f} | {row.seconds:.3f} "
        f"| {'yes' if row.proven else 'no'} | {row.check_seconds:.3f} | {row.proof_bytes / 1000:.1f} | {row.misses} |"
        for row in rows
    ]
    return "\n".join(lines)


def page(table, limit):
    families = {family: list(rows) for family, rows in itertools.groupby(table, lambda row: row.family)}
    return PAGE.format(
        limit=limit,
        count=len(table),
        proven=sum(row.proven for row in table),
        bad=sum(bool(row.misses) for row in table),
        families="\n".join(family_row(*item) for item in families.items()),
        tables="\n\n".join(family_table(*item) for item in families.items()),
    )


def judge(path, known, limits, folder):
    best, relaxation = known[path.name]
    solution, checked = run(path, limits, folder)
    cost = solution["cost"] if isinstance(solution["cost"], (int, float)) else float("inf")
    bound = solution["lower_bound"]
    return Row(
        path.parent.name,
        path.name,
        best,
        cost,
        bound,
        100 * (cost - bound) / max(1e-9, abs(cost)),
        solution["stats"]["solve_seconds"],
        solution["proven"],
        checked.seconds,
        checked.proof_bytes,
        " ".join(faults(path, solution, checked, best, relaxation)),
    )


def print_row(row):
    print(
        f"{row.file:38} {row.best:14.4f} {row.cost:14.4f} {row.lower_bound:14.4f} {row.gap_percent:8.3f} {row.seconds:7.2f} "
        f"{'yes' if row.proven else 'no':6}  {row.misses}",
        flush=True,
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--time-limit", type=float, default=60.0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--csv", type=pathlib.Path)
    parser.add_argument("--markdown", type=pathlib.Path)
    parser.add_argument("pattern", nargs="*")
    arguments = parser.parse_args()
    known = references()
    limits = ["--time-limit", str(arguments.time_limit), "--seed", str(arguments.seed)]
    table = []
    print(f"{'file':38} {'best known':>14} {'cost':>14} {'lower bound':>14} {'gap %':>8} {'s':>7} proven  misses")
    with tempfile.TemporaryDirectory() as folder:
        for path in sorted(ARCS.glob("*/*.nda*")):
            if arguments.pattern and not any(p in str(path) for p in arguments.pattern):
                continue
            table.append(judge(path, known, limits, pathlib.Path(folder)))
            print_row(table[-1])
    if arguments.csv:
        with arguments.csv.open("w", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(Row._fields)
            writer.writerows(table)
    if arguments.markdown:
        arguments.markdown.write_text(page(table, arguments.time_limit))
    bad = sum(bool(row.misses) for row in table)
    print(f"{len(table)} files, {sum(row.proven for row in table)} proven, {bad} miss a mark")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
