#!/usr/bin/python3
"""What every reduction removes, over all families, and what that saves; writes docs/benchmarks/reductions.md.

    bench/reductions.py BUILD_DIR [--limit S] [--runs N] [--no-write] [PATTERN...]

Needs a Release build with -DNDA_BUILD_BENCHMARKS=ON.  Files are all those of ../shared/data/arcs, if they are there, and one of every
generated family at its default parameters; PATTERN selects files by a part of their name.  The two tables of what is removed come from
bench/reductions_benchmark, to which S goes; what a solve counts and times, the least of N runs in which the settings take turns, are of files
solved within a second.
"""

import argparse
import json
import math
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
ARCS = ROOT.parent / "shared/data/arcs"
FAMILIES = ["bounded", "gadgets", "groups", "map3", "merged", "planted", "poore-5.1", "poore-5.3", "six-scan", "tracking"]
SETTINGS = ["none", "quick", "all"]
QUICK_S = 1


def shared_files():
    return sorted(ARCS.glob("*/*.nda*"))


def generated_files(nda, folder):
    files = []
    for family in FAMILIES:
        files.append(folder / f"{family}.nda")
        with open(files[-1], "w") as out:
            subprocess.run([nda, "generate", family], stdout=out, check=True)
    return files


def solve(nda, path, *options):
    command = [nda, "solve", path, "-q", "--json", "--threads", "1", *options]
    result = subprocess.run(command, capture_output=True, text=True)
    return json.loads(result.stdout)["stats"] if result.returncode == 0 else None


def solve_seconds(nda, path, setting):
    return solve(nda, path, "--set", f"search.reductions={setting}")["solve_seconds"]


def quick_stats(nda, path):
    """Those of a solve that ends within QUICK_S; else None."""
    return solve(nda, path, "--time-limit", str(QUICK_S))


def fixing_table(stats):
    lines = ["| file | arcs | at first | in the end | dropped | taken | splits: parts |", "|" + 7 * "---|"]
    for path, known in stats.items():
        searches = known["searches"]
        lines.append(
            f"| {path.name.split('.nda')[0]} | {known['arcs_after_shift']} | {known['arcs_after_fixing']} | {known['arcs_left']} | "
            f"{searches['dropped']} | {searches['taken']} | {searches['splits']}: {searches['parts']} |"
        )
    return "\n".join(lines)


def times_table(nda, paths, runs):
    lines = ["| file | " + " | ".join(f"{setting}, ms" for setting in SETTINGS) + " |", "|---|---|---|---|"]
    logs = [0.0] * len(SETTINGS)
    for path in paths:
        least = [math.inf] * len(SETTINGS)
        for _ in range(runs):
            least = [min(time, solve_seconds(nda, path, setting)) for time, setting in zip(least, SETTINGS)]
        logs = [total + math.log(time) for total, time in zip(logs, least)]
        lines.append(f"| {path.name.split('.nda')[0]} | " + " | ".join(f"{1000 * time:.3g}" for time in least) + " |")
    means = [1000 * math.exp(total / len(paths)) for total in logs]
    lines.append("| geometric mean | " + " | ".join(f"{mean:.3g}" for mean in means) + " |")
    return "\n".join(lines)


PAGE = """# Reductions, measured

Written by `bench/reductions.py build/release --limit {limit:g}`; [the rules](../reductions.md) have a page of their own. Each table has one row a file: all those of
`../shared/data/arcs` and one of every generated family at its default parameters. Of problems with bounds on uses (`bounded`, `merged`) the rules see what no bound couples,
which may be nothing.

## Components as they come

All rules in turn until none does anything. *Outweighing + excluded*: arcs taken, and others that these exclude. *Single + unprofitable*: arcs that became
the cost of leaving their index alone, and others that cost no less. *Sides: arcs*: parts that hung on one index, and their arcs. *Settled quickly*: components
that `search.reductions=quick` settles; *settled*: those of which all rules leave nothing.

{first}

## What reduced costs leave

Components of more than 128 arcs, after 50 evaluations of the dual function and with the cost of the best solution found in {limit:g} s: what fixing leaves of
them, how many arcs it drops (to zero) and takes (to one), and into how many parts the rest falls. Components that these bounds prove optimal are left out.

{second}

## What fixing does in a solve

Of all files that are solved within {quick:g} s, [as a solve counts it](../reductions.md#what-a-solve-counts): the arcs that the cost shift leaves, those that reduced costs leave of whole
components *at first* and *in the end*, and what is fixed within branch and cut and its searches, where an arc counts at every node. What Lagrangian branch and bound (`--method exact`)
fixes at a root is in the table before.

{fixing}

## Time

Milliseconds to a proof on one core, the least of {runs} runs in turn, of all files that are solved within {quick:g} s; the others are left out.

{times}
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--limit", type=float, default=5)
    parser.add_argument("--runs", type=int, default=9)
    parser.add_argument("--no-write", action="store_true")
    parser.add_argument("patterns", nargs="*")
    arguments = parser.parse_args()
    nda = arguments.build / "nda"
    with tempfile.TemporaryDirectory() as folder:
        files = shared_files() + generated_files(nda, pathlib.Path(folder))
        files = [path for path in files if not arguments.patterns or any(p in path.name for p in arguments.patterns)]
        command = [arguments.build / "bench/reductions_benchmark", "--limit", str(arguments.limit), *files]
        first, second = subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip().split("\n\n")
        stats = {path: found for path in files if (found := quick_stats(nda, path))}
        fixing = fixing_table(stats)
        times = times_table(nda, list(stats), arguments.runs)
    page = PAGE.format(first=first, second=second, fixing=fixing, times=times, limit=arguments.limit, runs=arguments.runs, quick=QUICK_S)
    print(page)
    if not arguments.no_write:
        (ROOT / "docs/benchmarks/reductions.md").write_text(page, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
