#!/usr/bin/python3
"""Every public instance of ../shared/data/arcs, solved and judged.

    bench/instances.py [--time-limit S] [--seed N] [--csv FILE] [--markdown FILE] [PATTERN...]

solves each file on one core with build/release/nda, has `nda check` verify the solution and the proof of its bound, and holds them against the marks:

- proven: every file but poore51-* and set packing of more than 200 variables; ucy-hard-w000-n5 within 60 s, tracking-large-s1 within 30 s, ais60-w000-n6 within 5 s;
- costs: no more than the best known, which for poore51-* is what CBC found in 60 s; that within 10 s;
- bounds: above no listed cost, and at least the listed value of the linear relaxation, to 0.1 %; tracking-large-s1 within 0.25 % of its cost in 1 s, by --gap 0.0025;
- checks: every proof of an optimum shows it, within twice the time of the solve.  Neither time has starting a process or reading in it; what takes longer is checked
  up to three times, the least time counts.

The marks within 1 and 10 s take runs of their own, where S is more.  PATTERN selects files by a part of their path.  Exit code 1 when a file misses a mark.
docs/benchmarks/instances.md is written by

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

ROOT = pathlib.Path(__file__).resolve().parent.parent
ARCS = ROOT.parent / "shared/data/arcs"
NDA = ROOT / "build/release/nda"
ASSIGNMENT_OPTIMA = {"assign100": 305.0, "assign200": 475.0, "assign300": 626.0, "assign400": 804.0}

MOST_PROVEN_VARIABLES = 200
MOST_SECONDS = {"ucy-hard-w000-n5": 60, "tracking-large-s1": 30, "ais60-w000-n6": 5}
BEST_COST_IN_S = 10  # poore51-*
CERTIFIED_IN_S, CERTIFIED_GAP = 1, 0.0025  # tracking-large-s1
CHECK_TO_SOLVE = 2
CHECKS = 3

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


def name_of(path):
    return path.name.split(".nda")[0]


def tolerance(best):
    """Listed costs are rounded."""
    return 1e-6 * max(1.0, abs(best))


def may_stay_open(path):
    packing = re.match(r"pb_(\d+)rnd", path.name)
    return path.name.startswith("poore51-") or (packing and int(packing.group(1)) > MOST_PROVEN_VARIABLES)


def solve(path, limit, seed, folder, *options):
    output = folder / "solution.json"
    command = [NDA, "solve", "--quiet", path, "--threads", "1", "--time-limit", str(limit), "--seed", str(seed), "--output", output, *options]
    subprocess.run(command, stdout=subprocess.DEVNULL, check=False)
    return json.loads(output.read_text())


def check_once(path, solution, proof):
    """Is it right, and the seconds that checking takes."""
    check = subprocess.run([NDA, "check", path, solution, "--proof", proof], capture_output=True, text=True, check=False)
    found = re.search(r"^time +([\d.]+) s checking", check.stdout, re.MULTILINE)
    return check.returncode == 0, float(found.group(1)) if found else float("inf")


def run(path, limit, seed, folder):
    proof = folder / "proof.gz"
    solution = solve(path, limit, seed, folder, "--proof", proof)
    if not proof.exists():
        return solution, Checked(False, float("inf"), 0)
    passed, seconds = check_once(path, folder / "solution.json", proof)
    for _ in range(CHECKS - 1):
        if passed and seconds > CHECK_TO_SOLVE * solution["stats"]["solve_seconds"]:
            seconds = min(seconds, check_once(path, folder / "solution.json", proof)[1])
    return solution, Checked(passed, seconds, proof.stat().st_size)


def early_faults(path, best, limit, seed, folder):
    """What runs of 1 and 10 s miss."""
    if name_of(path) == "tracking-large-s1" and limit > CERTIFIED_IN_S:
        early = solve(path, CERTIFIED_IN_S, seed, folder, "--gap", str(CERTIFIED_GAP))
        if early["cost"] - early["lower_bound"] > CERTIFIED_GAP * abs(early["cost"]):
            return [f"gap in {CERTIFIED_IN_S} s"]
    if path.name.startswith("poore51-") and limit > BEST_COST_IN_S:
        if solve(path, BEST_COST_IN_S, seed, folder)["cost"] > best + tolerance(best):
            return [f"cost in {BEST_COST_IN_S} s"]
    return []


def faults(path, solution, checked, best, relaxation):
    """What this result misses, as short words."""
    found = [] if checked.passed else ["check"]
    if not solution["solutions"]:
        return found + ["no solution"]
    seconds, is_dearer = solution["stats"]["solve_seconds"], solution["cost"] > best + tolerance(best)
    if solution["proven"]:
        if is_dearer:
            found.append("FALSE PROOF")
        if checked.seconds > CHECK_TO_SOLVE * seconds:
            found.append("slow check")
    elif not may_stay_open(path):
        found.append("not proven")
    if seconds > MOST_SECONDS.get(name_of(path), float("inf")):
        found.append("slow")
    if is_dearer:
        found.append("cost")
    if solution["lower_bound"] > best + tolerance(best):
        found.append("FALSE BOUND")
    if relaxation is not None and solution["lower_bound"] < relaxation - 1e-3 * abs(relaxation):
        found.append("bound")
    return found


PAGE = """# Every public instance

Written by `bench/instances.py --time-limit {limit:g} --markdown FILE`: {limit:g} s each on one core, no reading, answers and proofs verified by
`nda check`, whose time has no reading in it either; the times are those of the machine it ran on.  {count} files, {proven} proven optimal, {bad} miss a mark.
The best known values come with the instances.  The marks, as they stand at the top of the script:

{marks}

| family | files | proven | median s | slowest s | slowest check, s | check / solve, at most | largest proof, kB | largest gap, % | largest excess over the best known, % |
|---|---|---|---|---|---|---|---|---|---|
{families}

{tables}
"""


def family_row(family, rows):
    seconds = [row.seconds for row in rows]
    check_to_solve = max((row.check_seconds / row.seconds for row in rows if row.proven), default=0.0)
    excess = max(100 * (row.cost - row.best) / max(1e-9, abs(row.best)) for row in rows)
    return (
        f"| {family} | {len(rows)} | {sum(row.proven for row in rows)} | {statistics.median(seconds):.3f} | {max(seconds):.2f} "
        f"| {max(row.check_seconds for row in rows):.2f} | {check_to_solve:.2f} | {max(row.proof_bytes for row in rows) / 1000:.0f} "
        f"| {max(row.gap_percent for row in rows):.3f} | {max(0.0, excess):.3f} |"
    )


def family_table(family, rows):
    lines = [f"## {family}\n", "| file | best known | cost | lower bound | gap, % | s | proven | check, s | proof, kB | misses |", "|---" * 10 + "|"]
    lines += [
        f"| {row.file} | {row.best:.4f} | {row.cost:.4f} | {row.lower_bound:.4f} | {row.gap_percent:.3f} | {row.seconds:.4f} "
        f"| {'yes' if row.proven else 'no'} | {row.check_seconds:.4f} | {row.proof_bytes / 1000:.1f} | {row.misses} |"
        for row in rows
    ]
    return "\n".join(lines)


def page(table, limit):
    families = {family: list(rows) for family, rows in itertools.groupby(table, lambda row: row.family)}
    return PAGE.format(
        limit=limit,
        marks=__doc__[__doc__.index("- proven") : __doc__.index("\n\nThe marks within")],
        count=len(table),
        proven=sum(row.proven for row in table),
        bad=sum(bool(row.misses) for row in table),
        families="\n".join(family_row(*item) for item in families.items()),
        tables="\n\n".join(family_table(*item) for item in families.items()),
    )


def judge(path, known, limit, seed, folder):
    best, relaxation = known[path.name]
    solution, checked = run(path, limit, seed, folder)
    misses = faults(path, solution, checked, best, relaxation) + early_faults(path, best, limit, seed, folder)
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
        ", ".join(misses),
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
    table = []
    print(f"{'file':38} {'best known':>14} {'cost':>14} {'lower bound':>14} {'gap %':>8} {'s':>7} proven  misses")
    with tempfile.TemporaryDirectory() as folder:
        for path in sorted(ARCS.glob("*/*.nda*")):
            if arguments.pattern and not any(p in str(path) for p in arguments.pattern):
                continue
            table.append(judge(path, known, arguments.time_limit, arguments.seed, pathlib.Path(folder)))
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
