"""Performance profiles: of how many problems has a solver a proof, or a good solution, within so many times the best time of all."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from rivals.figures import OURS, SHIFT_S
from rivals.page import class_title, title

COLOURS = {"nda": "black", "highs": "tab:blue", "highs-program": "tab:purple", "cbc": "tab:orange", "glpk": "tab:green"}
STYLES = {"default": "-", "whole": ":", "parts": "--", "core": "-"}
LEAST_S = 1e-4  # of a proof; less than that counts as that
GOOD = 0.001
LARGEST_FACTOR = 1e4
LEAST_SHARE = 0.9  # of the problems: a profile of fewer, the easier ones as a rule, would mislead


def profile(times, least_s):
    """method -> (sorted factors to the best time, number of problems it ran on); times[name][method] or None."""
    factors, counts = {}, {}
    for row in times.values():
        proven = {method: max(least_s, time.seconds) for method, time in row.items() if time and time.proven}
        least = min(proven.values(), default=None)
        for method, time in row.items():
            counts[method] = counts.get(method, 0) + (time is not None)
            if method in proven:
                factors.setdefault(method, []).append(proven[method] / least)
    return {method: (sorted(factors.get(method, [])), count) for method, count in counts.items() if count}


def _panel(axes, times, least_s, label):
    for method, (factors, count) in profile(times, least_s).items():
        if count < LEAST_SHARE * len(times):
            continue
        shares = [(k + 1) / count for k in range(len(factors))]
        axes.step(
            [1, *factors, LARGEST_FACTOR],
            [0, *shares, shares[-1] if shares else 0],
            where="post",
            label=f"{title(method)} ({count})",
            color=COLOURS[method[0]],
            linestyle=STYLES[method[1]],
            linewidth=2 if method == OURS else 1,
        )
    axes.set(xscale="log", xlim=(1, LARGEST_FACTOR), ylim=(0, 1.02), xlabel="times the best", title=label)
    axes.grid(alpha=0.3)


def draw(results, folder):
    """docs/images/rivals-many.png and rivals-few.png."""
    methods = [OURS, *results.methods]
    folder.mkdir(parents=True, exist_ok=True)
    for many in (True, False):
        names = results.names(many)
        figure, panels = plt.subplots(1, 2, figsize=(10, 4), sharey=True)
        proofs = {name: {m: results.time(name, m) for m in methods} for name in names}
        _panel(panels[0], proofs, LEAST_S, f"proof, {class_title(many)}")
        good = {name: {m: results.target_time(name, m, GOOD) for m in methods} for name in names}
        _panel(panels[1], good, SHIFT_S, f"within {100 * GOOD:g} % of the best known")
        panels[0].set_ylabel("share of the problems")
        if names:
            panels[1].legend(fontsize=7, loc="lower right")
        figure.tight_layout()
        figure.savefig(folder / f"rivals-{'many' if many else 'few'}.png", dpi=110)
        plt.close(figure)
