"""From rows to figures: times, ratios, times to good solutions, and claims that cannot all be true.

A time is the median of the runs, those without a proof counting as endless.  A ratio says how many times as long a rival took as
nda; where only one of the two has a proof it is a bound: `>` where the rival has none, `<` where nda has none.
"""

import dataclasses
import math
import statistics

TARGETS = (0.01, 0.001, 0.0001)
CLEANLY_ENDED = ("optimal", "infeasible", "limit", "killed")
SHIFT_S = 0.01
MANY_ARCS = 5000
TINY_ARCS = 100
OURS = ("nda", "default")


@dataclasses.dataclass(frozen=True)
class Time:
    """Seconds to a proof, or, where `proven` is false, seconds that did not suffice."""

    seconds: float
    proven: bool

    def __str__(self):
        return f"{'' if self.proven else '>'}{seconds_text(self.seconds)}"


@dataclasses.dataclass(frozen=True)
class Ratio:
    value: float
    sign: str  # "", ">" at least, "<" at most

    def __str__(self):
        return f"{self.sign}{self.value:.3g}"

    @property
    def is_loss(self):
        return self.sign == "<" or self.value < 1 and self.sign == ""


def seconds_text(seconds):
    return f"{seconds:.2g}" if seconds < 0.1 else f"{seconds:.3g}"


def ratio(rival, own):
    """Ratio of two times; None where one is missing or neither has a proof."""
    if rival is None or own is None or not (rival.proven or own.proven):
        return None
    sign = ">" if not rival.proven else "<" if not own.proven else ""
    return Ratio(rival.seconds / max(1e-9, own.seconds), sign)


def best(times):
    """The least time with a proof; without any, what certainly did not suffice for the best of them."""
    proven = [time for time in times if time.proven]
    return min(proven or times, key=lambda time: time.seconds, default=None)


def geometric_mean(ratios):
    """Mean as a ratio: a bound where the members are bounds in one direction; None without members."""
    if not ratios:
        return None
    signs = {item.sign for item in ratios} - {""}
    value = math.exp(statistics.fmean(math.log(max(1e-9, item.value)) for item in ratios))
    return Ratio(value, signs.pop() if len(signs) == 1 else "" if not signs else "~")


def shifted_mean(seconds):
    """Geometric mean of seconds + SHIFT_S, less SHIFT_S: what is shorter than the clocks of logs does not count for much."""
    return math.exp(statistics.fmean(math.log(second + SHIFT_S) for second in seconds)) - SHIFT_S


def first_within(row, limit):
    """Second at which a run had a cost of at most `limit`; inf where it never had."""
    for second, cost in row.incumbents:
        if cost <= limit:
            return second
    return row.seconds if row.cost <= limit else math.inf


def tolerance(row, value):
    """What rounding and the absolute tolerances of the rivals may explain."""
    allowed = 1e-6 * max(1.0, abs(value))
    return allowed if row.solver == "nda" else allowed + 1e-6 * row.components


class Results:
    """All figures of the rows of a store."""

    def __init__(self, rows):
        self._groups = {}
        for row in rows:
            self._groups.setdefault(row.key, []).append(row)
        self.best_known = best_known(rows)
        self.about = {row.instance: row for row in rows}
        self.contradictions = contradictions(rows, self.best_known)
        self.failures = [row for row in rows if row.status not in CLEANLY_ENDED]
        self.programs = sorted({row.program for row in rows})
        self.machines = sorted({row.machine for row in rows})
        self.limits = {limit: sorted({row.solver for row in rows if row.limit_s == limit}) for limit in sorted({row.limit_s for row in rows})}

    @property
    def methods(self):
        """(solver, setup) of all rivals that ran."""
        found = {key[1:] for key in self._groups} - {OURS}
        order = ["highs", "highs-program", "cbc", "glpk"], ["whole", "parts", "core"]
        return sorted(found, key=lambda method: (order[0].index(method[0]), order[1].index(method[1])))

    def families(self):
        """family -> names of its problems, by number of arcs."""
        found = {}
        for name, row in sorted(self.about.items(), key=lambda item: (item[1].arcs, item[0])):
            found.setdefault(row.family, []).append(name)
        return dict(sorted(found.items()))

    def names(self, many):
        """Problems with at least MANY_ARCS arcs, or with fewer, that nda and a rival ran on."""
        return [
            name
            for name, row in self.about.items()
            if (row.arcs >= MANY_ARCS) == many and self.time(name, OURS) and self.best_rival(name)
        ]

    def _runs(self, name, method):
        """Runs that ended cleanly, the vain ones under the longest limit only."""
        rows = [row for row in self._groups.get((name, *method), []) if row.status in CLEANLY_ENDED]
        longest = max((row.limit_s for row in rows), default=0.0)
        return [row for row in rows if row.proven or row.limit_s == longest]

    def time(self, name, method):
        rows = self._runs(name, method)
        if not rows:
            return None
        median = statistics.median_low([row.seconds if row.proven else math.inf for row in rows])
        if math.isfinite(median):
            return Time(median, True)
        return Time(max(row.seconds for row in rows if not row.proven), False)

    def best_rival(self, name):
        return best([time for time in (self.time(name, method) for method in self.methods) if time])

    def target_time(self, name, method, share):
        """Median second at which the cost was within `share` of the best known; not proven: it was not."""
        rows = self._runs(name, method)
        if not rows:
            return None
        value = self.best_known[name]
        limit = value + share * abs(value) + 1e-9 * max(1.0, abs(value))
        median = statistics.median_low([first_within(row, limit) for row in rows])
        if math.isfinite(median):
            return Time(median, True)
        return Time(max(row.seconds for row in rows), False)

    def best_target_time(self, name, share):
        """The same of the fastest rival."""
        return best([time for time in (self.target_time(name, method, share) for method in self.methods) if time])

    def ratios(self, names, method):
        """Ratios of one rival, or of the best one where method is None."""
        found = (ratio(self.time(name, method) if method else self.best_rival(name), self.time(name, OURS)) for name in names)
        return [item for item in found if item]

    def losses(self, names):
        """Pairs (name, ratio) where the best rival was faster."""
        pairs = [(name, ratio(self.best_rival(name), self.time(name, OURS))) for name in names]
        return sorted([(name, item) for name, item in pairs if item and item.is_loss], key=lambda pair: pair[1].value)


def best_known(rows):
    """instance -> the least cost that anyone found or that is listed."""
    found = {}
    for row in rows:
        costs = [row.cost if row.status != "wrong" else math.inf, math.inf if math.isnan(row.best_known) else row.best_known]
        found[row.instance] = min(found.get(row.instance, math.inf), *costs)
    return found


def contradictions(rows, least):
    """Answers that are no solution, optima and bounds above what was found, infeasibility where there is a solution."""
    found = []
    for row in rows:
        who = f"{row.instance}: {row.solver} {row.setup}, run {row.run}:"
        value = least[row.instance]
        allowed = tolerance(row, value)
        if row.status == "wrong":
            found.append(f"{who} its answer is no solution {row.note}".rstrip())
        elif row.status == "infeasible" and math.isfinite(value):
            found.append(f"{who} infeasible, but there is a solution of cost {value:.10g}")
        elif row.status == "optimal" and row.cost > value + allowed:
            found.append(f"{who} claims the optimum {row.cost:.10g}, but {value:.10g} is known")
        elif row.bound > value + allowed:
            found.append(f"{who} claims the bound {row.bound:.10g}, but {value:.10g} is known")
    return found
