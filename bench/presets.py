#!/usr/bin/python3
"""The algorithms of papers side by side, as presets, on a small problem of each benchmark family; writes docs/benchmarks/presets.md.

    bench/presets.py NDA [--time-limit S] [--no-write]

NDA is the program, of a Release build.  Everything is measured by `NDA compare --presets`, which verifies every solution; exit code 1 where two methods
contradict each other.  Takes some minutes at most.
"""

import argparse
import csv
import math
import pathlib
import subprocess
import sys
import tempfile

from shared import ROOT, processor

PAGE = ROOT / "docs/benchmarks/presets.md"


def measure(nda, limit_s):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "presets.csv"
        subprocess.run([nda, "compare", "--presets", "--time-limit", str(limit_s), "--csv", path], stdout=subprocess.DEVNULL, check=True)
        with open(path, encoding="utf-8") as file:
            return list(csv.DictReader(file))


def by_family(rows):
    families = {}
    for row in rows:
        families.setdefault(row["file"], {})[row["method"]] = row
    return families


def number(text):
    return float(text) if text else math.nan


def best(rows, column, choose):
    return choose(number(row[column]) for row in rows.values() if row[column])


def percent(value):
    return "" if math.isnan(value) else f"{100 * value:.2f}"


def excess(row, rows):
    least = best(rows, "cost", min)
    return percent((number(row["cost"]) - least) / abs(least))


def shortfall(row, rows):
    least = best(rows, "cost", min)
    return percent((least - number(row["lower_bound"])) / abs(least))


def seconds(row, rows):
    cut_off = row["status"] == "time_limit"
    return f"{number(row['seconds']):.3g}{' (cut off)' if cut_off else ''}"


def table(families, figure):
    methods = list(next(iter(families.values())))
    lines = ["| family | arcs | " + " | ".join(methods) + " |", "|---|--:|" + "--:|" * len(methods)]
    for family, rows in families.items():
        cells = [figure(rows[method], rows) for method in methods]
        lines.append(f"| {family} | {rows[methods[0]]['arcs']} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


TEXT = """# Presets, measured

Written by `bench/presets.py` on {processor}, one core, at most {limit:g} s each: `nda compare --presets`, [what they are](../presets.md). The problems are the
first of each [family](../families.md) that `nda generate` makes (`poore-5.1` with 2,000 arcs; `small`, `hard6` and `six-scan` are presets of the tracking families).

## Cost above the best known, %

{costs}

## Bound below the best known cost, %

{bounds}

## Seconds

Cut off: the limit of time ended it, so that more would have been better, or proven.

{times}
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("nda")
    parser.add_argument("--time-limit", type=float, default=10)
    parser.add_argument("--no-write", action="store_true")
    arguments = parser.parse_args()
    families = by_family(measure(arguments.nda, arguments.time_limit))
    page = TEXT.format(
        processor=processor(),
        limit=arguments.time_limit,
        costs=table(families, excess),
        bounds=table(families, shortfall),
        times=table(families, seconds),
    )
    print(page)
    if not arguments.no_write:
        PAGE.write_text(page, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
