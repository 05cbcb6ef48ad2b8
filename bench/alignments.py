#!/usr/bin/python3
"""The experiments of the paper on partial branch and bound, again.

    bench/alignments.py [--seed N] [--time-limit S] [--page FILE]

On a hard problem of six scans: what plain relaxation finds against nonsmooth steps, with and without alignment selection; the same on
six more problems at convergence; the best and the 10th best of partial branch and bound, of Murty's rule and of exact ranking; run times, and
what the branching number costs.  Uses build/release/nda; needs Debian's python3-matplotlib.  Exit code 1 where an answer is refused
by `nda check`, is better than the proven optimum, or where partial branch and bound is worse than plain relaxation.
Tables go to standard output, or, with pictures beside it, into a page:

    bench/alignments.py --page docs/benchmarks/alignments.md
"""

import argparse
import collections
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

import shared

NDA = shared.ROOT / "build/release/nda"
PICTURE = shared.ROOT / "docs/images/alignments.png"
BEGIN, END = "<!-- tables: bench/alignments.py -->\n", "<!-- end -->\n"
STEPS = range(2, 81, 2)
BRANCHES = range(1, 11)
K = 10
TIE = 1e-9

Run = collections.namedtuple("Run", "costs bound seconds leaves proven")

RULES = {
    "plain": {"relaxation.alignment": "best_value"},
    "plain, selection": {"relaxation.alignment": "least_violation"},
    "partial": {"ranking.method": "alignments", "relaxation.alignment": "least_violation"},
    "partial, local search": {"ranking.method": "alignments", "relaxation.alignment": "least_violation",
                              "ranking.local_search": "true"},
    "Murty": {"ranking.method": "murty", "relaxation.alignment": "least_violation"},
}


class Solver:
    """Runs nda and keeps an eye on the answers."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        self.faults = []

    def generate(self, seed):
        path = self.folder / f"six-{seed}.nda"
        subprocess.run([NDA, "generate", "six-scan", "--seed", str(seed), "-o", path], check=True, stderr=subprocess.DEVNULL)
        return path

    def solve(self, path, *arguments):
        output = self.folder / "solution.json"
        subprocess.run([NDA, "solve", path, "--threads", "1", "-q", "-o", output, *map(str, arguments)],
                       check=False, stdout=subprocess.PIPE)
        if subprocess.run([NDA, "check", path, output], check=False, stdout=subprocess.PIPE).returncode != 0:
            self.faults.append(f"{path.name}, {arguments}: refused by nda check")
        solution = json.loads(output.read_text())
        ranks = solution["solutions"]
        return Run([rank["cost"] for rank in ranks], solution["lower_bound"], solution["stats"]["solve_seconds"],
                   solution["stats"]["recoveries"], sum(rank["proven"] for rank in ranks))

    def relax(self, path, rule, steps, branches=4):
        """The report's algorithm, recovering once, after so many steps at every stage."""
        settings = {"relaxation.max_evaluations": steps, "relaxation.recovery_evaluations": steps,
                    "relaxation.inner_evaluations": steps, "relaxation.recovery_interval": 1000000,
                    "ranking.branches": branches, **RULES[rule]}
        k = 1 if rule.startswith("plain") else K
        given = [text for name, value in settings.items() for text in ("--set", f"{name}={value}")]
        return self.solve(path, "--method", "relaxation", "--k", k, *given)


class Experiments:
    def __init__(self, solver, seed, limit):
        self.solver = solver
        self.path = solver.generate(seed)
        self.truth = solver.solve(self.path, "--k", K, "--time-limit", limit)
        self.by_steps = {rule: [solver.relax(self.path, rule, steps) for steps in STEPS] for rule in RULES}
        self.by_branches = [solver.relax(self.path, "partial", 50, branches) for branches in BRANCHES]
        self.more = {}
        for other in range(seed + 1, seed + 7):
            path = solver.generate(other)
            self.more[other] = (solver.solve(path, "--time-limit", limit), solver.relax(path, "plain", 500),
                                solver.relax(path, "plain, selection", 500))
        self.check()

    def check(self):
        faults = self.solver.faults
        for rule, runs in self.by_steps.items():
            for steps, run in zip(STEPS, runs):
                if self.truth.proven and run.costs[0] < self.truth.costs[0] - TIE * abs(self.truth.costs[0]):
                    faults.append(f"{rule}, {steps} steps: {run.costs[0]} is better than the optimum")
                if not rule.startswith("plain") and run.costs[0] > self.by_steps["plain, selection"][steps // 2 - 1].costs[0]:
                    faults.append(f"{rule}, {steps} steps: worse than plain relaxation")

    def quality(self, cost):
        """Of a cost below 0, in per cent of the best known."""
        return 100 * cost / self.truth.costs[0]

    def best(self, rule):
        return [self.quality(run.costs[0]) for run in self.by_steps[rule]]

    def tenth(self, rule):
        """Nothing where fewer were found."""
        return [self.quality(run.costs[K - 1]) if len(run.costs) >= K else float("nan") for run in self.by_steps[rule]]

    def seconds(self, rule):
        return [run.seconds for run in self.by_steps[rule]]


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|---" * len(head) + "|"]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def known(qualities):
    return [quality for quality in qualities if quality == quality]


def quality_table(experiments):
    rows = []
    for rule in RULES:
        for name, qualities in (("best", experiments.best(rule)), ("10th", experiments.tenth(rule))):
            if name == "10th" and rule.startswith("plain"):
                continue
            there, late = known(qualities), known(qualities[len(qualities) // 2:])
            rows.append([rule, name, f"{statistics.median(there):.2f}", f"{min(there):.2f}", f"{min(late):.2f}",
                         f"{sum(q >= 99 for q in there)}", f"{sum(q >= 98 for q in there)}", f"{sum(q < 95 for q in there)}",
                         f"{len(there)}"])
    return table(["method", "solution", "median quality, %", "worst", f"worst from {STEPS[len(STEPS) // 2]} steps", "runs at 99 % or more",
                  "at 98 % or more", "below 95 %", "of runs"], rows)


def truth_table(experiments):
    truth = experiments.truth
    proven = lambda rank: "proven" if truth.proven >= rank else "not proven"
    return table(["exact ranking", "cost", "quality, %", ""],
                 [["best", f"{truth.costs[0]:.6f}", "100", proven(1)],
                  ["10th", f"{truth.costs[K - 1]:.6f}", f"{experiments.quality(truth.costs[K - 1]):.2f}", proven(K)]])


def more_table(experiments):
    rows = []
    for seed, (truth, plain, selection) in experiments.more.items():
        share = lambda run: f"{100 * run.costs[0] / truth.costs[0]:.2f}"
        name = f"{truth.costs[0]:.4f}" + ("" if truth.proven else " (not proven)")
        rows.append([str(seed), name, f"{100 * plain.bound / truth.costs[0]:.2f}", share(plain), share(selection)])
    return table(["seed", "best known cost", "dual bound, % of it", "without selection, %", "with selection, %"], rows)


def time_table(experiments):
    plain = experiments.seconds("plain, selection")
    rows = []
    for rule in RULES:
        seconds = experiments.seconds(rule)
        ratio = statistics.median(own / other for own, other in zip(seconds, plain))
        rows.append([rule, f"{1000 * statistics.median(seconds):.1f}", f"{1000 * max(seconds):.1f}", f"{ratio:.2f}"])
    return table(["method", "median ms", "most ms", "median ratio to plain with selection"], rows)


def branch_table(experiments):
    rows = []
    for branches, run in zip(BRANCHES, experiments.by_branches):
        tenth = f"{experiments.quality(run.costs[K - 1]):.2f}" if len(run.costs) >= K else "fewer than 10 found"
        rows.append([str(branches), f"{experiments.quality(run.costs[0]):.2f}", tenth, f"{1000 * run.seconds:.1f}",
                     str(run.leaves), str(branches**4)])
    return table(["branches B", "best, %", "10th, %", "ms", "two-dimensional problems solved", "B^4"], rows)


def tables(experiments):
    return "\n".join([
        "### Quality over the number of steps\n",
        f"{len(STEPS)} runs of each, {STEPS[0]} to {STEPS[-1]} nonsmooth steps at every stage.\n", quality_table(experiments),
        truth_table(experiments), "### Six more problems, 500 steps\n", more_table(experiments),
        "### Run times\n", time_table(experiments), "### The branching number, 50 steps\n", branch_table(experiments),
    ])


def draw(experiments):
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(2, 3, figsize=(13, 7))
    panels = iter(axes.flat)

    def panel(title, across, up):
        axis = next(panels)
        axis.set(title=title, xlabel=across, ylabel=up)
        return axis

    def compare(title, curves, truth=None):
        axis = panel(title, "nonsmooth steps", "% of the optimum")
        for name, values in curves.items():
            axis.plot(STEPS, values, marker=".", label=name)
        if truth is not None:
            axis.axhline(truth, color="black", linewidth=0.8, linestyle=":", label="exact")
        axis.legend()

    e = experiments
    tenth = e.quality(e.truth.costs[K - 1])
    compare("Alignment selection", {"without": e.best("plain"), "with": e.best("plain, selection")}, 100)
    compare("Partial branch and bound, B = 4", {"best": e.best("partial"), "10th": e.tenth("partial"),
                                              "best, local search": e.best("partial, local search"), "plain": e.best("plain")}, tenth)
    compare("Best: Murty's rule and alignments", {"alignments": e.best("partial"), "Murty": e.best("Murty")}, 100)
    compare("10th: Murty's rule and alignments", {"alignments": e.tenth("partial"), "Murty": e.tenth("Murty")}, tenth)
    axis = panel("Run time", "nonsmooth steps", "ms")
    for rule in ("plain, selection", "partial"):
        axis.plot(STEPS, [1000 * seconds for seconds in e.seconds(rule)], marker=".", label=rule)
    axis.legend()
    axis = panel("Branching number, 50 steps", "B", "two-dimensional problems")
    axis.plot(BRANCHES, [run.leaves for run in e.by_branches], marker=".", label="solved")
    axis.plot(BRANCHES, [branches**4 for branches in BRANCHES], marker=".", label="B^4")
    axis.set_yscale("log")
    twin = axis.twinx()
    twin.plot(BRANCHES, [1000 * run.seconds for run in e.by_branches], color="green", marker=".", label="ms")
    twin.set_ylabel("ms")
    axis.legend(loc="upper left")
    twin.legend(loc="lower right")
    figure.tight_layout()
    figure.savefig(PICTURE, dpi=90)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, default=4, help="of the six-scan problem; those that follow are the six more")
    parser.add_argument("--time-limit", type=float, default=60, help="of exact ranking")
    parser.add_argument("--page", type=pathlib.Path, help="write the tables into this page, and the picture")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        experiments = Experiments(Solver(folder), arguments.seed, arguments.time_limit)
    if arguments.page:
        shared.write_between(arguments.page, BEGIN, END, tables(experiments))
        draw(experiments)
    else:
        print(tables(experiments))
    for fault in experiments.solver.faults:
        print(fault, file=sys.stderr)
    return 1 if experiments.solver.faults else 0


if __name__ == "__main__":
    sys.exit(main())
