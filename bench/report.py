#!/usr/bin/python3
"""The experiments of the AFOSR report (1995), section 5, again, with pictures.

    bench/report.py

builds the benchmarks, runs them and writes docs/report.md, docs/images/report-*.png and the sentence on tracking
instances in docs/nonsmooth.md.  Fails if a growth that the report calls linear is not (R^2 below 0.99).
Needs what scripts/test installs, and Debian's python3-matplotlib and python3-numpy.
"""

import csv
import io
import pathlib
import subprocess
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from shared import build, write_between

ROOT = pathlib.Path(__file__).resolve().parent.parent
BUILD = ROOT / "build/release"
PROGRAMS = ("report_benchmark", "dual_methods_benchmark", "exact_threshold_benchmark")
IMAGES = ROOT / "docs/images"
LEAST_R2 = 0.99
NONSMOOTH = ROOT / "docs/nonsmooth.md"
BEGIN, END = "<!-- tracking: bench/report.py -->\n", "<!-- end of tracking -->"


def output(*command):
    program = [BUILD / "bench" / command[0], *command[1:]]
    return subprocess.run(program, check=True, stdout=subprocess.PIPE, text=True).stdout


def run(experiment):
    """Rows of one experiment as dictionaries."""
    return list(csv.DictReader(io.StringIO(output("report_benchmark", experiment))))


def column(rows, name):
    return np.array([float(row[name]) for row in rows])


def fit(x, y):
    """Least-squares line and R^2."""
    slope, intercept = np.polyfit(x, y, 1)
    residual = y - (slope * x + intercept)
    return slope, intercept, 1 - residual.var() / y.var()


def draw_growth(rows, name, label, path):
    x = column(rows, name)
    figure, axes = plt.subplots(figsize=(6, 3.6))
    fits = []
    for key, text in (("total_ms", "whole"), ("collapse_ms", "cost evaluation (3.3)")):
        y = column(rows, key)
        slope, intercept, r2 = fit(x, y)
        fits.append(r2)
        points = axes.plot(x, y, "o", label=f"{text}, R² = {r2:.4f}")
        axes.plot(x, slope * x + intercept, color=points[0].get_color())
    axes.set(xlabel=label, ylabel="milliseconds", xlim=(0, None), ylim=(0, None))
    axes.legend()
    figure.tight_layout()
    figure.savefig(path, dpi=110)
    return fits


def growth_table(rows, name):
    lines = [f"| {name} | whole, ms | cost evaluation, ms |", "|---|---|---|"]
    lines += [
        f"| {row[name]} | {float(row['total_ms']):.2f} | {float(row['collapse_ms']):.2f} |" for row in rows
    ]
    return "\n".join(lines)


def verdict(r2):
    return f"{r2:.4f} ({'reached' if r2 >= LEAST_R2 else 'missed'})"


def growth_text(rows, name, fits):
    """Table, R^2 with verdicts, and how much of the time is cost evaluation."""
    whole, collapse = column(rows, "total_ms"), column(rows, "collapse_ms")
    share = 100 * collapse / whole
    slope = 100 * fit(column(rows, name), collapse)[0] / fit(column(rows, name), whole)[0]
    gap = whole - collapse
    return (
        f"{growth_table(rows, name)}\n\n"
        f"R² of the line through the whole times: {verdict(fits[0])}; through the cost evaluation: {verdict(fits[1])};"
        f" wanted: {LEAST_R2}.\n"
        f"The gap between the lines {'grows' if gap[-1] > gap[0] else 'shrinks'} from {gap[0]:.2f} to {gap[-1]:.2f} ms."
        f"  The cost evaluation takes {share[0]:.0f} % of the time at the first point,\n"
        f"{share[-1]:.0f} % at the last, and {slope:.0f} % of the growth."
    )


METHODS = (
    ("recovered_last", "recovered, last step"),
    ("recovered_every", "recovered, every step"),
    ("dual", "dual value"),
    ("greedy", "randomised greedy"),
)


def quality_table(rows):
    lines = ["| reading of the problem class | " + " | ".join(text for _, text in METHODS) + " |", "|---" * 5 + "|"]
    for reading in dict.fromkeys(row["reading"] for row in rows):
        chosen = [row for row in rows if row["reading"] == reading]
        cells = []
        for key, _ in METHODS:
            values = column(chosen, key)
            values = values[~np.isnan(values)]
            cells.append(f"{values.mean():.2f} ({values.min():.1f} .. {values.max():.1f}), {len(values)}")
        lines.append(f"| {reading} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def draw_quality(rows, path):
    chosen = [row for row in rows if row["reading"] == "dummies priced; costs shifted"]
    figure, axes = plt.subplots(figsize=(6, 3.6))
    for (key, text), marker in zip(METHODS[1:], "os^"):
        axes.plot(column(chosen, "problem"), column(chosen, key), marker, markersize=4, label=text)
    axes.axhline(100, color="black", linewidth=0.8)
    axes.set(xlabel="problem", ylabel="optimum = 100")
    axes.legend()
    figure.tight_layout()
    figure.savefig(path, dpi=110)


TEMPLATE = """# The report's experiments again

A. B. Poore, AFOSR final report 1995, section 5.  This page is written by `bench/report.py`; the times are those of the machine it
ran on, the shapes are what matters.  Every problem of three or more dimensions takes the same number of nonsmooth steps, recovery
follows the last, and at three dimensions every one, as the report describes.

## Section 4.3: which dual method for a fixed number of steps

The report: for a fixed small number of nonsmooth steps, say ten, bundle trust gives good solutions with the fewest evaluations.  On 20 tracking
instances (dense, crossing groups, sparse; largest component of each), every method starts at 0 and is stopped after so many
evaluations: distance of the bound below the best known, per cent, median and range, and on how many instances no other method is
better.  Confirmed means: lowest median, and best on more than half of the instances.

{methods}

## Section 4.7: up to what size to enumerate

The report: branch and bound for components of four or five arcs.  Time to a proof by size of the component: the default method, with enumeration
before everything else, and without it (relaxation, local search, branch and cut).  Time of the processor, least of three runs.  Of larger
components than the last row's some take minutes, either way.

{threshold}

## Figure 5.1: time against arcs

Four dimensions, 25 indices each on average, costs uniform in [-100, -1], 20 nonsmooth steps, means over 10 problems of the least
time of 25 runs, which go round all points in turn; time of the processor, of the cost evaluations by themselves.  The report:
linear growth, the cost evaluation dominates, the gap between the lines grows slightly.

![time against arcs](images/report-5.1.png)

{arcs}

## Figure 5.2: time against nonsmooth steps

100,000 arcs, measured the same way.  The report: linear.

![time against nonsmooth steps](images/report-5.2.png)

{steps}

## Figure 5.3: quality

Four dimensions, 7 indices each on average, a quarter of the tuples, costs uniform in [1, 100], 50 problems, relaxation run to convergence (at most 200
steps).  Optimum = 100 by exact search; mean, range, and number of problems with a feasible answer.  The report shows relaxation close to
100 with a small duality gap, and randomised greedy clearly worse.

{quality}

![quality](images/report-5.3.png)

The report does not say how its class is to be read.  With costs as given the optimum is a small sum of small costs, and everything relative to
it looks large: such figures do not agree with the report's small gaps.  Measured from the cost of the solution where every index stays alone (every
full tuple at 100), they do: dual value and recovered solutions lie within a few per cent of the optimum, provided that a
solution is recovered at every step; recovered from the last step alone they are no better than randomised greedy.
The picture shows the reading with priced dummies, costs shifted.
"""


def write_sentence(methods):
    """The last paragraph of section 4.3 stands in docs/nonsmooth.md too."""
    write_between(NONSMOOTH, BEGIN, END, methods.strip().split("\n\n")[-1] + "\n")


def main():
    IMAGES.mkdir(parents=True, exist_ok=True)
    build(*PROGRAMS)
    arcs, steps, quality = run("arcs"), run("steps"), run("quality")
    arcs_fit = draw_growth(arcs, "arcs", "arcs", IMAGES / "report-5.1.png")
    steps_fit = draw_growth(steps, "steps", "nonsmooth steps", IMAGES / "report-5.2.png")
    methods = output("dual_methods_benchmark")
    write_sentence(methods)
    draw_quality(quality, IMAGES / "report-5.3.png")
    text = TEMPLATE.format(
        methods=methods.strip(),
        threshold=output("exact_threshold_benchmark").strip(),
        arcs=growth_text(arcs, "arcs", arcs_fit),
        steps=growth_text(steps, "steps", steps_fit),
        quality=quality_table(quality),
    )
    (ROOT / "docs/report.md").write_text(text)
    print(text)
    if min(arcs_fit + steps_fit) < LEAST_R2:
        sys.exit(f"growth is not linear: R^2 below {LEAST_R2}")


if __name__ == "__main__":
    main()
