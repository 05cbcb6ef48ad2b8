#!/usr/bin/python3
"""The family of relaxations: gap closed against time, merit function, order of sets, cost shift; writes docs/benchmarks/relaxations.md.

    bench/relaxations.py [--seeds N] [--no-write]

builds what it needs; the page says what is measured.  Needs Debian's python3-matplotlib.
"""

import argparse
import json
import pathlib
import subprocess
import sys
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from shared import ROOT, build, processor

PAGE = ROOT / "docs/benchmarks/relaxations.md"
IMAGE = ROOT / "docs/images/relaxations.png"
OPTIMUM_LIMIT_S = 20
LIMIT_S = 10
EVALUATIONS = 60
LEAST_SHOWN = -50  # per cent, in the picture

FAMILIES = {
    "poore-5.1, 300 arcs": ["poore-5.1", "--arcs", "300"],
    "poore-5.3": ["poore-5.3"],
    "six-scan": ["six-scan", "--targets", "16", "--cap", "60"],
    "groups": ["groups", "--scans", "5", "--targets", "18", "--cap", "60"],
    "tracking": ["tracking", "--scans", "5", "--targets", "40", "--side", "500"],
    "gadgets": ["gadgets"],
}
MIXED_SIZES = {
    "poore-5.1, sizes 10 to 40": ["poore-5.1", "--arcs", "400", "--min-size", "10", "--max-size", "40"],
    "poore-5.3, sizes 4 to 10": ["poore-5.3", "--min-size", "4", "--max-size", "10"],
    "groups": FAMILIES["groups"],
}
PRICED = {
    "poore-5.3": ["poore-5.3"],
    "poore-5.3, size 10": ["poore-5.3", "--min-size", "10", "--max-size", "10"],
    "planted, priced": ["planted", "--size", "50", "--arcs", "2000", "--singletons", "priced"],
}
INEXACT = {"kept_exact_arcs": 0, "two_first": "false"}
MEMBERS = {
    "m = 0": {"kept_sets": 0},
    "m = 1": {"kept_sets": 1},
    "m = 2": {"kept_sets": 2},
    "m = 3, exact": {"kept_sets": 3},
    "m = 4, exact": {"kept_sets": 4},
    "m = N - 1, exact": {"kept_sets": 64},
    "m = 3, merit": {"kept_sets": 3, **INEXACT},
    "m = 3, no merit": {"kept_sets": 3, "merit": "false", **INEXACT},
    "m = N - 1, merit": {"kept_sets": 64, **INEXACT},
    "m = N - 1, no merit": {"kept_sets": 64, "merit": "false", **INEXACT},
}
ORDERS = ["as_given", "largest_first", "most_conflicting_first", "probe"]


class Instances:
    """Files of a family with their optimum, or best cost known, and the value of the linear relaxation, nearly."""

    def __init__(self, nda, folder, name, arguments, seeds):
        self.files = []
        for seed in range(1, seeds + 1):
            path = folder / f"{name.split(',')[0].replace(' ', '')}-{len(list(folder.iterdir()))}.nda"
            subprocess.run([nda, "generate", *arguments, "--seed", str(seed), "-o", path], check=True, stderr=subprocess.DEVNULL)
            self.files.append(path)
        best = [solve(nda, path, OPTIMUM_LIMIT_S, []) for path in self.files]
        self.optima = [answer["cost"] for answer in best]
        self.proven = sum(answer["proven"] for answer in best)
        self.seconds = mean([answer["stats"]["solve_seconds"] for answer in best])
        self.linear = [relax(nda, path, {}, 1000)["lower_bound"] for path in self.files]


def mean(values):
    return sum(values) / len(values)


def solve(nda, path, limit, settings):
    command = [nda, "solve", path, "-q", "--json", "--threads", "1", "--time-limit", str(limit)]
    for setting in settings:
        command += ["--set", setting]
    return json.loads(subprocess.run(command, capture_output=True, text=True).stdout)


def relax(nda, path, options, evaluations=EVALUATIONS):
    settings = [f"relaxation.{name}={value}" for name, value in options.items()]
    return solve(nda, path, LIMIT_S, ["method=relaxation", f"relaxation.max_evaluations={evaluations}", *settings])


def per_cent_below(value, optimum):
    return 100 * (optimum - value) / max(1e-9, abs(optimum))


def closed(answers, instances):
    """Per cent of the gaps between linear relaxation and optimum, all together; None where there is hardly any."""
    gap = sum(instances.optima) - sum(instances.linear)
    if gap <= 1e-6 * abs(sum(instances.optima)):
        return None
    return 100 * (sum(answer["lower_bound"] for answer in answers) - sum(instances.linear)) / gap


def measure(nda, instances, options):
    answers = [relax(nda, path, options) for path in instances.files]
    stats = [answer["stats"] for answer in answers]
    return {
        "below": mean([per_cent_below(a["lower_bound"], o) for a, o in zip(answers, instances.optima)]),
        "closed": closed(answers, instances),
        "above": mean([per_cent_below(o, a["cost"]) * abs(a["cost"] / o) for a, o in zip(answers, instances.optima)]),
        "seconds": mean([s["solve_seconds"] for s in stats]),
        "evaluations": mean([s["dual_evaluations"] for s in stats]),
        "nodes": mean([s["nodes"] for s in stats]),
    }


def shown(value):
    return "-" if value is None else f"{value:.3g}"


def members_table(nda, families):
    lines = ["| family | relaxation | bound below optimum, % | gap closed, % | cost above, % | seconds | evaluations | nodes |",
             "|---|---|--:|--:|--:|--:|--:|--:|"]
    points = {}
    for name, instances in families.items():
        for member, options in MEMBERS.items():
            row = measure(nda, instances, options)
            points[name, member] = row
            cells = [row[key] for key in ("below", "closed", "above", "seconds", "evaluations", "nodes")]
            lines.append(f"| {name} | {member} | " + " | ".join(map(shown, cells)) + " |")
        solved = f"{instances.proven} of {len(instances.files)} proven"
        lines.append(f"| {name} | the default: {solved} | | | | {shown(instances.seconds)} | | |")
    return "\n".join(lines), points


def draw(points):
    names = [name for name in FAMILIES if any(points[name, member]["closed"] is not None for member in MEMBERS)]
    figure, axes = plt.subplots(2, (len(names) + 1) // 2, figsize=(9, 6), sharex=True, sharey=True, squeeze=False)
    for axis, name in zip(axes.flat, names):
        for number, member in enumerate(MEMBERS):
            row = points[name, member]
            if row["closed"] is not None:
                axis.plot(row["seconds"], max(LEAST_SHOWN, row["closed"]), "o^sDvPX*<>"[number], label=member)
        axis.axhline(0, color="grey", linewidth=0.8)
        axis.set(title=name, xscale="log")
    figure.supxlabel("seconds")
    figure.supylabel("gap closed beyond linear relaxation, %")
    figure.legend(*axes[0][0].get_legend_handles_labels(), loc="center right", fontsize=8)
    figure.tight_layout(rect=(0, 0, 0.84, 1))
    figure.savefig(IMAGE, dpi=110)


def orders_table(nda, families):
    lines = ["| family | m | order of both | bound below optimum, % | cost above, % | evaluations |", "|---|--:|---|--:|--:|--:|"]
    for name, instances in families.items():
        for kept in (2, 3):
            for order in ORDERS:
                row = measure(nda, instances, {"kept_sets": kept, "set_order": order, "recovery_order": order})
                lines.append(f"| {name} | {kept} | {order} | {shown(row['below'])} | {shown(row['above'])} | {shown(row['evaluations'])} |")
    return "\n".join(lines)


def default_table(nda, families):
    lines = ["| family | proven with two kept sets | seconds | proven with three | seconds |", "|---|--:|--:|--:|--:|"]
    for name, instances in families.items():
        cells = []
        for kept in (2, 3):
            answers = [solve(nda, path, OPTIMUM_LIMIT_S, [f"relaxation.kept_sets={kept}"]) for path in instances.files]
            cells += [f"{sum(a['proven'] for a in answers)} of {len(answers)}", shown(mean([a["stats"]["solve_seconds"] for a in answers]))]
        lines.append(f"| {name} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


TEXT = """# Relaxations, measured

Written by `bench/relaxations.py` on {processor}, one core; [what they are](../relaxations.md). Means over {seeds} instances of each family, at most {evaluations}
evaluations of the dual function in question and {limit} s. *Bound below optimum*: in per cent of the optimum, or of the best cost known where the
default does not prove one in {optimum_limit} s. *Gap closed*: of that between the linear relaxation, as 1000 evaluations with two kept sets give it, and the
optimum, all instances together; negative where the bound falls short of the linear relaxation. *Cost above*: of the recovered solution. Evaluations and nodes are those of all levels.

## Gap closed against time

*Exact*: relaxed problems are solved exactly up to 2000 arcs and 100000 nodes each time, from the best multipliers of two kept sets. *Merit, no merit*: by relaxation
alone, from 0, with and without the merit function.

{members}

Below -50 % points are drawn at -50 %.

![Gap closed against time](../images/relaxations.png)

## Three kept sets in the default pipeline

The same instances by the default method, which begins with two kept sets, or with three.

{default}

## Order of sets

The order of the component's sets and of those of recovery problems, with the same limit of evaluations; probes come on top of it, uncounted.

{orders}

## Cost shift

`bench/cost_shift_benchmark`: per cent of the dual's rise that is left after so many evaluations of bundle trust from 0, with two kept sets, where costs are as they are, where the
singletons are shifted to zero, and where on top of that the most negative cost is.

{shift}
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", type=int, default=4)
    parser.add_argument("--no-write", action="store_true")
    arguments = parser.parse_args()
    programs = build("nda", "nda_cli", "cost_shift_benchmark")
    nda = programs.parent / "nda"
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        make = lambda families: {key: Instances(nda, folder, key, value, arguments.seeds) for key, value in families.items()}
        families = make(FAMILIES)
        members, points = members_table(nda, families)
        priced = [path for instances in make(PRICED).values() for path in instances.files]
        shift = subprocess.run([programs / "cost_shift_benchmark", *priced], check=True, stdout=subprocess.PIPE, text=True).stdout.strip()
        page = TEXT.format(processor=processor(), seeds=arguments.seeds, evaluations=EVALUATIONS, limit=LIMIT_S, optimum_limit=OPTIMUM_LIMIT_S,
                           members=members, default=default_table(nda, families), orders=orders_table(nda, make(MIXED_SIZES)), shift=shift)
    print(page)
    if not arguments.no_write:
        PAGE.write_text(page, encoding="utf-8")
        draw(points)
    return 0


if __name__ == "__main__":
    sys.exit(main())
